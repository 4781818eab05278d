//! One test for each sentence of `spec/2-offloading.md` that a requester alone can keep or break.

mod fallback;
mod properties;
mod protocol;
mod quality;

use super::{
    Action, Event, EventKind, Group, Groups, Parameters, Requester, RequesterError, StationRecord,
};
use crate::input::profile::Profile;

type TestResult = Result<(), RequesterError>;

const MOT: Group = Group::Mot;
const PLAN: Group = Group::Plan;
const PROFILES: [Profile; 2] = [Profile::Paper, Profile::Hardened];
const FREE: [StationRecord; 4] = [StationRecord::FREE; 4];
const TICK: EventKind = EventKind::Tick;
const UNSAFE: EventKind = EventKind::Verdict { safe: false, groups: Groups::ALL };
const SAFE: EventKind = EventKind::Verdict { safe: true, groups: Groups::ALL };

/// Small times, each of its own size.
const TIMES: Parameters = Parameters {
    t_wait_ns: 1000,
    request_timeout_ns: 50,
    l_max_ns: 20,
    dt_max_ns: 100,
    qos_hold: false,
};

/// Takes one event and compares the actions.
#[track_caller]
fn act(
    requester: &mut Requester<'_>,
    t_ns: i64,
    kind: EventKind,
    expected: &[Action],
) -> TestResult {
    let actions = requester.step(&Event { t_ns, kind })?;
    assert_eq!(actions.as_slice(), expected, "{kind:?} at {t_ns}");
    assert!(requester.is_valid(), "after {kind:?} at {t_ns}: {requester:?}");
    Ok(())
}

/// MOT and PLAN run on station 1 since time 0, in the sessions 1 and 2, and no local services
/// compute. In the hardened profile one element of each, generated at -1, was used at 0.
fn remote(
    profile: Profile,
    parameters: Parameters,
    table: &mut [StationRecord],
) -> Result<Requester<'_>, RequesterError> {
    let mut requester = Requester::new(profile, parameters, table)?;
    act(&mut requester, 0, offer(1, Groups::ALL), &[])?;
    act(&mut requester, 0, TICK, &[request(1, MOT, 1), request(1, PLAN, 2)])?;
    match profile {
        Profile::Paper => {
            act(&mut requester, 0, confirm(1, MOT, 1), &[Action::Deactivate(MOT)])?;
            act(&mut requester, 0, confirm(1, PLAN, 2), &[Action::Deactivate(PLAN)])?;
        }
        Profile::Hardened => {
            act(&mut requester, 0, confirm(1, MOT, 1), &[])?;
            act(&mut requester, 0, confirm(1, PLAN, 2), &[])?;
            act(&mut requester, 0, data(1, MOT, 1, -1), &[])?;
            act(&mut requester, 0, data(1, PLAN, 2, -1), &[])?;
            let stop = [Action::Deactivate(MOT), Action::Deactivate(PLAN)];
            act(&mut requester, 0, SAFE, &stop)?;
        }
    }
    Ok(requester)
}

fn only(group: Group) -> Groups {
    Groups::from(group)
}

fn offer(station: i64, groups: Groups) -> EventKind {
    EventKind::Offer { station, groups }
}

fn withdraw(station: i64) -> EventKind {
    EventKind::Withdraw { station }
}

fn lost(station: i64) -> EventKind {
    EventKind::Lost { station }
}

fn area(groups: Groups) -> EventKind {
    EventKind::Area { groups }
}

fn confirm(station: i64, group: Group, session: i64) -> EventKind {
    EventKind::Confirm { station, group, session }
}

fn reject(station: i64, group: Group, session: i64) -> EventKind {
    EventKind::Reject { station, group, session }
}

fn data(station: i64, group: Group, session: i64, generated_ns: i64) -> EventKind {
    EventKind::Data { station, group, session, generated_ns }
}

fn safe(groups: Groups) -> EventKind {
    EventKind::Verdict { safe: true, groups }
}

fn request(station: i64, group: Group, session: i64) -> Action {
    Action::Request { station, group, session }
}

fn release(station: i64, group: Group, session: i64) -> Action {
    Action::Release { station, group, session }
}
