//! A whole cycle of the implementation against the exact model: soundness
//! (`spec/4-arithmetic.md#conformance-of-an-implementation.1`), completeness (`.2`) and failing
//! stage (`.3`), as `conformance::conforms` has them:
//! `spec/4-arithmetic.md#conformance-of-an-implementation.2`,
//! `spec/4-arithmetic.md#conformance-of-an-implementation.3`.

use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_model::input::profile::HardenedRule;
use mufasa_model::report::Stage;
use mufasa_props::differential::{agree, near_threshold};
use mufasa_props::strategy::draw::Draw;
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

/// Sets of rules, with a stage left out of some: of studies, and none of a record.
#[test]
fn any_set_of_rules() {
    let cycle = |draw: &mut Draw<'_>, profile| -> Cycle {
        let mut cycle = whole::cycle(draw, profile);
        for rule in HardenedRule::ALL {
            if draw.one_in(6) {
                cycle.profile = cycle.profile.without(rule);
            }
        }
        if draw.one_in(6) {
            cycle.profile = cycle.profile.without_stage(draw.pick(&Stage::ALL));
        }
        cycle
    };
    agree("cycle of a study", Profile::HARDENED, cycle, near_threshold)
        .assert_aimed(&["i", "ii", "iii", "iv", "v", "safe"]);
}
