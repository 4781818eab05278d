//! A whole cycle of the implementation against the exact model: soundness
//! (`spec/4-arithmetic.md#conformance-of-an-implementation.1`), completeness (`.2`) and failing
//! stage (`.3`), as `conformance::conforms` has them:
//! `spec/4-arithmetic.md#conformance-of-an-implementation.2`,
//! `spec/4-arithmetic.md#conformance-of-an-implementation.3`.

use mufasa_model::input::cycle::Profile;
use mufasa_props::differential::{agree, near_threshold};
use mufasa_props::strategy::whole;

#[test]
fn paper() {
    agree("cycle", Profile::PAPER, whole::cycle, near_threshold)
        .assert_aimed(&["i", "ii", "iii", "iv", "v", "safe"]);
}

#[test]
fn hardened() {
    agree("cycle", Profile::HARDENED, whole::cycle, near_threshold)
        .assert_aimed(&["i", "ii", "iii", "iv", "v", "safe"]);
}
