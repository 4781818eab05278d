//! Invalid input: the implementation names the same field and index as the model, and neither
//! panics (`spec/3-stages.md#invalid-input`,
//! IMPL-05): INPUT-04, INPUT-07, DOM-01.

use mufasa_model::input::cycle::Profile;
use mufasa_props::differential::agree;
use mufasa_props::strategy::input;

#[test]
fn paper() {
    agree("input", Profile::PAPER, input::cycle, input::is_near)
        .assert_aimed(&["error", "input", "safe"]);
}

#[test]
fn hardened() {
    agree("input", Profile::HARDENED, input::cycle, input::is_near)
        .assert_aimed(&["error", "input", "safe"]);
}
