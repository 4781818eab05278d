//! Stage iv of the implementation against the exact model
//! (`spec/3-stages.md#stage-iv-trajectory-with-detections`, H-04, H-14): DOM-03.

use mufasa_model::input::cycle::Profile;
use mufasa_props::differential::{agree, near_threshold};
use mufasa_props::strategy::detections;

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
