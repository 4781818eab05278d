//! `spec/2-offloading.md#fallback`. Default: `t_wait` 10 s.

use mufasa_model::offloading::requester::Action::Deactivate;
use mufasa_model::offloading::requester::Group::{Mot, Plan};
use mufasa_model::offloading::requester::GroupState::Local;
use mufasa_model::offloading::requester::{EventKind, Groups};
use mufasa_model::report::{FailedStage, InvalidInput, Outcome, Report, Stage};
use mufasa_model::services::configuration::Source;

use crate::{Cav, MOT, PLAN, PROFILES, Profile, SESSION_1, TICK, confirm, data, offer, on, safe};

const T_WAIT_NS: i64 = 10_000_000_000;

/// FALL-01, PROTO-10: the groups that an unsafe verdict names do not matter (I-10).
#[test]
fn a_safety_issue_ends_all_remote_and_requested_services_whatever_the_cycle_used() {
    for groups in [Groups::NONE, MOT, PLAN, Groups::ALL] {
        for profile in PROFILES {
            let mut cav = Cav::remote(profile, Groups::ALL);
            let sessions = cav.model().sessions(groups);
            cav.at(1, EventKind::Verdict { safe: false, sessions });
            assert_eq!(cav.states(), (Local, Local));
            assert_eq!([Mot, Plan].map(|group| cav.model().source(group)), [Source::Local; 2]);
            assert_eq!(cav.model().hold_until_ns(), Some(1 + T_WAIT_NS));
        }
    }
}

/// FALL-11
#[test]
fn a_cycle_that_ends_in_error_is_handed_to_the_requester_as_unsafe() {
    let stages = [const { Outcome::NotScheduled }; 5];
    let report = |failed_stage| Report { failed_stage, stages: stages.clone(), input: None };
    let problem =
        InvalidInput { field: "ego.x".to_owned(), index: None, message: "is NaN".to_owned() };
    for (result, safe) in [
        (Ok(report(None)), true),
        (Ok(report(Some(FailedStage::Stage(Stage::Ii)))), false),
        (Ok(report(Some(FailedStage::Input))), false),
        (Ok(report(Some(FailedStage::NoObstacleCheck))), false),
        (Err(problem), false),
    ] {
        let kind = EventKind::of_cycle(&result, SESSION_1);
        assert_eq!(kind, EventKind::Verdict { safe, sessions: SESSION_1 });
    }
    let stages = [mufasa::report::Outcome::NotScheduled; 5];
    let report = |failed_stage| mufasa::report::Report { failed_stage, stages, input: None };
    let problem = mufasa::report::Problem::NotFinite;
    for (result, safe) in [
        (Ok(report(None)), true),
        (Ok(report(Some(mufasa::report::FailedStage::Input))), false),
        (Ok(report(Some(mufasa::report::FailedStage::NoObstacleCheck))), false),
        (Err(mufasa::report::InvalidInput { field: "ego.x", index: None, problem }), false),
    ] {
        let sessions = mufasa::offloading::requester::Sessions { mot: Some(1), plan: None };
        let kind = mufasa::offloading::requester::EventKind::of_cycle(&result, sessions);
        assert_eq!(kind, mufasa::offloading::requester::EventKind::Verdict { safe, sessions });
    }
}

/// CONF-03, PROTO-08 (H-08)
#[test]
fn local_services_are_not_stopped_while_no_result_of_the_running_session_was_in_a_safe_cycle() {
    let mut cav = Cav::remote(Profile::HARDENED, MOT);
    assert_eq!(cav.at(1, safe(Some(1), None)), [], "no result");
    cav.at(2, data(1, Mot, 9, 2));
    assert_eq!(cav.at(2, safe(Some(1), None)), [], "no result of the running session");
    cav.at(3, data(1, Mot, 1, 3));
    assert_eq!(cav.at(3, safe(None, Some(1))), [], "the cycle did not use it");
    assert_eq!(cav.at(3, safe(Some(2), None)), [], "another session");
    cav.at(4, offer(1, Groups::NONE));
    cav.at(4, offer(1, MOT));
    cav.at(4, TICK);
    cav.at(4, confirm(1, Mot, 2));
    assert_eq!(cav.model().state(Mot), on(1, 2));
    assert_eq!(cav.at(5, safe(Some(2), None)), [], "the used result was of an earlier session");
    cav.at(6, data(1, Mot, 2, 6));
    assert_eq!(cav.at(6, safe(Some(1), None)), [], "a verdict on an earlier session (F-25)");
    assert_eq!(cav.at(6, safe(Some(2), None)), [Deactivate(Mot)]);
    assert_eq!(cav.at(7, safe(Some(2), None)), [], "only the first");
}
