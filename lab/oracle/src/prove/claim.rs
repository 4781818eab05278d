//! One claim with what the engines say of it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What an engine says; of two answers on one claim the one that comes first here counts, but a refutation before all. Who
/// does not know what it should counts more than a test.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
pub enum Status {
    /// True of the whole domain.
    #[serde(rename = "proved")]
    Proved,
    /// False of something in it.
    #[serde(rename = "refuted")]
    Refuted,
    /// The engine does not know, or its claim may be one of nothing.
    #[serde(rename = "unknown")]
    Unknown,
    /// True of some values of the domain, which were run. No proof.
    #[serde(rename = "tested")]
    Tested,
    /// The engine is not here, or this was left out. Nothing is claimed.
    #[serde(rename = "not run")]
    NotRun,
}

impl Status {
    /// All of them.
    pub const ALL: [Self; 5] =
        [Self::Proved, Self::Refuted, Self::Unknown, Self::Tested, Self::NotRun];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Proved => "proved",
            Self::Refuted => "refuted",
            Self::Unknown => "unknown",
            Self::Tested => "tested",
            Self::NotRun => "not run",
        }
    }
}

/// What one engine says of a claim.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct EngineAnswer {
    /// The engine.
    pub engine: &'static str,
    /// What it says.
    #[serde(rename = "verdict")]
    pub status: Status,
    /// Time taken, s; none where nothing ran.
    pub seconds: Option<f64>,
    /// What was run, as a number of cases or paths.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ran: Option<String>,
    /// Why it is not proved, or was not run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

impl EngineAnswer {
    /// Nothing was asked.
    pub fn not_run(engine: &'static str, reason: &str) -> Self {
        let reason = Some(reason.to_owned());
        Self { engine, status: Status::NotRun, seconds: None, ran: None, reason }
    }

    /// An answer after this time.
    pub fn given(engine: &'static str, status: Status, seconds: f64) -> Self {
        Self { engine, status, seconds: Some(seconds), ran: None, reason: None }
    }
}

/// One claim.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Claim {
    /// Its name, a sentence.
    pub id: String,
    /// What is claimed.
    pub statement: String,
    /// Of which inputs, and what is not covered.
    pub domain: String,
    /// The answer that counts.
    #[serde(flatten)]
    pub answer: EngineAnswer,
    /// What other engines say of the same claim.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub others: Vec<EngineAnswer>,
    /// The statement near it that was refuted, of theorems.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub refuted_variant: Option<String>,
    /// The drive that refutes it, a table of times, places and speeds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drive: Option<String>,
    /// The changes of the source that make it fail; `scripts/mutants` applies them.
    pub mutants: Vec<String>,
}

impl Claim {
    /// A claim that nothing was asked about yet.
    pub fn new([id, statement, domain]: [&str; 3], answer: EngineAnswer) -> Self {
        Self {
            id: id.to_owned(),
            statement: statement.to_owned(),
            domain: domain.to_owned(),
            answer,
            others: Vec::new(),
            refuted_variant: None,
            drive: None,
            mutants: Vec::new(),
        }
    }

    /// Takes the answers of several engines: the one that counts first, then the others.
    pub fn answered(self, mut answers: Vec<EngineAnswer>) -> Self {
        answers.sort_by_key(|answer| (answer.status != Status::Refuted, answer.status));
        let mut answers = answers.into_iter();
        match answers.next() {
            Some(answer) => Self { answer, others: answers.collect(), ..self },
            None => self,
        }
    }
}
