//! The laws of the requester over every event sequence of a small alphabet
//! (`spec/2-offloading.md`), and a wrong variant that refutes each.
//!
//! Domain: 15 events, sequences of up to 6 (5 for the refutations), times of a few nanoseconds,
//! two stations. Not covered: longer sequences, time that runs backwards, more stations.

use std::collections::BTreeMap;

use mufasa::cycle::Profile;
use mufasa::requester::{
    Action, Event, EventKind, Group, GroupState, Groups, Parameters, Requester, Source,
    StationRecord, Suspended,
};
use mufasa_proofs::law::requester::{LAWS, Law, Seen, Step};

/// Longest sequence: offer, tick, confirm, unsafe, tick, confirm is the shortest with two holds.
const LENGTH: usize = 6;

const PARAMETERS: Parameters =
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
    Unsafe,
}

const ALPHABET: [Letter; 15] = [
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
    Letter::Unsafe,
];

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

/// A step that can be changed.
#[derive(Clone, Debug)]
struct Taken {
    profile: Profile,
    before: Seen,
    event: Event,
    actions: Vec<Action>,
    after: Seen,
}

impl Taken {
    fn keeps(&self, law: Law) -> bool {
        let Self { profile, before, event, ref actions, after } = *self;
        law(&Step { profile, parameters: PARAMETERS, before, event, actions, after })
    }
}

fn event(before: &Seen, now_ns: i64, letter: Letter) -> Event {
    let session = |group: Group| match before.states[usize::from(group == Group::Plan)] {
        GroupState::Local => (1, 1),
        GroupState::Requested { station, session, .. }
        | GroupState::Remote { station, session } => (station, session),
    };
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
        Letter::Safe => (0, EventKind::Verdict { safe: true, groups: Groups::ALL }),
        Letter::Unsafe => (0, EventKind::Verdict { safe: false, groups: Groups::ALL }),
    };
    Event { t_ns: now_ns + dt, kind }
}

/// Visits every step of every sequence of this length.
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

#[test]
fn every_law_holds_in_every_sequence() {
    for profile in [Profile::Paper, Profile::Hardened] {
        let mut steps = 0_u64;
        let mut reached: BTreeMap<&str, u64> = BTreeMap::new();
        explore(&Node::start(profile), profile, LENGTH, &mut |step| {
            for (name, law) in LAWS {
                assert!(step.keeps(law), "{name} is broken by {step:#?}");
            }
            steps += 1;
            for (what, seen) in sights(step) {
                *reached.entry(what).or_default() += u64::from(seen);
            }
        });
        println!("{profile:?}: {steps} steps, {reached:?}");
        for (what, count) in reached {
            assert!(count > 0, "no step with {what}");
        }
    }
}

