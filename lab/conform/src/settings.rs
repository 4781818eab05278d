//! What a campaign is to do.

use std::ffi::OsString;
use std::path::PathBuf;
use std::time::Duration;

use mufasa_model::input::cycle::Profile;

use crate::judge::class::Kind;

/// What is to be done.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// The version of the kit: what it asks, and what it takes for right, may change with it.
    pub version: String,
    /// The program under test and its arguments.
    pub command: Vec<OsString>,
    /// Profile of generated cases and of recorded drives.
    pub profile: Profile,
    /// Cases of all shards, vectors not counted; by default 10,000, or all that the drives give.
    pub cases: Option<u64>,
    /// Seed of the cases.
    pub seed: u64,
    /// How long an answer may take.
    pub time_limit: Duration,
    /// How long records are made small, in all.
    pub shrinking: Duration,
    /// Kinds of generated records.
    pub kinds: Vec<Kind>,
    /// Only the cases whose number leaves the first when divided by the second.
    pub shard: Option<(u64, u64)>,
    /// Files of drives that give the cases instead.
    pub drives: Vec<PathBuf>,
    /// Whether the vectors that fit are asked before generated cases.
    pub vectors: bool,
    /// Margin within which a disagreement is none, m.
    pub tolerance: Option<f64>,
    /// Where summary, JUnit and reproducers go.
    pub out: PathBuf,
}

#[cfg(test)]
impl Settings {
    /// The vectors and cases of a profile and of these kinds, for no program.
    pub fn of(profile: Profile, kinds: &[Kind]) -> Self {
        Self {
            version: String::new(),
            command: Vec::new(),
            profile,
            cases: None,
            seed: 0,
            time_limit: Duration::ZERO,
            shrinking: Duration::ZERO,
            kinds: kinds.into(),
            shard: None,
            drives: Vec::new(),
            vectors: true,
            tolerance: None,
            out: "out".into(),
        }
    }
}
