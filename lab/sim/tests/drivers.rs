//! The driver model against its formula.

use mufasa_sim::map::route::{Route, RouteKind};
use mufasa_sim::map::{Lane, Town};
use mufasa_sim::path::Path;
use mufasa_sim::pose::Point;
use mufasa_sim::scenario::{Scenario, Start};
use mufasa_sim::traffic::idm::Idm;
use mufasa_sim::vehicle::Command;
use mufasa_sim::world::World;

/// One straight street of 3 km, and one far from it for an ego that stands.
fn street() -> Town {
    let line = |y: f64| {
        Path::new(vec![Point::new(0.0, y), Point::new(3000.0, y)]).unwrap().resampled(1.0).unwrap()
    };
    let route = |y: f64| Route::new("street", RouteKind::Road, line(y), 1.75, 20.0);
    let lanes = vec![Lane { path: line(0.0), width: 3.5 }];
    Town { lanes, routes: vec![route(0.0), route(500.0)], ..Town::default() }
}

fn scenario(actors: Vec<Start>) -> Scenario {
    Scenario {
        ego_route: 1,
        ego_s: 10.0,
        ego_speed: 0.0,
        actors,
        walkers: Vec::new(),
        signal_offset: 0.0,
        refill: false,
        time_limit: 60.0,
    }
}

fn car(s: f64, speed: f64, idm: Idm) -> Start {
    Start { route: 0, s, speed, length: 5.0, width: 1.8, idm, halts: Vec::new() }
}

const STAY: Command = Command { acceleration: 0.0, steering: 0.0 };

#[test]
fn the_gap_settles_where_the_formula_says() {
    let town = street();
    for speed in [3.0, 6.0, 9.0] {
        let follower = Idm::default();
        let lead = Idm { v0: speed, ..follower };
        let mut world = World::new(
            &town,
            &scenario(vec![car(100.0, speed, lead), car(60.0, speed, follower)]),
            0,
        );
        for _ in 0..12_000 {
            world.step(STAY);
        }
        let (lead, back) = (&world.agents()[1], &world.agents()[2]);
        // Equilibrium: s_e = (s0 + v T) / sqrt(1 - (v/v0)^4), written out here.
        let share = speed / follower.v0;
        let wanted = (2.0 + 1.5 * speed) / (1.0 - share * share * share * share).sqrt();
        assert!((back.speed - speed).abs() < 0.01, "{} {speed}", back.speed);
        assert!(
            (lead.rear() - back.front() - wanted).abs() < 0.05,
            "{} {wanted}",
            lead.rear() - back.front()
        );
        assert!(follower.behind(speed, wanted, speed).abs() < 1e-12);
    }
}
