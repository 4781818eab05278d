//! Exact breadth-first search over packed states, and a search for lassos.
//!
//! Every state is stored whole, so two states are never taken for one. States are found in the
//! order of their distance from the start, so the first finding of a kind has a shortest trace.

use super::fit::fitted;
use super::moves::Move;
use super::properties::{Property, Set, Sight};
use super::system::System;

/// All reachable states of a system.
#[derive(Debug)]
pub struct Explored {
    index: Index,
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
    let mut index = Index::default();
    index.insert(layout.pack(&system.start()));
    let (mut parents, mut transitions) = (vec![0], 0_u64);
    let (mut broken, mut seen) = (Vec::new(), Vec::new());
    let (mut all_broken, mut all_seen) = (Set::EMPTY, Set::EMPTY);
    let (mut depth, mut end_of_level) = (0, 1);
    let mut moves = Vec::new();
    let mut done = 0;
    while done < index.len() {
        if done == end_of_level {
            depth += 1;
            end_of_level = index.len();
        }
        if done % REPORT_EVERY == 0 {
            report(Progress { states: index.len(), done, depth, transitions });
        }
        let from = fitted(done);
        let state = layout.unpack(index.state(from));
        moves.clear();
        system.moves(&state, &mut moves);
        for by in moves.iter().copied() {
            let Some(next) = system.apply(&state, by) else { continue };
            transitions += 1;
            let step = Step { from, by };
            note(&Property::ALL, next.found.broken, &mut all_broken, step, &mut broken);
            note(&Sight::ALL, next.found.seen, &mut all_seen, step, &mut seen);
            if next.state != state && index.insert(layout.pack(&next.state)) {
                parents.push(from);
            }
        }
        done += 1;
    }
    Explored { index, parents, transitions, depth, broken, seen }
}

/// Keeps the first step that shows a member.
fn note<T: super::properties::Member>(
    all: &[T],
    found: Set<T>,
    known: &mut Set<T>,
    step: Step,
    list: &mut Vec<(T, Step)>,
) {
    let new = found.without(*known);
    if !new.is_empty() {
        known.extend(new);
        list.extend(all.iter().filter(|it| new.contains(**it)).map(|it| (*it, step)));
    }
}

impl Explored {
    /// Number of states.
    pub fn len(&self) -> usize {
        self.index.len()
    }

    /// Never: there is a start.
    pub fn is_empty(&self) -> bool {
        self.index.len() == 0
    }

    /// The state at a place in the order of the search.
    pub fn state(&self, place: u32) -> u128 {
        self.index.state(place)
    }

    /// The place of a state, if it was reached.
    pub fn place(&self, state: u128) -> Option<u32> {
        self.index.place(state)
    }

    /// Bytes that the states take.
    pub fn bytes(&self) -> usize {
        self.index.bytes() + self.parents.capacity() * size_of::<u32>()
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

/// A set of packed states in the order of their insertion: open addressing over places.
#[derive(Debug, Default)]
struct Index {
    states: Vec<u128>,
    /// 1 + the place of a state, or 0.
    slots: Vec<u32>,
}

impl Index {
    fn len(&self) -> usize {
        self.states.len()
    }

    fn state(&self, place: u32) -> u128 {
        self.states[place as usize]
    }

    fn bytes(&self) -> usize {
        self.states.capacity() * size_of::<u128>() + self.slots.capacity() * size_of::<u32>()
    }

    fn place(&self, state: u128) -> Option<u32> {
        self.slots[self.slot(state)].checked_sub(1)
    }

    /// Whether the state is new.
    fn insert(&mut self, state: u128) -> bool {
        if self.states.len() * 3 >= self.slots.len() * 2 {
            self.grow();
        }
        let slot = self.slot(state);
        if self.slots[slot] != 0 {
            return false;
        }
        self.states.push(state);
        self.slots[slot] = fitted(self.states.len());
        true
    }

    /// Where the state is, or would be put.
    fn slot(&self, state: u128) -> usize {
        let mask = self.slots.len() - 1;
        let mut slot = scatter(state) & mask;
        while self.slots[slot] != 0 && self.states[self.slots[slot] as usize - 1] != state {
            slot = (slot + 1) & mask;
        }
        slot
    }

    fn grow(&mut self) {
        let size = (self.slots.len() * 2).max(1 << 10);
        self.slots.clear();
        self.slots.resize(size, 0);
        for place in 0..self.states.len() {
            let slot = self.slot(self.states[place]);
            self.slots[slot] = fitted(place + 1);
        }
    }
}

/// Spreads states over slots; nothing depends on it but speed.
fn scatter(state: u128) -> usize {
    const ODD: u64 = 0x9e37_79b9_7f4a_7c15;
    let [high, low] = [state >> 64, state & u128::from(u64::MAX)].map(fitted::<_, u64>);
    let mixed = (low ^ high.wrapping_mul(ODD).rotate_left(29)).wrapping_mul(ODD);
    fitted((mixed ^ mixed >> 32) & 0xffff_ffff)
}
