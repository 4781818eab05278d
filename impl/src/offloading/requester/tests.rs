//! What the implementation alone can do wrong: refusals of what the model has no type for. What
//! `spec/2-offloading.md` says is tested with the model's requester beside it, in
//! `props/tests/offloading`.

use super::{
    Action, Event, EventKind, Group, Groups, Parameters, Requester, RequesterError, Sessions,
    StationRecord,
};
use crate::input::profile::Profile;
use crate::services::configuration::Configuration;

type TestResult = Result<(), RequesterError>;

const MOT: Group = Group::Mot;
const PLAN: Group = Group::Plan;

/// MOT and PLAN run on station 1 since time 0, in the sessions 1 and 2.
fn remote(table: &mut [StationRecord]) -> Result<Requester<'_>, RequesterError> {
    let mut requester = Requester::new(Profile::PAPER, Parameters::default(), table)?;
    let confirm = |group, session| EventKind::Confirm { station: 1, group, session };
    for kind in [offer(1, Groups::ALL), EventKind::Tick, confirm(MOT, 1), confirm(PLAN, 2)] {
        let _done = requester.step(&Event { t_ns: 0, kind })?;
    }
    Ok(requester)
}

fn offer(station: i64, groups: Groups) -> EventKind {
    EventKind::Offer { station, groups }
}

/// `spec/5-interfaces.md#offloading-trace`: stations of events are >= 1; anything else is an
/// error and changes nothing.
#[test]
fn an_event_of_a_station_below_1_is_an_error_that_changes_nothing() -> TestResult {
    let mut table = [StationRecord::FREE; 4];
    let mut requester = remote(&mut table)?;
    for station in [0, -1, i64::MIN] {
        for kind in [
            offer(station, Groups::ALL),
            EventKind::Withdraw { station },
            EventKind::Lost { station },
            EventKind::Confirm { station, group: MOT, session: 1 },
            EventKind::Reject { station, group: MOT, session: 1 },
            EventKind::Data { station, group: MOT, session: 1, generated_ns: 0 },
        ] {
            let refused = requester.step(&Event { t_ns: 500, kind });
            assert_eq!(refused, Err(RequesterError::Station { station }), "{kind:?}");
        }
    }
    assert_eq!(requester.configuration(), Configuration::AllRemote);
    assert_eq!(requester.dropped(MOT), 0);
    Ok(())
}

/// IMPL-09: an offer that the table has no place
/// for is an error and changes nothing; other events go on.
#[test]
fn an_offer_beyond_the_table_is_an_error_that_changes_nothing() -> TestResult {
    let mut table = [StationRecord::FREE; 1];
    let mut requester = remote(&mut table)?;
    let full = RequesterError::TableFull { station: 2, capacity: 1 };
    let offered = requester.step(&Event { t_ns: 0, kind: offer(2, Groups::from(MOT)) });
    assert_eq!(offered, Err(full));
    for kind in [offer(2, Groups::NONE), EventKind::Withdraw { station: 2 }] {
        assert!(requester.step(&Event { t_ns: 0, kind })?.is_empty());
    }
    assert_eq!(requester.configuration(), Configuration::AllRemote);
    let lost = requester.step(&Event { t_ns: 0, kind: EventKind::Lost { station: 1 } })?;
    assert_eq!(lost.as_slice(), [Action::Activate(MOT), Action::Activate(PLAN)]);
    let offered = requester.step(&Event { t_ns: 0, kind: offer(2, Groups::from(MOT)) });
    assert_eq!(offered, Err(full), "station 1 was asked, so it is not forgotten");
    assert!(requester.step(&Event { t_ns: 1, kind: EventKind::Tick })?.is_empty());
    Ok(())
}

