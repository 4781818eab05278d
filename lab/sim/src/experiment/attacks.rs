//! Every attack in every configuration: what finds it, and when.
//!
//! Each attack, and none as the control, with MOT, PLAN or both offered, in the same scenarios for each variant.
//! It begins 5 s after the start and lasts. Counted from then on are the cycles with something remote, and
//! the way driven in them, until the first that fails. The control says how often that happens without an
//! attack: a detection is one only as far as it is above that.

use mufasa::services::configuration::{Group, Groups};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::job::{self, Campaign, ExperimentError, Job, Options, kind_name};
use super::watch::{By, Watch};
use crate::attack::Kind;
use crate::cav::guard::Variant;
use crate::map::Town;
use crate::run::{End, Outcome};

/// Its name.
pub const NAME: &str = "attacks";
/// A few scenarios of each of 216 combinations.
pub const OPTIONS: Options = Options::town(2, 15, 0);

/// What the station offers.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "lowercase")]
pub enum Offered {
    /// Tracking alone.
    Mot,
    /// Planning alone.
    Plan,
    /// Both.
    Both,
}

impl Offered {
    /// All.
    pub const ALL: [Self; 3] = [Self::Mot, Self::Plan, Self::Both];

    /// Its name in tables and files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Mot => "mot",
            Self::Plan => "plan",
            Self::Both => "both",
        }
    }

    /// As the station has it.
    pub fn groups(self) -> Groups {
        match self {
            Self::Mot => Groups::of(&[Group::Mot]),
            Self::Plan => Groups::of(&[Group::Plan]),
            Self::Both => Groups::ALL,
        }
    }
}

/// What came of it.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Attacks {
    /// How large it was.
    pub options: Options,
    /// The table.
    pub rows: Vec<Row>,
    /// Every run.
    pub runs: Vec<Run>,
}

/// Runs of one attack, offer and variant.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Row {
    /// The attack; none in the control.
    pub attack: Option<Kind>,
    /// What the station offers.
    pub offered: Offered,
    /// What is checked.
    pub variant: Variant,
    /// Runs.
    pub runs: usize,
    /// Those in which a cycle failed after the attack's start.
    pub detected: usize,
    /// Where the first of them failed, with the number of runs, such as `i 3, iv 1`.
    pub by: String,
    /// Of the runs with a detection, the median of the cycles with something remote until it; of an even
    /// number of runs the lower one.
    pub median_cycles: Option<u64>,
    /// As many metres.
    pub median_metres: Option<f64>,
    /// Runs that ended in a collision.
    pub collided: usize,
    /// Runs that did not reach the target in time.
    pub late: usize,
    /// How often a group came back for late data or silence.
    pub lost: u64,
}

/// A run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Run {
    /// By which it can be repeated.
    pub id: String,
    /// The attack; none in the control.
    pub attack: Option<Kind>,
    /// What the station offers.
    pub offered: Offered,
    /// What is checked.
    pub variant: Variant,
    /// Which route.
    pub route: usize,
    /// Which scenario on it.
    pub scenario: u64,
    /// Where the first cycle failed after the attack's start; none if it was missed.
    pub by: Option<By>,
    /// Cycles with something remote from the attack's start until it was detected, or until the end.
    pub cycles: u64,
    /// Way driven in them, m.
    pub metres: f64,
    /// How it ended.
    pub end: End,
    /// When, s.
    pub t_s: f64,
    /// Fallbacks for a safety issue.
    pub fallbacks: u64,
    /// How often a group came back for late data or silence.
    pub lost: u64,
}

/// The attack and what is offered.
type What = (Option<Kind>, Offered);

/// The runs.
pub fn jobs(town: &Town, options: Options) -> Vec<Job<What>> {
    let mut jobs = Vec::new();
    for attack in [None].into_iter().chain(Kind::ALL.map(Some)) {
        for offered in Offered::ALL {
            for variant in Variant::ALL {
                let word = format!("{}/{}", kind_name(attack), offered.name());
                for (route, scenario) in job::starts(town, options) {
                    let place = (variant, route, scenario);
                    let mut job = Job::new(NAME, (&word, (attack, offered)), place, options);
                    job.settings.offers = offered.groups();
                    jobs.push(job.attacked(attack));
                }
            }
        }
    }
    jobs
}

/// Makes the runs. Errors: those of [`job::make`].
pub fn experiment(campaign: &Campaign<'_>) -> Result<Attacks, ExperimentError> {
    let &Campaign { town, options, .. } = campaign;
    let runs = job::make(campaign, jobs(town, options), kept)?;
    let same =
        |a: &Run, b: &Run| (a.attack, a.offered, a.variant) == (b.attack, b.offered, b.variant);
    Ok(Attacks { options, rows: runs.chunk_by(same).map(row).collect(), runs })
}

fn kept(job: &Job<What>, outcome: &Outcome, watch: &Watch) -> Run {
    let (attack, offered) = job.what;
    Run {
        id: job.id.clone(),
        attack,
        offered,
        variant: job.settings.variant,
        route: job.route,
        scenario: job.scenario,
        by: watch.first.map(|first| first.by),
        cycles: watch.cycles,
        metres: watch.metres,
        end: outcome.end,
        t_s: outcome.t,
        fallbacks: watch.fallbacks,
        lost: watch.lost,
    }
}

fn row(runs: &[Run]) -> Row {
    let detected: Vec<&Run> = runs.iter().filter(|run| run.by.is_some()).collect();
    let mut cycles: Vec<u64> = detected.iter().map(|run| run.cycles).collect();
    cycles.sort_unstable();
    let mut metres: Vec<f64> = detected.iter().map(|run| run.metres).collect();
    metres.sort_unstable_by(f64::total_cmp);
    let middle = detected.len().saturating_sub(1) / 2;
    let by = By::ALL.into_iter().filter_map(|by| {
        let count = detected.iter().filter(|run| run.by == Some(by)).count();
        (count > 0).then(|| format!("{} {count}", by.name()))
    });
    Row {
        attack: runs[0].attack,
        offered: runs[0].offered,
        variant: runs[0].variant,
        runs: runs.len(),
        detected: detected.len(),
        by: by.collect::<Vec<_>>().join(", "),
        median_cycles: cycles.get(middle).copied(),
        median_metres: metres.get(middle).copied(),
        collided: runs.iter().filter(|run| run.end == End::Collided).count(),
        late: runs.iter().filter(|run| run.end == End::Late).count(),
        lost: runs.iter().map(|run| run.lost).sum(),
    }
}
