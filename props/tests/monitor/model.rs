//! The monitor answers as the exact model of it, on sequences that aim at every time that it compares.

use std::cell::RefCell;

use mufasa::monitor::{DropReason, Monitor};
use mufasa_model::input::profile::Profile;
use mufasa_model::monitor as twin;
use mufasa_model::monitor::messages::{Answer, Brake, Decision, Dropped, Event, EventKind};
use mufasa_model::monitor::settings::Settings;
use mufasa_model::report::{InvalidInput, Outcome, Reading, Report, Witness};
use mufasa_props::bridge::{Bridged, lent, route_to_impl, settings_to_impl};
use mufasa_props::differential::{cases, runner};
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

/// MON-01, MON-02, MON-04, MON-05, MON-06, MON-07, MON-08, MON-09, MON-10, MON-11, MON-12, MON-13, MON-14,
/// MON-15, MON-16, MON-17, MON-19, MON-20, MON-30 to MON-46, MON-47 to MON-59, PROTO-07, FALL-13.
fn as_the_model(profile: Profile) {
    let reached = RefCell::new(Reached::default());
    let mut runner = runner();
    let config = Config { cases: sequences(), max_shrink_iters: 2_000, ..runner.config().clone() };
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
    reached.is_enough(profile);
}

fn sequence(tape: &[u32], profile: Profile, reached: &RefCell<Reached>) -> Result<(), String> {
    let (mut script, settings) = Script::new(tape, profile);
    let mut lent = lent(&settings);
    let implementation = settings_to_impl(&settings).expect("times from 0 on");
    let mut monitor = Monitor::new(implementation, lent.memory()).expect("settings");
    let (closed, cross_sections) = route_to_impl(&route());
    let kept = mufasa::input::cycle::Route { closed, cross_sections: &cross_sections };
    monitor.set_route(&kept).expect("a route");
    let mut bridged = Bridged::new(monitor);
    let mut model =
        twin::Monitor::new(settings.clone(), route(), Reading::Exact).expect("settings");
    let mut before = Vec::new();
    for at in 0..STEPS {
        let event = script.event();
        let expected = model.step(event.clone());
        let (found, dropped) = bridged.step(&event);
        compare(&event, &expected, found, dropped, &settings).map_err(|what| {
            format!("step {at} behind {before:#?}\n{settings:?}\n{event:?}: {what}")
        })?;
        before.push(brief(&event));
        before.drain(..before.len().saturating_sub(24));
        script.take(&event, &expected);
        reached.borrow_mut().count(&event, &expected);
    }
    Ok(())
}

fn compare(
    event: &Event,
    expected: &Answer,
    found: Answer,
    dropped: Option<DropReason>,
    settings: &Settings,
) -> Result<(), String> {
    let same = match (expected.dropped, dropped) {
        (None, None) => true,
        (Some(one), Some(other)) => is_same_reason(event, one, other, settings),
        (Some(_), None) | (None, Some(_)) => false,
    };
    if !same {
        return Err(format!("dropped as {:?} and {dropped:?}", expected.dropped));
    }
    // As text, in which NaN is NaN.
    let text = |answer: Answer| {
        let decision = answer.decision.map(plain);
        format!("{:#?}", Answer { decision, dropped: None, ..answer })
    };
    let [one, other] = [text(expected.clone()), text(found)];
    if one == other {
        Ok(())
    } else {
        Err(format!("the model says {one}\nand the monitor {other}"))
    }
}

/// An event without its contents.
fn brief(event: &Event) -> String {
    let text = format!("{event:?}");
    text.chars().take(240).collect()
}

/// The words of the implementation are finer for what is late, those of the model for what is not newer.
fn is_same_reason(event: &Event, model: Dropped, word: DropReason, settings: &Settings) -> bool {
    let (EventKind::Tracks { generated_ns, .. } | EventKind::Trajectory { generated_ns, .. }) =
        event.kind
    else {
        return false;
    };
    let latency_ns = event.t_ns - generated_ns;
    let l_max_ns = settings.requester.l_max_ns;
    match word {
        DropReason::TooLong => model == Dropped::DoesNotFit,
        DropReason::OtherSession => model == Dropped::OtherSession,
        DropReason::TooOld => model == Dropped::Stale,
        DropReason::Starved => model == Dropped::Starved,
        DropReason::FromTheFuture => model == Dropped::Late && latency_ns < 0,
        DropReason::Late => model == Dropped::Late && latency_ns > l_max_ns,
        DropReason::AfterSilence => model == Dropped::Late && (0..=l_max_ns).contains(&latency_ns),
        DropReason::NotNewer => matches!(model, Dropped::Repeated | Dropped::Older),
    }
}

/// Without the words of a problem, the numbers that a witness compared, and the segment that an index may find
/// otherwise.
fn plain(decision: Decision) -> Decision {
    let Decision { report, tracks, trajectory, brake_by_ns, brake } = decision;
    let report = match report {
        Ok(Report { failed_stage, stages, input }) => Ok(Report {
            failed_stage,
            stages: stages.map(|outcome| match outcome {
                Outcome::Failed(witness) => Outcome::Failed(named(witness)),
                other => other,
            }),
            input: input.map(place),
        }),
        Err(problem) => Err(place(problem)),
    };
    let brake = brake.map(|brake| match brake {
        Brake::Failed(stage, witness) => Brake::Failed(stage, witness.map(named)),
        Brake::Invalid(problem) => Brake::Invalid(place(problem)),
        Brake::NoTrajectory => Brake::NoTrajectory,
    });
    Decision { report, tracks, trajectory, brake_by_ns, brake }
}

fn place(problem: InvalidInput) -> InvalidInput {
    InvalidInput { message: String::new(), ..problem }
}

fn named(mut witness: Witness) -> Witness {
    (witness.segment, witness.compared) = (None, [0.0; 2]);
    witness
}

#[test]
fn the_monitor_answers_as_the_model_in_the_hardened_profile() {
    as_the_model(Profile::HARDENED);
}

#[test]
fn the_monitor_answers_as_the_model_in_the_paper_profile() {
    as_the_model(Profile::PAPER);
}