/// `spec/2-offloading.md`, the defaults; `spec/4-arithmetic.md#domain`: 0 to 2^63 - 1.
#[test]
fn parameters_have_the_defaults_of_the_text_and_none_is_below_0() -> TestResult {
    let expected = Parameters {
        t_wait_ns: 10_000_000_000,
        request_timeout_ns: 500_000_000,
        l_max_ns: 50_000_000,
        dt_max_ns: 100_000_000,
        qos_hold: false,
    };
    assert_eq!(Parameters::default(), expected);
    let widest = Parameters {
        t_wait_ns: i64::MAX,
        request_timeout_ns: i64::MAX,
        l_max_ns: i64::MAX,
        dt_max_ns: 0,
        qos_hold: true,
    };
    Requester::new(Profile::PAPER, widest, &mut [])?;
    for (field, parameters) in [
        ("t_wait_ns", Parameters { t_wait_ns: -1, dt_max_ns: -1, ..expected }),
        ("request_timeout_ns", Parameters { request_timeout_ns: i64::MIN, ..expected }),
        ("l_max_ns", Parameters { l_max_ns: -1, ..expected }),
        ("dt_max_ns", Parameters { dt_max_ns: -1, ..expected }),
    ] {
        let refused = Requester::new(Profile::PAPER, parameters, &mut []).err();
        assert_eq!(refused, Some(RequesterError::NegativeParameter { field }));
    }
    Ok(())
}

/// `spec/hardened/H-08.md`, H-08: a verdict stops local services only when it names the
/// running session of the group, and only after a result of that session was used. PROTO-09.
#[test]
fn a_verdict_of_another_session_stops_nothing() -> TestResult {
    let mut table = [StationRecord::FREE; 2];
    let mut requester = Requester::new(Profile::HARDENED, Parameters::default(), &mut table)?;
    let mut step = |kind| requester.step(&Event { t_ns: 0, kind }).map(|actions| actions.to_vec());
    let safe = |mot| EventKind::Verdict { safe: true, sessions: Sessions { mot, plan: None } };
    step(offer(1, Groups::from(MOT)))?;
    step(EventKind::Tick)?;
    step(EventKind::Confirm { station: 1, group: MOT, session: 1 })?;
    assert_eq!(step(safe(Some(1)))?, [], "no result was used");
    step(EventKind::Data { station: 1, group: MOT, session: 1, generated_ns: 0 })?;
    for other in [None, Some(0), Some(2)] {
        assert_eq!(step(safe(other))?, [], "{other:?}");
    }
    assert_eq!(step(safe(Some(1)))?, [Action::Deactivate(MOT)]);
    assert_eq!(step(safe(Some(1)))?, []);
    Ok(())
}

/// `spec/2-offloading.md#fallback`: a hold is never made shorter, and bars requests alone.
#[test]
fn a_hold_from_outside_bars_requests_until_its_end() -> TestResult {
    let mut table = [StationRecord::FREE; 2];
    let parameters = Parameters { t_wait_ns: 10, ..Parameters::default() };
    let mut requester = Requester::new(Profile::HARDENED, parameters, &mut table)?;
    requester.hold(i64::MIN);
    let _none = requester.step(&Event { t_ns: 0, kind: offer(1, Groups::from(MOT)) })?;
    let asked = requester.step(&Event { t_ns: 0, kind: EventKind::Tick })?;
    assert_eq!(asked.as_slice(), [Action::Request { station: 1, group: MOT, session: 1 }]);
    let confirm = EventKind::Confirm { station: 1, group: MOT, session: 1 };
    requester.hold(5);
    let _none = requester.step(&Event { t_ns: 0, kind: confirm })?;
    let _none = requester.step(&Event { t_ns: 0, kind: offer(1, Groups::ALL) })?;
    requester.hold(-1);
    for t_ns in 0..5 {
        assert!(requester.step(&Event { t_ns, kind: EventKind::Tick })?.is_empty(), "{t_ns}");
    }
    assert_eq!(requester.configuration(), Configuration::MotRemote);
    let asked = requester.step(&Event { t_ns: 5, kind: EventKind::Tick })?;
    assert_eq!(asked.as_slice(), [Action::Request { station: 1, group: PLAN, session: 2 }]);
    let unsafe_cycle = EventKind::Verdict { safe: false, sessions: Sessions::NONE };
    requester.hold(15);
    let _fallback = requester.step(&Event { t_ns: 6, kind: unsafe_cycle })?;
    assert_eq!(requester.hold_until_ns(), Some(16));
    requester.hold(i64::MAX);
    assert_eq!(requester.hold_until_ns(), Some(i64::MAX));
    Ok(())
}
