//! Combinations of attacks of all kinds, drawn at random over time: who fails.
//!
//! With MOT, PLAN or both offered, in the same scenarios for each variant. Attacks begin one after the other, each of
//! a random kind and as long as it happens, so that none, one or several go on at a time; half of them are of the size that
//! the other experiments have, half of one at random. Left out are kinds that cost time alone, which a run does not
//! know (`flood`, `slow`), and those that came after runs of this experiment had been named in findings
//! (`stamps-ahead`, `silent`, `late`): with them an id would name another run. The wait after a failure is 2 s, as in the paper's random experiment.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::attacks::Offered;
use super::falsify::genome::{KINDS, means};
use super::job::{self, Campaign, ExperimentError, Job, Options};
use super::watch::Watch;
use crate::attack::Attack;
use crate::cav::Cav;
use crate::cav::guard::{Decided, Variant};
use crate::map::Town;
use crate::run::{Cycle, End, Outcome, Watcher};
use crate::snapshot::Snapshot;

/// Its name.
pub const NAME: &str = "combinations";
/// Scenarios on each route.
pub const OPTIONS: Options = Options::town(10, 15, 0);
/// The wait after a failure, ns.
const T_WAIT_NS: i64 = 2_000_000_000;
/// Attacks until then, s: no run is longer.
const UNTIL: f64 = 130.0;
/// Of `KINDS` so many, the first ones, are drawn.
pub const DRAWN: usize = 18;
/// From the start of an attack to that of the next one, and how long one lasts, s: at least, and at most.
const BETWEEN: (f64, f64) = (0.5, 8.0);
const LASTS: (f64, f64) = (0.5, 10.0);

/// What came of it.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Combinations {
    /// How large it was.
    pub options: Options,
    /// The table.
    pub rows: Vec<Row>,
    /// Every run.
    pub runs: Vec<Run>,
}

/// Runs of one offer and variant.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Row {
    /// What the station offers.
    pub offered: Offered,
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
    /// Attacks that had begun when the run ended.
    pub attacks: usize,
    /// Share of the cycles in which two attacks or more went on.
    pub share_several: f64,
    /// Fallbacks for a safety issue.
    pub fallbacks: u64,
    /// Cycles that failed without an attack.
    pub false_alarms: u64,
    /// Share of the cycles with remote tracks.
    pub share_mot: f64,
    /// Share of the cycles with a remote trajectory.
    pub share_plan: f64,
}

/// A run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Run {
    /// By which it can be repeated.
    pub id: String,
    /// What the station offers.
    pub offered: Offered,
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
    /// Attacks that had begun when it ended.
    pub attacks: usize,
    /// The most of them that went on at the same time.
    pub most_at_once: usize,
    /// Cycles in all.
    pub cycles: u64,
    /// Those in which two attacks or more went on.
    pub several: u64,
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

/// Counts how many attacks go on at the same time.
#[derive(Clone, Debug)]
struct Overlaps {
    watch: Watch,
    attacks: Vec<Attack>,
    most_at_once: usize,
    several: u64,
}

impl Overlaps {
    fn of(attacks: &[Attack]) -> Self {
        let attacks = attacks.to_vec();
        Self { watch: Watch::default(), attacks, most_at_once: 0, several: 0 }
    }
}

impl Watcher for Overlaps {
    fn cycle(&mut self, truth: &Snapshot, cav: &Cav<'_>, decided: &Decided, cycle: &Cycle) {
        self.watch.cycle(truth, cav, decided, cycle);
        let going_on = |it: &&Attack| it.from <= cycle.t && cycle.t < it.until;
        let count = self.attacks.iter().filter(going_on).count();
        self.most_at_once = self.most_at_once.max(count);
        self.several += u64::from(count > 1);
    }
}

