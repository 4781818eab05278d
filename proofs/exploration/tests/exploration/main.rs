//! The small worlds, explored: every property, every sight, and the number of
//! reachable states, which is pinned so that a change of the protocol is seen.
//!
//! Covers, within the bounds of `proofs/exploration/src/bounds.rs`, F-12 and H-08, that model and implementation
//! take every explored step alike (`System::new` fails at the first difference), and:
//! * PROTO-01
//! * PROTO-02
//! * PROTO-03
//! * PROTO-04
//! * PROTO-05, PROTO-06
//! * PROTO-08
//! * PROTO-11

mod likeness;
mod monitor;

use std::collections::BTreeSet;

use mufasa_exploration::bounds::Bounds;
use mufasa_exploration::properties::Property;
use mufasa_exploration::replay;
use mufasa_exploration::run::{self, WorldOutcome};
use mufasa_exploration::system::System;
use mufasa_model::input::cycle::Profile;

/// Of a world: states of the requester, its steps compared, states of the system, moves; states
/// from which offloading, and the end of a left session, lie ahead, and the most ticks until then.
type Sizes = (&'static str, usize, usize, usize, u64, [Option<(usize, u16)>; 2]);

const PAPER: &[Sizes] = &[
    ("anything", 11_696, 840_000, 21_952, 1_666_560, [None, None]),
    ("qos-hold", 1_611, 77_913, 2_932, 145_772, [None, None]),
    ("link", 140, 6_332, 1_578_440, 91_945_784, [Some((2_476_806, 3)), Some((1_795_762, 2))]),
    ("choice", 88, 2_856, 348_688, 15_943_916, [Some((1_153_220, 5)), Some((489_592, 2))]),
    ("fleet", 22, 498, 1_439_518, 83_733_132, [None, Some((1_020_596, 2))]),
    ("shared", 22, 348, 1_228_312, 32_311_808, [Some((1_468_426, 3)), Some((1_201_178, 2))]),
    ("honest", 22, 348, 5_073, 82_688, [Some((3_302, 3)), Some((3_110, 2))]),
    ("roam", 66, 1_548, 51_010, 1_730_388, [Some((32_762, 6)), Some((41_596, 3))]),
];

/// The states of the system are as many as in the paper profile: where one has stopped the local
/// services, the other remembers what a stop still waits for, which the observer does in both.
const HARDENED: &[Sizes] = &[
    ("anything", 21_952, 1_666_560, 21_952, 1_666_560, [None, None]),
    ("qos-hold", 2_852, 143_292, 2_932, 145_772, [None, None]),
    ("link", 295, 13_759, 1_578_440, 91_945_784, [Some((2_476_806, 3)), Some((1_795_762, 2))]),
    ("choice", 116, 3_948, 348_688, 15_943_916, [Some((1_153_220, 5)), Some((489_592, 2))]),
    ("fleet", 29, 687, 1_439_518, 83_733_132, [None, Some((1_020_596, 2))]),
    ("shared", 29, 474, 1_228_312, 32_311_808, [Some((1_468_426, 3)), Some((1_201_178, 2))]),
    ("honest", 29, 474, 5_073, 82_688, [Some((3_302, 3)), Some((3_110, 2))]),
    ("roam", 80, 1_968, 51_010, 1_730_388, [Some((32_762, 6)), Some((41_596, 3))]),
];

fn explore_all(profile: Profile, expected: &[Sizes]) -> Vec<WorldOutcome> {
    let worlds = Bounds::Small.worlds();
    let outcomes: Vec<_> = worlds
        .iter()
        .map(|world| run::explore(world, profile, |_| {}).unwrap_or_else(|it| panic!("{it}")))
        .collect();
    let sizes: Vec<Sizes> = outcomes
        .iter()
        .map(|outcome| {
            let requesters = outcome.system.requesters();
            let name = outcome.system.world().name;
            let (states, moves) = (outcome.states, outcome.transitions);
            println!("{profile:?} {name}: {states} states, {moves} moves, {:?}", outcome.time);
            let endless =
                [Property::OffloadingReachedAgain, Property::LeftSessionEnds].map(|property| {
                    outcome
                        .results
                        .iter()
                        .find(|it| it.property == property)
                        .and_then(|it| it.ahead)
                });
            (name, requesters.len(), requesters.reactions(), states, moves, endless)
        })
        .collect();
    assert_eq!(sizes, expected, "the protocol or the bounds have changed");
    outcomes
}

/// A search that keeps states as they are, packed by nothing, finds as many in the worlds that are small enough
/// for it, with as many moves.
#[test]
fn a_plain_search_finds_as_many_states() {
    for (name, _, _, states, moves, _) in HARDENED.iter().filter(|it| it.3 < 10_000) {
        let world =
            Bounds::Small.worlds().iter().find(|world| world.name == *name).expect("listed");
        let system = System::new(world, Profile::HARDENED).expect("no difference");
        let mut known = BTreeSet::from([format!("{:?}", system.start())]);
        let (mut open, mut tried, mut possible) = (vec![system.start()], 0, Vec::new());
        while let Some(state) = open.pop() {
            possible.clear();
            system.moves(&state, &mut possible);
            for next in possible.iter().filter_map(|by| system.apply(&state, *by)) {
                tried += 1;
                if known.insert(format!("{:?}", next.state)) {
                    open.push(next.state);
                }
            }
        }
        assert_eq!((known.len(), tried), (*states, *moves), "{name}");
    }
}

fn claimed_properties_hold(profile: Profile, outcome: &WorldOutcome) {
    for finding in outcome.results.iter().filter(|finding| finding.property.is_claimed(profile)) {
        let name = outcome.system.world().name;
        assert_eq!(finding.counterexample, None, "{name}: {}", finding.property.name());
        // An aim that never lay ahead would have been reached by nobody.
        assert_ne!(finding.ahead.map(|(states, _)| states), Some(0), "{name}");
    }
}

/// Every property was asked somewhere, and everything was seen that it speaks of.
fn no_property_is_empty(profile: Profile, outcomes: &[WorldOutcome]) {
    for property in Property::ALL {
        let asked = outcomes.iter().flat_map(|it| &it.results).any(|it| it.property == property);
        assert!(asked, "{} was asked nowhere", property.name());
        for sight in property.companions().iter().filter(|sight| sight.is_expected(profile)) {
            let seen = outcomes.iter().any(|it| it.moves_to(property, *sight).is_some());
            assert!(seen, "{}: never seen: {}", property.name(), sight.name());
        }
    }
}

/// Each shortest trace to a sight, and each to what fails, can be walked by the real parts, and
/// comes by the explored states.
fn traces_are_real(outcome: &WorldOutcome) {
    let sights = outcome.seen.iter().map(|(_, trace)| trace.clone());
    let failures = outcome.results.iter().filter_map(|it| it.counterexample.as_ref());
    for trace in sights.chain(failures.map(|it| [&it.trace[..], &it.circle].concat())) {
        let walked = replay::walk(&outcome.system, &trace);
        let name = outcome.system.world().name;
        assert_eq!(walked.map(|it| it.len()), Ok(trace.len()), "{name}: {trace:?}");
    }
}

/// A station that waits for a left session does so for its lease at most.
fn left_sessions_end_within_the_lease(outcome: &WorldOutcome) {
    let lease = outcome.system.world().ticks.lease;
    let finding = outcome.results.iter().find(|it| it.property == Property::LeftSessionEnds);
    if let Some((_, ticks)) = finding.and_then(|it| it.ahead) {
        assert!(i64::from(ticks) <= lease, "{}: {ticks}", outcome.system.world().name);
    }
}

#[test]
fn all_properties_hold_in_the_hardened_profile() {
    let outcomes = explore_all(Profile::HARDENED, HARDENED);
    for outcome in &outcomes {
        claimed_properties_hold(Profile::HARDENED, outcome);
        traces_are_real(outcome);
        left_sessions_end_within_the_lease(outcome);
    }
    no_property_is_empty(Profile::HARDENED, &outcomes);
}

/// In the paper profile all hold but one: F-12 is found in every world, and its trace, which is
/// minimal, ends with the confirmation at which the local services stop.
#[test]
fn all_properties_but_f_12_hold_in_the_paper_profile() {
    let outcomes = explore_all(Profile::PAPER, PAPER);
    for outcome in &outcomes {
        claimed_properties_hold(Profile::PAPER, outcome);
        traces_are_real(outcome);
        left_sessions_end_within_the_lease(outcome);
        let finding =
            outcome.results.iter().find(|it| it.property == Property::NoStopBeforeSafeCycle);
        let found = finding.and_then(|it| it.counterexample.as_ref()).expect("F-12");
        // Offer, tick, forged confirmation; or offer, tick, request and confirmation delivered.
        let shortest = if outcome.system.world().attacker { 3 } else { 4 };
        assert_eq!(found.trace.len(), shortest);
        let episodes = replay::walk(&outcome.system, &found.trace).expect("it can be walked");
        let last = episodes.last().expect("some moves");
        assert!(!last.cavs[0].computes[0], "the local services stopped");
        assert!(episodes.iter().rev().skip(1).all(|episode| episode.cavs[0].computes[0]));
    }
    no_property_is_empty(Profile::PAPER, &outcomes);
}

#[test]
fn the_bounds_are_stated() {
    for bounds in [Bounds::Small, Bounds::Large] {
        let names: BTreeSet<_> = bounds.worlds().iter().map(|world| world.name).collect();
        assert_eq!(names.len(), bounds.worlds().len(), "names are used once");
        for world in bounds.worlds() {
            assert!(world.why.len() > 40, "{}: why?", world.name);
            assert!(world.in_flight == 0 || world.in_flight >= 2, "a tick sends two messages");
        }
    }
}
