//! Many random runs with a stand-in ego: nobody else collides, traffic flows, the ego arrives.

mod common;

use mufasa_sim::map::Town;
use mufasa_sim::map::streets;
use mufasa_sim::scenario::Scenario;
use mufasa_sim::world::World;

struct Outcome {
    arrived: Option<f64>,
    way: f64,
    agents: usize,
    off_road: bool,
}

fn run(town: &Town, route: usize, seed: u64) -> Outcome {
    let scenario = Scenario::draw(town, route, 30, seed);
    let mut world = World::new(town, &scenario, seed);
    let mut outcome =
        Outcome { arrived: None, way: 0.0, agents: scenario.actors.len(), off_road: false };
    for step in 0..6000 {
        let command = common::drive(town, &world);
        world.step(command);
        outcome.way += world.agents()[1..].iter().map(|a| a.speed * 0.01).sum::<f64>();
        if outcome.arrived.is_none() {
            outcome.off_road |= world.is_off_road();
            if world.has_arrived() {
                outcome.arrived = Some(f64::from(step) * 0.01);
            }
        }
        if step % 5 == 0 {
            let pairs = world.collisions_of_others();
            if !pairs.is_empty() || world.collision().is_some() {
                let ids = pairs.first().copied().unwrap_or((0, world.collision().unwrap_or(0)));
                for a in world.agents().iter().filter(|a| a.id == ids.0 || a.id == ids.1) {
                    eprintln!(
                        "{} {:?} s {:.1} v {:.1} a {:.1} granted {} cleared {} {:?} {:?}",
                        town.routes[a.route].name,
                        a.kind,
                        a.s,
                        a.speed,
                        a.acceleration,
                        a.granted,
                        a.cleared,
                        town.routes[a.route].passages,
                        a.rectangle.pose.at
                    );
                }
                panic!(
                    "seed {seed} route {route} step {step}: {pairs:?} {:?} forced {}",
                    world.collision(),
                    world.forced()
                );
            }
        }
    }
    assert_eq!(world.forced(), 0, "seed {seed}");
    outcome
}

#[test]
fn nobody_collides() {
    let town = streets::town();
    for route in town.ego_routes() {
        let (mut arrived, mut way, mut agents, mut off, mut time) = (0, 0.0, 0, 0, 0.0);
        for seed in 0..100 {
            let outcome = run(&town, route, seed);
            arrived += i32::from(outcome.arrived.is_some());
            time += outcome.arrived.unwrap_or(0.0);
            off += i32::from(outcome.off_road);
            way += outcome.way;
            agents += outcome.agents;
        }
        eprintln!(
            "route {route}: arrived {arrived} mean {:.1} s, off road {off}, agents {agents}, mean speed of others {:.2}",
            time / f64::from(arrived),
            way / 60.0 / agents as f64
        );
    }
}
