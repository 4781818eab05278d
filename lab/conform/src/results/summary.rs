//! The result of a campaign or of a shard, as it is kept and merged.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::ConformError;
use crate::judge::class::{Class, Kind};
use crate::results::found::Found;

/// The result of a campaign, or of some of its shards.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Summary {
    /// What was done; equal in all shards.
    pub campaign: Campaign,
    /// Shards in it, ascending.
    pub shards: Vec<u64>,
    /// Vectors asked.
    pub vectors: u64,
    /// Cases asked.
    pub asked: u64,
    /// Vectors not asked because their kind was given up.
    pub vectors_skipped: u64,
    /// Vectors that only the tolerance makes agree.
    pub vectors_tolerated: u64,
    /// Cases not asked because their kind was given up.
    pub skipped: u64,
    /// Cases that only the tolerance makes agree.
    pub tolerated: u64,
    /// Answers that came too late and, when the case was asked again, in time.
    pub late: u64,
    /// How often the program had to be started again while vectors and cases were asked.
    pub restarts: u64,
    /// Whether it was ended before all cases were asked, or before their records were made small.
    pub interrupted: bool,
    /// Whether the cases were left out because the vectors show that much is wrong.
    pub enough: bool,
    /// Kinds that were given up after too many restarts.
    pub given_up: Vec<Kind>,
    /// Cases by kind, profile, configuration and expected verdict.
    pub groups: Vec<CaseCount>,
    /// Disagreements, by class.
    pub classes: Vec<Found>,
}

/// What makes shards parts of one campaign.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Campaign {
    /// The version of the kit, as `mufasa --version` has it; empty: one that did not say.
    #[serde(default)]
    pub version: String,
    /// The program under test and its arguments.
    pub command: Vec<String>,
    /// `paper` or `hardened`.
    pub profile: String,
    /// Seed of the cases.
    pub seed: u64,
    /// Vectors of all shards together, asked before the cases.
    pub vectors: u64,
    /// Cases of all shards together.
    pub cases: u64,
    /// Kinds of records.
    pub kinds: Vec<Kind>,
    /// Files of drives; empty when cases are generated.
    pub drives: Vec<String>,
    /// Time limit of an answer, ms.
    pub time_limit_ms: u64,
    /// Margin within which a disagreement is none, m.
    pub tolerance: Option<f64>,
    /// Into how many shards the cases are divided.
    pub of: u64,
}

/// Cases that have something in common.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CaseCount {
    /// Kind of the records.
    pub kind: Kind,
    /// Profile, or empty.
    pub profile: String,
    /// Configuration, or empty.
    pub configuration: String,
    /// What the exact model says: `safe`, a failing stage, `error`; empty for other kinds.
    pub expected: String,
    /// Cases asked.
    pub cases: u64,
    /// Disagreements among them.
    pub disagreements: u64,
}

impl Summary {
    /// Whether nothing was asked.
    pub fn is_empty(&self) -> bool {
        self.asked + self.vectors == 0
    }

    /// The vectors on which the program disagrees.
    pub fn wrong_vectors(&self) -> Vec<&str> {
        self.classes.iter().flat_map(|found| &found.vectors).map(String::as_str).collect()
    }

    /// All disagreements, of vectors and cases.
    pub fn disagreements(&self) -> u64 {
        self.classes.iter().map(|found| found.count).sum()
    }

    /// Whether every shard is in it, to its end.
    pub fn is_complete(&self) -> bool {
        self.missing().is_empty() && !self.interrupted
    }

    /// Shards that are not in it, the first hundred of them.
    pub fn missing(&self) -> Vec<u64> {
        (0..self.campaign.of).filter(|shard| !self.shards.contains(shard)).take(100).collect()
    }

    /// Reads a summary from a file.
    pub fn read(path: &Path) -> Result<Self, ConformError> {
        let text = fs::read_to_string(path)
            .map_err(|error| ConformError::file(path, format!("cannot be read: {error}")))?;
        serde_json::from_str(&text).map_err(|error| {
            ConformError::file(path, format!("is no summary of `mufasa conform`: {error}"))
        })
    }

    /// Joins the shards of one campaign. Errors: other campaigns, a shard given twice.
    pub fn merge(files: &[PathBuf]) -> Result<Self, ConformError> {
        let mut merged: Option<Self> = None;
        for path in files {
            let summary = Self::read(path)?;
            merged = Some(match merged {
                None => summary,
                Some(merged) => merged.with(summary, path)?,
            });
        }
        let merged = merged.map(Self::of_one_run);
        merged.ok_or_else(|| ConformError::Merge(String::from("no summaries given")))
    }

    fn with(mut self, other: Self, path: &Path) -> Result<Self, ConformError> {
        if self.campaign != other.campaign {
            let what = "belongs to another campaign: version of mufasa, command, profile, seed, cases, vectors, kinds, \
                        drives, time limit, tolerance and number of shards must be the same";
            return Err(ConformError::file(path, what));
        }
        if let Some(shard) = other.shards.iter().find(|shard| self.shards.contains(shard)) {
            return Err(ConformError::file(path, format!("shard {shard} is given twice")));
        }
        self.shards.extend(other.shards);
        self.shards.sort_unstable();
        self.vectors += other.vectors;
        self.asked += other.asked;
        self.vectors_skipped += other.vectors_skipped;
        self.vectors_tolerated += other.vectors_tolerated;
        self.skipped += other.skipped;
        self.tolerated += other.tolerated;
        self.late += other.late;
        self.restarts += other.restarts;
        self.interrupted |= other.interrupted;
        self.enough |= other.enough;
        self.given_up.extend(other.given_up);
        self.given_up.sort();
        self.given_up.dedup();
        for group in other.groups {
            let same = |it: &&mut CaseCount| {
                (it.kind, &it.profile, &it.configuration, &it.expected)
                    == (group.kind, &group.profile, &group.configuration, &group.expected)
            };
            match self.groups.iter_mut().find(same) {
                Some(known) => {
                    known.cases += group.cases;
                    known.disagreements += group.disagreements;
                }
                None => self.groups.push(group),
            }
        }
        let key = |it: &CaseCount| {
            (it.kind, it.profile.clone(), it.configuration.clone(), it.expected.clone())
        };
        self.groups.sort_by_key(key);
        let mut classes: BTreeMap<Class, Found> = BTreeMap::new();
        for found in self.classes.into_iter().chain(other.classes) {
            let class = found.class.clone();
            let joined = match classes.remove(&class) {
                None => found,
                Some(known) => known.with(&found),
            };
            classes.insert(class, joined);
        }
        self.classes = classes.into_values().collect();
        Ok(self)
    }

    /// What one run of all shards would have said, where all are there.
    fn of_one_run(mut self) -> Self {
        if self.missing().is_empty() {
            self.campaign.of = 1;
            self.shards = vec![0];
            self.classes.iter_mut().for_each(|found| found.tried.clear());
        }
        self
    }
}
