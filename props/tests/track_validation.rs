//! Stage i of the implementation against the exact model
//! (`spec/3-stages.md#stage-i-track-validation`, H-01, H-09).

use mufasa_model::cycle::Profile;
use mufasa_props::differential::{agree, near_threshold};
use mufasa_props::strategy::track_validation;

#[test]
fn paper() {
    agree("stage i", Profile::Paper, track_validation::cycle, near_threshold)
        .assert_aimed(&["i", "safe"]);
}

#[test]
fn hardened() {
    agree("stage i", Profile::Hardened, track_validation::cycle, near_threshold)
        .assert_aimed(&["i", "safe"]);
}
