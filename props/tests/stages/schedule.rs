//! The schedule of the implementation against the exact model
//! (`spec/3-stages.md#schedule`, H-02, H-05, H-10).

use mufasa_model::input::cycle::Profile;
use mufasa_props::differential::agree;
use mufasa_props::strategy::schedule;

#[test]
fn paper() {
    agree("schedule", Profile::PAPER, schedule::cycle, schedule::is_near)
        .assert_aimed(&["i", "ii", "iii", "iv", "v", "safe"]);
}

#[test]
fn hardened() {
    agree("schedule", Profile::HARDENED, schedule::cycle, schedule::is_near)
        .assert_aimed(&["i", "ii", "iii", "iv", "v", "safe"]);
}
