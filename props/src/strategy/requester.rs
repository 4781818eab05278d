//! Event sequences for the requester, with times at its borders: deadlines, holds, silence,
//! latency, the limits of 64 bits, time that runs backwards (`spec/2-offloading.md`).

use mufasa_model::input::cycle::Profile;
use mufasa_model::offloading::requester::{
    Event, EventKind, Group, GroupState, Groups, Parameters, Requester, Sessions,
};

use super::draw::Draw;

/// A requester's parameters and the events it gets.
#[derive(Clone, Debug)]
pub struct Trace {
    /// Profile in force.
    pub profile: Profile,
    /// Its times.
    pub parameters: Parameters,
    /// What happens.
    pub events: Vec<Event>,
    /// How many events lie within one nanosecond of a border.
    pub near: usize,
}

/// A trace of up to 40 events. A requester of the model goes along, but only so that events can
/// name its sessions and meet its deadlines.
pub fn trace(draw: &mut Draw<'_>) -> Trace {
    let profile = draw.pick(&[Profile::HARDENED, Profile::PAPER]);
    let parameters = parameters(draw);
    let mut guide = Guide::new(profile, parameters);
    let mut events = Vec::new();
    let mut near = 0;
    for _ in 0..draw.between(4, 40) {
        let (t_ns, is_near) = guide.time(draw);
        let (kind, also_near) = guide.kind(draw, t_ns);
        let event = Event { t_ns, kind };
        guide.take(&event);
        near += usize::from(is_near || also_near);
        events.push(event);
    }
    Trace { profile, parameters, events, near }
}

fn parameters(draw: &mut Draw<'_>) -> Parameters {
    let mut parameters = Parameters::default();
    if draw.one_in(3) {
        parameters.t_wait_ns = draw.pick(&[0, 1, 1_000, i64::MAX]);
        parameters.request_timeout_ns = draw.pick(&[0, 1, 500, i64::MAX]);
        parameters.l_max_ns = draw.pick(&[0, 50, i64::MAX]);
        parameters.dt_max_ns = draw.pick(&[0, 100, i64::MAX]);
    }
    parameters.qos_hold = draw.one_in(3);
    parameters
}

/// What a generator has to know to aim.
struct Guide {
    requester: Requester,
    parameters: Parameters,
    now_ns: i64,
    /// Last arrival or activation of a group, and the generation time of its last element.
    arrival_ns: [i64; 2],
    generated_ns: [i64; 2],
}

impl Guide {
    fn new(profile: Profile, parameters: Parameters) -> Self {
        let requester = Requester::new(profile, parameters);
        Self { requester, parameters, now_ns: 0, arrival_ns: [0; 2], generated_ns: [0; 2] }
    }

    /// The time of the next event, and whether it is within 1 ns of a border.
    fn time(&self, draw: &mut Draw<'_>) -> (i64, bool) {
        let index = draw.below(2);
        let border = match draw.below(12) {
            0..=2 => match self.requester.state(Group::ALL[index]) {
                GroupState::Requested { deadline_ns, .. } => Some(deadline_ns),
                GroupState::Remote { .. } => {
                    Some(self.arrival_ns[index].saturating_add(self.parameters.dt_max_ns))
                }
                GroupState::Local => self.requester.hold_until_ns(),
            },
            3 | 4 => self.requester.hold_until_ns(),
            5 => Some(draw.pick(&[i64::MAX, i64::MIN])).filter(|_| draw.one_in(8)),
            _ => None,
        };
        if let Some(border) = border {
            return (draw.near_ns(border), true);
        }
        let step = match draw.below(8) {
            0..=3 => draw.pick(&[10_000_000, 1, 40_000_000, 100]),
            4 => 0,
            5 => -draw.pick(&[1, 50_000_000, 20_000_000_000]),
            6 => 600_000_000,
            _ => 11_000_000_000,
        };
        (self.now_ns.saturating_add(step), false)
    }

