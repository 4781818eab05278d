//! The laws of the requester over every event sequence of a small alphabet
//! (`spec/2-offloading.md`).

use std::vec::Vec;

use mufasa::input::profile::Profile;
use mufasa::offloading::requester::{
    Action, Event, EventKind, Group, GroupState, Groups, Parameters, Requester, Sessions, Source,
    StationRecord, Suspended,
};

use super::{Run, Topic};
use crate::law::requester::{LAWS, Law, Seen, Step};

/// What is run.
pub const TOPIC: Topic = Topic {
    name: "requester",
    domain: "every sequence of up to 6 of 17 events from the first state, two stations, times of a few \
             nanoseconds, both profiles. Not covered: longer sequences, time that runs backwards, `qos_hold`",
    laws: || LAWS.iter().map(|&(name, _)| name).collect(),
    run,
};

/// Longest sequence: offer, tick, confirm, unsafe, tick, confirm is the shortest with two holds.
const LENGTH: usize = 6;

/// Times in force, ns.
pub const PARAMETERS: Parameters =
    Parameters { t_wait_ns: 2, request_timeout_ns: 2, l_max_ns: 1, dt_max_ns: 1, qos_hold: false };

/// Events with the time that passes before them; sessions are those in use.
#[derive(Clone, Copy, Debug)]
enum Letter {
    OfferAll,
    OfferPlanElsewhere,
    Withdraw,
    Lost,
    AreaWithoutPlan,
    Tick(i64),
    Confirm(Group),
    ConfirmLate(Group),
    Reject(Group),
    Data(Group, i64),
    Safe,
    SafeWithoutMot,
    SafeTooLate,
    Unsafe,
}

const ALPHABET: [Letter; 17] = [
    Letter::OfferAll,
    Letter::OfferPlanElsewhere,
    Letter::Withdraw,
    Letter::Lost,
    Letter::AreaWithoutPlan,
    Letter::Tick(0),
    Letter::Tick(1),
    Letter::Tick(2),
    Letter::Confirm(Group::Mot),
    Letter::Confirm(Group::Plan),
    Letter::ConfirmLate(Group::Mot),
    Letter::Reject(Group::Plan),
    Letter::Data(Group::Mot, 0),
    Letter::Safe,
    Letter::SafeWithoutMot,
    Letter::SafeTooLate,
    Letter::Unsafe,
];

/// A step that can be changed.
#[derive(Clone, Debug)]
pub struct Taken {
    /// Profile in force.
    pub profile: Profile,
    /// Before the event.
    pub before: Seen,
    /// The event.
    pub event: Event,
    /// What the requester did.
    pub actions: Vec<Action>,
    /// After the event.
    pub after: Seen,
}

impl Taken {
    /// Whether the law holds of this step.
    pub fn keeps(&self, law: Law) -> bool {
        let Self { profile, before, event, ref actions, after } = *self;
        law(&Step { profile, parameters: PARAMETERS, before, event, actions, after })
    }

    fn is_after(&self, test: fn(&GroupState) -> bool) -> bool {
        self.after.states.iter().any(test)
    }

    fn does(&self, test: fn(&Action) -> bool) -> bool {
        self.actions.iter().any(test)
    }
}

/// Visits every step of every sequence of this length.
pub fn every_step(profile: Profile, length: usize, visit: &mut impl FnMut(&Taken)) {
    explore(&Node::start(profile), profile, length, visit);
}

fn run() -> Run {
    let (mut cases, mut broken, mut seen) = (0, LAWS.map(|_| None), [0; SIGHTS.len()]);
    for profile in [Profile::PAPER, Profile::HARDENED] {
        every_step(profile, LENGTH, &mut |step| {
            cases += 1;
            for ((_, law), broken) in LAWS.into_iter().zip(&mut broken) {
                if broken.is_none() && !step.keeps(law) {
                    *broken = Some(std::format!("{step:?}"));
                }
            }
            for ((_, is_seen), count) in SIGHTS.into_iter().zip(&mut seen) {
                *count += u64::from(is_seen(step));
            }
        });
    }
    let laws = LAWS.into_iter().zip(broken).map(|((name, _), broken)| (name, broken));
    let reached = SIGHTS.into_iter().zip(seen).map(|((what, _), count)| (what, count));
    Run { cases, laws: laws.collect(), reached: reached.collect() }
}

/// A requester put aside, with its table and its time.
#[derive(Clone, Copy)]
struct Node {
    aside: Suspended,
    table: [StationRecord; 2],
    now_ns: i64,
}

