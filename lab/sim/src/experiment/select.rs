//! Which runs of an experiment are made: all, or those of an id.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

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

/// Which runs are made, and what is looked at in them.
#[derive(Debug, Default)]
pub struct Select<'s> {
    /// Only runs whose id is this or begins with these parts.
    pub only: Option<&'s str>,
    /// Each so many cycles are checked by the model; 0: none.
    pub checked_every: u64,
    /// Whether runs that fail are drawn: of the hardened profile each, of the others those of the first
    /// `DRAWN` scenarios of a route.
    pub draws: bool,
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

    /// Whether a run is chosen.
    pub(super) fn has(&self, id: &str) -> bool {
        let rest = self.only.map_or(Some(""), |only| id.strip_prefix(only));
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
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