    /// What happens, and whether its generation time is within 1 ns of a border.
    fn kind(&self, draw: &mut Draw<'_>, t_ns: i64) -> (EventKind, bool) {
        let station = draw.pick(&[1, 2, 3, 1, 2, 9, i64::MAX]);
        let groups = draw.pick(&[
            Groups::ALL,
            Groups { mot: true, plan: false },
            Groups { mot: false, plan: true },
            Groups::NONE,
        ]);
        let index = draw.below(2);
        let group = Group::ALL[index];
        let (station_in_use, session) = self.session(draw, group, station);
        if draw.below(2) == 0 {
            return (self.progress(draw, group, t_ns), false);
        }
        let kind = match draw.below(20) {
            0..=3 => EventKind::Tick,
            4..=6 => EventKind::Offer { station, groups },
            7 => EventKind::Withdraw { station: station_in_use },
            8 => EventKind::Lost { station: station_in_use },
            9 => EventKind::Area { groups },
            10..=13 => EventKind::Confirm { station: station_in_use, group, session },
            14 => EventKind::Reject { station: station_in_use, group, session },
            15..=17 => {
                let (generated_ns, near) = self.generated(draw, index, t_ns);
                let station = station_in_use;
                return (EventKind::Data { station, group, session, generated_ns }, near);
            }
            18 => EventKind::Verdict { safe: true, sessions: self.sessions(draw, groups) },
            _ => EventKind::Verdict { safe: false, sessions: self.sessions(draw, groups) },
        };
        (kind, false)
    }

    /// The running sessions of the groups, or at times another of one.
    fn sessions(&self, draw: &mut Draw<'_>, groups: Groups) -> Sessions {
        let mut sessions = self.requester.sessions(groups);
        if draw.below(3) == 0 {
            let other = draw.pick(&[-1, 1, 0, i64::MAX]);
            let beside = |it: i64| it.saturating_add(other);
            match draw.below(2) {
                0 => sessions.mot = sessions.mot.map(beside),
                _ => sessions.plan = Some(sessions.plan.map_or(other, beside)),
            }
        }
        sessions
    }

    /// What leads on to remote services: an offer, a tick, a confirmation, data, a safe verdict.
    fn progress(&self, draw: &mut Draw<'_>, group: Group, t_ns: i64) -> EventKind {
        match self.requester.state(group) {
            GroupState::Local if draw.below(3) == 0 => {
                EventKind::Offer { station: draw.pick(&[1, 2, 3]), groups: Groups::ALL }
            }
            GroupState::Local => EventKind::Tick,
            GroupState::Requested { station, session, .. } => {
                EventKind::Confirm { station, group, session }
            }
            GroupState::Remote { station, session } => match draw.below(3) {
                0 => {
                    let sessions = self.sessions(draw, Groups::ALL);
                    EventKind::Verdict { safe: true, sessions }
                }
                _ => EventKind::Data {
                    station,
                    group,
                    session,
                    generated_ns: t_ns.saturating_sub(1_000),
                },
            },
        }
    }

    /// Mostly the session and station in use, at times others.
    fn session(&self, draw: &mut Draw<'_>, group: Group, station: i64) -> (i64, i64) {
        let (in_use, session) = match self.requester.state(group) {
            GroupState::Local => (station, 1),
            GroupState::Requested { station, session, .. }
            | GroupState::Remote { station, session } => (station, session),
        };
        let other = draw.pick(&[session - 1, session + 1, 0, -1, i64::MAX, i64::MIN]);
        (
            if draw.one_in(8) { station } else { in_use },
            if draw.one_in(8) { other } else { session },
        )
    }

    /// Generation times at the borders of latency and order, and others.
    fn generated(&self, draw: &mut Draw<'_>, index: usize, t_ns: i64) -> (i64, bool) {
        match draw.below(8) {
            0 | 1 => (draw.near_ns(t_ns.saturating_sub(self.parameters.l_max_ns)), true),
            2 | 3 => (draw.near_ns(t_ns), true),
            4 => (draw.near_ns(self.generated_ns[index]), true),
            5 => (draw.pick(&[i64::MIN, i64::MAX]), false),
            _ => (t_ns.saturating_sub(20_000_000), false),
        }
    }

    fn take(&mut self, event: &Event) {
        self.requester.step(event);
        self.now_ns = event.t_ns;
        match event.kind {
            EventKind::Confirm { group, .. } => self.arrival_ns[place(group)] = event.t_ns,
            EventKind::Data { group, generated_ns, .. } => {
                self.arrival_ns[place(group)] = event.t_ns;
                self.generated_ns[place(group)] = generated_ns;
            }
            EventKind::Offer { .. }
            | EventKind::Withdraw { .. }
            | EventKind::Lost { .. }
            | EventKind::Area { .. }
            | EventKind::Tick
            | EventKind::Reject { .. }
            | EventKind::Verdict { .. } => {}
        }
    }
}

fn place(group: Group) -> usize {
    match group {
        Group::Mot => 0,
        Group::Plan => 1,
    }
}
