//! The laws of a cycle's report over every configuration, both profiles, and every input missing,
//! too old, harmless or harmful (`spec/3-stages.md#schedule`); a wrong report refutes each.
//!
//! Domain: one scene, 8 x 5 x 4^4 cycles. Not covered: what the stages compare.

use std::collections::BTreeMap;

use mufasa::configuration::Configuration;
use mufasa::cycle::{Cycle, Profile};
use mufasa::schedule::check;
use mufasa::scratch::{Column, Row, Scratch};
use mufasa::verdict::{FailedStage, Outcome, Reason, Report, Stage};
use mufasa_proofs::harness::scene::{Given, cycle};
use mufasa_proofs::law::schedule::{LAWS, hardened_accepts_nothing_that_paper_rejects};

fn report(cycle: &Cycle<'_>) -> Report {
    let (mut rows, mut columns) = ([Row::default(); 4], [Column::default(); 8]);
    check(cycle, &mut Scratch::new(&mut rows, &mut columns)).expect("the input is valid")
}

fn every_cycle(mut visit: impl FnMut(Configuration, [Given; 5])) {
    for configuration in Configuration::ALL {
        for code in 0..4_usize.pow(5) {
            let given = [0, 1, 2, 3, 4].map(|place| Given::ALL[code / 4_usize.pow(place) % 4]);
            visit(configuration, given);
        }
    }
}

#[test]
fn every_law_holds_in_every_configuration_with_every_input() {
    let mut verdicts: BTreeMap<String, u32> = BTreeMap::new();
    every_cycle(|configuration, given| {
        let [paper, hardened] = [Profile::Paper, Profile::Hardened].map(|profile| {
            let cycle = cycle(profile, configuration, given);
            let report = report(&cycle);
            for (name, law) in LAWS {
                assert!(law(&cycle, &report), "{name} is broken: {cycle:#?} {report:#?}");
            }
            *verdicts.entry(format!("{:?}", report.failed_stage)).or_default() += 1;
            report
        });
        assert!(
            hardened_accepts_nothing_that_paper_rejects(&paper, &hardened),
            "{configuration:?} {given:?}: {paper:#?} {hardened:#?}"
        );
    });
    println!("{verdicts:?}");
    // Five stages, no obstacle check, safe.
    assert_eq!(verdicts.len(), 7, "a verdict never occurs: {verdicts:?}");
}

/// One wrong report for each law: what a schedule with one fault would have said.
#[test]
fn every_law_is_refuted_by_a_wrong_report() {
    type Fault = fn(&Cycle<'_>, &mut Report);
    let faults: [(&str, Fault); 6] = [
        ("no_stage_runs_in_local", |_, report| report.stages[1] = Outcome::Passed),
        ("only_scheduled_stages_run", |_, report| report.stages[2] = Outcome::NotScheduled),
        ("nothing_runs_after_a_failure", |_, report| {
            for outcome in &mut report.stages {
                if *outcome == Outcome::Skipped(Reason::AfterFailure) {
                    *outcome = Outcome::Passed;
                }
            }
        }),
        ("unsafe_exactly_when_something_failed", |_, report| report.failed_stage = None),
        ("nothing_runs_without_its_input", |_, report| {
            for outcome in &mut report.stages {
                if matches!(outcome, Outcome::NotApplicable(_)) {
                    *outcome = Outcome::Passed;
                }
            }
        }),
        ("no_trajectory_is_accepted_unexamined", |_, report| {
            if report.failed_stage == Some(FailedStage::NoObstacleCheck) {
                report.failed_stage = None;
            }
        }),
    ];
    for ((name, law), (of, fault)) in LAWS.into_iter().zip(faults) {
        assert_eq!(name, of, "the faults stand in the order of the laws");
        let mut refuted = 0;
        every_cycle(|configuration, given| {
            let cycle = cycle(Profile::Hardened, configuration, given);
            let mut wrong = report(&cycle);
            fault(&cycle, &mut wrong);
            refuted += u32::from(!law(&cycle, &wrong));
        });
        println!("{name}: refuted by {refuted} wrong reports");
        assert!(refuted > 0, "{name} cannot fail");
    }
    let safe = report(&cycle(Profile::Paper, Configuration::Local, [Given::Missing; 5]));
    let mut wrong = safe;
    wrong.failed_stage = Some(FailedStage::Stage(Stage::Ii));
    assert!(!hardened_accepts_nothing_that_paper_rejects(&wrong, &safe));
}
