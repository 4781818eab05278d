//! Many random runs with a stand-in ego: nobody collides, nobody enters what was not granted, traffic
//! flows, and most egos arrive.

mod common;

use mufasa_sim::collision::overlap;
use mufasa_sim::map::Town;
use mufasa_sim::map::streets;
use mufasa_sim::scenario::Scenario;
use mufasa_sim::traffic::ahead;
use mufasa_sim::world::World;

/// What runs of 60 s showed.
#[derive(Default)]
struct Outcome {
    arrived: u32,
    off_road: u32,
    way: f64,
    leads: u32,
    halts: u32,
    others: u32,
}

fn run(town: &Town, route: usize, seed: u64, outcome: &mut Outcome) {
    let scenario = Scenario::draw(town, route, 30, seed);
    let mut world = World::new(town, &scenario, seed);
    let starts = world.agents();
    for (index, a) in starts.iter().enumerate() {
        assert!(
            starts[index + 1..].iter().all(|b| !overlap(&a.rectangle, &b.rectangle)),
            "seed {seed}"
        );
    }
    outcome.others += u32::try_from(starts.len()).unwrap() - 1;
    outcome.leads += u32::from(ahead::nearest(starts, 0, world.route(), 80.0).is_some());
    outcome.halts += scenario.actors.iter().map(|a| u32::from(!a.halts.is_empty())).sum::<u32>();
    let mut arrived = false;
    // The first tenth runs until the ego has arrived, and it must.
    for step in 0..if seed < 10 { 12000 } else { 6000 } {
        let command = common::drive(&world);
        world.step(command);
        outcome.way += world.agents()[1..].iter().map(|a| a.speed * 0.01).sum::<f64>();
        arrived |= world.has_arrived();
        outcome.off_road += u32::from(!arrived && world.is_off_road());
        if step % 5 == 0 {
            let (ego, others) = (world.collision(), world.collisions_of_others());
            assert!(
                ego.is_none() && others.is_empty(),
                "seed {seed}, step {step}: {ego:?} {others:?}"
            );
        }
    }
    assert_eq!(world.forced(), 0, "seed {seed}");
    assert!(arrived || seed >= 10, "seed {seed} is late");
    outcome.arrived += u32::from(arrived);
}

/// 100 seeds on a route. Others travel 3 m/s on average at least: a town in which all stand is not free
/// of collisions for a good reason.
fn check(route: usize, least: u32) {
    let town = streets::town();
    assert_eq!(town.ego_routes().collect::<Vec<_>>(), [0, 1]);
    let mut outcome = Outcome::default();
    for seed in 0..100 {
        run(&town, route, seed, &mut outcome);
    }
    let speed = outcome.way / 66.0 / f64::from(outcome.others);
    let Outcome { arrived, off_road, leads, halts, others, .. } = outcome;
    eprintln!(
        "route {route}: {arrived} arrived, {leads} leads, {halts} halts, {others} others at {speed:.1} m/s"
    );
    assert_eq!(off_road, 0);
    assert!(arrived >= least && leads >= 60 && halts >= 20 && others >= 2800 && speed > 3.0);
}

#[test]
fn nobody_collides_on_the_straight_route() {
    check(0, 50);
}

#[test]
fn nobody_collides_on_the_route_with_turns() {
    check(1, 15);
}
