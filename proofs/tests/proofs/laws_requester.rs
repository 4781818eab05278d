//! A faulty step refutes each law of the requester: none holds of nothing. That they hold is shown by
//! `tests/proofs/laws.rs`.

use std::collections::BTreeMap;

use mufasa::input::profile::Profile;
use mufasa::offloading::requester::{
    Action, Event, EventKind, GroupState, Groups, Requester, StationRecord,
};
use mufasa_proofs::exhaust::requester::{PARAMETERS, Taken, every_step};
use mufasa_proofs::law::requester::{LAWS, Seen};

/// Length of the sequences that show a fault.
const LENGTH: usize = 5;

/// The same step as a requester with one fault would have shown it; `None` where the fault does
/// not show.
type Fault = fn(&Taken) -> Option<Taken>;

/// One fault for each law, by the law's name.
fn faults() -> BTreeMap<&'static str, Fault> {
    fn only(step: &Taken, when: bool, fault: impl FnOnce(&mut Taken)) -> Option<Taken> {
        let mut wrong = step.clone();
        when.then(|| fault(&mut wrong)).map(|()| wrong)
    }
    fn requests(step: &Taken) -> bool {
        step.actions.iter().any(|action| matches!(action, Action::Request { .. }))
    }
    let mut faults: BTreeMap<&'static str, Fault> = BTreeMap::new();
    faults.insert("every_reachable_state_is_valid", |step| {
        // The table is lost between two events.
        let mut lost = [StationRecord::FREE; 2];
        let mut table = [StationRecord::FREE; 2];
        let mut requester = Requester::new(step.profile, PARAMETERS, &mut table).ok()?;
        let offer = EventKind::Offer { station: 1, groups: Groups::ALL };
        let _done = requester.step(&Event { t_ns: 0, kind: offer }).ok()?;
        let _done = requester.step(&Event { t_ns: 0, kind: EventKind::Tick }).ok()?;
        let broken = Requester::resume(requester.suspend(), &mut lost);
        Some(Taken { after: Seen::of(&broken), ..step.clone() })
    });
    faults.insert("t_wait_blocks_offloading", |step| {
        // The hold would have ended one nanosecond after this request.
        only(step, requests(step) && step.before.hold_until_ns.is_some(), |wrong| {
            wrong.before.hold_until_ns = Some(step.event.t_ns + 1);
        })
    });
    faults.insert("requests_are_decided_at_ticks_only", |step| {
        only(step, requests(step), |wrong| {
            wrong.event.kind = EventKind::Area { groups: Groups::ALL };
        })
    });
    faults.insert("a_safety_issue_ends_every_remote_service", |step| {
        let in_use = step.before.states != [GroupState::Local; 2];
        only(step, in_use, |wrong| wrong.after.states = step.before.states)
    });
    faults.insert("a_hold_is_never_shortened", |step| {
        only(step, step.after.hold_until_ns > step.before.hold_until_ns, |wrong| {
            std::mem::swap(&mut wrong.before, &mut wrong.after);
        })
    });
    faults.insert("a_session_left_is_released_exactly_once", |step| {
        let is_release = |action: &Action| matches!(action, Action::Release { .. });
        only(step, step.actions.iter().any(is_release), |wrong| {
            wrong.actions.retain(|action| !is_release(action));
        })
    });
    faults.insert("actions_come_in_their_order", |step| {
        only(step, step.actions.len() > 1, |wrong| wrong.actions.reverse())
    });
    faults.insert("local_services_stop_when_the_profile_says", |step| {
        // Break before make under the name of the hardened profile, and the other way round.
        only(step, true, |wrong| {
            wrong.profile = match step.profile {
                Profile::PAPER => Profile::HARDENED,
                _ => Profile::PAPER,
            };
        })
    });
    faults.insert("a_group_becomes_remote_by_confirmation_only", |step| {
        // The deadline was this very moment.
        only(step, matches!(step.event.kind, EventKind::Confirm { .. }), |wrong| {
            for state in &mut wrong.before.states {
                if let GroupState::Requested { deadline_ns, .. } = state {
                    *deadline_ns = step.event.t_ns;
                }
            }
        })
    });
    faults
}

#[test]
fn every_law_is_refuted_by_a_fault() {
    let faults = faults();
    assert_eq!(faults.len(), LAWS.len(), "one fault for each law");
    for (name, law) in LAWS {
        let fault = faults[name];
        let mut refuted = 0_u64;
        for profile in [Profile::PAPER, Profile::HARDENED] {
            every_step(profile, LENGTH, &mut |step| {
                refuted += u64::from(fault(step).is_some_and(|wrong| !wrong.keeps(law)));
            });
        }
        println!("{name}: refuted by {refuted} faulty steps");
        assert!(refuted > 0, "{name} cannot fail");
    }
}
