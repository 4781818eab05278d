//! The laws of `proofs/src/law`, which are proved on complete small domains and by the solvers, on the
//! generators' cycles and traces.

use std::cell::RefCell;
use std::collections::BTreeMap;

use mufasa::offloading::requester::{Requester, StationRecord};
use mufasa::report::{FailedStage, Report, Stage};
use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_proofs::law::requester::{LAWS as REQUESTER, Seen, Step};
use mufasa_proofs::law::schedule::{LAWS as SCHEDULE, hardened_accepts_nothing_that_paper_rejects};
use mufasa_props::bridge;
use mufasa_props::differential::runner;
use mufasa_props::strategy::draw::{Draw, long_tape, tape};
use mufasa_props::strategy::requester::{Trace, trace};
use mufasa_props::strategy::whole;
use proptest::strategy::Strategy;
use proptest::test_runner::TestCaseError;

/// Judges the report of the implementation by every law of one report; none for invalid input.
fn judged(cycle: &Cycle) -> Result<Option<Report>, String> {
    bridge::with_impl(cycle, |cycle, scratch| {
        let Ok(report) = mufasa::cycle::check(cycle, scratch) else { return Ok(None) };
        if report.failed_stage == Some(FailedStage::Input) {
            return Ok(None);
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
    let cycles = tape().prop_map(|tape| whole::cycle(&mut Draw::new(&tape), Profile::HARDENED));
    let result = runner().run(&cycles, |mut cycle| {
        let hardened = judged(&cycle).map_err(TestCaseError::fail)?;
        // With a budget, and where tracks are older or younger than detections, the hardened stage i
        // passes what the paper's does not (H-01).
        let stamps = [
            cycle.tracks.as_ref().map(|list| list.stamp_ns),
            cycle.detections.as_ref().map(|list| list.stamp_ns),
        ];
        let same_stage_i = cycle.parameters.miss_budget == 0 && stamps[0] == stamps[1];
        cycle.profile = Profile::PAPER;
        let paper = judged(&cycle).map_err(TestCaseError::fail)?;
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
    for verdict in [(true, true), (true, false), (false, false)] {
        assert!(verdicts.get(&verdict).is_some_and(|count| *count > 100), "{verdicts:?}");
    }
}

#[test]
fn every_step_keeps_the_laws_of_the_requester() {
    let steps = RefCell::new([0_u64; 2]);
    let traces = long_tape().prop_map(|tape| trace(&mut Draw::new(&tape)));
    let result = runner().run(&traces, |trace| {
        let [all, held] = follow(&trace).map_err(TestCaseError::fail)?;
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
}

/// Steps, and those of them that began during a hold.
fn follow(trace: &Trace) -> Result<[u64; 2], String> {
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
        if let Some((name, _)) = REQUESTER.iter().find(|(_, law)| !law(&step)) {
            return Err(format!("{name}: {step:?}"));
        }
        counts = [counts[0] + 1, counts[1] + u64::from(before.hold_until_ns.is_some())];
    }
    Ok(counts)
}
