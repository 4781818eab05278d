//! Stage iv of the implementation against the exact model
//! (`spec/3-stages.md#stage-iv-trajectory-with-detections`, H-04, H-14): DOM-03.

use crate::agreed::failed_clearly;
use mufasa_model::input::cycle::{Cycle, DetectionList, Profile, Trajectory};
use mufasa_model::report::Rule;
use mufasa_model::services::configuration::Configuration;
use mufasa_props::differential::{agree, near_threshold};
use mufasa_props::strategy::base::{self, Frame};
use mufasa_props::strategy::detections;
use mufasa_props::strategy::draw::Draw;
use mufasa_props::strategy::track_validation::detection;

#[test]
fn paper() {
    agree("stage iv", Profile::PAPER, detections::cycle, near_threshold)
        .assert_aimed(&["iv", "safe"]);
}

#[test]
fn hardened() {
    agree("stage iv", Profile::HARDENED, detections::cycle, near_threshold)
        .assert_aimed(&["iv", "safe"]);
}

/// The CAV needs 90 km to a stop. Its trajectory has two points, the second one in a detection and so much farther away
/// than that.
fn far(beyond: f64) -> Cycle {
    const S_B: f64 = 90_000.0;
    let frame = Frame { x: 0.0, y: 0.0, cos: 1.0, sin: 0.0 };
    let configuration = Configuration::PlanRemote;
    let mut cycle = base::cycle(&mut Draw::new(&[]), frame, Profile::PAPER, configuration);
    (cycle.ego.speed, cycle.parameters.a_b, cycle.parameters.delta) = (150.0, 0.125, 1e-8);
    cycle.route = base::road_to(frame, 3.0, S_B + 100.0);
    let stamp_ns = cycle.now_ns;
    let mut points = base::straight(&cycle.ego, frame, stamp_ns, &cycle.parameters).points;
    points.truncate(2);
    points[1].x = S_B + beyond;
    cycle.trajectory = Some(Trajectory { stamp_ns, points });
    let items = vec![detection(frame, (S_B, 0.0))];
    cycle.detections = Some(DetectionList { stamp_ns, items });
    cycle
}

/// DIST-03, IMPL-02: 5e-8 m of 90 km are not rounded away.
#[test]
fn a_point_just_beyond_a_far_horizon_is_not_examined() {
    let ahead = Some(Rule::Collision);
    for (beyond, rule) in [(-5e-8, ahead), (0.0, ahead), (5e-8, None)] {
        assert_eq!(failed_clearly(&far(beyond)), rule, "{beyond}");
    }
}
