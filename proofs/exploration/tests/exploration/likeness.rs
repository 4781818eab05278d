//! That the exploration loses nothing: states that it takes for one behave alike, and the system
//! in which parts are automata is the system in which they are real.
//!
//! Random states are made by long random walks of the real parts, from any time and with numbers
//! of any size, and compared with the one part that stands for all that are like it.

use mufasa_exploration::automaton::{Automaton, Part};
use mufasa_exploration::bounds::{Bounds, World};
use mufasa_exploration::cav::CavPart;
use mufasa_exploration::moves::Move;
use mufasa_exploration::replay::Replay;
use mufasa_exploration::station::StationPart;
use mufasa_exploration::stimulus::{Named, Stimulus};
use mufasa_exploration::system::System;
use mufasa_model::input::cycle::Profile;
use mufasa_model::offloading::provider::{Provider, ProviderEvent, ProviderEventKind};
use mufasa_props::refine::Pair;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const PROFILES: [Profile; 2] = [Profile::PAPER, Profile::HARDENED];
/// As far from 0 as a clock may be, and still far from where times saturate.
const FAR_NS: i64 = i64::MAX / 2;

/// Reproducible numbers.
struct Numbers(ChaCha8Rng);

impl Numbers {
    fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    fn below(&mut self, bound: usize) -> usize {
        self.0.random_range(0..bound)
    }

    fn time(&mut self) -> i64 {
        let spread = i64::try_from(self.below(1 << 30)).expect("30 bits") << 32;
        if self.below(2) == 0 { spread - FAR_NS } else { FAR_NS - spread }
    }
}

fn world(name: &str) -> &'static World {
    let worlds = Bounds::Small.worlds().iter();
    worlds.into_iter().find(|world| world.name == name).expect("a world of this name")
}

/// Walks the part at random and compares each step with the automaton. `step` makes the real
/// step in every way that the stimulus leaves open.
fn steps_as_the_automaton<P: Part>(
    automaton: &Automaton<P>,
    mut part: P,
    steps: usize,
    numbers: &mut Numbers,
    step: impl Fn(&P, P::Stimulus) -> Vec<Option<(P, P::Effect)>>,
) -> usize
where
    P::Likeness: std::fmt::Debug,
    P::Effect: std::fmt::Debug,
    P::Stimulus: std::fmt::Debug,
{
    let mut possible = 0;
    for _ in 0..steps {
        let id = automaton.id(&part.likeness()).expect("a state that was explored");
        // Half of the stimuli are such that change something; most do not.
        let all = 0..automaton.stimuli().len();
        let changes = |place: &usize| automaton.react(id, *place).is_some_and(|it| it.0 != id);
        let changing: Vec<usize> = all.clone().filter(changes).collect();
        let place = match numbers.below(2) {
            0 => numbers.below(all.len()),
            _ => changing[numbers.below(changing.len())],
        };
        let stimulus = automaton.stimuli()[place];
        let expected = automaton.react(id, place);
        let mut ways = step(&part, stimulus);
        assert!(!ways.is_empty());
        for way in &mut ways {
            let taken = way.as_mut().map(|(next, effect)| (next.likeness(), effect.clone()));
            let expected =
                expected.map(|(next, effect)| (automaton.likeness(next).clone(), effect.clone()));
            assert_eq!(taken, expected, "{stimulus:?} in {:?}", automaton.likeness(id));
        }
        let which = numbers.below(ways.len());
        if let Some((next, _)) = ways.swap_remove(which) {
            possible += 1;
            part = next;
        }
    }
    possible
}

