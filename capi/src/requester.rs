//! The state of a monitor's requester for C, and what it refuses.

use mufasa::offloading::requester::{Group, GroupState, Requester, RequesterError};

use crate::convert;
use crate::cycle::MufasaConfiguration;
use crate::status::MufasaStatus;
use crate::time::MufasaTime;

/// The state of a group.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MufasaGroupStateKind {
    /// It runs on the CAV.
    Local = 0,
    /// It runs on the CAV, and a station was asked to run it.
    Requested = 1,
    /// It runs on a station.
    Remote = 2,
}

/// The state of a group.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaGroupState {
    /// What it is.
    pub kind: MufasaGroupStateKind,
    /// The station, or 0.
    pub station: i64,
    /// The session, or 0.
    pub session: i64,
    /// Of a requested group: a confirmation must come before this time.
    pub deadline: MufasaTime,
    /// The station whose results may reach control; 0 is the CAV.
    pub source: i64,
}

/// The state of a requester.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaRequesterState {
    /// MOT.
    pub mot: MufasaGroupState,
    /// PLAN.
    pub plan: MufasaGroupState,
    /// Which groups are remote.
    pub configuration: MufasaConfiguration,
    /// 0: there never was a hold.
    pub has_hold: u32,
    /// No request is sent before this time.
    pub hold_until: MufasaTime,
}

/// The state for C.
pub(crate) fn state_of(requester: &Requester<'_>) -> MufasaRequesterState {
    let group = |group| {
        let (kind, station, session, deadline_ns) = match requester.state(group) {
            GroupState::Local => (MufasaGroupStateKind::Local, 0, 0, 0),
            GroupState::Requested { station, session, deadline_ns } => {
                (MufasaGroupStateKind::Requested, station, session, deadline_ns)
            }
            GroupState::Remote { station, session } => {
                (MufasaGroupStateKind::Remote, station, session, 0)
            }
        };
        let source = requester.source(group).station();
        MufasaGroupState {
            kind,
            station,
            session,
            deadline: MufasaTime { ns: deadline_ns },
            source,
        }
    };
    MufasaRequesterState {
        mot: group(Group::Mot),
        plan: group(Group::Plan),
        configuration: convert::configuration_number(requester.configuration()),
        has_hold: u32::from(requester.hold_until_ns().is_some()),
        hold_until: MufasaTime { ns: requester.hold_until_ns().unwrap_or(0) },
    }
}

/// Why settings or an event were not taken.
pub(crate) fn refused(error: RequesterError) -> MufasaStatus {
    match error {
        RequesterError::NegativeParameter { .. } => MufasaStatus::NegativeParameter,
        RequesterError::Station { .. } => MufasaStatus::InvalidStation,
        RequesterError::TableFull { .. } => MufasaStatus::TableFull,
    }
}
