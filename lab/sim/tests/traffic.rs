//! Many random runs with a stand-in ego: nobody collides, nobody enters what was not granted, traffic
//! flows, and most egos arrive.

use mufasa_sim::collision::overlap;
use mufasa_sim::map::given::Given;
use mufasa_sim::map::route::{Route, RouteKind};
use mufasa_sim::map::{Town, conflicts, streets};
use mufasa_sim::path::Path;
use mufasa_sim::pose::Point;
use mufasa_sim::scenario::Scenario;
use mufasa_sim::traffic::agent::{Agent, Kind};
use mufasa_sim::traffic::{ahead, give_way};
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
        let command = crate::common::drive(&world);
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

/// Two roads that cross after 100 m, the ego and somebody who was granted the way, both before their lines: how
/// many passages each has then.
fn granted(lets_ego_go: bool, ego: (f64, f64, f64), other: (f64, f64)) -> [usize; 2] {
    let line = |from: Point, to: Point| {
        let path = Path::new(vec![from, to]).unwrap().resampled(1.0).unwrap();
        Route::new("road", RouteKind::Road, path, 1.75, 10.0)
    };
    let along = line(Point::new(-100.0, 0.0), Point::new(100.0, 0.0));
    let across = line(Point::new(0.0, -100.0), Point::new(0.0, 100.0));
    let given = Given { lets_ego_go, ..Given::default() };
    let mut town = Town { routes: vec![along, across], given, ..Town::default() };
    conflicts::compute(&mut town);
    let before = |route: usize, room: f64| town.routes[route].passages[0].from - room - 2.5;
    let mut agents = vec![
        Agent::new(0, Kind::Ego, &town, 0, before(0, ego.0), (5.0, 1.8)),
        Agent::new(1, Kind::Car, &town, 1, before(1, other.0), (5.0, 1.8)),
    ];
    (agents[0].speed, agents[0].acceleration, agents[1].speed) = (ego.1, ego.2, other.1);
    agents[1].granted = 1;
    assert_eq!(give_way::grant(&mut agents, &town, 0.0, 0.0), 0);
    [agents[0].granted, agents[1].granted]
}

#[test]
fn others_let_the_ego_go_that_goes_if_they_can_still_stop() {
    assert_eq!(granted(true, (1.0, 0.5, 1.5), (2.0, 1.0)), [1, 0], "it goes");
    assert_eq!(granted(true, (1.0, 0.5, 1.5), (0.2, 1.0)), [1, 1], "too late to stop");
    assert_eq!(granted(true, (1.0, 0.5, -1.0), (2.0, 1.0)), [0, 1], "it brakes");
    assert_eq!(granted(true, (1.0, 0.2, 1.5), (2.0, 1.0)), [0, 1], "it has hardly moved");
    assert_eq!(granted(true, (6.0, 0.5, 1.5), (2.0, 1.0)), [0, 1], "it is not there yet");
    assert_eq!(granted(false, (1.0, 0.5, 1.5), (2.0, 1.0)), [0, 1], "not on every map");
}
