//! Stage i of the implementation against the exact model
//! (`spec/3-stages.md#stage-i-track-validation`, H-01): H-01.3, H-01.5 (too many columns alone), SEEN-04.

use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_props::differential::{agree, near_threshold};
use mufasa_props::strategy::draw::Draw;
use mufasa_props::strategy::track_validation;

#[test]
fn paper() {
    agree("stage i", Profile::PAPER, track_validation::cycle, near_threshold)
        .assert_aimed(&["i", "safe"]);
}

#[test]
fn hardened() {
    agree("stage i", Profile::HARDENED, track_validation::cycle, near_threshold)
        .assert_aimed(&["i", "safe"]);
}

/// S1-08: with limits that many assignments exceed.
#[test]
fn limited() {
    for profile in [Profile::PAPER, Profile::HARDENED] {
        let tally = agree("stage i, limited", profile, limited_cycle, near_threshold);
        assert!(10 * tally.undecided > tally.cases, "the limit decides: {tally}");
        tally.assert_aimed(&["i", "safe"]);
    }
}

fn limited_cycle(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    let mut cycle = track_validation::cycle(draw, profile);
    cycle.parameters.work_limit = draw.pick(&[0, 1, 2, 8, 27, 64, 125]);
    cycle
}
