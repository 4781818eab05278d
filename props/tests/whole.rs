//! A whole cycle of the implementation against the exact model
//! (`spec/4-arithmetic.md#conformance-of-an-implementation`).

use mufasa_model::cycle::Profile;
use mufasa_props::differential::{agree, near_threshold};
use mufasa_props::strategy::whole;

#[test]
fn paper() {
    agree("cycle", Profile::Paper, whole::cycle, near_threshold)
        .assert_aimed(&["i", "ii", "iii", "iv", "v", "safe"]);
}

#[test]
fn hardened() {
    agree("cycle", Profile::Hardened, whole::cycle, near_threshold)
        .assert_aimed(&["i", "ii", "iii", "iv", "v", "safe"]);
}
