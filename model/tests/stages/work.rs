//! `spec/4-arithmetic.md#conformance-of-an-implementation`: a cycle that needs more than 10^10
//! comparisons is an error.

use mufasa_model::cycle::{check, readings};
use mufasa_model::input::cycle::{Cycle, DetectionList, Profile, Track};
use mufasa_model::report::{InvalidInput, Outcome, Reading, Rule, Stage};
use mufasa_model::services::configuration::Configuration::PlanRemote;

use crate::base::*;

/// 2000 detections, as many in the reference list and `others` in another one: H-14 needs 2000 * 2000
/// (2000 + others + 32 places + 51 points) comparisons and (32 + 2 * 2000 * 2000) * 2 with the route, the rest
/// of the cycle (51 + 32) * 2 + 51 * 2000.
/// The strict reading makes none of H-14, whose work is above work_limit.
fn crowded(others: usize) -> Cycle {
    let mut cycle = base(Profile::HARDENED, PlanRemote);
    (cycle.tracks, cycle.parameters.work_limit) = (None, 0);
    cycle.detections = detections(vec![detection(60.0, 0.0); 2000]);
    let list = |ms: i64, count: usize| DetectionList {
        stamp_ns: NOW - ms * 1_000_000,
        items: vec![detection(60.0, 0.0); count],
    };
    cycle.detection_history = vec![list(300, others), list(500, 2000)];
    cycle
}

/// MARGIN-09.
#[test]
fn more_than_ten_to_the_ten_comparisons_are_an_error() {
    let strict = check(&crowded(412), Reading::Strict).expect("not too much work");
    assert!(matches!(&strict.stages[3], Outcome::Failed(it) if it.rule == Rule::WorkLimit));
    for reading in [Reading::Strict, Reading::Exact, Reading::Lax] {
        let error = check(&crowded(413), reading).expect_err("too much work");
        let InvalidInput { field, index, message } = error;
        assert_eq!((field.as_str(), index), ("work", None));
        assert!(message.contains("10000102230 comparisons"), "{message}");
    }
    assert!(readings(&crowded(413)).is_err());
}

/// Work that no stage comes to is not counted.
#[test]
fn only_what_a_stage_is_about_to_do_counts() {
    let mut cycle = crowded(413);
    cycle.ego.y = 2.5;
    assert_eq!(rule(&cycle, Stage::Ii), Some(Rule::Position));
    let mut paper = crowded(413);
    paper.profile = Profile::PAPER;
    assert!(passes(&paper, Stage::Iv));
    // The gap fails stage iv before H-14 is come to.
    let mut near = crowded(413);
    near.lead = lead(0.0, 0.0);
    assert_eq!(rule(&near, Stage::Iv), Some(Rule::Gap));
}

/// H-14.51, H-14.52: at the default limit conformance asks for the answer in dense traffic: twelve vehicles around
/// the CAV, each with a track and seen four times, take more than a twentieth of it and less than all.
#[test]
fn the_default_limit_bears_dense_traffic() {
    let places = [20.0, 34.0, -14.0, -28.0].map(|x| (x, 0.0));
    let beside = [-24.0, -8.0, 8.0, 24.0].iter().flat_map(|x| [(*x, 3.5), (x + 4.0, -3.5)]);
    let all: Vec<(f64, f64)> = places.into_iter().chain(beside).collect();
    let mut cycle = base(Profile::HARDENED, PlanRemote);
    let moving = |(id, (x, y)): (i64, &(f64, f64))| Track { vx: 10.0, ..track(id, *x, *y) };
    cycle.tracks = tracks((0..).zip(&all).map(moving).collect());
    cycle.detections = detections(all.iter().map(|(x, y)| detection(*x, *y)).collect());
    cycle.detection_history =
        history(&all.iter().map(|(x, y)| [*x, *y, 10.0, 0.0]).collect::<Vec<_>>());
    let strict = |cycle: &Cycle| check(cycle, Reading::Strict).expect("valid").stages[3].clone();
    assert!(!matches!(strict(&cycle), Outcome::Failed(_)));
    let limit = cycle.parameters.work_limit;
    cycle.parameters.work_limit = 0;
    let Outcome::Failed(witness) = strict(&cycle) else { panic!("there is work") };
    let work: i64 = witness.compared[0].to_string().parse().expect("whole steps");
    assert!(work < limit && 20 * work > limit, "{work}");
}