/// The runs.
pub fn jobs(town: &Town, options: Options) -> Vec<Job<Offered>> {
    let mut jobs = Vec::new();
    for offered in Offered::ALL {
        for variant in Variant::ALL {
            for (route, scenario) in job::starts(town, options) {
                let place = (variant, route, scenario);
                let mut job = Job::new(NAME, (offered.name(), offered), place, options);
                job.settings.offers = offered.groups();
                job.settings.requester.t_wait_ns = T_WAIT_NS;
                job.settings.attacks = attacks(job.settings.seed, route);
                jobs.push(job);
            }
        }
    }
    jobs
}

/// Makes the runs. Errors: those of [`job::make`].
pub fn experiment(campaign: &Campaign<'_>) -> Result<Combinations, ExperimentError> {
    let &Campaign { town, options, .. } = campaign;
    let watcher = |job: &Job<Offered>| Overlaps::of(&job.settings.attacks);
    let runs = job::watched(campaign, jobs(town, options), watcher, kept)?;
    let same = |a: &Run, b: &Run| (a.offered, a.variant) == (b.offered, b.variant);
    Ok(Combinations { options, rows: runs.chunk_by(same).map(row).collect(), runs })
}

/// Attacks of a run, the same for each variant and offer.
pub fn attacks(seed: u64, route: usize) -> Vec<Attack> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(u64::try_from(route).unwrap_or(0) + 1);
    let mut attacks = Vec::new();
    let mut from = random.random_range(BETWEEN.0..BETWEEN.1);
    while from < UNTIL {
        let kind = KINDS[random.random_range(0..DRAWN)];
        let until = from + random.random_range(LASTS.0..LASTS.1);
        let attack = Attack::new(kind, from, until, seed);
        let shares: [f64; 4] = std::array::from_fn(|_| random.random());
        let is_random = random.random_bool(0.5);
        attacks.push(if is_random {
            Attack { means: means(kind, shares), ..attack }
        } else {
            attack
        });
        from += random.random_range(BETWEEN.0..BETWEEN.1);
    }
    attacks
}

fn kept(job: &Job<Offered>, outcome: &Outcome, seen: &Overlaps) -> Run {
    let attacks = &job.settings.attacks;
    Run {
        id: job.id.clone(),
        offered: job.what,
        variant: job.settings.variant,
        route: job.route,
        scenario: job.scenario,
        end: outcome.end,
        t_s: outcome.t,
        least_distance_m: Some(outcome.least_distance).filter(|it| it.is_finite()),
        attacks: attacks.iter().filter(|it| it.from <= outcome.t).count(),
        most_at_once: seen.most_at_once,
        cycles: outcome.cycles,
        several: seen.several,
        remote_mot: outcome.offloaded[0],
        remote_plan: outcome.offloaded[1],
        fallbacks: seen.watch.fallbacks,
        false_alarms: outcome.false_alarms,
        off_road: outcome.off_road,
    }
}

#[expect(clippy::cast_precision_loss, reason = "counts far below 2^53")]
fn row(runs: &[Run]) -> Row {
    let count = |is_it: &dyn Fn(&Run) -> bool| runs.iter().filter(|run| is_it(run)).count();
    let sum = |of: fn(&Run) -> u64| runs.iter().map(of).sum::<u64>();
    let cycles = sum(|run| run.cycles) as f64;
    Row {
        offered: runs[0].offered,
        variant: runs[0].variant,
        runs: runs.len(),
        failures: count(&|run| run.end.is_failure()),
        collided: count(&|run| run.end == End::Collided),
        late: count(&|run| run.end == End::Late),
        off_road: count(&|run| run.off_road > 0),
        attacks: runs.iter().map(|run| run.attacks).sum(),
        share_several: sum(|run| run.several) as f64 / cycles,
        fallbacks: sum(|run| run.fallbacks),
        false_alarms: sum(|run| run.false_alarms),
        share_mot: sum(|run| run.remote_mot) as f64 / cycles,
        share_plan: sum(|run| run.remote_plan) as f64 / cycles,
    }
}
