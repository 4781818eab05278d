//! The result of a campaign, as it is kept.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::judge::class::Kind;
use crate::results::found::Found;

/// The result of a campaign.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Summary {
    /// What was done.
    pub campaign: Campaign,
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

/// What a campaign asks, and whom.
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
    /// Vectors, asked before the cases.
    pub vectors: u64,
    /// Cases.
    pub cases: u64,
    /// Kinds of records.
    pub kinds: Vec<Kind>,
    /// Files of drives; empty when cases are generated.
    pub drives: Vec<String>,
    /// Time limit of an answer, ms.
    pub time_limit_ms: u64,
    /// Margin within which a disagreement is none, m.
    pub tolerance: Option<f64>,
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
}
