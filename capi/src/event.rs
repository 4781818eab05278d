//! Events and actions of a monitor, as C gives and gets them.

use mufasa::offloading::requester::{Action, Group, Groups};

use crate::status::MufasaStatus;
use crate::time::MufasaTime;

/// A group of services; a set of groups is the sum of their numbers.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MufasaGroup {
    /// MOT: multi-object tracking.
    Mot = 1,
    /// PLAN: environment model and trajectory planning.
    Plan = 2,
}

/// What happens; the comment says which further fields of MufasaEvent it uses.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MufasaEventType {
    /// A station offers groups: station, groups.
    Offer = 1,
    /// A station withdraws its offer: station.
    Withdraw = 2,
    /// A station can no longer be reached: station.
    Lost = 3,
    /// These groups may be offloaded here: groups.
    Area = 4,
    /// Time passes.
    Tick = 5,
    /// A station confirms: station, group, session.
    Confirm = 6,
    /// A station rejects: station, group, session.
    Reject = 7,
}

/// Something that happens at a time. Fields that its type does not use may be anything.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaEvent {
    /// The CAV's monotonic clock.
    pub t: MufasaTime,
    /// A MufasaEventType.
    pub event_type: u32,
    /// A MufasaGroup.
    pub group: u32,
    /// Sum of MufasaGroup.
    pub groups: u32,
    /// Id of the station, at least 1.
    pub station: i64,
    /// The session that the message names.
    pub session: i64,
}

/// What the requester does; the comment says which fields of MufasaAction it uses.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MufasaActionType {
    /// Ask a station to run a group: station, group, session.
    Request = 1,
    /// Tell a station that a session has ended: station, group, session.
    Release = 2,
    /// Start the local services: group.
    Activate = 3,
    /// Stop the local services: group.
    Deactivate = 4,
    /// Do not use the element that arrived: group.
    Drop = 5,
}

/// Something to be done.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaAction {
    /// What.
    pub action_type: MufasaActionType,
    /// Which group.
    pub group: MufasaGroup,
    /// Id of the station, or 0.
    pub station: i64,
    /// The session, or 0.
    pub session: i64,
}

/// One event never makes more actions than this.
pub const MUFASA_MAX_ACTIONS: usize = 8;

/// The type of this number.
pub(crate) fn event_type(raw: u32) -> Result<MufasaEventType, MufasaStatus> {
    let types = [
        MufasaEventType::Offer,
        MufasaEventType::Withdraw,
        MufasaEventType::Lost,
        MufasaEventType::Area,
        MufasaEventType::Tick,
        MufasaEventType::Confirm,
        MufasaEventType::Reject,
    ];
    types.into_iter().find(|&it| it as u32 == raw).ok_or(MufasaStatus::UnknownValue)
}

/// The groups of which this is the sum.
pub(crate) fn groups(raw: u32) -> Result<Groups, MufasaStatus> {
    let (mot, plan) = (MufasaGroup::Mot as u32, MufasaGroup::Plan as u32);
    if raw & !(mot | plan) != 0 {
        return Err(MufasaStatus::UnknownValue);
    }
    Ok(Groups { mot: raw & mot != 0, plan: raw & plan != 0 })
}

/// The group of this number.
pub(crate) fn group(raw: u32) -> Result<Group, MufasaStatus> {
    let found = Group::ALL.into_iter().find(|&group| group_number(group) as u32 == raw);
    found.ok_or(MufasaStatus::UnknownValue)
}

pub(crate) const fn group_number(group: Group) -> MufasaGroup {
    match group {
        Group::Mot => MufasaGroup::Mot,
        Group::Plan => MufasaGroup::Plan,
    }
}

/// The action for C.
pub(crate) fn action(action: Action) -> MufasaAction {
    let message = |action_type, station, group, session| MufasaAction {
        action_type,
        group: group_number(group),
        station,
        session,
    };
    match action {
        Action::Request { station, group, session } => {
            message(MufasaActionType::Request, station, group, session)
        }
        Action::Release { station, group, session } => {
            message(MufasaActionType::Release, station, group, session)
        }
        Action::Activate(group) => message(MufasaActionType::Activate, 0, group, 0),
        Action::Deactivate(group) => message(MufasaActionType::Deactivate, 0, group, 0),
        Action::Drop(group) => message(MufasaActionType::Drop, 0, group, 0),
    }
}
