//! `spec/4-arithmetic.md#conformance-of-an-implementation`: a cycle that needs more than 10^10
//! comparisons is an error.

use mufasa_model::input::cycle::{Cycle, DetectionList, Profile};
use mufasa_model::report::{InvalidInput, Reading, Rule, Stage};
use mufasa_model::services::configuration::Configuration::PlanRemote;
use mufasa_model::stages::{check, readings};

use crate::base::*;

/// 2000 detections, as many in the reference list and `others` in another one: H-13 needs 2000 * 2000
/// (2000 + others + 51 points) comparisons, the rest of the cycle 51 * 2 + 51 * 2000. The gap fails stage iv
/// before any of them is made.
fn crowded(others: usize) -> Cycle {
    let mut cycle = base(Profile::Hardened, PlanRemote);
    (cycle.tracks, cycle.lead) = (None, lead(0.0, 0.0));
    cycle.detections = detections(vec![detection(60.0, 0.0); 2000]);
    let list = |ms: i64, count: usize| DetectionList {
        stamp_ns: NOW - ms * 1_000_000,
        items: vec![detection(60.0, 0.0); count],
    };
    cycle.detection_history = vec![list(300, others), list(500, 2000)];
    cycle
}

#[test]
fn more_than_ten_to_the_ten_comparisons_are_an_error() {
    assert_eq!(rule(&crowded(448), Stage::Iv), Some(Rule::Gap));
    for reading in [Reading::Strict, Reading::Exact, Reading::Lax] {
        let error = check(&crowded(449), reading).expect_err("too much work");
        let InvalidInput { field, index, message } = error;
        assert_eq!((field.as_str(), index), ("work", None));
        assert!(message.contains("10000102102 comparisons"), "{message}");
    }
    assert!(readings(&crowded(449)).is_err());
}

/// Work that no stage comes to is not counted.
#[test]
fn only_what_a_stage_is_about_to_do_counts() {
    let mut cycle = crowded(449);
    cycle.ego.y = 2.5;
    assert_eq!(rule(&cycle, Stage::Ii), Some(Rule::StartPosition));
    let mut paper = crowded(449);
    paper.profile = Profile::Paper;
    assert_eq!(rule(&paper, Stage::Iv), Some(Rule::Gap));
}
