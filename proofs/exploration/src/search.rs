//! Exact breadth-first search over packed states.
//!
//! Every state is stored whole, so two states are never taken for one. States are found in the
//! order of their distance from the start, so the first finding of a kind has a shortest trace.

use enumset::{EnumSet, EnumSetType};
use indexmap::IndexSet;
use rustc_hash::FxBuildHasher;

use super::fit::fitted;
use super::moves::Move;
use super::properties::{Property, Sight};
use super::system::System;

/// All reachable states of a system.
#[derive(Debug)]
pub struct Explored {
    /// The states, packed, in the order of the search.
    states: IndexSet<u128, FxBuildHasher>,
    /// By state: the one from which it was reached first.
    parents: Vec<u32>,
    /// Moves tried.
    pub transitions: u64,
    /// Largest distance of a state from the start.
    pub depth: usize,
    /// The properties broken, each with the first step that breaks it.
    pub broken: Vec<(Property, Step)>,
    /// The sights seen, each with the first step that shows it.
    pub seen: Vec<(Sight, Step)>,
}

/// A move in a state, given by its place in the order of the search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    /// The state.
    pub from: u32,
    /// The move.
    pub by: Move,
}

/// How far a search is.
#[derive(Clone, Copy, Debug)]
pub struct Progress {
    /// States found.
    pub states: usize,
    /// States whose moves were tried.
    pub done: usize,
    /// Distance of the states at hand from the start.
    pub depth: usize,
    /// Moves tried.
    pub transitions: u64,
}

/// States between two reports.
const REPORT_EVERY: usize = 1 << 16;

/// Finds all reachable states. `report` is told now and then how far the search is.
pub fn explore(system: &System, mut report: impl FnMut(Progress)) -> Explored {
    let layout = system.layout();
    let mut states = IndexSet::default();
    states.insert(layout.pack(&system.start()));
    let (mut parents, mut transitions) = (vec![0], 0_u64);
    let (mut broken, mut seen) = (Vec::new(), Vec::new());
    let (mut all_broken, mut all_seen) = (EnumSet::empty(), EnumSet::empty());
    let (mut depth, mut end_of_level) = (0, 1);
    let mut moves = Vec::new();
    let mut done = 0;
    while done < states.len() {
        if done == end_of_level {
            depth += 1;
            end_of_level = states.len();
        }
        if done % REPORT_EVERY == 0 {
            report(Progress { states: states.len(), done, depth, transitions });
        }
        let from = fitted(done);
        let state = layout.unpack(states[done]);
        moves.clear();
        system.moves(&state, &mut moves);
        for by in moves.iter().copied() {
            let Some(next) = system.apply(&state, by) else { continue };
            transitions += 1;
            let step = Step { from, by };
            note(next.found.broken, &mut all_broken, step, &mut broken);
            note(next.found.seen, &mut all_seen, step, &mut seen);
            if next.state != state && states.insert(layout.pack(&next.state)) {
                parents.push(from);
            }
        }
        done += 1;
    }
    Explored { states, parents, transitions, depth, broken, seen }
}

/// Keeps the first step that shows a member.
fn note<T: EnumSetType>(
    found: EnumSet<T>,
    known: &mut EnumSet<T>,
    step: Step,
    list: &mut Vec<(T, Step)>,
) {
    list.extend((found - *known).iter().map(|it| (it, step)));
    *known |= found;
}

impl Explored {
    /// Number of states. There is always a start.
    #[allow(clippy::len_without_is_empty, reason = "there is always a start")]
    pub fn len(&self) -> usize {
        self.states.len()
    }

    /// The state at a place in the order of the search.
    pub fn state(&self, place: u32) -> u128 {
        self.states[place as usize]
    }

    /// The place of a state, if it was reached.
    pub fn place(&self, state: u128) -> Option<u32> {
        self.states.get_index_of(&state).map(fitted)
    }

    /// Bytes that the states take: each with its hash, its place in the table of hashes, and its parent.
    pub fn bytes(&self) -> usize {
        let state = size_of::<(u64, u128)>() + size_of::<usize>();
        self.states.capacity() * state + self.parents.capacity() * size_of::<u32>()
    }

    /// A shortest trace from the start to a state: its moves.
    pub fn trace(&self, system: &System, place: u32) -> Vec<Move> {
        let mut places = vec![place];
        while let Some(last) = places.last().copied().filter(|last| *last != 0) {
            places.push(self.parents[last as usize]);
        }
        places.reverse();
        let mut moves = Vec::new();
        places
            .windows(2)
            .map(|step| {
                let state = system.layout().unpack(self.state(step[0]));
                moves.clear();
                system.moves(&state, &mut moves);
                let leads = |by: &Move| {
                    let next = system.apply(&state, *by);
                    next.is_some_and(|it| system.layout().pack(&it.state) == self.state(step[1]))
                };
                let Some(by) = moves.iter().copied().find(leads) else {
                    unreachable!("some move leads from a parent to its child")
                };
                by
            })
            .collect()
    }

    /// A shortest trace that ends with this step.
    pub fn trace_of(&self, system: &System, step: Step) -> Vec<Move> {
        let mut trace = self.trace(system, step.from);
        trace.push(step.by);
        trace
    }
}
