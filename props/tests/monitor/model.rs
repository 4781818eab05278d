//! The monitor answers as the exact model of it, on sequences that aim at every time that it compares: SEEN-01,
//! MON-01, MON-02, MON-04, MON-05, MON-06, MON-07, MON-08, MON-09, MON-10, MON-11, MON-12, MON-13, MON-14,
//! MON-15, MON-16, MON-17, MON-19, MON-20, MON-30 to MON-46, MON-47 to MON-59, PROTO-07, FALL-13.

use std::cell::RefCell;

use mufasa_model::input::profile::Profile;
use mufasa_model::monitor::messages::Event;
use mufasa_props::bridge::lent;
use mufasa_props::differential::{are_enough, cases, runner};
use mufasa_props::refine::Monitors;
use mufasa_props::strategy::monitor::{Script, route};
use proptest::collection::vec;
use proptest::prelude::any;
use proptest::test_runner::{Config, TestCaseError, TestError, TestRunner};

use super::reached::Reached;

/// Events and cycles of a sequence.
const STEPS: usize = 500;
/// Choices of a sequence; there are at most about 15 for a step.
const TAPE: usize = 6_000;

/// Sequences in each of the two profiles: 100 make the 10^5 steps of the default of 20,000 cases.
fn sequences() -> u32 {
    (cases() / 200).max(1)
}

fn as_the_model(profile: Profile) {
    let reached = RefCell::new(Reached::default());
    let mut runner = runner();
    let max_shrink_iters = runner.config().max_shrink_iters.min(2_000);
    let config = Config { cases: sequences(), max_shrink_iters, ..runner.config().clone() };
    runner = TestRunner::new_with_rng(config, runner.rng().clone());
    let result = runner.run(&vec(any::<u32>(), TAPE), |tape| {
        sequence(&tape, profile, &reached).map_err(TestCaseError::fail)
    });
    let reached = reached.into_inner();
    println!("{profile:?}: {reached}");
    match result {
        Ok(()) => {}
        Err(TestError::Fail(why, _) | TestError::Abort(why)) => panic!("{profile:?}: {why}"),
    }
    if are_enough() {
        reached.is_enough(profile);
    }
}

fn sequence(tape: &[u32], profile: Profile, reached: &RefCell<Reached>) -> Result<(), String> {
    let (mut script, settings) = Script::new(tape, profile);
    let mut lent = lent(&settings);
    let mut pair =
        Monitors::new(&settings, route(), &mut lent)?.ok_or("both refuse the settings")?;
    let mut before = Vec::new();
    for at in 0..STEPS {
        let event = script.event();
        let expected = pair.step(&event).map_err(|what| {
            format!("step {at} behind {before:#?}\n{settings:?}\n{event:?}: {what}")
        })?;
        before.push(brief(&event));
        before.drain(..before.len().saturating_sub(24));
        script.take(&event, &expected);
        reached.borrow_mut().count(&event, &expected);
    }
    Ok(())
}

/// An event without its contents.
fn brief(event: &Event) -> String {
    let text = format!("{event:?}");
    text.chars().take(240).collect()
}

#[test]
fn the_monitor_answers_as_the_model_in_the_hardened_profile() {
    as_the_model(Profile::HARDENED);
}

#[test]
fn the_monitor_answers_as_the_model_in_the_paper_profile() {
    as_the_model(Profile::PAPER);
}
