//! H-14, `spec/hardened/H-14.md`: what no vector shows, in the three readings.

mod excess;
mod following;
mod goes_along;
mod meeting;
mod motions;
mod path;
mod reach;
mod returns;
mod road;
mod route_bends;
mod times;
mod widening;

use mufasa_model::input::cycle::{Cycle, Track};
use mufasa_model::input::scene::Scene;
use mufasa_model::report::{Outcome, Reading, Rule, Stage, Witness};
use mufasa_model::services::configuration::Configuration::MotRemote;

use crate::base::*;

/// A track of a current list is the only object; stage iv does not run. The CAV at 8 m/s takes 0.5 s and
/// 4.5 m before it brakes, at 10 m/s, and stands after 1.75 s and 10.75 m; s_b(8) = 4.
fn alone(cycle: &mut Cycle, track: Track) {
    (cycle.configuration, cycle.ego.speed) = (MotRemote, 8.0);
    (cycle.parameters.tau, cycle.parameters.a_max) = (0.5, 4.0);
    cycle.tracks = tracks(vec![track]);
    cycle.detections = None;
}

fn scene(cycle: &Cycle, reading: Reading) -> Scene {
    Scene::new(cycle, reading)
}

/// The witness of H-14, if it failed; no other rule did in stage iv.
fn found(cycle: &Cycle) -> Option<Witness> {
    match outcome(cycle, Stage::Iv) {
        Outcome::Failed(witness) => {
            assert_eq!(witness.rule, Rule::FailSafe);
            Some(witness)
        }
        _ => None,
    }
}
