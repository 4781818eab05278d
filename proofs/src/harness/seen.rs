//! A step of the requester from any state, what was seen of it, and what the laws of `group` ask of it.

use mufasa::input::profile::Profile;
use mufasa::offloading::requester::{
    Action, Event, EventKind, Group, GroupRecord, Groups, Parts, Requester, RequesterError,
    Running, Sessions, StationRecord, Suspended,
};
use mufasa::parts::decide;

use super::any::{groups, near_integer, option, time_ns};
use super::states::{any_record, any_state, any_station};
#[cfg(not(kani))]
use crate::kani;

pub(super) const DROPS: usize = 0;
pub(super) const RELEASES: usize = 1;
pub(super) const SERVICES: usize = 2;
pub(super) const REQUESTS: usize = 3;
pub(super) const GROUPS: [Group; 2] = [Group::Mot, Group::Plan];

/// A step, and what was seen of it.
pub(super) struct Seen {
    pub(super) event: Event,
    pub(super) before: Parts,
    pub(super) after: Parts,
    pub(super) done: [[Option<Action>; 2]; 4],
    /// Of events that have nothing to do with it: the place of a station before and after.
    pub(super) place: Option<[StationRecord; 2]>,
}

impl Seen {
    pub(super) fn is_hardened(&self) -> bool {
        self.before.profile == Profile::HARDENED
    }

    /// The laws of a step that asks for nothing. What the events that name a session leave as it is has harnesses of its
    /// own (`the_other_group_is_untouched`), because one formula of all did not end.
    pub(super) fn keeps_every_law(&self) -> bool {
        self.keeps_the_hold()
            && self.asks_for_nothing()
            && (self.names_a_session() || self.keeps_the_rest())
            && (matches!(self.event.kind, EventKind::Data { .. }) || self.drops_nothing())
            && each(|at| {
                self.becomes_remote_by_confirmation(at)
                    && self.says_what_services_do(at)
                    && self.stops_services_when_the_profile_says(at)
                    && self.keeps_the_group_valid(at)
                    && self.keeps_the_group_in_order(at)
                    && self.keeps_what_stays(at)
            })
    }

    /// The area is that of the last change; profile, times and the table stay.
    pub(super) fn keeps_the_rest(&self) -> bool {
        let area = match self.event.kind {
            EventKind::Area { groups } => groups,
            _ => self.before.area,
        };
        self.after.area == area
            && self.after.profile == self.before.profile
            && self.after.parameters == self.before.parameters
            && self.place.is_none_or(|[before, after]| before == after)
    }

    /// A group that is left is local; one that stays is as it was, but that local services may stop.
    pub(super) fn keeps_what_stays(&self, at: usize) -> bool {
        let before = match (self.event.kind, self.before.groups[at]) {
            _ if self.names_a_session() => return true,
            (EventKind::Verdict { .. }, GroupRecord::Remote(running)) if self.stops(at) => {
                GroupRecord::Remote(Running { local_computes: false, ..running })
            }
            (_, before) => before,
        };
        let expected = if self.leaves(at) { GroupRecord::Local } else { before };
        same(self.after.groups[at], expected)
    }

    /// Only data are dropped and counted.
    pub(super) fn drops_nothing(&self) -> bool {
        each(|at| {
            self.done[DROPS][at].is_none() && self.after.dropped[at] == self.before.dropped[at]
        })
    }

    fn names_a_session(&self) -> bool {
        use EventKind::{Confirm, Data, Reject};
        matches!(self.event.kind, Confirm { .. } | Reject { .. } | Data { .. })
    }

