//! Arbitrary states of the requester and places of its table, valid or not, and stations.

use mufasa::offloading::requester::{
    EventKind, GroupRecord, Parameters, Parts, Running, StationRecord,
};

use super::any::{below, duration_ns, groups, near_integer, option, profile, time_ns};
#[cfg(not(kani))]
use crate::kani;

/// Any id that a station can have.
pub(super) fn any_station() -> i64 {
    let station = near_integer(1, 3);
    kani::assume(station >= 1);
    station
}

/// A withdrawal or, if told, a loss of any station that there can be, and that station.
pub(super) fn withdrawal(is_loss: bool) -> (EventKind, i64) {
    let station = any_station();
    let kind = if is_loss { EventKind::Lost { station } } else { EventKind::Withdraw { station } };
    (kind, station)
}

pub(super) fn any_record() -> StationRecord {
    any_record_of(near_integer(1, 3))
}

/// A place that is free, or that of this station.
pub(super) fn any_record_of(station: i64) -> StationRecord {
    let last_request = [option(|| near_integer(1, 6)), option(|| near_integer(1, 6))];
    StationRecord::from_parts(station, groups(), last_request)
}

pub(super) fn any_state() -> Parts {
    any_state_with([any_group(), any_group()])
}

pub(super) fn any_state_with(groups_in_use: [GroupRecord; 2]) -> Parts {
    Parts {
        profile: profile(),
        parameters: any_parameters(),
        groups: groups_in_use,
        hold_until_ns: option(time_ns),
        area: groups(),
        sessions: near_integer(4, 8),
        dropped: [kani::any(), kani::any()],
    }
}

pub(super) fn any_parameters() -> Parameters {
    Parameters {
        t_wait_ns: duration_ns(),
        request_timeout_ns: duration_ns(),
        l_max_ns: duration_ns(),
        dt_max_ns: duration_ns(),
        qos_hold: kani::any(),
    }
}

pub(super) fn any_group() -> GroupRecord {
    any_group_of(|free| free)
}

/// Everything is drawn first and chosen from then; see `any::option`. Station and session are chosen
/// by `named`, of free ones.
pub(super) fn any_group_of(named: impl FnOnce((i64, i64)) -> (i64, i64)) -> GroupRecord {
    let (kind, free) = (below(3), (near_integer(1, 3), near_integer(1, 6)));
    let (deadline_ns, last_arrival_ns, last_used_ns) = (time_ns(), time_ns(), option(time_ns));
    let local_computes = kani::any();
    let (station, session) = named(free);
    match kind {
        0 => GroupRecord::Local,
        1 => GroupRecord::Requested { station, session, deadline_ns },
        _ => GroupRecord::Remote(Running {
            station,
            session,
            last_arrival_ns,
            last_used_ns,
            local_computes,
        }),
    }
}
