//! Long random runs where exploration cannot reach: any times, forwards and backwards, up to the
//! limits of 64 bits; any parameters; four stations. Model and implementation take every step
//! alike (`Pair::step`), and an observer judges what they do.

use mufasa_model::input::cycle::Profile;
use mufasa_model::offloading::requester::{
    Action, Event, EventKind, Group, GroupState, Groups, Parameters, Sessions,
};
use mufasa_props::refine::Pair;
use proptest::prelude::*;
use proptest::strategy::ValueTree;

/// A step of a walk: how far the clock moves, what happens, and what its numbers are near to.
#[derive(Clone, Copy, Debug)]
struct Stride {
    clock: Clock,
    what: u8,
    station: i64,
    group: bool,
    groups: Groups,
    session: i64,
    age: i64,
}

/// How the clock moves.
#[derive(Clone, Copy, Debug)]
enum Clock {
    By(i64),
    To(i64),
    /// To the end of the hold, a deadline, or a silence, give or take.
    Near(u8, i64),
}

fn extreme() -> impl Strategy<Value = i64> {
    prop_oneof![
        Just(i64::MIN),
        Just(i64::MAX),
        Just(0),
        i64::MIN..i64::MIN + 50,
        i64::MAX - 50..i64::MAX,
        any::<i64>(),
    ]
}

fn stride() -> impl Strategy<Value = Stride> {
    let clock = prop_oneof![
        12 => (0_i64..4).prop_map(Clock::By),
        3 => (-3_i64..60).prop_map(Clock::By),
        6 => (0_u8..4, -1_i64..=1).prop_map(|(what, by)| Clock::Near(what, by)),
        1 => extreme().prop_map(Clock::To),
    ];
    let groups = (any::<bool>(), any::<bool>()).prop_map(|(mot, plan)| Groups { mot, plan });
    // Mostly the current session, sometimes one beside it, or any.
    let session = prop_oneof![8 => Just(0), 2 => -3_i64..=3, 1 => extreme()];
    let age = prop_oneof![6 => 0_i64..4, 2 => -1_i64..30, 1 => extreme()];
    (clock, 0_u8..40, 1_i64..=4, any::<bool>(), groups, session, age).prop_map(
        |(clock, what, station, group, groups, session, age)| Stride {
            clock,
            what,
            station,
            group,
            groups,
            session,
            age,
        },
    )
}

fn parameters() -> impl Strategy<Value = Parameters> {
    let time = || prop_oneof![6 => 0_i64..20, 1 => Just(i64::MAX), 1 => 0..=i64::MAX];
    (time(), time(), time(), time(), any::<bool>()).prop_map(
        |(t_wait_ns, request_timeout_ns, l_max_ns, dt_max_ns, qos_hold)| Parameters {
            t_wait_ns,
            request_timeout_ns,
            l_max_ns,
            dt_max_ns,
            qos_hold,
        },
    )
}

/// A requester on its way, and what an observer remembers.
struct Walk {
    profile: Profile,
    parameters: Parameters,
    pair: Pair,
    now_ns: i64,
    /// By group: whether the local services compute, and whether a result of the running session
    /// was used, and was in a safe cycle.
    computes: [bool; 2],
    used: [bool; 2],
    proven: [bool; 2],
    /// As the observer reckons it, from safety issues alone.
    blocked_until_ns: Option<i64>,
    /// Whether the clock ran backwards since the last safety issue.
    set_back: bool,
    offloaded: usize,
}

impl Walk {
    fn new(profile: Profile, parameters: Parameters) -> Self {
        let pair = Pair::new(profile, parameters).expect("no difference");
        Self {
            profile,
            parameters,
            pair,
            now_ns: 0,
            computes: [true; 2],
            used: [false; 2],
            proven: [false; 2],
            blocked_until_ns: None,
            set_back: false,
            offloaded: 0,
        }
    }

    fn stride(&mut self, stride: Stride) {
        let now_ns = self.clock(stride.clock);
        self.set_back |= now_ns < self.now_ns;
        self.now_ns = now_ns;
        let kind = self.kind(stride);
        let before = self.pair.clone();
        let event = Event { t_ns: self.now_ns, kind };
        let actions = self.pair.step(&event).unwrap_or_else(|it| panic!("{it}"));
        assert!(self.pair.is_valid(), "after {kind:?}: {:?}", self.pair);
        self.judge(&before, kind, &actions);
    }

