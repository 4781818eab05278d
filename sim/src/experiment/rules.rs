//! The price of each rule: false alarms, and time that is not offloaded, with all rules and without each alone.
//!
//! No attack, the same scenarios for each: the paper's profile, the hardened one, and the hardened one without one
//! rule (`cav::without`). The areas are those of `stages`, so that each configuration has a third of the way, and
//! the wait after a failure is 1 s, so that one alarm hides few others. Every fallback is a false alarm; its cause is the
//! first stage that fails, and the rule of its witness.

use std::collections::BTreeMap;

use mufasa_model::report::Outcome as StageOutcome;
use mufasa_props::bridge::report_from_impl;
use mufasa_records::names;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::job::{self, Campaign, ExperimentError, Job, Options};
use super::stages::areas;
use super::watch::{By, Watch};
use crate::cav::Cav;
use crate::cav::guard::{Decided, Variant};
use crate::cav::without::Without;
use crate::map::Town;
use crate::run::{Cycle, End, Outcome, PERIOD_NS, Watcher};
use crate::services::way::seconds;
use crate::snapshot::Snapshot;

/// Its name.
pub const NAME: &str = "rules";
/// Scenarios of each of 15 sets of rules.
pub const OPTIONS: Options = Options::town(10, 15, 0);

/// The wait after a failure, ns.
const T_WAIT_NS: i64 = 1_000_000_000;

/// What came of it.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Rules {
    /// How large it was.
    pub options: Options,
    /// The table.
    pub rows: Vec<Row>,
    /// What raised the false alarms of each row.
    pub causes: Vec<Cause>,
    /// Every run.
    pub runs: Vec<Run>,
}

/// Runs with one set of rules.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Row {
    /// What is checked.
    pub variant: Variant,
    /// The rule that is left out.
    pub without: Option<Without>,
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
    /// Cycles in which all rules decide otherwise than those in force.
    pub overruled: u64,
    /// How often a group came back for late data or silence.
    pub lost: u64,
    /// Share of the cycles with remote tracks.
    pub share_mot: f64,
    /// Share of the cycles with a remote trajectory.
    pub share_plan: f64,
    /// Share of the cycles with both.
    pub share_both: f64,
    /// Where the fallbacks come from: stage and rule of the witness, with their number, the most first.
    pub by: String,
}

/// Fallbacks of one cause, in the runs of a row.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Cause {
    /// What is checked.
    pub variant: Variant,
    /// The rule that is left out.
    pub without: Option<Without>,
    /// The stage that failed.
    pub stage: By,
    /// The rule of its witness, in the words of the answers; none where no stage failed.
    pub rule: Option<String>,
    /// The hardened rule that alone has such witnesses; none, where the paper's stages have them, too.
    pub only_by: Option<Without>,
    /// Fallbacks.
    pub fallbacks: u64,
}

/// A run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Run {
    /// By which it can be repeated.
    pub id: String,
    /// What is checked.
    pub variant: Variant,
    /// The rule that is left out.
    pub without: Option<Without>,
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
    /// Cycles in which all rules decide otherwise than those in force.
    pub overruled: u64,
    /// How often a group came back for late data or silence.
    pub lost: u64,
}

