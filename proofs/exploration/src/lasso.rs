//! The search for lassos: endless runs in which what has to come never comes.
//!
//! A run is described by its steps from each state. They are chosen so that every endless run of
//! them is a fair one (time passes again and again, because everything else is used up), which
//! makes the search itself simple: a run avoids what is wanted for ever exactly when it comes
//! back to a state, or ends.

use super::fit::fitted;
use super::moves::Move;
use super::search::Explored;
use super::system::System;

/// What a run is to come to, from a state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aim {
    /// It is here.
    Reached,
    /// It has to come.
    Ahead,
    /// The property does not speak of this state.
    Elsewhere,
}

/// A step of a run: some moves, and the state to which they lead.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Leap {
    /// In order.
    pub moves: Vec<Move>,
    /// Packed.
    pub to: u128,
}

/// The result of a search.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hunted {
    /// States from which the aim lies ahead.
    pub ahead: usize,
    /// Most time that a run needs, ticks; meaningless with a lasso.
    pub longest: u16,
    /// A run that never comes to the aim.
    pub lasso: Option<Lasso>,
}

/// A run that never comes to its aim.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Lasso {
    /// From the start to the first state of the run.
    pub stem: Vec<Move>,
    /// From there to the first state of the loop.
    pub way: Vec<Move>,
    /// Round and round; empty when the run ends there.
    pub circle: Vec<Move>,
}

const NEW: u16 = 0;
const OPEN: u16 = 1;
/// A state from which every run comes to the aim within `colour - DONE` ticks.
const DONE: u16 = 2;

/// Looks for a run that stays ahead of its aim for ever. `leaps` lists the steps of the runs from
/// a state, all of which must be reachable states; `aim` says how a state is to the aim.
pub fn find(
    system: &System,
    explored: &Explored,
    leaps: impl Fn(u128, &mut Vec<Leap>),
    aim: impl Fn(u128) -> Aim,
) -> Hunted {
    let mut hunt = Hunt {
        explored,
        leaps,
        aim,
        colours: vec![NEW; explored.len()],
        path: Vec::new(),
        longest: 0,
    };
    let mut ahead = 0;
    for start in 0..explored.len() {
        let start = fitted(start);
        if (hunt.aim)(explored.state(start)) != Aim::Ahead {
            continue;
        }
        ahead += 1;
        if hunt.colour(start) == NEW
            && let Some(first) = hunt.run(start)
        {
            let lasso = Some(lasso(system, explored, &hunt.path, first));
            return Hunted { ahead, longest: hunt.longest, lasso };
        }
    }
    Hunted { ahead, longest: hunt.longest, lasso: None }
}

/// A depth-first search through the states from which the aim lies ahead.
struct Hunt<'a, L, A> {
    explored: &'a Explored,
    leaps: L,
    aim: A,
    colours: Vec<u16>,
    path: Vec<Visit>,
    longest: u16,
}

impl<L: Fn(u128, &mut Vec<Leap>), A: Fn(u128) -> Aim> Hunt<'_, L, A> {
    /// Follows all runs from a state. `Some` when one never comes to its aim: the place on the
    /// path to which it comes back, or at which it ends.
    fn run(&mut self, start: u32) -> Option<usize> {
        self.enter(start);
        while let Some(top) = self.path.last() {
            if top.leaps.is_empty() {
                return Some(self.path.len() - 1);
            }
            match top.leaps.get(top.next).map(|leap| leap.to) {
                None => self.leave(),
                Some(to) if (self.aim)(to) != Aim::Ahead => self.arrive(0),
                Some(to) => {
                    let Some(to) = self.explored.place(to) else {
                        unreachable!("runs are made of the system's moves")
                    };
                    match self.colour(to) {
                        NEW => self.enter(to),
                        OPEN => return self.path.iter().position(|visit| visit.place == to),
                        done => self.arrive(done - DONE),
                    }
                }
            }
        }
        None
    }

    fn colour(&self, place: u32) -> u16 {
        self.colours[place as usize]
    }

    fn enter(&mut self, place: u32) {
        self.colours[place as usize] = OPEN;
        let mut leaps = Vec::new();
        (self.leaps)(self.explored.state(place), &mut leaps);
        self.path.push(Visit { place, leaps, next: 0, longest: 0 });
    }

    /// All leaps of the last state on the path are done.
    fn leave(&mut self) {
        if let Some(Visit { place, longest, .. }) = self.path.pop() {
            self.colours[place as usize] = DONE + longest;
            self.longest = self.longest.max(longest);
            self.arrive(longest);
        }
    }

    /// The leap at hand is done: from where it leads, `ticks` more are needed at most.
    fn arrive(&mut self, ticks: u16) {
        if let Some(visit) = self.path.last_mut() {
            let time = visit.leaps[visit.next].moves.contains(&Move::TimePasses);
            visit.longest = visit.longest.max(ticks + u16::from(time));
            visit.next += 1;
        }
    }
}

/// A state on the path, and how far it is done.
struct Visit {
    place: u32,
    leaps: Vec<Leap>,
    next: usize,
    longest: u16,
}

fn lasso(system: &System, explored: &Explored, path: &[Visit], first: usize) -> Lasso {
    let moves = |visits: &[Visit]| {
        let taken = visits.iter().filter_map(|visit| visit.leaps.get(visit.next));
        taken.flat_map(|leap| leap.moves.iter().copied()).collect()
    };
    Lasso {
        stem: explored.trace(system, path[0].place),
        way: moves(&path[..first]),
        circle: moves(&path[first..]),
    }
}
