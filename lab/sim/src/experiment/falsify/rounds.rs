//! What is searched, and what came of it: rounds, each with its own collisions, which are shrunk when the rounds are
//! put together, in their order.

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::caller::Caller;
use super::found::Found;
use super::shrink::shrunk;
use crate::attack::Kind;
use crate::cav::guard::Variant;
use crate::map::Town;
use crate::map::id::MapId;
use crate::run::RunError;

/// What is searched.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Options {
    /// What is checked of remote data.
    pub variant: Variant,
    /// Kinds of attacks that are tried, at least one.
    pub kinds: Vec<Kind>,
    /// Most runs with attacks.
    pub runs: Option<u64>,
    /// Most rounds, each to its end; neither: as long as the caller lets it.
    pub rounds: Option<u64>,
    /// Other vehicles.
    pub vehicles: usize,
    /// Of the scenarios and of what is drawn.
    pub seed: u64,
    /// On which map.
    #[serde(default)]
    pub map: MapId,
}

/// What came of it.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Falsified {
    /// What was searched.
    pub options: Options,
    /// Whether it was ended by an interrupt: what was found until then, not all of it shrunk to its end, and no number of
    /// runs gives the same.
    pub interrupted: bool,
    /// Rounds, the last one perhaps in part.
    pub rounds: u64,
    /// Runs with attacks.
    pub runs: u64,
    /// Those that ended in a collision.
    pub collided: u64,
    /// Of these the random ones: the others were found by going on from what came near.
    pub collided_at_random: u64,
    /// Runs to shrink what was found.
    pub shrinking_runs: u64,
    /// Runs without an attack that collided: their scenarios were left out.
    pub clean_collided: u64,
    /// By kind of attack.
    pub rows: Vec<Row>,
    /// Every run with attacks, in order.
    pub tries: Vec<Try>,
    /// Collisions that are not made of the kinds of another one, offered the same.
    pub found: Vec<Found>,
}

/// Runs with one kind of attack, alone or with another.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Row {
    /// The kind; none: without attacks.
    pub attack: Option<Kind>,
    /// Runs.
    pub runs: u64,
    /// Those that ended in a collision.
    pub collided: u64,
    /// Of these, those when the CAV could have stood by its own services (`Found::is_after`).
    pub after: u64,
    /// Least time left to react of those that did not, s (`danger`); `FREE_S` where nothing was in the way.
    pub least_time_left_s: f64,
    /// Least distance to another of those that did not, m; none in an empty town.
    pub least_distance_m: Option<f64>,
}

/// A run with attacks.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Try {
    /// Its round, from 0.
    pub round: u64,
    /// Whether it is a random point; if not, a search goes on from the best of these.
    pub is_random: bool,
    /// Least time left to react, s; none where it ended in a collision.
    pub time_left_s: Option<f64>,
}

/// What came of a round. It depends on its number and the options, and on no other round.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Round {
    /// Runs with attacks.
    pub runs: u64,
    /// Those that ended in a collision.
    pub collided: u64,
    /// Of these the random ones.
    pub collided_at_random: u64,
    /// Runs without an attack that collided.
    pub clean_collided: u64,
    /// By kind of attack.
    pub rows: Vec<Row>,
    /// Its runs with attacks, in order.
    pub tries: Vec<Try>,
    /// Collisions as they were found, those that are not made of the kinds of an earlier one.
    pub found: Vec<Found>,
}

impl Falsified {
    /// Before the first round.
    pub fn nothing(options: Options) -> Self {
        Self {
            options,
            interrupted: false,
            rounds: 0,
            runs: 0,
            collided: 0,
            collided_at_random: 0,
            shrinking_runs: 0,
            clean_collided: 0,
            rows: Vec::new(),
            tries: Vec::new(),
            found: Vec::new(),
        }
    }

    /// How many runs may still be made: as many as one likes while there are rounds left.
    pub(super) fn left(&self) -> u64 {
        match (self.options.runs, self.options.rounds) {
            (Some(runs), _) => runs.saturating_sub(self.runs),
            (None, Some(rounds)) if self.rounds >= rounds => 0,
            (None, _) => u64::MAX,
        }
    }

    /// Takes the next round: shrinks its collisions that are new, and keeps those that are new then, too. New is one
    /// that no kept one explains ([`explains`]).
    ///
    /// Errors: those of a run.
    pub fn add(&mut self, town: &Town, round: Round, caller: &impl Caller) -> Result<(), RunError> {
        let Round { runs, collided, collided_at_random, clean_collided, rows, tries, found } =
            round;
        self.rounds += 1;
        self.runs += runs;
        self.collided += collided;
        self.collided_at_random += collided_at_random;
        self.clean_collided += clean_collided;
        self.tries.extend(tries);
        for row in rows {
            match self.rows.binary_search_by_key(&row.attack, |it| it.attack) {
                Ok(at) => self.rows[at] = self.rows[at].with(row),
                Err(at) => self.rows.insert(at, row),
            }
        }
        let is_new = |it: &&Found| !self.found.iter().any(|old| explains(old, it));
        let new: Vec<&Found> = found.iter().filter(is_new).collect();
        let small: Vec<(Found, u64)> =
            new.into_par_iter().map(|it| shrunk(town, it, caller)).collect::<Result<_, _>>()?;
        for (found, runs) in small {
            self.shrinking_runs += runs;
            if !self.found.iter().any(|old| explains(old, &found)) {
                self.found.retain(|old| !explains(&found, old));
                self.found.push(found);
            }
        }
        Ok(())
    }
}

impl Row {
    /// The runs of both.
    pub(super) fn with(self, other: Self) -> Self {
        let distances = [self.least_distance_m, other.least_distance_m].into_iter().flatten();
        Self {
            runs: self.runs + other.runs,
            collided: self.collided + other.collided,
            after: self.after + other.after,
            least_time_left_s: self.least_time_left_s.min(other.least_time_left_s),
            least_distance_m: distances.reduce(f64::min),
            ..self
        }
    }
}

/// Whether a collision has all kinds of attacks of another one, with the same offered, both before the CAV could have
/// stood, or both after.
pub fn explains(smaller: &Found, found: &Found) -> bool {
    let (a, b) = (&smaller.case, &found.case);
    a.offered == b.offered
        && smaller.is_after() == found.is_after()
        && a.attacks.iter().all(|it| b.attacks.iter().any(|other| other.kind == it.kind))
}
