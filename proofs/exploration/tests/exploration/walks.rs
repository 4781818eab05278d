//! Random runs where exploration cannot reach: any times, forwards and backwards, up to the limits of 64 bits;
//! any parameters; four stations and more. Model and implementation take every step alike (`Pair::step`), and an
//! observer judges what they do. The laws of single steps on the same runs: `props/tests/stages/laws.rs`.

use std::cell::RefCell;

use mufasa_model::input::cycle::Profile;
use mufasa_model::offloading::requester::{
    Action, Event, EventKind, Group, GroupState, Parameters,
};
use mufasa_props::differential::runner;
use mufasa_props::refine::Pair;
use mufasa_props::strategy::draw::{Draw, long_tape};
use mufasa_props::strategy::requester::{Trace, trace};
use proptest::strategy::Strategy;

/// A requester on its way, and what an observer remembers.
struct Walk {
    profile: Profile,
    parameters: Parameters,
    pair: Pair,
    /// By group: whether the local services compute, and whether a result of the running session
    /// was used, and was in a safe cycle.
    computes: [bool; 2],
    used: [bool; 2],
    proven: [bool; 2],
    /// As the observer reckons it, from safety issues alone.
    blocked_until_ns: Option<i64>,
    /// Whether the clock ran backwards since the last safety issue.
    set_back: bool,
    now_ns: i64,
    /// Steps after which a group is remote, and after which local services stand still.
    offloaded: u64,
    stopped: u64,
}

impl Walk {
    fn of(trace: &Trace) -> Self {
        let &Trace { profile, parameters, .. } = trace;
        let mut walk = Self {
            profile,
            parameters,
            pair: Pair::new(profile, parameters).expect("no difference"),
            computes: [true; 2],
            used: [false; 2],
            proven: [false; 2],
            blocked_until_ns: None,
            set_back: false,
            now_ns: 0,
            offloaded: 0,
            stopped: 0,
        };
        trace.events.iter().for_each(|event| walk.step(event));
        walk
    }

    fn step(&mut self, event: &Event) {
        self.set_back |= event.t_ns < self.now_ns;
        self.now_ns = event.t_ns;
        let before = self.pair.clone();
        let actions = self.pair.step(event).unwrap_or_else(|it| panic!("{it}"));
        assert!(self.pair.is_valid(), "after {event:?}: {:?}", self.pair);
        self.an_ended_session_changes_nothing(&before, event.kind, &actions);
        if let EventKind::Verdict { safe: false, .. } = event.kind {
            let until_ns = self.now_ns.saturating_add(self.parameters.t_wait_ns);
            self.blocked_until_ns = self.blocked_until_ns.max(Some(until_ns));
            self.set_back = false;
        }
        for (place, group) in Group::ALL.into_iter().enumerate() {
            self.judge(place, group, &before, event.kind, &actions);
        }
        self.stopped += u64::from(self.computes.contains(&false));
    }

    fn judge(
        &mut self,
        place: usize,
        group: Group,
        before: &Pair,
        kind: EventKind,
        actions: &[Action],
    ) {
        for (action, computes) in
            [(Action::Activate(group), true), (Action::Deactivate(group), false)]
        {
            if actions.contains(&action) {
                assert_ne!(self.computes[place], computes, "{action:?} twice");
                self.computes[place] = computes;
            }
        }
        match kind {
            EventKind::Data { group: of, .. }
                if of == group && !actions.contains(&Action::Drop(group)) =>
            {
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
        self.offloaded += u64::from(remote);
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

/// FALL-11, PROTO-01,
/// `.2`, `.6` and `.7`. The walks do what they are for: groups are remote, and local services stand still.
#[test]
fn walks_at_any_time_keep_the_properties() {
    let (offloaded, stopped) = (RefCell::new(0), RefCell::new(0));
    let traces = long_tape().prop_map(|tape| trace(&mut Draw::new(&tape)));
    let result = runner().run(&traces, |trace| {
        let walk = Walk::of(&trace);
        *offloaded.borrow_mut() += walk.offloaded;
        *stopped.borrow_mut() += walk.stopped;
        Ok(())
    });
    result.unwrap_or_else(|error| panic!("{error}"));
    let (offloaded, stopped) = (offloaded.into_inner(), stopped.into_inner());
    println!("remote after {offloaded} steps, local services stand still after {stopped}");
    assert!(offloaded > 50_000 && stopped > 5_000, "{offloaded} {stopped}");
}