    fn clock(&self, clock: Clock) -> i64 {
        let model = self.pair.model();
        let near = |what: u8| match what {
            0 => model.hold_until_ns(),
            1 => Group::ALL.into_iter().find_map(|group| match model.state(group) {
                GroupState::Requested { deadline_ns, .. } => Some(deadline_ns),
                GroupState::Local | GroupState::Remote { .. } => None,
            }),
            _ => {
                let session = Group::ALL.into_iter().find_map(|group| model.session_of(group));
                session.map(|it| it.last_arrival_ns.saturating_add(self.parameters.dt_max_ns))
            }
        };
        match clock {
            Clock::By(by) => self.now_ns.saturating_add(by),
            Clock::To(time) => time,
            Clock::Near(what, by) => near(what).unwrap_or(self.now_ns).saturating_add(by),
        }
    }

    fn kind(&self, stride: Stride) -> EventKind {
        let Stride { what, station, groups, .. } = stride;
        let group = Group::ALL[usize::from(stride.group)];
        // The partner of the group, most of the time; its session, or one beside it.
        let current = current(&self.pair, group);
        let session = current.map_or(1, |(_, session)| session).saturating_add(stride.session);
        let partner = current.map_or(station, |(partner, _)| partner);
        let station = if what % 4 == 0 { station } else { partner };
        let generated_ns = self.now_ns.saturating_sub(stride.age);
        // The running sessions, or at times those beside them.
        let running = self.pair.model().sessions(groups);
        let beside = |session: i64| session.saturating_add(stride.session);
        let others = Sessions { mot: running.mot.map(beside), plan: running.plan.map(beside) };
        let sessions = if what == 18 { others } else { running };
        match what {
            0 => EventKind::Withdraw { station },
            1 => EventKind::Lost { station },
            2 => EventKind::Area { groups },
            3 => EventKind::Area { groups: Groups::ALL },
            4 => EventKind::Verdict { safe: false, sessions: self.pair.model().sessions(groups) },
            5..=7 => EventKind::Offer { station: stride.station, groups },
            8..=10 => EventKind::Offer { station: stride.station, groups: Groups::ALL },
            11 => EventKind::Reject { station, group, session },
            12..=17 => EventKind::Confirm { station, group, session },
            18..=21 => EventKind::Verdict { safe: true, sessions },
            22..=30 => EventKind::Data { station, group, session, generated_ns },
            _ => EventKind::Tick,
        }
    }

    fn judge(&mut self, before: &Pair, kind: EventKind, actions: &[Action]) {
        self.an_ended_session_changes_nothing(before, kind, actions);
        for (place, group) in Group::ALL.into_iter().enumerate() {
            if actions.contains(&Action::Activate(group)) {
                assert!(!self.computes[place], "started twice");
                self.computes[place] = true;
            }
            if actions.contains(&Action::Deactivate(group)) {
                assert!(self.computes[place], "stopped twice");
                self.computes[place] = false;
            }
            let dropped = actions.contains(&Action::Drop(group));
            match kind {
                EventKind::Data { group: of, .. } if of == group && !dropped => {
                    let barred = self.blocked_until_ns.is_some_and(|until| self.now_ns < until);
                    // What was rightly offloaded stays so when the clock is set back.
                    assert!(!barred || self.set_back, "a result was used before hold_until");
                    self.used[place] = true;
                }
                EventKind::Verdict { safe: true, sessions } => {
                    let names = sessions.of(group).is_some()
                        && sessions.of(group) == current(before, group).map(|it| it.1);
                    self.proven[place] |= names && self.used[place];
                }
                _ => {}
            }
            let remote = matches!(self.pair.model().state(group), GroupState::Remote { .. });
            if !remote {
                (self.used[place], self.proven[place]) = (false, false);
            }
            assert!(self.computes[place] || remote, "no source");
            if self.profile == Profile::HARDENED {
                assert!(self.computes[place] || self.proven[place], "H-08");
            }
            self.offloaded += usize::from(remote);
        }
        self.a_hold_only_grows(before, kind, actions);
    }

