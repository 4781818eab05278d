//! Laws of the requester (`spec/2-offloading.md`).

use mufasa::input::profile::{HardenedRule, Profile};
use mufasa::offloading::requester::{
    Action, Event, EventKind, Group, GroupState, Parameters, Requester, Source,
};

/// What can be seen of a requester between two events.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Seen {
    /// States of MOT and PLAN.
    pub states: [GroupState; 2],
    /// Sources of MOT and PLAN.
    pub sources: [Source; 2],
    /// End of the last hold, ns.
    pub hold_until_ns: Option<i64>,
    /// `Requester::is_valid`.
    pub valid: bool,
}

impl Seen {
    /// What can be seen of this requester now.
    pub fn of(requester: &Requester<'_>) -> Self {
        Self {
            states: Group::ALL.map(|group| requester.state(group)),
            sources: Group::ALL.map(|group| requester.source(group)),
            hold_until_ns: requester.hold_until_ns(),
            valid: requester.is_valid(),
        }
    }
}

/// One event, what was done about it, and what was seen before and after.
#[derive(Clone, Copy, Debug)]
pub struct Step<'a> {
    /// Profile in force.
    pub profile: Profile,
    /// Times in force.
    pub parameters: Parameters,
    /// Before the event.
    pub before: Seen,
    /// The event.
    pub event: Event,
    /// What the requester did.
    pub actions: &'a [Action],
    /// After the event.
    pub after: Seen,
}

