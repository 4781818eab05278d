//! What was run and what came of it, for people and programs.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

use schemars::JsonSchema;
use serde::Serialize;

use super::checks::Check;

/// What is asked for where nothing may be left out.
pub(super) const RELEASE: &str = "release";

/// The tools on whose word a check counts, and how they say their version.
const TOOLS: [(&str, &[&str]); 15] = [
    ("began, UTC", &["date", "-u", "+%Y-%m-%d %H:%M"]),
    ("system", &["uname", "-srm"]),
    ("rustc", &["rustc", "--version"]),
    ("cargo", &["cargo", "--version"]),
    ("cc", &["cc", "--version"]),
    ("z3", &["z3", "--version"]),
    ("cbmc", &["chroot", "target/provers", "cbmc", "--version"]),
    ("rustc of the proofs", &["chroot", "target/provers", "rustc", "--version"]),
    ("valgrind", &["valgrind", "--version"]),
    ("qemu", &["qemu-system-arm", "--version"]),
    ("python", &["python3", "--version"]),
    ("node", &["node", "--version"]),
    ("miri", &["cargo", "+nightly", "miri", "--version"]),
    ("cargo-mutants", &["cargo-mutants", "mutants", "--version"]),
    ("cargo-deny", &["cargo-deny", "--version"]),
];

/// How a check or a test of it ended; the worst comes last.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, JsonSchema)]
pub enum Status {
    /// It shows what it is to show.
    #[serde(rename = "passed")]
    Passed,
    /// Something is not here, or was left out. Nothing is shown.
    #[serde(rename = "not run")]
    NotRun,
    /// It does not.
    #[serde(rename = "failed")]
    Failed,
}

/// What a verification showed.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Evidence {
    /// Whether it came to its end.
    pub complete: bool,
    /// What was asked for: `quick`, `all`, `night`, `some` or `release`.
    pub asked: &'static str,
    /// The commit of the checkout, `with changes` where files differ from it.
    pub commit: String,
    /// With what it was made, and when; none: it is not here.
    pub versions: BTreeMap<&'static str, Option<String>>,
    /// What came of the checks that are through.
    pub checks: Vec<Outcome>,
}

/// What came of a check.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Outcome {
    /// The check.
    #[serde(flatten)]
    pub check: Check,
    /// How it ended.
    pub status: Status,
    /// Why it did not pass, with what brings what is missing.
    pub reason: Option<String>,
    /// Time taken, s.
    pub taken: f64,
    /// Its tests or claims, and what it says that it left out.
    pub cases: Vec<Case>,
}

/// A test, a claim, or something that a check says that it left out.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Case {
    /// Its name.
    pub name: String,
    /// How it ended.
    pub status: Status,
    /// Why it did not pass, as far as it is known; of a claim also by which engine it did.
    pub reason: Option<String>,
}

impl Status {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Passed, Self::NotRun, Self::Failed];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Passed => "passed",
            Self::NotRun => "not run",
            Self::Failed => "failed",
        }
    }
}

impl Outcome {
    /// Of a check that was not run.
    pub(super) fn not_run(check: &Check, reason: String) -> Self {
        let (check, reason) = (check.clone(), Some(reason));
        Self { check, status: Status::NotRun, reason, taken: 0.0, cases: Vec::new() }
    }

    /// How many of its cases ended so.
    pub(super) fn count(&self, status: Status) -> usize {
        self.cases.iter().filter(|case| case.status == status).count()
    }

    /// Its cases, and itself where none of them ended as it did.
    pub(super) fn entries(&self) -> Vec<Case> {
        let (name, reason) = (self.check.name.clone(), self.reason.clone());
        let itself = Case { name, status: self.status, reason };
        let is_said = self.count(self.status) > 0;
        self.cases.iter().cloned().chain((!is_said).then_some(itself)).collect()
    }
}

impl Evidence {
    /// Before the first check.
    pub(super) fn new(asked: &'static str, root: &Path) -> Self {
        let own = ("mufasa", Some(env!("MUFASA_VERSION").to_owned()));
        let tools = TOOLS.map(|(tool, command)| (tool, said(root, command)));
        let commit = said(root, &["git", "rev-parse", "HEAD"]);
        let commit = commit.unwrap_or_else(|| String::from("unknown"));
        let changes = said(root, &["git", "status", "--porcelain"]).map(|_| " with changes");
        Self {
            complete: false,
            asked,
            commit: commit + changes.unwrap_or_default(),
            versions: [own].into_iter().chain(tools).collect(),
            checks: Vec::new(),
        }
    }

    /// Whether what was not run counts as failed.
    pub(super) fn is_release(&self) -> bool {
        self.asked == RELEASE
    }

    /// The worst that came of a check or a test.
    pub(super) fn worst(&self) -> Status {
        let each = self.checks.iter().flat_map(Outcome::entries).map(|it| it.status);
        each.max().unwrap_or(Status::NotRun)
    }

    /// How many checks ended so.
    pub(super) fn count(&self, status: Status) -> usize {
        self.checks.iter().filter(|check| check.status == status).count()
    }
}

/// The first line of what it says, if it says something and succeeds.
fn said(root: &Path, command: &[&str]) -> Option<String> {
    let output = Command::new(command[0]).args(&command[1..]).current_dir(root).output().ok()?;
    let text = String::from_utf8_lossy(&output.stdout);
    text.lines().next().filter(|_| output.status.success()).map(str::to_owned)
}
