//! H-14 of the implementation against the exact model (`spec/hardened/H-14.md`).

use mufasa_model::input::cycle::Profile;
use mufasa_props::differential::{agree, hold, near_threshold, same_witness};
use mufasa_props::strategy::{fail_safe, seen};

#[test]
fn hardened() {
    agree("H-14", Profile::HARDENED, fail_safe::cycle, near_threshold)
        .assert_aimed(&["iv", "safe"]);
}

/// A track whose word counts, or not, by one term of `spec/hardened/what-the-cav-saw.md`.
#[test]
fn what_the_cav_saw() {
    let tally = agree("what the CAV saw", Profile::HARDENED, seen::cycle, near_threshold);
    assert!(["iv", "safe"].iter().all(|verdict| 4 * tally.count(verdict) > tally.cases), "{tally}");
}

#[test]
fn the_witness() {
    hold("witness of H-14", Profile::HARDENED, fail_safe::cycle, near_threshold, same_witness)
        .assert_aimed(&["iv", "safe"]);
}