    /// A safety issue holds, and with `qos_hold` a violation, until now + `t_wait` or later; nothing
    /// else changes the hold, which so never ends sooner.
    pub(super) fn keeps_the_hold(&self) -> bool {
        let violates = match self.event.kind {
            EventKind::Data { .. } => self.leaves(0) || self.leaves(1),
            EventKind::Tick => self.is_silent(0) || self.is_silent(1),
            _ => false,
        };
        let end_ns = self.event.t_ns.saturating_add(self.before.parameters.t_wait_ns);
        let later_ns = match self.before.hold_until_ns {
            Some(until_ns) if until_ns > end_ns => until_ns,
            Some(_) | None => end_ns,
        };
        let holds = self.is_unsafe() || (violates && self.before.parameters.qos_hold);
        self.after.hold_until_ns == if holds { Some(later_ns) } else { self.before.hold_until_ns }
    }

    /// The group is overdue or silent.
    pub(super) fn is_due(&self, at: usize) -> bool {
        match self.before.groups[at] {
            GroupRecord::Local => false,
            GroupRecord::Requested { deadline_ns, .. } => self.event.t_ns >= deadline_ns,
            GroupRecord::Remote(_) => self.is_silent(at),
        }
    }

    /// Nothing has come for longer than `dt_max`.
    pub(super) fn is_silent(&self, at: usize) -> bool {
        let GroupRecord::Remote(running) = self.before.groups[at] else { return false };
        let since_ns = i128::from(self.event.t_ns) - i128::from(running.last_arrival_ns);
        since_ns > i128::from(self.before.parameters.dt_max_ns)
    }

    /// Requests are decided at ticks alone.
    pub(super) fn asks_for_nothing(&self) -> bool {
        self.done[REQUESTS][0].is_none()
            && self.done[REQUESTS][1].is_none()
            && self.after.sessions == self.before.sessions
    }

    /// No group becomes remote but by a confirmation that names it.
    pub(super) fn becomes_remote_by_confirmation(&self, at: usize) -> bool {
        let confirms =
            matches!(self.event.kind, EventKind::Confirm { group, .. } if group == GROUPS[at]);
        confirms || !self.is_remote_now(at)
    }

    /// Local services are started and stopped exactly when they start and stop to compute.
    pub(super) fn says_what_services_do(&self, at: usize) -> bool {
        match self.done[SERVICES][at] {
            None => !self.starts(at) && !self.stops(at),
            Some(Action::Activate(group)) => group == GROUPS[at] && self.starts(at),
            Some(Action::Deactivate(group)) => group == GROUPS[at] && self.stops(at),
            Some(Action::Request { .. } | Action::Release { .. } | Action::Drop(_)) => false,
        }
    }

    /// Drops and releases are in the places of their kind and group, and name that group; for the other
    /// two kinds see `says_what_services_do` and `asks_for_nothing`.
    pub(super) fn lists_actions_by_kind(&self, at: usize) -> bool {
        let drops = match self.done[DROPS][at] {
            None => true,
            Some(Action::Drop(group)) => group == GROUPS[at],
            Some(_) => false,
        };
        drops
            && match self.done[RELEASES][at] {
                None => true,
                Some(Action::Release { group, .. }) => group == GROUPS[at],
                Some(_) => false,
            }
    }

    /// If the group was valid: hardened, local services stop exactly at a safe verdict that names the running session
    /// after a result was used (H-08); paper, at the confirmation.
    pub(super) fn stops_services_when_the_profile_says(&self, at: usize) -> bool {
        let may = match (self.before.profile, self.event.kind, self.before.groups[at]) {
            (Profile::PAPER, EventKind::Confirm { group, .. }, _) => group == GROUPS[at],
            (
                Profile::HARDENED,
                EventKind::Verdict { safe: true, sessions },
                GroupRecord::Remote(running),
            ) => {
                let named = if at == 0 { sessions.mot } else { sessions.plan };
                running.last_used_ns.is_some()
                    && match named {
                        Some(session) => session == running.session,
                        None => false,
                    }
            }
            _ => false,
        };
        let is_due = may && self.is_hardened() && computes(self.before.groups[at]);
        !self.is_valid(self.before.groups[at]) || if self.stops(at) { may } else { !is_due }
    }

    /// Paper: no local services compute beside remote ones. Hardened: none stop before a result was
    /// used.
    pub(super) fn keeps_the_group_valid(&self, at: usize) -> bool {
        !self.is_valid(self.before.groups[at]) || self.is_valid(self.after.groups[at])
    }

