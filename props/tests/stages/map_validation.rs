//! Stage ii of the implementation against the exact model
//! (`spec/3-stages.md#stage-ii-trajectory-to-map`, H-07, H-11, H-14).

use mufasa_model::input::cycle::Profile;
use mufasa_props::differential::{agree, near_threshold};
use mufasa_props::strategy::{map_validation, roads};

#[test]
fn paper() {
    agree("stage ii", Profile::PAPER, map_validation::cycle, near_threshold)
        .assert_aimed(&["ii", "safe"]);
}

#[test]
fn hardened() {
    agree("stage ii", Profile::HARDENED, map_validation::cycle, near_threshold)
        .assert_aimed(&["ii", "safe"]);
}

#[test]
fn roads_paper() {
    agree("roads", Profile::PAPER, roads::cycle, near_threshold).assert_aimed(&["ii", "safe"]);
}

#[test]
fn roads_hardened() {
    agree("roads", Profile::HARDENED, roads::cycle, near_threshold).assert_aimed(&["ii", "safe"]);
}
