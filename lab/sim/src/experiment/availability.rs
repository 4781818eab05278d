//! What the checks cost without an attack: fallbacks, and time that is not offloaded.
//!
//! One setting at a time differs from the defaults. Settings of the detectors are those of the CAV and of the
//! station alike.

use mufasa::services::configuration::Groups;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::job::{self, Campaign, ExperimentError, Job, Options};
use super::watch::Watch;
use crate::cav::guard::Variant;
use crate::map::Town;
use crate::run::{End, Outcome, PERIOD_NS, Settings};
use crate::services::way::seconds;

/// Its name.
pub const NAME: &str = "availability";
/// A few scenarios of each of 46 combinations.
pub const OPTIONS: Options = Options::town(2, 15, 0);

/// What is set.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "kebab-case")]
pub enum Factor {
    /// Share of the visible objects that a cycle's detections leave out.
    Missed,
    /// Mean number of detections of nothing in a cycle.
    Clutter,
    /// Standard deviation of each coordinate of a detection, m.
    PositionM,
    /// Mean of what comes on top of a message's least latency, ms.
    JitterMs,
    /// Share of the messages that never arrive, in both directions.
    Loss,
    /// The wait after a failure, s.
    TWaitS,
}

impl Factor {
    /// All.
    pub const ALL: [Self; 6] =
        [Self::Missed, Self::Clutter, Self::PositionM, Self::JitterMs, Self::Loss, Self::TWaitS];

    /// Its name in tables and files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Missed => "missed",
            Self::Clutter => "clutter",
            Self::PositionM => "position-m",
            Self::JitterMs => "jitter-ms",
            Self::Loss => "loss",
            Self::TWaitS => "t-wait-s",
        }
    }

    /// What it is set to; the default is among them.
    pub const fn values(self) -> &'static [f64] {
        match self {
            Self::Missed => &[0.0, 0.01, 0.05, 0.1],
            Self::Clutter => &[0.0, 0.1, 1.0],
            Self::PositionM => &[0.02, 0.05, 0.1, 0.2],
            Self::JitterMs => &[0.0, 2.0, 5.0, 10.0],
            Self::Loss => &[0.0, 0.001, 0.01, 0.05, 0.1],
            Self::TWaitS => &[1.0, 10.0, 60.0],
        }
    }

    /// What it is where nothing sets it.
    pub fn of_default(self) -> f64 {
        let settings = Settings::new(Variant::Hardened, Groups::ALL, 0);
        match self {
            Self::Missed => settings.errors.missed,
            Self::Clutter => settings.errors.clutter,
            Self::PositionM => settings.errors.position,
            Self::JitterMs => 1e3 * seconds(settings.radio.jitter_ns),
            Self::Loss => settings.radio.loss,
            Self::TWaitS => seconds(settings.requester.t_wait_ns),
        }
    }

    fn set(self, settings: &mut Settings, value: f64) {
        #[expect(clippy::cast_possible_truncation, reason = "at most a minute")]
        let ns = |seconds: f64| (seconds * 1e9) as i64;
        match self {
            Self::Missed => settings.errors.missed = value,
            Self::Clutter => settings.errors.clutter = value,
            Self::PositionM => settings.errors.position = value,
            Self::JitterMs => settings.radio.jitter_ns = ns(value / 1e3),
            Self::Loss => settings.radio.loss = value,
            Self::TWaitS => settings.requester.t_wait_ns = ns(value),
        }
    }
}

/// What came of it.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Availability {
    /// How large it was.
    pub options: Options,
    /// The table.
    pub rows: Vec<Row>,
    /// Every run.
    pub runs: Vec<Run>,
}