    /// What is in use is in the area, and its session is one of those so far.
    pub(super) fn keeps_the_group_in_order(&self, at: usize) -> bool {
        let (before, after) = (self.before.groups[at], self.after.groups[at]);
        let area = |area: Groups| if at == 0 { area.mot } else { area.plan };
        !is_in_order(before, area(self.before.area), self.before.sessions)
            || is_in_order(after, area(self.after.area), self.after.sessions)
    }

    pub(super) fn is_valid(&self, group: GroupRecord) -> bool {
        match (group, self.is_hardened()) {
            (GroupRecord::Local | GroupRecord::Requested { .. }, _) => true,
            (GroupRecord::Remote(running), false) => !running.local_computes,
            (GroupRecord::Remote(running), true) => {
                running.local_computes || running.last_used_ns.is_some()
            }
        }
    }

    pub(super) fn starts(&self, at: usize) -> bool {
        !computes(self.before.groups[at]) && computes(self.after.groups[at])
    }

    pub(super) fn stops(&self, at: usize) -> bool {
        computes(self.before.groups[at]) && !computes(self.after.groups[at])
    }

    pub(super) fn is_remote_now(&self, at: usize) -> bool {
        let is_remote = |group: GroupRecord| matches!(group, GroupRecord::Remote(_));
        !is_remote(self.before.groups[at]) && is_remote(self.after.groups[at])
    }

    pub(super) fn has_hold(&self) -> bool {
        self.before.hold_until_ns.is_none() && self.after.hold_until_ns.is_some()
    }

    pub(super) fn is_unsafe(&self) -> bool {
        matches!(self.event.kind, EventKind::Verdict { safe: false, .. })
    }

    /// Nothing is done about the group, and it is as it was.
    pub(super) fn leaves_alone(&self, at: usize) -> bool {
        same(self.before.groups[at], self.after.groups[at])
            && self.after.dropped[at] == self.before.dropped[at]
            && self.done[DROPS][at].is_none()
            && self.done[RELEASES][at].is_none()
            && self.done[SERVICES][at].is_none()
            && self.done[REQUESTS][at].is_none()
    }

    /// The group does no more use what it used.
    pub(super) fn leaves(&self, at: usize) -> bool {
        let used = in_use(self.before.groups[at]);
        used.is_some() && in_use(self.after.groups[at]) != used
    }

    /// The group is local after the step, or the step asks for it.
    fn is_free(&self, at: usize) -> bool {
        matches!(self.after.groups[at], GroupRecord::Local) || self.done[REQUESTS][at].is_some()
    }

    /// One release of the session if the group is left, which is local then or asked for anew, else none.
    pub(super) fn releases_what_it_leaves(&self, at: usize) -> bool {
        match self.done[RELEASES][at] {
            None => !self.leaves(at),
            Some(Action::Release { station, group, session }) => {
                self.leaves(at)
                    && self.is_free(at)
                    && group == GROUPS[at]
                    && in_use(self.before.groups[at]) == Some((station, session))
            }
            Some(_) => false,
        }
    }
}

/// Whether it holds of both groups.
pub(super) fn each(holds: impl Fn(usize) -> bool) -> bool {
    holds(0) && holds(1)
}

/// Field by field, so that nothing has to be in memory.
pub(super) fn same(one: GroupRecord, other: GroupRecord) -> bool {
    match (one, other) {
        (GroupRecord::Local, GroupRecord::Local) => true,
        (
            GroupRecord::Requested { station, session, deadline_ns },
            GroupRecord::Requested { station: s, session: n, deadline_ns: d },
        ) => station == s && session == n && deadline_ns == d,
        (GroupRecord::Remote(a), GroupRecord::Remote(b)) => {
            a.station == b.station
                && a.session == b.session
                && a.last_arrival_ns == b.last_arrival_ns
                && a.last_used_ns == b.last_used_ns
                && a.local_computes == b.local_computes
        }
        (GroupRecord::Local | GroupRecord::Requested { .. } | GroupRecord::Remote(_), _) => false,
    }
}

