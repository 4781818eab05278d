//! One claim with what an engine says of it.

use serde::{Deserialize, Serialize};

/// What an engine says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Verdict {
    /// True of the whole domain.
    #[serde(rename = "proved")]
    Proved,
    /// False of something in it.
    #[serde(rename = "refuted")]
    Refuted,
    /// The engine does not know, or its claim may be one of nothing.
    #[serde(rename = "unknown")]
    Unknown,
    /// The engine is not here, or this was left out. Nothing is claimed.
    #[serde(rename = "not run")]
    NotRun,
}

impl Verdict {
    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Proved => "proved",
            Self::Refuted => "refuted",
            Self::Unknown => "unknown",
            Self::NotRun => "not run",
        }
    }
}

/// One claim.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Line {
    /// Its name, a sentence.
    pub id: String,
    /// What is claimed.
    pub statement: String,
    /// What judged it.
    pub engine: String,
    /// Of which inputs, and what is not covered.
    pub domain: String,
    /// The verdict.
    pub verdict: Verdict,
    /// Time taken, s; none where nothing ran.
    pub seconds: Option<f64>,
    /// Paths of the execution, of theorems.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub paths: Option<usize>,
    /// The statement near it that was refuted, of theorems.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub refuted_variant: Option<String>,
    /// The change of the source that makes it fail.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mutant: Option<String>,
    /// Why it is not proved, or was not run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

impl Line {
    /// A claim that nothing was asked about yet.
    pub fn not_run(engine: &str, [id, statement, domain]: [&str; 3], reason: &str) -> Self {
        Self {
            id: id.to_owned(),
            statement: statement.to_owned(),
            engine: engine.to_owned(),
            domain: domain.to_owned(),
            verdict: Verdict::NotRun,
            seconds: None,
            paths: None,
            refuted_variant: None,
            mutant: None,
            reason: Some(reason.to_owned()),
        }
    }
}
