//! The laws of `proofs/src/law` on the generators' cycles and traces. What they say of the requester and of the order of
//! stages CBMC proves of one step each (`proofs/HARNESSES.md`). Each is refuted by some report or step that is made
//! wrong: none holds of nothing.

use std::cell::RefCell;
use std::collections::BTreeMap;

use mufasa::cycle::ValidCycle;
use mufasa::offloading::requester::{
    Action, EventKind, GroupState, Groups, Requester, StationRecord,
};
use mufasa::report::{FailedStage, Outcome, Reason, Report, Stage};
use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_proofs::law::requester::{LAWS as REQUESTER, Seen, Step};
use mufasa_proofs::law::schedule::{
    LAWS as SCHEDULE, fails_instead_of_iv, hardened_accepts_nothing_that_paper_rejects,
};
use mufasa_props::bridge;
use mufasa_props::differential::runner;
use mufasa_props::strategy::draw::{Draw, long_tape, tape};
use mufasa_props::strategy::requester::{Trace, trace};
use mufasa_props::strategy::whole;
use proptest::strategy::Strategy;
use proptest::test_runner::TestCaseError;

/// How often each law was refuted by what was made wrong.
type Refuted = RefCell<BTreeMap<&'static str, u64>>;

/// A change of a report, by its name.
type Wrong = (&'static str, fn(&mut Report));

/// By law: how a schedule with one fault would have said it.
const WRONG_REPORTS: [Wrong; 6] = [
    ("no_stage_runs_in_local", |report| report.stages[1] = Outcome::Passed),
    ("only_scheduled_stages_run", |report| report.stages[2] = Outcome::NotScheduled),
    ("nothing_runs_after_a_failure", |report| {
        let after = report.stages.iter_mut();
        let after = after.filter(|it| **it == Outcome::Skipped(Reason::AfterFailure));
        after.for_each(|outcome| *outcome = Outcome::Passed);
    }),
    ("unsafe_exactly_when_something_failed", |report| report.failed_stage = None),
    ("nothing_runs_without_its_input", |report| {
        let missing = report.stages.iter_mut();
        let missing = missing.filter(|it| matches!(it, Outcome::NotApplicable(_)));
        missing.for_each(|outcome| *outcome = Outcome::Passed);
    }),
    ("no_trajectory_is_accepted_unexamined", |report| report.failed_stage = None),
];

/// A step that is made wrong, with its actions.
type WrongStep = fn(&mut Step<'_>, &mut Vec<Action>);

/// By law: what a requester with one fault would have done.
const WRONG_STEPS: [(&str, WrongStep); 9] = [
    ("every_reachable_state_is_valid", |step, _| step.after.valid = false),
    ("t_wait_blocks_offloading", |step, _| {
        step.before.hold_until_ns = Some(step.event.t_ns.saturating_add(1));
    }),
    ("requests_are_decided_at_ticks_only", |step, _| {
        step.event.kind = EventKind::Area { groups: Groups::ALL };
    }),
    ("a_safety_issue_ends_every_remote_service", |step, _| step.after.states = step.before.states),
    ("a_hold_is_never_shortened", |step, _| std::mem::swap(&mut step.before, &mut step.after)),
    ("a_session_left_is_released_exactly_once", |_, actions| {
        actions.retain(|action| !matches!(action, Action::Release { .. }));
    }),
    ("actions_come_in_their_order", |_, actions| actions.reverse()),
    ("local_services_stop_when_the_profile_says", |step, _| {
        let is_paper = step.profile == mufasa::input::profile::Profile::PAPER;
        let [paper, hardened] = [Profile::PAPER, Profile::HARDENED].map(bridge::profile_to_impl);
        step.profile = if is_paper { hardened } else { paper };
    }),
    ("a_group_becomes_remote_by_confirmation_only", |step, _| {
        for state in &mut step.before.states {
            if let GroupState::Requested { deadline_ns, .. } = state {
                *deadline_ns = step.event.t_ns;
            }
        }
    }),
];

fn all_were_refuted(refuted: &Refuted) {
    println!("refuted by what was made wrong: {:?}", refuted.borrow());
    assert!(refuted.borrow().values().all(|count| *count > 0), "{:?}", refuted.borrow());
}

/// Judges the report of the implementation by every law of one report; none for invalid input. Each stage that ran
/// says the same when it is run alone.
fn judged(cycle: &Cycle, refuted: &Refuted) -> Result<Option<Report>, String> {
    bridge::with_impl(cycle, |cycle, scratch| {
        let Ok(report) = mufasa::cycle::check(cycle, scratch) else { return Ok(None) };
        if report.failed_stage == Some(FailedStage::Input) {
            return Ok(None);
        }
        let valid = ValidCycle::new(cycle, None, scratch).map_err(|it| format!("{it:?}"))?;
        for (stage, outcome) in Stage::ALL.into_iter().zip(report.stages) {
            let ran = matches!(outcome, Outcome::Passed | Outcome::Failed(_));
            let instead = stage == Stage::Iv && fails_instead_of_iv(cycle, &outcome);
            let alone = valid.stage(stage, scratch);
            if ran && !instead && alone != outcome {
                return Err(format!("stage {stage:?} alone: {alone:?}, not {outcome:?}"));
            }
        }
        for ((name, law), (of, fault)) in SCHEDULE.into_iter().zip(WRONG_REPORTS) {
            assert_eq!(name, of, "in the order of the laws");
            let mut wrong = report;
            fault(&mut wrong);
            *refuted.borrow_mut().entry(name).or_default() += u64::from(!law(cycle, &wrong));
        }
        match SCHEDULE.iter().find(|(_, law)| !law(cycle, &report)) {
            Some((name, _)) => Err(format!("{name}: {report:?}")),
            None => Ok(Some(report)),
        }
    })
}

#[test]
fn every_report_keeps_the_laws_of_the_schedule() {
    let (verdicts, asked) = (RefCell::new(BTreeMap::new()), RefCell::new(0_u64));
    let refuted = Refuted::default();
    let cycles = tape().prop_map(|tape| whole::cycle(&mut Draw::new(&tape), Profile::HARDENED));
    let result = runner().run(&cycles, |mut cycle| {
        let hardened = judged(&cycle, &refuted).map_err(TestCaseError::fail)?;
        // With a budget, and where tracks are older or younger than detections, the hardened stage i
        // passes what the paper's does not (H-01).
        let stamps = [
            cycle.tracks.as_ref().map(|list| list.stamp_ns),
            cycle.detections.as_ref().map(|list| list.stamp_ns),
        ];
        let same_stage_i = cycle.parameters.miss_budget == 0 && stamps[0] == stamps[1];
        cycle.profile = Profile::PAPER;
        let paper = judged(&cycle, &refuted).map_err(TestCaseError::fail)?;
        if let (Some(paper), Some(hardened)) = (paper, hardened) {
            let verdict = (paper.failed_stage.is_none(), hardened.failed_stage.is_none());
            *verdicts.borrow_mut().entry(verdict).or_insert(0_u64) += 1;
            let by_i = paper.failed_stage == Some(FailedStage::Stage(Stage::I));
            if !same_stage_i && by_i {
                return Ok(());
            }
            *asked.borrow_mut() += u64::from(paper.failed_stage.is_some());
            if !hardened_accepts_nothing_that_paper_rejects(&paper, &hardened) {
                return Err(TestCaseError::fail("the hardened profile accepts more"));
            }
        }
        Ok(())
    });
    if let Err(error) = result {
        panic!("{error}");
    }
    let verdicts = verdicts.into_inner();
    let asked = asked.into_inner();
    println!(
        "laws of the schedule: safe in (paper, hardened): {verdicts:?}, {asked} rejected by paper"
    );
    assert!(asked > 100, "{asked}");
    all_were_refuted(&refuted);
    for verdict in [(true, true), (true, false), (false, false)] {
        assert!(verdicts.get(&verdict).is_some_and(|count| *count > 100), "{verdicts:?}");
    }
}

#[test]
fn every_step_keeps_the_laws_of_the_requester() {
    let (steps, refuted) = (RefCell::new([0_u64; 2]), Refuted::default());
    let traces = long_tape().prop_map(|tape| trace(&mut Draw::new(&tape)));
    let result = runner().run(&traces, |trace| {
        let [all, held] = follow(&trace, &refuted).map_err(TestCaseError::fail)?;
        let mut steps = steps.borrow_mut();
        *steps = [steps[0] + all, steps[1] + held];
        Ok(())
    });
    if let Err(error) = result {
        panic!("{error}");
    }
    let [all, held] = steps.into_inner();
    println!("laws of the requester: {all} steps, {held} during a hold");
    assert!(held > 1000 && all > 2 * held);
    all_were_refuted(&refuted);
}

/// Steps, and those of them that began during a hold.
fn follow(trace: &Trace, refuted: &Refuted) -> Result<[u64; 2], String> {
    let mut table = [StationRecord::FREE; 8];
    let profile = bridge::profile_to_impl(trace.profile);
    let parameters = bridge::parameters_to_impl(&trace.parameters);
    let mut requester =
        Requester::new(profile, parameters, &mut table).map_err(|error| error.to_string())?;
    let mut counts = [0, 0];
    for event in &trace.events {
        let (before, event) = (Seen::of(&requester), bridge::event_to_impl(event));
        let actions = requester.step(&event).map_err(|error| error.to_string())?;
        let (actions, after) = (actions.to_vec(), Seen::of(&requester));
        let step = Step { profile, parameters, before, event, actions: &actions, after };
        for ((name, law), (of, fault)) in REQUESTER.into_iter().zip(WRONG_STEPS) {
            assert_eq!(name, of, "in the order of the laws");
            let (mut wrong, mut actions) = (step, actions.clone());
            fault(&mut wrong, &mut actions);
            let holds = law(&Step { actions: &actions, ..wrong });
            *refuted.borrow_mut().entry(name).or_default() += u64::from(!holds);
        }
        if let Some((name, _)) = REQUESTER.iter().find(|(_, law)| !law(&step)) {
            return Err(format!("{name}: {step:?}"));
        }
        counts = [counts[0] + 1, counts[1] + u64::from(before.hold_until_ns.is_some())];
    }
    Ok(counts)
}