/// Two requesters with the same likeness do the same, whatever their clock says and whichever
/// number a message has that does not name the current session.
#[test]
fn requesters_that_are_alike_react_alike() {
    let mut numbers = Numbers::new(1);
    for (name, profile) in
        ["anything", "qos-hold", "choice"].into_iter().flat_map(|it| PROFILES.map(|p| (it, p)))
    {
        let world = world(name);
        let start = CavPart::new(world, profile).expect("no difference");
        let automaton = Automaton::explore(start, CavPart::stimuli(world)).expect("no difference");
        let mut possible = 0;
        for _ in 0..40 {
            let pair = Pair::new(profile, world.parameters()).expect("no difference");
            let part = CavPart::standing_for(world, pair, numbers.time());
            possible += steps_as_the_automaton(&automaton, part, 500, &mut numbers, |part, it| {
                let others = match it {
                    Stimulus::Confirm(Named { group, current: false, .. })
                    | Stimulus::Reject(Named { group, current: false, .. })
                    | Stimulus::Data(Named { group, current: false, .. }, _) => {
                        part.other_numbers(group)
                    }
                    _ => vec![0],
                };
                let step = |other| part.react_to(it, other).expect("no difference");
                others.into_iter().map(step).collect()
            });
        }
        assert!(possible > 10_000, "{name}: the walks hardly moved");
    }
}

/// Two providers with the same likeness do the same, whatever their clock says and whichever
/// numbers their sessions have.
#[test]
fn providers_that_are_alike_react_alike() {
    let mut numbers = Numbers::new(2);
    for name in ["link", "choice", "fleet"] {
        let world = world(name);
        let (capacity, lease) = (world.stations[0].capacity, world.ticks.lease);
        let start = StationPart::new(world, capacity);
        let automaton =
            Automaton::explore(start, StationPart::stimuli(world)).expect("no difference");
        let mut possible = 0;
        for _ in 0..100 {
            let (now, session) = (numbers.time(), numbers.time());
            let mut provider = Provider::new(capacity, lease);
            for group in world.groups() {
                let kind = ProviderEventKind::Request { requester: 0, group, session };
                provider.step(&ProviderEvent { t_ns: now, kind });
            }
            let part = StationPart::standing_for(provider, now, capacity, lease);
            possible += steps_as_the_automaton(&automaton, part, 200, &mut numbers, |part, it| {
                vec![part.react(it).expect("no difference")]
            });
        }
        assert!(possible > 5_000, "{name}: the walks hardly moved");
    }
}

/// Random walks of every world with real requesters, providers, numbers and times: after each
/// move the state is, packed, the one to which the exploration comes by the same move.
#[test]
fn the_explored_system_is_the_real_one() {
    let mut numbers = Numbers::new(3);
    for (world, profile) in
        Bounds::Small.worlds().iter().flat_map(|it| PROFILES.map(|profile| (it, profile)))
    {
        let system = System::new(world, profile).expect("no difference");
        let mut delivered = 0;
        for _ in 0..150 {
            let mut replay = Replay::new(&system, numbers.time()).expect("no difference");
            let mut state = system.start();
            let mut moves = Vec::new();
            for _ in 0..300 {
                moves.clear();
                system.moves(&state, &mut moves);
                // A third of the moves are those of the network, a third make it needed.
                let kind = numbers.below(3);
                let needs_the_network = |place: u16| {
                    let stimulus = system.requesters().stimuli()[usize::from(place)];
                    matches!(stimulus, Stimulus::Offer(..) | Stimulus::Tick)
                };
                moves.retain(|by| match (kind, *by) {
                    (0, by) => !matches!(by, Move::Event { .. }),
                    (1, Move::Event { place, .. }) => needs_the_network(place),
                    (kind, _) => kind == 2,
                });
                let by = moves[numbers.below(moves.len())];
                state = system.apply(&state, by).expect("a listed move is possible").state;
                replay.go(by).unwrap_or_else(|it| panic!("{}: {it}", world.name));
                delivered += usize::from(matches!(by, Move::Deliver { .. }));
                let real = replay.state();
                assert_eq!(real, Some(state.parts()), "{}: {}", world.name, system.words(by));
                let layout = system.layout();
                assert_eq!(layout.unpack(layout.pack(&state)), state, "{}", world.name);
            }
        }
        assert!(delivered > 1_000 || world.in_flight == 0, "{}: {delivered}", world.name);
    }
}