/// Runs of one setting and variant.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Row {
    /// What is set.
    pub factor: Factor,
    /// To what.
    pub value: f64,
    /// What is checked.
    pub variant: Variant,
    /// Runs.
    pub runs: usize,
    /// Those that failed.
    pub failures: usize,
    /// Time driven in all of them, h.
    pub hours: f64,
    /// Fallbacks for a safety issue that is none.
    pub fallbacks: u64,
    /// As many in an hour of driving.
    pub fallbacks_per_hour: f64,
    /// How often a group came back for late data or silence.
    pub lost: u64,
    /// Share of the cycles with remote tracks.
    pub share_mot: f64,
    /// Share of the cycles with a remote trajectory.
    pub share_plan: f64,
    /// Share of the cycles with both.
    pub share_both: f64,
}

/// A run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Run {
    /// By which it can be repeated.
    pub id: String,
    /// What is set.
    pub factor: Factor,
    /// To what.
    pub value: f64,
    /// What is checked.
    pub variant: Variant,
    /// Which route.
    pub route: usize,
    /// Which scenario on it.
    pub scenario: u64,
    /// How it ended.
    pub end: End,
    /// Cycles in all.
    pub cycles: u64,
    /// Those with remote tracks.
    pub remote_mot: u64,
    /// Those with a remote trajectory.
    pub remote_plan: u64,
    /// Those with both.
    #[serde(default)]
    pub remote_both: u64,
    /// Fallbacks for a safety issue that is none.
    pub fallbacks: u64,
    /// How often a group came back for late data or silence.
    pub lost: u64,
}

type Set = (Factor, f64);

/// The runs.
pub fn jobs(town: &Town, options: Options) -> Vec<Job<Set>> {
    let mut jobs = Vec::new();
    for factor in Factor::ALL {
        for &value in factor.values() {
            for variant in [Variant::Paper, Variant::Hardened] {
                for (route, scenario) in job::starts(town, options) {
                    let (word, place) =
                        (format!("{}={value}", factor.name()), (variant, route, scenario));
                    let mut job = Job::new(NAME, (&word, (factor, value)), place, options);
                    factor.set(&mut job.settings, value);
                    jobs.push(job);
                }
            }
        }
    }
    jobs
}

/// Makes the runs. Errors: those of [`job::make`].
pub fn experiment(campaign: &Campaign<'_>) -> Result<Availability, ExperimentError> {
    let &Campaign { town, options, .. } = campaign;
    let runs = job::make(campaign, jobs(town, options), kept)?;
    let same = |a: &Run, b: &Run| (a.factor, a.value, a.variant) == (b.factor, b.value, b.variant);
    Ok(Availability { options, rows: runs.chunk_by(same).map(row).collect(), runs })
}

fn kept(job: &Job<Set>, outcome: &Outcome, watch: &Watch) -> Run {
    let (factor, value) = job.what;
    Run {
        id: job.id.clone(),
        factor,
        value,
        variant: job.settings.variant,
        route: job.route,
        scenario: job.scenario,
        end: outcome.end,
        cycles: outcome.cycles,
        remote_mot: outcome.offloaded[0],
        remote_plan: outcome.offloaded[1],
        remote_both: watch.both,
        fallbacks: watch.fallbacks,
        lost: watch.lost,
    }
}

#[expect(clippy::cast_precision_loss, reason = "counts far below 2^53")]
fn row(runs: &[Run]) -> Row {
    let sum = |of: fn(&Run) -> u64| runs.iter().map(of).sum::<u64>();
    let cycles = sum(|run| run.cycles) as f64;
    let hours = cycles * seconds(PERIOD_NS) / 3600.0;
    let fallbacks = sum(|run| run.fallbacks);
    Row {
        factor: runs[0].factor,
        value: runs[0].value,
        variant: runs[0].variant,
        runs: runs.len(),
        failures: runs.iter().filter(|run| run.end.is_failure()).count(),
        hours,
        fallbacks,
        fallbacks_per_hour: fallbacks as f64 / hours,
        lost: sum(|run| run.lost),
        share_mot: sum(|run| run.remote_mot) as f64 / cycles,
        share_plan: sum(|run| run.remote_plan) as f64 / cycles,
        share_both: sum(|run| run.remote_both) as f64 / cycles,
    }
}
