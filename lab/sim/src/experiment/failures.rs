//! Failures under the attacks of the paper, without and with the stages: the paper's figure.
//!
//! Every attack of the paper, and none as the control, on both routes, in the same scenarios for each variant.
//! It begins 5 s after the start and lasts. A failure is a collision, or a target that is not reached in time.
//!
//! Of the readings of the attack with empty lists (`readings`) it is the one that the text allows and that gives the
//! paper's figure: between the true lists, on the interface within the station alone.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::job::{self, Campaign, ExperimentError, Job, Options, kind_name};
use super::watch::Watch;
use crate::attack::means::{Comes, Lists};
use crate::attack::{Attack, Kind};
use crate::cav::guard::Variant;
use crate::map::Town;
use crate::run::{End, Outcome};

/// Its name.
pub const NAME: &str = "failures";
/// As large as the paper's, on each route.
pub const OPTIONS: Options = Options::town(10, 15, 0);

/// What came of it.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Failures {
    /// How large it was.
    pub options: Options,
    /// The table.
    pub rows: Vec<Row>,
    /// Every run.
    pub runs: Vec<Run>,
}

/// Runs of one attack and variant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Row {
    /// The attack; none in the control.
    pub attack: Option<Kind>,
    /// What is checked.
    pub variant: Variant,
    /// Runs.
    pub runs: usize,
    /// Those that failed.
    pub failures: usize,
    /// Those that ended in a collision.
    pub collided: usize,
    /// Those that did not reach the target in time.
    pub late: usize,
    /// Runs in which some part of the CAV was outside of its corridor while it drove.
    pub off_road: usize,
}

/// A run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Run {
    /// By which it can be repeated.
    pub id: String,
    /// The attack; none in the control.
    pub attack: Option<Kind>,
    /// What is checked.
    pub variant: Variant,
    /// Which route.
    pub route: usize,
    /// Which scenario on it.
    pub scenario: u64,
    /// How it ended.
    pub end: End,
    /// When, s.
    pub t_s: f64,
    /// Least distance to another, m; none in an empty town.
    pub least_distance_m: Option<f64>,
    /// Cycles in all.
    pub cycles: u64,
    /// Those with remote tracks.
    pub remote_mot: u64,
    /// Those with a remote trajectory.
    pub remote_plan: u64,
    /// Fallbacks for a safety issue.
    pub fallbacks: u64,
    /// Cycles that failed without an attack.
    pub false_alarms: u64,
    /// Cycles with some part of the CAV outside of its corridor.
    pub off_road: u64,
}

/// The runs.
pub fn jobs(town: &Town, options: Options) -> Vec<Job<Option<Kind>>> {
    let attacks = [None].into_iter().chain(Kind::PAPER.map(Some));
    let mut jobs = Vec::new();
    for attack in attacks {
        for variant in Variant::ALL {
            for (route, scenario) in job::starts(town, options) {
                let place = (variant, route, scenario);
                let job = Job::new(NAME, (kind_name(attack), attack), place, options);
                let mut job = job.attacked(attack);
                job.settings.attacks.iter_mut().for_each(as_in_the_paper);
                jobs.push(job);
            }
        }
    }
    jobs
}

fn as_in_the_paper(attack: &mut Attack) {
    if attack.kind == Kind::TracksEmpty {
        (attack.means.lists, attack.means.comes) = (Lists::Planner, Comes::Interleaved);
    }
}

/// Makes the runs. Errors: those of [`job::make`].
pub fn experiment(campaign: &Campaign<'_>) -> Result<Failures, ExperimentError> {
    let &Campaign { town, options, .. } = campaign;
    let runs = job::make(campaign, jobs(town, options), kept)?;
    Ok(Failures { options, rows: rows(&runs), runs })
}

fn kept(job: &Job<Option<Kind>>, outcome: &Outcome, watch: &Watch) -> Run {
    Run {
        id: job.id.clone(),
        attack: job.what,
        variant: job.settings.variant,
        route: job.route,
        scenario: job.scenario,
        end: outcome.end,
        t_s: outcome.t,
        least_distance_m: Some(outcome.least_distance).filter(|it| it.is_finite()),
        cycles: outcome.cycles,
        remote_mot: outcome.offloaded[0],
        remote_plan: outcome.offloaded[1],
        fallbacks: watch.fallbacks,
        false_alarms: outcome.false_alarms,
        off_road: outcome.off_road,
    }
}

fn rows(runs: &[Run]) -> Vec<Row> {
    let same = |a: &Run, b: &Run| (a.attack, a.variant) == (b.attack, b.variant);
    let row = |runs: &[Run]| {
        let count = |is_it: &dyn Fn(&Run) -> bool| runs.iter().filter(|run| is_it(run)).count();
        Row {
            attack: runs[0].attack,
            variant: runs[0].variant,
            runs: runs.len(),
            failures: count(&|run| run.end.is_failure()),
            collided: count(&|run| run.end == End::Collided),
            late: count(&|run| run.end == End::Late),
            off_road: count(&|run| run.off_road > 0),
        }
    };
    runs.chunk_by(same).map(row).collect()
}
