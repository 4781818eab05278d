//! The first witness in the order of the rules: the implementation's is the model's
//! (`spec/3-stages.md#schedule`): SCHED-19.

use mufasa_model::input::cycle::Profile;
use mufasa_props::differential::{hold, near_threshold, same_witness};
use mufasa_props::strategy::whole;

#[test]
fn paper() {
    hold("witness", Profile::PAPER, whole::cycle, near_threshold, same_witness)
        .assert_aimed(&["i", "ii", "iii", "iv", "v", "safe"]);
}

#[test]
fn hardened() {
    hold("witness", Profile::HARDENED, whole::cycle, near_threshold, same_witness)
        .assert_aimed(&["i", "ii", "iii", "iv", "v", "safe"]);
}
