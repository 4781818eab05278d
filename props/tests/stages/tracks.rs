//! Stage iii of the implementation against the exact model
//! (`spec/3-stages.md#stage-iii-trajectory-with-tracks`, H-02).

use mufasa_model::input::cycle::Profile;
use mufasa_props::differential::{agree, near_threshold};
use mufasa_props::strategy::tracks;

#[test]
fn paper() {
    agree("stage iii", Profile::PAPER, tracks::cycle, near_threshold)
        .assert_aimed(&["iii", "safe"]);
}

#[test]
fn hardened() {
    agree("stage iii", Profile::HARDENED, tracks::cycle, near_threshold)
        .assert_aimed(&["iii", "safe"]);
}

#[test]
fn before_its_list_paper() {
    agree("stage iii before its list", Profile::PAPER, tracks::before, near_threshold)
        .assert_aimed(&["iii", "safe"]);
}

#[test]
fn before_its_list_hardened() {
    agree("stage iii before its list", Profile::HARDENED, tracks::before, near_threshold)
        .assert_aimed(&["iii", "safe"]);
}