pub(super) fn in_use(group: GroupRecord) -> Option<(i64, i64)> {
    match group {
        GroupRecord::Local => None,
        GroupRecord::Requested { station, session, .. }
        | GroupRecord::Remote(Running { station, session, .. }) => Some((station, session)),
    }
}

fn is_in_order(group: GroupRecord, in_area: bool, sessions: i64) -> bool {
    match in_use(group) {
        None => true,
        Some((_, session)) => in_area && 1 <= session && session <= sessions,
    }
}

/// Whether the local services of the group compute.
pub(super) fn computes(group: GroupRecord) -> bool {
    match group {
        GroupRecord::Local | GroupRecord::Requested { .. } => true,
        GroupRecord::Remote(running) => running.local_computes,
    }
}

pub(super) fn area(see: &impl Fn(&Seen)) {
    see(&after_beside_the_table(EventKind::Area { groups: groups() }));
}

pub(super) fn tick(see: &impl Fn(&Seen)) {
    see(&after(EventKind::Tick, &mut []));
}

pub(super) fn verdict(see: &impl Fn(&Seen)) {
    see(&after_beside_the_table(any_verdict()));
}

pub(super) fn data(see: &impl Fn(&Seen)) {
    data_of(&|step: &Seen, _, _| see(step));
}

pub(super) fn confirm(see: &impl Fn(&Seen, usize, (i64, i64))) {
    naming(see, |station, group, session| EventKind::Confirm { station, group, session });
}

pub(super) fn reject(see: &impl Fn(&Seen, usize, (i64, i64))) {
    naming(see, |station, group, session| EventKind::Reject { station, group, session });
}

pub(super) fn data_of(see: &impl Fn(&Seen, usize, (i64, i64))) {
    let generated_ns = time_ns();
    naming(see, |station, group, session| EventKind::Data {
        station,
        group,
        session,
        generated_ns,
    });
}

/// The group is chosen last, so that it is a constant in each of the two branches.
pub(super) fn naming(
    see: &impl Fn(&Seen, usize, (i64, i64)),
    kind: impl Fn(i64, Group, i64) -> EventKind,
) {
    let (station, session) = (any_station(), near_integer(1, 6));
    if kani::any() {
        see(&after_beside_the_table(kind(station, Group::Mot, session)), 0, (station, session));
    } else {
        see(&after_beside_the_table(kind(station, Group::Plan, session)), 1, (station, session));
    }
}

pub(super) fn any_verdict() -> EventKind {
    let (mot, plan) = (option(|| near_integer(1, 6)), option(|| near_integer(1, 6)));
    EventKind::Verdict { safe: kani::any(), sessions: Sessions { mot, plan } }
}

pub(super) fn after(kind: EventKind, table: &mut [StationRecord]) -> Seen {
    after_in(any_state(), Event { t_ns: time_ns(), kind }, table)
}

pub(super) fn after_in(before: Parts, event: Event, table: &mut [StationRecord]) -> Seen {
    let (Ok(done), after) = answered(&before, event, table) else {
        unreachable!("no event is refused")
    };
    Seen { event, before, after, done, place: None }
}

/// Actions by kind and group.
type Answer = Result<[[Option<Action>; 2]; 4], RequesterError>;

/// What is said of the event, and the state after it.
pub(super) fn answered(
    before: &Parts,
    event: Event,
    table: &mut [StationRecord],
) -> (Answer, Parts) {
    let mut requester = Requester::resume(Suspended::from_parts(before), table);
    let done = decide(&mut requester, &event);
    (done, requester.suspend().parts())
}

/// With one station in the table, with which such an event has nothing to do; a change that looks at what
/// it offers is seen.
fn after_beside_the_table(kind: EventKind) -> Seen {
    let record = any_record();
    let mut table = [record];
    let step = after(kind, &mut table);
    Seen { place: Some([record, table[0]]), ..step }
}