/// Of a fallback: where the cycle failed, the word of its rule, and whose it is.
type Why = (By, Option<&'static str>, Option<Without>);

/// Counts fallbacks by their causes.
#[derive(Clone, Debug, Default)]
struct Alarms {
    watch: Watch,
    causes: BTreeMap<Why, u64>,
    overruled: u64,
}

impl Watcher for Alarms {
    fn cycle(&mut self, truth: &Snapshot, cav: &Cav<'_>, decided: &Decided, cycle: &Cycle) {
        self.watch.cycle(truth, cav, decided, cycle);
        self.overruled += u64::from(decided.is_overruled && cycle.remote != 0);
        let Some(by) = By::of(cycle.failed).filter(|_| cycle.remote != 0) else { return };
        let report = decided.report.as_ref().and_then(|it| it.as_ref().ok()).map(report_from_impl);
        let outcomes = report.into_iter().flat_map(|it| it.stages);
        let rule = outcomes.filter_map(|it| match it {
            StageOutcome::Failed(witness) => Some(witness.rule),
            _ => None,
        });
        let rule = rule.into_iter().next();
        let why = (by, rule.map(names::rule), rule.and_then(Without::of));
        *self.causes.entry(why).or_default() += 1;
    }
}

/// The rules of a run: variant and what is left out.
fn sets() -> impl Iterator<Item = (Variant, Option<Without>)> {
    let whole = [Variant::Paper, Variant::Hardened].map(|variant| (variant, None));
    whole.into_iter().chain(Without::ALL.map(|rule| (Variant::Hardened, Some(rule))))
}

type Set = (Variant, Option<Without>);

/// The runs.
pub fn jobs(town: &Town, options: Options) -> Vec<Job<Set>> {
    let routes: Vec<usize> = town.ego_routes().collect();
    let mut jobs = Vec::new();
    for (variant, without) in sets() {
        let word = without.map_or_else(|| "all".to_owned(), |it| format!("without-{}", it.name()));
        for (route, scenario) in job::starts(town, options) {
            let place = (variant, route, scenario);
            let mut job = Job::new(NAME, (&word, (variant, without)), place, options);
            job.settings.without = without;
            job.settings.requester.t_wait_ns = T_WAIT_NS;
            job.settings.areas = areas(town, routes[route]);
            jobs.push(job);
        }
    }
    jobs
}

/// Makes the runs. Errors: those of [`job::make`].
pub fn experiment(campaign: &Campaign<'_>) -> Result<Rules, ExperimentError> {
    let &Campaign { town, options, .. } = campaign;
    let made = job::watched(campaign, jobs(town, options), |_| Alarms::default(), kept)?;
    let same = |(a, _): &Kept, (b, _): &Kept| (a.variant, a.without) == (b.variant, b.without);
    let (mut rows, mut causes) = (Vec::new(), Vec::new());
    for made in made.chunk_by(same) {
        let of_row = summed(made);
        rows.push(row(made, &of_row));
        causes.extend(of_row);
    }
    Ok(Rules { options, rows, causes, runs: made.into_iter().map(|(run, _)| run).collect() })
}

/// A run, and the causes of its fallbacks.
type Kept = (Run, Vec<Cause>);

fn kept(job: &Job<Set>, outcome: &Outcome, alarms: &Alarms) -> Kept {
    let (variant, without) = job.what;
    let run = Run {
        id: job.id.clone(),
        variant,
        without,
        route: job.route,
        scenario: job.scenario,
        end: outcome.end,
        cycles: outcome.cycles,
        remote_mot: outcome.offloaded[0],
        remote_plan: outcome.offloaded[1],
        remote_both: alarms.watch.both,
        fallbacks: alarms.watch.fallbacks,
        overruled: alarms.overruled,
        lost: alarms.watch.lost,
    };
    let causes = alarms.causes.iter().map(|(&(stage, rule, only_by), &fallbacks)| {
        let rule = rule.map(str::to_owned);
        Cause { variant, without, stage, rule, only_by, fallbacks }
    });
    (run, causes.collect())
}

/// The causes of all runs, the most fallbacks first.
fn summed(made: &[Kept]) -> Vec<Cause> {
    let mut sums: Vec<Cause> = Vec::new();
    for cause in made.iter().flat_map(|(_, causes)| causes) {
        let same = |it: &&mut Cause| (it.stage, &it.rule) == (cause.stage, &cause.rule);
        match sums.iter_mut().find(same) {
            Some(sum) => sum.fallbacks += cause.fallbacks,
            None => sums.push(cause.clone()),
        }
    }
    sums.sort_by_key(|it| (u64::MAX - it.fallbacks, it.stage, it.rule.clone()));
    sums
}

#[expect(clippy::cast_precision_loss, reason = "counts far below 2^53")]
fn row(made: &[Kept], causes: &[Cause]) -> Row {
    let first = &made[0].0;
    let sum = |of: fn(&Run) -> u64| made.iter().map(|(run, _)| of(run)).sum::<u64>();
    let cycles = sum(|run| run.cycles) as f64;
    let hours = cycles * seconds(PERIOD_NS) / 3600.0;
    let fallbacks = sum(|run| run.fallbacks);
    let by = causes.iter().map(|cause| match &cause.rule {
        Some(rule) => format!("{} {rule} {}", cause.stage.name(), cause.fallbacks),
        None => format!("{} {}", cause.stage.name(), cause.fallbacks),
    });
    Row {
        variant: first.variant,
        without: first.without,
        runs: made.len(),
        failures: made.iter().filter(|(run, _)| run.end.is_failure()).count(),
        hours,
        fallbacks,
        fallbacks_per_hour: fallbacks as f64 / hours,
        overruled: sum(|run| run.overruled),
        lost: sum(|run| run.lost),
        share_mot: sum(|run| run.remote_mot) as f64 / cycles,
        share_plan: sum(|run| run.remote_plan) as f64 / cycles,
        share_both: sum(|run| run.remote_both) as f64 / cycles,
        by: by.collect::<Vec<_>>().join(", "),
    }
}