/// A law of one step.
pub type Law = fn(&Step<'_>) -> bool;

/// All laws with their names.
pub const LAWS: [(&str, Law); 9] = [
    ("every_reachable_state_is_valid", every_reachable_state_is_valid),
    ("t_wait_blocks_offloading", t_wait_blocks_offloading),
    ("requests_are_decided_at_ticks_only", requests_are_decided_at_ticks_only),
    ("a_safety_issue_ends_every_remote_service", a_safety_issue_ends_every_remote_service),
    ("a_hold_is_never_shortened", a_hold_is_never_shortened),
    ("a_session_left_is_released_exactly_once", a_session_left_is_released_exactly_once),
    ("actions_come_in_their_order", actions_come_in_their_order),
    ("local_services_stop_when_the_profile_says", local_services_stop_when_the_profile_says),
    ("a_group_becomes_remote_by_confirmation_only", a_group_becomes_remote_by_confirmation_only),
];

/// Every state that events can lead to satisfies the invariant of the requester.
pub fn every_reachable_state_is_valid(step: &Step<'_>) -> bool {
    step.after.valid
}

/// No request is sent before `hold_until` (`spec/2-offloading.md#fallback`, I-08).
pub fn t_wait_blocks_offloading(step: &Step<'_>) -> bool {
    let held = step.before.hold_until_ns.is_some_and(|until_ns| step.event.t_ns < until_ns);
    !held || !step.actions.iter().any(is_request)
}

/// `spec/2-offloading.md#requester`: requests are decided at ticks only.
pub fn requests_are_decided_at_ticks_only(step: &Step<'_>) -> bool {
    step.event.kind == EventKind::Tick || !step.actions.iter().any(is_request)
}

/// After a safety issue every group is local, its source too, and nothing is asked for before now
/// + `t_wait` (`spec/2-offloading.md#fallback`).
pub fn a_safety_issue_ends_every_remote_service(step: &Step<'_>) -> bool {
    if !matches!(step.event.kind, EventKind::Verdict { safe: false, .. }) {
        return true;
    }
    let end_ns = step.event.t_ns.saturating_add(step.parameters.t_wait_ns);
    step.after.states == [GroupState::Local; 2]
        && step.after.sources == [Source::Local; 2]
        && step.after.hold_until_ns.is_some_and(|until_ns| until_ns >= end_ns)
}

/// Whatever happens, and whatever time does, the end of a hold only moves later.
pub fn a_hold_is_never_shortened(step: &Step<'_>) -> bool {
    step.after.hold_until_ns >= step.before.hold_until_ns
}

/// Whoever was asked or ran a group and does so no more gets one release of that session, except
/// for one that rejected or was lost, who gets none. Before that it gets none, but for the one
/// that answers a confirmation that comes too late.
pub fn a_session_left_is_released_exactly_once(step: &Step<'_>) -> bool {
    let silent = matches!(step.event.kind, EventKind::Lost { .. } | EventKind::Reject { .. });
    Group::ALL.into_iter().zip(step.before.states).zip(step.after.states).all(
        |((group, before), after)| {
            let Some((station, session)) = in_use(before) else { return true };
            let left = in_use(after) != Some((station, session));
            let release = Action::Release { station, group, session };
            let releases = step.actions.iter().filter(|action| **action == release).count();
            let too_late = step.event.kind == EventKind::Confirm { station, group, session }
                && after == before
                && matches!(before, GroupState::Requested { .. });
            releases == usize::from((left && !silent) || too_late)
        },
    )
}

/// Drops, releases, activations and deactivations, requests; MOT before PLAN within each.
pub fn actions_come_in_their_order(step: &Step<'_>) -> bool {
    let place = |action: &Action| match *action {
        Action::Drop(group) => (0, group),
        Action::Release { group, .. } => (1, group),
        Action::Activate(group) | Action::Deactivate(group) => (2, group),
        Action::Request { group, .. } => (3, group),
    };
    step.actions.is_sorted_by_key(place)
}

/// Local services stop at the confirmation in the paper profile, at a safe verdict that names the
/// running session of the group in the hardened one (H-08).
pub fn local_services_stop_when_the_profile_says(step: &Step<'_>) -> bool {
    step.actions.iter().all(|action| {
        let Action::Deactivate(stopped) = *action else { return true };
        match (step.profile.has(HardenedRule::H08), step.event.kind) {
            (false, EventKind::Confirm { group, .. }) => group == stopped,
            (true, EventKind::Verdict { safe: true, sessions }) => {
                let state = step.before.states[usize::from(stopped == Group::Plan)];
                let running = matches!(state, GroupState::Remote { session, .. }
                    if sessions.of(stopped) == Some(session));
                running
            }
            (
                true | false,
                EventKind::Offer { .. }
                | EventKind::Withdraw { .. }
                | EventKind::Lost { .. }
                | EventKind::Area { .. }
                | EventKind::Tick
                | EventKind::Confirm { .. }
                | EventKind::Reject { .. }
                | EventKind::Data { .. }
                | EventKind::Verdict { .. },
            ) => false,
        }
    })
}

/// A group that is remote now and was not is the one whose requested session this event confirms,
/// before its deadline.
pub fn a_group_becomes_remote_by_confirmation_only(step: &Step<'_>) -> bool {
    Group::ALL.into_iter().zip(step.before.states).zip(step.after.states).all(
        |((of, before), after)| match (before, after) {
            (_, GroupState::Local | GroupState::Requested { .. })
            | (GroupState::Remote { .. }, GroupState::Remote { .. }) => true,
            (GroupState::Local, GroupState::Remote { .. }) => false,
            (
                GroupState::Requested { station, session, deadline_ns },
                GroupState::Remote { .. },
            ) => {
                step.event.kind == EventKind::Confirm { station, group: of, session }
                    && step.event.t_ns < deadline_ns
                    && in_use(after) == Some((station, session))
            }
        },
    )
}

fn is_request(action: &Action) -> bool {
    matches!(action, Action::Request { .. })
}

/// Station and session that a group is requested from or runs on.
fn in_use(state: GroupState) -> Option<(i64, i64)> {
    match state {
        GroupState::Local => None,
        GroupState::Requested { station, session, .. }
        | GroupState::Remote { station, session } => Some((station, session)),
    }
}