impl Node {
    fn start(profile: Profile) -> Self {
        let mut table = [StationRecord::FREE; 2];
        let requester = Requester::new(profile, PARAMETERS, &mut table).expect("valid times");
        let aside = requester.suspend();
        Self { aside, table, now_ns: 0 }
    }

    /// The node behind one letter, and what was seen on the way.
    fn follow(&self, profile: Profile, letter: Letter) -> (Self, Taken) {
        let mut next = *self;
        let mut requester = Requester::resume(self.aside, &mut next.table);
        let before = Seen::of(&requester);
        let event = event(&before, self.now_ns, letter);
        let actions = requester.step(&event).expect("two stations have two places");
        let after = Seen::of(&requester);
        next.aside = requester.suspend();
        next.now_ns = event.t_ns;
        let actions = actions.as_slice().to_vec();
        (next, Taken { profile, before, event, actions, after })
    }
}

fn event(before: &Seen, now_ns: i64, letter: Letter) -> Event {
    let session = |group: Group| match before.states[usize::from(group == Group::Plan)] {
        GroupState::Local => (1, 1),
        GroupState::Requested { station, session, .. }
        | GroupState::Remote { station, session } => (station, session),
    };
    let remote = |place: usize| match before.states[place] {
        GroupState::Remote { session, .. } => Some(session),
        GroupState::Local | GroupState::Requested { .. } => None,
    };
    let running = Sessions { mot: remote(0), plan: remote(1) };
    let (dt, kind) = match letter {
        Letter::OfferAll => (0, EventKind::Offer { station: 1, groups: Groups::ALL }),
        Letter::OfferPlanElsewhere => {
            (0, EventKind::Offer { station: 2, groups: Groups::from(Group::Plan) })
        }
        Letter::Withdraw => (0, EventKind::Withdraw { station: 1 }),
        Letter::Lost => (0, EventKind::Lost { station: 1 }),
        Letter::AreaWithoutPlan => (0, EventKind::Area { groups: Groups::from(Group::Mot) }),
        Letter::Tick(dt) => (dt, EventKind::Tick),
        Letter::Confirm(group) | Letter::ConfirmLate(group) => {
            let (station, session) = session(group);
            let late = if matches!(letter, Letter::ConfirmLate(_)) { 2 } else { 1 };
            (late, EventKind::Confirm { station, group, session })
        }
        Letter::Reject(group) => {
            let (station, session) = session(group);
            (0, EventKind::Reject { station, group, session })
        }
        Letter::Data(group, age_ns) => {
            let (station, session) = session(group);
            let generated_ns = now_ns + 1 - age_ns;
            (1, EventKind::Data { station, group, session, generated_ns })
        }
        Letter::Safe => (0, EventKind::Verdict { safe: true, sessions: running }),
        Letter::SafeWithoutMot => {
            (0, EventKind::Verdict { safe: true, sessions: Sessions { mot: None, ..running } })
        }
        Letter::SafeTooLate => {
            let late = |session: Option<i64>| session.map(|it| it - 1);
            let sessions = Sessions { mot: late(running.mot), plan: late(running.plan) };
            (0, EventKind::Verdict { safe: true, sessions })
        }
        Letter::Unsafe => (0, EventKind::Verdict { safe: false, sessions: running }),
    };
    Event { t_ns: now_ns + dt, kind }
}

fn explore(node: &Node, profile: Profile, length: usize, visit: &mut impl FnMut(&Taken)) {
    if length == 0 {
        return;
    }
    for letter in ALPHABET {
        let (next, step) = node.follow(profile, letter);
        visit(&step);
        explore(&next, profile, length - 1, visit);
    }
}

type Sight = fn(&Taken) -> bool;

/// What has to occur, or the laws would hold of too little.
const SIGHTS: [(&str, Sight); 6] = [
    ("a remote group", |step| step.is_after(|state| matches!(state, GroupState::Remote { .. }))),
    ("a requested group", |step| step.is_after(|it| matches!(it, GroupState::Requested { .. }))),
    ("a remote source", |step| step.after.sources.iter().any(|source| *source != Source::Local)),
    ("a release", |step| step.does(|action| matches!(action, Action::Release { .. }))),
    ("a drop", |step| step.does(|action| matches!(action, Action::Drop(_)))),
    ("a request after a hold", |step| {
        let is_held = step.before.hold_until_ns.is_some();
        is_held && step.does(|action| matches!(action, Action::Request { .. }))
    }),
];
