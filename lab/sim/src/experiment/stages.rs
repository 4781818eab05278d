//! How often each stage runs and finds a safety issue: the paper's last table.
//!
//! Scenarios with up to the given number of vehicles, a wait of 2 s after a failure, and the three attacks of
//! the paper at random times. MOT is offered on the first two thirds of the way and PLAN on the last two, so
//! that each configuration has a third; the paper says that its areas differ, not where they are.

use mufasa::services::configuration::Group;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::job::{self, Campaign, ExperimentError, Job, Options};
use super::watch::{By, Watch};
use crate::attack::{Attack, Kind};
use crate::cav::Areas;
use crate::cav::guard::Variant;
use crate::map::Town;
use crate::run::{End, Outcome};

/// Its name.
pub const NAME: &str = "stages";
/// As large as the paper's.
pub const OPTIONS: Options = Options::town(4, 30, 0);
/// Executions and detections of the five stages in the paper.
pub const PAPER: [(u64, u64); 5] = [(1386, 24), (582, 3), (216, 15), (76, 1), (188, 0)];
/// The wait after a failure, ns.
const T_WAIT_NS: i64 = 2_000_000_000;
/// Attacks until then, s: no run is longer.
const UNTIL: f64 = 130.0;
/// How long nobody attacks, and how long an attack lasts, s: at least, and at most.
const PAUSE: (f64, f64) = (2.0, 6.0);
const LASTS: (f64, f64) = (1.0, 4.0);

/// What came of it.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Stages {
    /// How large it was.
    pub options: Options,
    /// The table.
    pub rows: Vec<Row>,
    /// Every run.
    pub runs: Vec<Run>,
}

/// A stage in all runs of a variant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Row {
    /// What is checked.
    pub variant: Variant,
    /// The stage.
    pub stage: By,
    /// How often it ran.
    pub executions: u64,
    /// How often it found a safety issue.
    pub detections: u64,
    /// How often it ran in the paper.
    pub paper_executions: u64,
    /// How often it found a safety issue in the paper.
    pub paper_detections: u64,
}

/// A run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Run {
    /// By which it can be repeated.
    pub id: String,
    /// What is checked.
    pub variant: Variant,
    /// Which route.
    pub route: usize,
    /// Which scenario.
    pub scenario: u64,
    /// Other vehicles.
    pub vehicles: usize,
    /// How it ended.
    pub end: End,
    /// When, s.
    pub t_s: f64,
    /// How often stage i ran.
    pub executions_i: u64,
    /// How often it found a safety issue.
    pub detections_i: u64,
    /// How often stage ii ran.
    pub executions_ii: u64,
    /// How often it found a safety issue.
    pub detections_ii: u64,
    /// How often stage iii ran.
    pub executions_iii: u64,
    /// How often it found a safety issue.
    pub detections_iii: u64,
    /// How often stage iv ran.
    pub executions_iv: u64,
    /// How often it found a safety issue.
    pub detections_iv: u64,
    /// How often stage v ran.
    pub executions_v: u64,
    /// How often it found a safety issue.
    pub detections_v: u64,
    /// Cycles that failed for another reason: no obstacle check, invalid input.
    pub other_failures: u64,
    /// Cycles that failed without an attack.
    pub false_alarms: u64,
    /// Cycles with remote tracks.
    pub remote_mot: u64,
    /// Cycles with a remote trajectory.
    pub remote_plan: u64,
}

/// The runs: the routes by turns, the vehicles from half of the most on.
pub fn jobs(town: &Town, options: Options) -> Vec<Job<()>> {
    let routes: Vec<usize> = town.ego_routes().collect();
    let mut jobs = Vec::new();
    for variant in [Variant::Paper, Variant::Hardened] {
        for (scenario, route) in (0..options.scenarios).zip((0..routes.len()).cycle()) {
            let place = (variant, route, scenario);
            let mut job = Job::new(NAME, ("random", ()), place, options);
            let more = options.scenarios.saturating_sub(1).max(1);
            let share = usize::try_from(more - scenario.min(more)).unwrap_or(0);
            let least = options.vehicles / 2;
            job.vehicles -= least * share / usize::try_from(more).unwrap_or(1);
            job.settings.requester.t_wait_ns = T_WAIT_NS;
            job.settings.areas = areas(town, routes[route]);
            job.settings.attacks = attacks(job.settings.seed);
            jobs.push(job);
        }
    }
    jobs
}

/// Makes the runs. Errors: those of [`job::make`].
pub fn experiment(campaign: &Campaign<'_>) -> Result<Stages, ExperimentError> {
    let &Campaign { town, options, .. } = campaign;
    let made = job::make(campaign, jobs(town, options), kept)?;
    let rows = rows(&made);
    let runs = made.into_iter().map(|(run, _)| run).collect();
    Ok(Stages { options, rows, runs })
}

/// MOT on the first two thirds of the way to the target, PLAN on the last two.
pub(super) fn areas(town: &Town, route: usize) -> Areas {
    let route = &town.routes[route];
    let (start, end) = route.task.map_or((0.0, route.path.length()), |task| {
        (task.start, route.path.project(task.target.pose.at).s)
    });
    let third = (end - start) / 3.0;
    let mut areas: Areas = [(start, end); 2];
    areas[Group::Mot as usize].1 = end - third;
    areas[Group::Plan as usize].0 = start + third;
    areas
}

/// One after the other, each of a random kind.
fn attacks(seed: u64) -> Vec<Attack> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut attacks = Vec::new();
    let mut t = random.random_range(PAUSE.0..PAUSE.1);
    while t < UNTIL {
        let kind = Kind::PAPER[random.random_range(0..Kind::PAPER.len())];
        let until = t + random.random_range(LASTS.0..LASTS.1);
        attacks.push(Attack::new(kind, t, until, seed));
        t = until + random.random_range(PAUSE.0..PAUSE.1);
    }
    attacks
}

/// A run, and the executions and detections of its stages.
type Kept = (Run, [[u64; 2]; 5]);

fn kept(job: &Job<()>, outcome: &Outcome, _: &Watch) -> Kept {
    let [i, ii, iii, iv, v] = outcome.stages;
    let run = Run {
        id: job.id.clone(),
        variant: job.settings.variant,
        route: job.route,
        scenario: job.scenario,
        vehicles: job.vehicles,
        end: outcome.end,
        t_s: outcome.t,
        executions_i: i[0],
        detections_i: i[1],
        executions_ii: ii[0],
        detections_ii: ii[1],
        executions_iii: iii[0],
        detections_iii: iii[1],
        executions_iv: iv[0],
        detections_iv: iv[1],
        executions_v: v[0],
        detections_v: v[1],
        other_failures: outcome.other_failures,
        false_alarms: outcome.false_alarms,
        remote_mot: outcome.offloaded[0],
        remote_plan: outcome.offloaded[1],
    };
    (run, outcome.stages)
}

fn rows(made: &[Kept]) -> Vec<Row> {
    let mut rows = Vec::new();
    for made in made.chunk_by(|(a, _), (b, _)| a.variant == b.variant) {
        let sum = |stage: usize, of: usize| -> u64 {
            made.iter().map(|(_, stages)| stages[stage][of]).sum()
        };
        for (index, paper) in PAPER.into_iter().enumerate() {
            rows.push(Row {
                variant: made[0].0.variant,
                stage: By::ALL[index],
                executions: sum(index, 0),
                detections: sum(index, 1),
                paper_executions: paper.0,
                paper_detections: paper.1,
            });
        }
    }
    rows
}
