//! Which runs of an experiment are made here: all, those of an id, one part of many on other machines; or none,
//! because all were made before.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use schemars::JsonSchema;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use thiserror::Error;

use super::checks::Checks;
use crate::map::id::MapId;

/// How large an experiment is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Options {
    /// Scenarios of each combination; on each of the two routes, where the experiment uses both.
    pub scenarios: u64,
    /// Other vehicles of a scenario, or the most of them.
    pub vehicles: usize,
    /// The first scenario's seed; the others follow.
    pub seed: u64,
    /// On which map.
    #[serde(default)]
    pub map: MapId,
    /// Whether the station and the CAV's own planner send what they have, and ask nobody before.
    #[serde(default)]
    pub without_precheck: bool,
}

impl Options {
    /// In the town, with a station that asks.
    pub const fn town(scenarios: u64, vehicles: usize, seed: u64) -> Self {
        Self { scenarios, vehicles, seed, map: MapId::Town, without_precheck: false }
    }
}

/// One of so many parts of an experiment: every `of`-th of its runs, from run `index` - 1 on.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
pub struct Shard {
    /// Which part, from 1.
    pub index: u32,
    /// How many there are.
    pub of: u32,
}

impl Shard {
    pub(super) fn has(self, run: usize) -> bool {
        let [index, of] = [self.index, self.of].map(|it| usize::try_from(it).unwrap_or(usize::MAX));
        run % of.max(1) + 1 == index
    }
}

/// The runs of a part, as a file holds them until all are there.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Part<O = Options> {
    /// The program that made it, as `mufasa --version` has it; empty: one that did not say.
    #[serde(default)]
    pub version: String,
    /// Of which experiment.
    pub experiment: String,
    /// How large it is, with all parts.
    pub options: O,
    /// Which part it is.
    pub shard: Shard,
    /// Whether a search was ended by an interrupt: no part then, but what was found until then.
    #[serde(default)]
    pub interrupted: bool,
    /// What is kept of each run, by its id.
    pub runs: BTreeMap<String, Value>,
    /// What was checked of its cycles; in a search none is.
    pub checks: Checks,
}

/// A run is missing in the parts, or is not what this program writes.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("run {id}{why}")]
pub struct NotKept {
    /// The run's id.
    pub id: String,
    /// What is wrong with it.
    pub why: String,
}

impl NotKept {
    fn unreadable(id: &str, error: &serde_json::Error) -> Self {
        Self { id: id.to_owned(), why: format!(": {error}; write the part anew") }
    }
}

/// Which runs are made, what is looked at in them, and what is kept of them.
#[derive(Debug, Default)]
pub struct Select<'s> {
    /// Only runs whose id is this or begins with these parts.
    pub only: Option<&'s str>,
    /// Only runs of this part.
    pub shard: Option<Shard>,
    /// What was kept of all runs when they were made: none is made again.
    pub made: Option<&'s BTreeMap<String, Value>>,
    /// Each so many cycles are checked by the model; 0: none.
    pub checked_every: u64,
    /// Whether runs that fail are drawn: of the hardened profile each, of the others those of the first
    /// `DRAWN` scenarios of a route.
    pub draws: bool,
    /// Of each run of a part, by its id.
    pub kept: Mutex<BTreeMap<String, Value>>,
    /// What was checked.
    pub checks: Mutex<Checks>,
    /// Pages of runs that failed, by their ids.
    pub drawn: Mutex<BTreeMap<String, String>>,
}

impl<'s> Select<'s> {
    /// Runs whose id is this or begins with these parts; every run, where nothing is named.
    pub fn only(only: Option<&'s str>) -> Self {
        Self { only, ..Self::default() }
    }

    /// Whether a run is chosen. `at`: its place among all.
    pub(super) fn has(&self, at: usize, id: &str) -> bool {
        let rest = self.only.map_or(Some(""), |only| id.strip_prefix(only));
        let is_named = rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('/'));
        is_named && self.shard.is_none_or(|shard| shard.has(at))
    }

    /// What was kept of a run; `None`: it has to be made.
    ///
    /// Errors: it should be there, and is not.
    pub(super) fn made<R: DeserializeOwned>(&self, id: &str) -> Result<Option<R>, NotKept> {
        let Some(made) = self.made else { return Ok(None) };
        let value = made.get(id).ok_or_else(|| {
            let why = " is in none of the parts; give all of one experiment".to_owned();
            NotKept { id: id.to_owned(), why }
        })?;
        R::deserialize(value).map(Some).map_err(|error| NotKept::unreadable(id, &error))
    }

    /// Keeps what came of a run, if that is asked for.
    ///
    /// Errors: what no JSON can hold.
    pub(super) fn keep<R: Serialize>(&self, id: &str, run: &R) -> Result<(), NotKept> {
        if self.shard.is_some() {
            let value =
                serde_json::to_value(run).map_err(|error| NotKept::unreadable(id, &error))?;
            self.kept.lock().unwrap_or_else(PoisonError::into_inner).insert(id.to_owned(), value);
        }
        Ok(())
    }

    /// Keeps what was seen beside a run.
    pub(super) fn looked(&self, id: &str, checks: Checks, page: Option<String>) {
        self.checks.lock().unwrap_or_else(PoisonError::into_inner).add(checks);
        if let Some(page) = page {
            let mut drawn = self.drawn.lock().unwrap_or_else(PoisonError::into_inner);
            drawn.insert(id.to_owned(), page);
        }
    }
}
