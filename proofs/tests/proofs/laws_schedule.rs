//! A wrong report refutes each law of the schedule and of the distances: none holds of nothing. That they hold is
//! shown by `tests/proofs/laws.rs` and the harnesses of `distances`.

use mufasa::input::cycle::Cycle;
use mufasa::input::profile::Profile;
use mufasa::report::{FailedStage, Outcome, Reason, Report, Stage};
use mufasa::services::configuration::Configuration;
use mufasa_proofs::exhaust::schedule::{every_cycle, report};
use mufasa_proofs::harness::scene::{Given, cycle};
use mufasa_proofs::law::distances::{
    a_larger_gap_is_never_worse, failed_by_gap, s_follow_falls_with_v_lead,
    s_follow_is_never_below_s_cav,
};
use mufasa_proofs::law::schedule::{LAWS, hardened_accepts_nothing_that_paper_rejects};

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
            let cycle = cycle(Profile::HARDENED, configuration, given);
            let mut wrong = report(&cycle);
            fault(&cycle, &mut wrong);
            refuted += u32::from(!law(&cycle, &wrong));
        });
        println!("{name}: refuted by {refuted} wrong reports");
        assert!(refuted > 0, "{name} cannot fail");
    }
    let safe = report(&cycle(Profile::PAPER, Configuration::Local, [Given::Missing; 5]));
    let mut wrong = safe;
    wrong.failed_stage = Some(FailedStage::Stage(Stage::Ii));
    assert!(!hardened_accepts_nothing_that_paper_rejects(&wrong, &safe));
}

#[test]
fn every_law_of_the_gap_is_refuted_by_a_wrong_report() {
    use Given::{Harmful, Harmless, Missing};
    let behind = |lead| {
        let given = [Harmless, Missing, Harmless, lead, Missing];
        cycle(Profile::PAPER, Configuration::PlanRemote, given)
    };
    let (near, far) = (behind(Harmful), behind(Harmless));
    let (fails, passes) = (report(&near), report(&far));
    assert!(failed_by_gap(&fails) && s_follow_is_never_below_s_cav(&near, &fails));
    assert!(!s_follow_is_never_below_s_cav(&near, &passes));
    assert!(!a_larger_gap_is_never_worse(&passes, &fails));
    assert!(!s_follow_falls_with_v_lead(&passes, &fails));
}
