//! `spec/3-stages.md#stage-iv-trajectory-with-detections`

use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_model::report::{Rule, Stage};
use mufasa_model::services::configuration::Configuration::MotRemote;

use crate::base::*;

/// Speed 16 m/s and a_b 8 m/s^2: s_b = 16 m; safety_time 1.5 s: s_CAV = 24 m.
fn with(x: f64) -> Cycle {
    let mut cycle = base(Profile::Paper, MotRemote);
    cycle.ego.speed = 16.0;
    cycle.parameters.safety_time = 1.5;
    cycle.detections = detections(vec![detection(x, 0.0), detection(60.0, 0.0)]);
    cycle
}

/// spec/3-stages.md#stage-iv-trajectory-with-detections.1: detections stand still, whatever the
/// tracks say.
#[test]
fn detections_stand_still() {
    let found = witness(&with(15.0), Stage::Iv);
    assert_eq!((found.rule, found.point, found.detection), (Rule::Collision, Some(11), Some(0)));
}

/// spec/3-stages.md#stage-iv-trajectory-with-detections.2: without a leading vehicle up to s_b.
#[test]
fn without_lead_up_to_s_b() {
    assert!(!passes(&with(20.0), Stage::Iv), "touched at 16 m");
    assert!(passes(&with(21.0), Stage::Iv));
}

/// spec/3-stages.md#stage-iv-trajectory-with-detections.2: behind a leading vehicle up to s_follow.
#[test]
fn behind_a_lead_up_to_s_follow() {
    // s_follow = max(16 - 4, 0) + 24 = 36.
    let behind = |x: f64| Cycle { lead: lead(100.0, 8.0), ..with(x) };
    assert!(!passes(&behind(40.0), Stage::Iv));
    assert!(passes(&behind(41.0), Stage::Iv));
    // s_follow = 0 + 1 * 16 = 16 with safety_time 1; a fast leading vehicle can shorten it (F-05).
    let mut fast = Cycle { lead: lead(100.0, 40.0), ..with(20.0) };
    fast.parameters.safety_time = 0.5;
    assert!(passes(&fast, Stage::Iv), "s_follow = 8 m < s_b = 16 m");
}

/// spec/3-stages.md#stage-iv-trajectory-with-detections.2, I-03: a gap equal to s_follow fails.
#[test]
fn a_gap_of_s_follow_fails() {
    let gap = |gap: f64| Cycle { lead: lead(gap, 8.0), ..with(60.0) };
    let found = witness(&gap(36.0), Stage::Iv);
    assert_eq!(found.rule, Rule::Gap);
    assert_eq!(found.compared.map(f64::to_bits), [36.0, 36.0].map(f64::to_bits));
    assert!(passes(&gap(36.0f64.next_up()), Stage::Iv));
    // The gap is the first rule: it is named although there is a collision as well.
    let both = Cycle { lead: lead(36.0, 8.0), ..with(10.0) };
    assert_eq!(witness(&both, Stage::Iv).rule, Rule::Gap);
}