/// What has to occur, or the laws would hold of too little.
fn sights(step: &Taken) -> [(&'static str, bool); 6] {
    let state = |test: fn(&GroupState) -> bool| step.after.states.iter().any(test);
    let action = |test: fn(&Action) -> bool| step.actions.iter().any(test);
    [
        ("a remote group", state(|state| matches!(state, GroupState::Remote { .. }))),
        ("a requested group", state(|state| matches!(state, GroupState::Requested { .. }))),
        ("a remote source", step.after.sources.iter().any(|s| *s != Source::Local)),
        ("a release", action(|action| matches!(action, Action::Release { .. }))),
        ("a drop", action(|action| matches!(action, Action::Drop(_)))),
        (
            "a request after a hold",
            action(|action| matches!(action, Action::Request { .. }))
                && step.before.hold_until_ns.is_some(),
        ),
    ]
}

/// The same step as a requester with one fault would have shown it; `None` where the fault does
/// not show.
type Fault = fn(&Taken) -> Option<Taken>;

/// One fault for each law, by the law's name.
fn faults() -> BTreeMap<&'static str, Fault> {
    fn only(step: &Taken, when: bool, fault: impl FnOnce(&mut Taken)) -> Option<Taken> {
        let mut wrong = step.clone();
        when.then(|| fault(&mut wrong)).map(|()| wrong)
    }
    fn requests(step: &Taken) -> bool {
        step.actions.iter().any(|action| matches!(action, Action::Request { .. }))
    }
    let mut faults: BTreeMap<&'static str, Fault> = BTreeMap::new();
    faults.insert("every_reachable_state_is_valid", |step| {
        // The table is lost between two events.
        let mut lost = [StationRecord::FREE; 2];
        let mut table = [StationRecord::FREE; 2];
        let mut requester = Requester::new(step.profile, PARAMETERS, &mut table).ok()?;
        let offer = EventKind::Offer { station: 1, groups: Groups::ALL };
        requester.step(&Event { t_ns: 0, kind: offer }).ok()?;
        requester.step(&Event { t_ns: 0, kind: EventKind::Tick }).ok()?;
        let broken = Requester::resume(requester.suspend(), &mut lost);
        Some(Taken { after: Seen::of(&broken), ..step.clone() })
    });
    faults.insert("t_wait_blocks_offloading", |step| {
        // The hold would have ended one nanosecond after this request.
        only(step, requests(step) && step.before.hold_until_ns.is_some(), |wrong| {
            wrong.before.hold_until_ns = Some(step.event.t_ns + 1);
        })
    });
    faults.insert("requests_are_decided_at_ticks_only", |step| {
        only(step, requests(step), |wrong| {
            wrong.event.kind = EventKind::Area { groups: Groups::ALL };
        })
    });
    faults.insert("a_safety_issue_ends_every_remote_service", |step| {
        let in_use = step.before.states != [GroupState::Local; 2];
        only(step, in_use, |wrong| wrong.after.states = step.before.states)
    });
    faults.insert("a_hold_is_never_shortened", |step| {
        only(step, step.after.hold_until_ns > step.before.hold_until_ns, |wrong| {
            std::mem::swap(&mut wrong.before, &mut wrong.after);
        })
    });
    faults.insert("a_session_left_is_released_exactly_once", |step| {
        let is_release = |action: &Action| matches!(action, Action::Release { .. });
        only(step, step.actions.iter().any(is_release), |wrong| {
            wrong.actions.retain(|action| !is_release(action));
        })
    });
    faults.insert("actions_come_in_their_order", |step| {
        only(step, step.actions.len() > 1, |wrong| wrong.actions.reverse())
    });
    faults.insert("local_services_stop_when_the_profile_says", |step| {
        // Break before make under the name of the hardened profile, and the other way round.
        only(step, true, |wrong| {
            wrong.profile = match step.profile {
                Profile::Paper => Profile::Hardened,
                Profile::Hardened => Profile::Paper,
            };
        })
    });
    faults.insert("a_group_becomes_remote_by_confirmation_only", |step| {
        // The deadline was this very moment.
        only(step, matches!(step.event.kind, EventKind::Confirm { .. }), |wrong| {
            for state in &mut wrong.before.states {
                if let GroupState::Requested { deadline_ns, .. } = state {
                    *deadline_ns = step.event.t_ns;
                }
            }
        })
    });
    faults
}

#[test]
fn every_law_is_refuted_by_a_fault() {
    let faults = faults();
    assert_eq!(faults.len(), LAWS.len(), "one fault for each law");
    for (name, law) in LAWS {
        let fault = faults[name];
        let mut refuted = 0_u64;
        for profile in [Profile::Paper, Profile::Hardened] {
            explore(&Node::start(profile), profile, LENGTH - 1, &mut |step| {
                refuted += u64::from(fault(step).is_some_and(|wrong| !wrong.keeps(law)));
            });
        }
        println!("{name}: refuted by {refuted} faulty steps");
        assert!(refuted > 0, "{name} cannot fail");
    }
}