    /// `spec/2-offloading.md#fallback`: the hold is the later of the old one and now + `t_wait`,
    /// whatever the clock does, and no request is sent before its end.
    fn a_hold_only_grows(&mut self, before: &Pair, kind: EventKind, actions: &[Action]) {
        let [old, new] = [before, &self.pair].map(|pair| pair.model().hold_until_ns());
        assert!(new >= old, "{old:?} became {new:?}");
        if let EventKind::Verdict { safe: false, .. } = kind {
            let until = self.now_ns.saturating_add(self.parameters.t_wait_ns);
            self.blocked_until_ns = self.blocked_until_ns.max(Some(until));
            self.set_back = false;
            assert_eq!(new, old.max(Some(until)));
            let local = |group| self.pair.model().state(group) == GroupState::Local;
            assert!(Group::ALL.into_iter().all(local), "{:?}", self.pair);
            let partners = Group::ALL.into_iter().filter(|it| current(before, *it).is_some());
            let releases = actions.iter().filter(|action| matches!(action, Action::Release { .. }));
            assert_eq!(releases.count(), partners.count(), "one release per group");
        }
        if actions.iter().any(|action| matches!(action, Action::Request { .. })) {
            assert!(old.is_none_or(|until| self.now_ns >= until), "a request before {old:?}");
        }
    }

    fn an_ended_session_changes_nothing(&self, before: &Pair, kind: EventKind, actions: &[Action]) {
        let (EventKind::Confirm { station, group, session }
        | EventKind::Reject { station, group, session }
        | EventKind::Data { station, group, session, .. }) = kind
        else {
            return;
        };
        if current(before, group) != Some((station, session)) {
            assert_eq!(before.model(), self.pair.model());
            let expected = match kind {
                EventKind::Confirm { .. } => vec![Action::Release { station, group, session }],
                EventKind::Data { .. } => vec![Action::Drop(group)],
                _ => vec![],
            };
            assert_eq!(actions, expected);
        }
    }
}

fn current(pair: &Pair, group: Group) -> Option<(i64, i64)> {
    match pair.model().state(group) {
        GroupState::Local => None,
        GroupState::Requested { station, session, .. }
        | GroupState::Remote { station, session } => Some((station, session)),
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 512, failure_persistence: None, ..ProptestConfig::default() })]

    /// `spec/2-offloading.md#fallback.6`, `spec/2-offloading.md#properties-of-the-whole-protocol.1`,
    /// `.2`, `.6` and `.7` over 600 events each.
    #[test]
    fn long_walks_at_any_time(
        hardened in any::<bool>(),
        parameters in parameters(),
        strides in prop::collection::vec(stride(), 600),
    ) {
        let profile = if hardened { Profile::HARDENED } else { Profile::PAPER };
        let mut walk = Walk::new(profile, parameters);
        for stride in strides {
            walk.stride(stride);
        }
    }
}

/// The walks do what they are for: groups are remote, and elements used, in a good part of them.
#[test]
fn walks_offload() {
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let walks = (parameters(), prop::collection::vec(stride(), 600));
    let (mut offloaded, mut stopped) = (0, 0);
    for _ in 0..64 {
        let tree = walks.new_tree(&mut runner).expect("a walk");
        let (parameters, strides) = tree.current();
        let mut walk = Walk::new(Profile::HARDENED, parameters);
        for stride in strides {
            walk.stride(stride);
            stopped += usize::from(walk.computes.contains(&false));
        }
        offloaded += usize::from(walk.offloaded > 20);
    }
    assert!(offloaded > 32, "only {offloaded} of 64 walks offload");
    assert!(stopped > 200, "local services stood still in {stopped} states only");
}

/// F-25: a verdict that comes so late that its session has ended, and a result of the next was used,
/// stops no local services: it names the session that its data came from.
#[test]
fn a_verdict_that_comes_after_its_session_stops_nothing() {
    let parameters = Parameters { request_timeout_ns: 9, ..Parameters::default() };
    let mut pair = Pair::new(Profile::HARDENED, parameters).expect("no difference");
    let groups = Groups { mot: true, plan: false };
    let (station, group) = (1, Group::Mot);
    let mut at = |t_ns, kind| pair.step(&Event { t_ns, kind }).expect("no difference");
    at(0, EventKind::Offer { station, groups });
    at(0, EventKind::Tick);
    at(1, EventKind::Confirm { station, group, session: 1 });
    // The cycle whose verdict will be late uses this result of session 1.
    assert_eq!(at(2, EventKind::Data { station, group, session: 1, generated_ns: 2 }), []);
    at(3, EventKind::Withdraw { station });
    at(3, EventKind::Offer { station, groups });
    at(4, EventKind::Tick);
    at(5, EventKind::Confirm { station, group, session: 2 });
    assert_eq!(at(6, EventKind::Data { station, group, session: 2, generated_ns: 6 }), []);
    let safe = |session| EventKind::Verdict {
        safe: true,
        sessions: Sessions { mot: Some(session), plan: None },
    };
    assert_eq!(at(7, safe(1)), [], "no result of session 2 was judged");
    assert_eq!(at(8, safe(2)), [Action::Deactivate(group)]);
}
