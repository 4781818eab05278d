//! Events of the model for C, and what C says in words of the model.

use mufasa_capi::event::{
    MufasaAction, MufasaActionType, MufasaEvent, MufasaEventType as Kind, MufasaGroup,
};
use mufasa_capi::monitor::{MufasaActions, MufasaDropReason};
use mufasa_capi::requester::{MufasaGroupState, MufasaGroupStateKind};
use mufasa_capi::time::MufasaTime;
use mufasa_model::monitor::messages::{Dropped, EventKind};
use mufasa_model::offloading::requester::{Action, Group, GroupState, Groups};

/// An event that needs no more than this.
pub fn plain(t: MufasaTime, kind: &EventKind) -> MufasaEvent {
    let set = |Groups { mot, plan }: Groups| u32::from(mot) | u32::from(plan) << 1;
    let one = |group: Group| set(Groups { mot: group == Group::Mot, plan: group == Group::Plan });
    let (event_type, station, group, groups, session) = match *kind {
        EventKind::Offer { station, groups } => (Kind::Offer, station, 0, set(groups), 0),
        EventKind::Withdraw { station } => (Kind::Withdraw, station, 0, 0, 0),
        EventKind::Lost { station } => (Kind::Lost, station, 0, 0, 0),
        EventKind::Area { groups } => (Kind::Area, 0, 0, set(groups), 0),
        EventKind::Tick => (Kind::Tick, 0, 0, 0, 0),
        EventKind::Confirm { station, group, session } => {
            (Kind::Confirm, station, one(group), 0, session)
        }
        EventKind::Reject { station, group, session } => {
            (Kind::Reject, station, one(group), 0, session)
        }
        EventKind::Tracks { .. } | EventKind::Trajectory { .. } | EventKind::Cycle { .. } => {
            unreachable!("these have contents")
        }
    };
    MufasaEvent { t, event_type: event_type as u32, group, groups, station, session }
}

pub fn group_state(it: MufasaGroupState) -> GroupState {
    let MufasaGroupState { kind, station, session, deadline, .. } = it;
    match kind {
        MufasaGroupStateKind::Local => GroupState::Local,
        MufasaGroupStateKind::Requested => {
            GroupState::Requested { station, session, deadline_ns: deadline.ns }
        }
        MufasaGroupStateKind::Remote => GroupState::Remote { station, session },
    }
}

pub fn reason(it: MufasaDropReason) -> Option<Dropped> {
    Some(match it {
        MufasaDropReason::None => return None,
        MufasaDropReason::TooLong => Dropped::DoesNotFit,
        MufasaDropReason::OtherSession => Dropped::OtherSession,
        MufasaDropReason::FromTheFuture
        | MufasaDropReason::Late
        | MufasaDropReason::AfterSilence => Dropped::Late,
        MufasaDropReason::TooOld => Dropped::Stale,
        MufasaDropReason::Starved => Dropped::Starved,
        MufasaDropReason::NotNewer => Dropped::Repeated,
    })
}

pub fn taken(actions: &MufasaActions) -> Vec<Action> {
    let action = |it: &MufasaAction| {
        let (station, session) = (it.station, it.session);
        let group = match it.group {
            MufasaGroup::Mot => Group::Mot,
            MufasaGroup::Plan => Group::Plan,
        };
        match it.action_type {
            MufasaActionType::Request => Action::Request { station, group, session },
            MufasaActionType::Release => Action::Release { station, group, session },
            MufasaActionType::Activate => Action::Activate(group),
            MufasaActionType::Deactivate => Action::Deactivate(group),
            MufasaActionType::Drop => Action::Drop(group),
        }
    };
    actions.items[..actions.len].iter().map(action).collect()
}
