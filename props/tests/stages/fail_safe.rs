//! H-14 of the implementation against the exact model (`spec/hardened/H-14.md`).

use mufasa_model::input::cycle::Profile;
use mufasa_props::differential::{agree, hold, near_threshold, same_witness};
use mufasa_props::strategy::fail_safe;

#[test]
fn hardened() {
    agree("H-14", Profile::HARDENED, fail_safe::cycle, near_threshold)
        .assert_aimed(&["iv", "safe"]);
}

#[test]
fn the_witness() {
    hold("witness of H-14", Profile::HARDENED, fail_safe::cycle, near_threshold, same_witness)
        .assert_aimed(&["iv", "safe"]);
}
