//! H-01: which tracks may be left out, and what remains.

use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_model::report::{Rule, Stage};
use mufasa_model::services::configuration::Configuration::MotRemote;

use crate::base::*;

/// Stage i alone: tracks that stand at (x, y), detections there, and what the CAV saw before of
/// `backed`.
fn cycle(at: &[[f64; 2]], seen: &[[f64; 2]], backed: &[[f64; 2]]) -> Cycle {
    let mut cycle = base(Profile::HARDENED, MotRemote);
    cycle.trajectory = None;
    let items = (1..).zip(at).map(|(id, [x, y])| track(id, *x, *y));
    cycle.tracks = tracks(items.collect());
    cycle.detections = detections(seen.iter().map(|[x, y]| detection(*x, *y)).collect());
    let objects: Vec<[f64; 4]> = backed.iter().map(|[x, y]| [*x, *y, 0.0, 0.0]).collect();
    cycle.detection_history = history(&objects);
    cycle
}

const FAR: [f64; 2] = [90.0, 0.0];
const A: [f64; 2] = [20.0, 5.0];
const B: [f64; 2] = [40.0, 5.0];

/// H-01.2.
#[test]
fn at_most_miss_budget_tracks_are_left_out() {
    let with = |budget: i64| {
        let backed = [B, [40.0, -5.0], [30.0, -5.0]];
        let mut cycle = cycle(&[A, backed[0], backed[1], backed[2]], &[A, FAR], &backed);
        cycle.parameters.miss_budget = budget;
        rule(&cycle, Stage::I)
    };
    assert_eq!(with(3), None);
    assert_eq!(with(2), Some(Rule::NoAssignment));
}

/// The mean is that of what remains: a track left out makes it neither better nor worse.
/// H-01.4.
#[test]
fn the_mean_is_that_of_what_remains() {
    // A is 0.3 m off, B exact; C is gone, and backed.
    let c = [30.0, -5.0];
    let off = [20.0, 5.3];
    let with = |at: &[[f64; 2]], seen: &[[f64; 2]], theta_tr: f64| {
        let mut cycle = cycle(at, seen, &[c]);
        cycle.parameters.theta_tr = theta_tr;
        cycle.detections.as_mut().expect("set").items.push(detection(90.0, 0.0));
        rule(&cycle, Stage::I)
    };
    assert_eq!(with(&[A, B, c], &[off, B], 0.151), None);
    assert_eq!(with(&[A, B, c], &[off, B], 0.149), Some(Rule::MeanCost));
    assert_eq!(with(&[A, B], &[off, B], 0.149), Some(Rule::MeanCost));
    // Of what may be left out the worst is: here the backed track that is 0.3 m off.
    let backed_off = |budget: i64, theta_tr: f64| {
        let mut cycle = cycle(&[A, B], &[off, B, FAR], &[A]);
        (cycle.parameters.miss_budget, cycle.parameters.theta_tr) = (budget, theta_tr);
        rule(&cycle, Stage::I)
    };
    assert_eq!(backed_off(0, 0.149), Some(Rule::MeanCost));
    assert_eq!(backed_off(1, 0.149), None);
    assert_eq!(backed_off(1, 0.001), None, "B alone is exact");
}
