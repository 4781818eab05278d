//! Strict, exact and lax reading of the model (`spec/4-arithmetic.md#strict-and-lax`): what one
//! accepts the next accepts, with the same outcomes, so `readings` may copy reports.

use mufasa_model::cycle::check;
use mufasa_model::cycle::readings;
use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_model::report::Reading;
use mufasa_props::conformance::Answer;
use mufasa_props::differential::{Generator, are_enough, cases, hold, near_threshold};
use mufasa_props::strategy::{fail_safe, whole};

fn readings_are_nested(cycle: &Cycle, _: &Answer, _: &Answer) -> Result<(), String> {
    let all = [Reading::Strict, Reading::Exact, Reading::Lax];
    let apart = all.into_iter().map(|it| check(cycle, it)).collect::<Result<Vec<_>, _>>();
    let together = readings(cycle).map(Vec::from);
    if apart == together {
        return Ok(());
    }
    Err(format!("one by one {apart:?}\ntogether {together:?}"))
}

/// How near the cases are to a threshold is asked where the implementation is compared on more of them.
fn nested(profile: Profile, generator: Generator, verdicts: &[&str]) {
    let number = cases() / 4;
    let tally = hold(number, "readings", profile, generator, near_threshold, readings_are_nested);
    if are_enough() {
        assert!(verdicts.iter().all(|verdict| tally.count(verdict) > 0), "{tally}");
    }
}

#[test]
fn paper() {
    nested(Profile::PAPER, whole::cycle, &["i", "ii", "iii", "iv", "v", "safe"]);
}

#[test]
fn hardened() {
    nested(Profile::HARDENED, whole::cycle, &["i", "ii", "iii", "iv", "v", "safe"]);
}

#[test]
fn of_the_fail_safe_rule() {
    nested(Profile::HARDENED, fail_safe::cycle, &["iv", "safe"]);
}
