//! What is kept of each run of an experiment, and the rows of its table.

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::axes::{Axes, Detectors, FROM, Factor, LeftOut, Offered};
use super::checks::Checks;
use super::job::Job;
use super::select::{NotKept, Options, Select};
use super::watch::{By, Watch};
use crate::attack::Kind;
use crate::attack::means::{Comes, Lists};
use crate::cav::Cav;
use crate::cav::guard::{Decided, Variant};
use crate::cav::recorder::Share;
use crate::map::Town;
use crate::replay::Replay;
use crate::run::{Cycle, End, Outcome, PERIOD_NS, RunError, Watcher};
use crate::services::way::seconds;
use crate::snapshot::Snapshot;

/// A collision this soon after something was remote is one of offloading, s: the CAV stops within it from any speed
/// that it has here.
const AFTER: f64 = 3.0;

/// An experiment.
#[derive(Clone, Copy, Debug)]
pub struct Experiment {
    /// Its name.
    pub name: &'static str,
    /// How large it is, if nothing else is said.
    pub options: Options,
    /// Its runs; those of a row are neighbours. It is told its name.
    pub(super) jobs: fn(&str, &Town, Options) -> Vec<Job>,
    /// Whether two runs are of one row.
    pub(super) same: fn(&Run, &Run) -> bool,
    /// Where each stage has a row: what the paper has of them, executions and detections.
    pub(super) by_stage: Option<[(u64, u64); 5]>,
}

/// What came of an experiment.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Made {
    /// How large it was.
    pub options: Options,
    /// The table.
    pub rows: Vec<Row>,
    /// Every run.
    pub runs: Vec<Run>,
}

/// A run. What is special about it is empty where the experiment does not have it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Run {
    /// By which it can be repeated.
    pub id: String,
    /// The attack that goes on from 5 s on; none in the control.
    pub attack: Option<Kind>,
    /// Whose lists it spoils.
    pub lists: Option<Lists>,
    /// How its lists come.
    pub comes: Option<Comes>,
    /// Whether an empty list is a list to the stages (I-11).
    pub empty_is_a_list: Option<bool>,
    /// What the station offers.
    pub offered: Offered,
    /// What is set.
    pub factor: Option<Factor>,
    /// To what.
    pub value: Option<f64>,
    /// How wrong detectors are.
    pub detectors: Option<Detectors>,
    /// What is left out.
    pub left_out: Option<LeftOut>,
    /// What is checked.
    pub variant: Variant,
    /// Which route.
    pub route: usize,
    /// Which scenario on it.
    pub scenario: u64,
    /// Other vehicles.
    pub vehicles: usize,
    /// How it ended.
    pub end: End,
    /// When, s.
    pub t_s: f64,
    /// Least distance to another, m; none in an empty town.
    pub least_distance_m: Option<f64>,
    /// Whether something was remote in the last 3 s.
    pub is_remote_at_end: bool,
    /// Where the first cycle failed from 5 s on; none: nowhere.
    pub by: Option<By>,
    /// Cycles with something remote from 5 s on until then, or until the end.
    pub cycles_until: u64,
    /// Way driven in them, m.
    pub metres_until: f64,
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
    /// Those with both.
    pub remote_both: u64,
    /// Fallbacks for a safety issue.
    pub fallbacks: u64,
    /// How often a group came back for late data or silence.
    pub lost: u64,
    /// Cycles that failed without an attack.
    pub false_alarms: u64,
    /// Cycles that failed for another reason than a stage: no obstacle check, invalid input.
    pub other_failures: u64,
    /// Cycles with some part of the CAV outside of its corridor.
    pub off_road: u64,
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
}

/// Runs that differ in nothing but route and scenario; of `left-out` in the attack and the offer, too, and of `stages`
/// as often as there are stages. What is special about them is empty where they do not have it in common.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Row {
    /// The attack; none in the control.
    pub attack: Option<Kind>,
    /// Whose lists it spoils.
    pub lists: Option<Lists>,
    /// How its lists come.
    pub comes: Option<Comes>,
    /// Whether an empty list is a list to the stages (I-11).
    pub empty_is_a_list: Option<bool>,
    /// What the station offers.
    pub offered: Option<Offered>,
    /// What is set.
    pub factor: Option<Factor>,
    /// To what.
    pub value: Option<f64>,
    /// How wrong detectors are.
    pub detectors: Option<Detectors>,
    /// What is left out.
    pub left_out: Option<LeftOut>,
    /// What is checked.
    pub variant: Variant,
    /// Runs; where some are without an attack and others under one, those without. What follows is of these alone, if
    /// it does not say otherwise.
    pub runs: usize,
    /// Those that failed.
    pub failures: usize,
    /// Those that ended in a collision.
    pub collided: usize,
    /// Those of them in which something was remote in the last 3 s.
    pub collided_remote: usize,
    /// Those that did not reach the target in time.
    pub late: usize,
    /// Runs in which some part of the CAV was outside of its corridor while it drove.
    pub off_road: usize,
    /// Runs in which a cycle failed from 5 s on.
    pub detected: usize,
    /// Where the first of them failed, with the number of runs, such as `i 3, iv 1`.
    pub by: String,
    /// Of the runs with a detection, the median of the cycles with something remote until it; of an even
    /// number of runs the lower one.
    pub median_cycles: Option<u64>,
    /// As many metres.
    pub median_metres: Option<f64>,
    /// Attacks that had begun when the run ended.
    pub attacks: usize,
    /// Time driven in all of them, h.
    pub hours: f64,
    /// Fallbacks for a safety issue.
    pub fallbacks: u64,
    /// As many in an hour of driving.
    pub fallbacks_per_hour: f64,
    /// How often a group came back for late data or silence.
    pub lost: u64,
    /// Cycles that failed without an attack.
    pub false_alarms: u64,
    /// Share of the cycles in which two attacks or more went on.
    pub share_several: f64,
    /// Share of the cycles with remote tracks.
    pub share_mot: f64,
    /// Share of the cycles with a remote trajectory.
    pub share_plan: f64,
    /// Share of the cycles with both.
    pub share_both: f64,
    /// Runs under an attack, where others are without one.
    pub attacked_runs: usize,
    /// Those of them that ended in a collision.
    pub attacked_collided: usize,
    /// Those of these in which something was remote in the last 3 s.
    pub attacked_collided_remote: usize,
    /// The stage; none: v.
    pub stage: Option<By>,
    /// How often it ran, in all runs.
    pub executions: u64,
    /// How often it found a safety issue.
    pub detections: u64,
    /// How often it ran in the paper.
    pub paper_executions: Option<u64>,
    /// How often it found a safety issue in the paper.
    pub paper_detections: Option<u64>,
}

/// Why an experiment could not be made.
#[derive(Debug)]
pub enum ExperimentError {
    /// Settings, a route or a town that cannot be.
    Run(RunError),
    /// A run that was made before is not there.
    NotKept(NotKept),
}

impl From<RunError> for ExperimentError {
    fn from(error: RunError) -> Self {
        Self::Run(error)
    }
}

impl From<NotKept> for ExperimentError {
    fn from(error: NotKept) -> Self {
        Self::NotKept(error)
    }
}

impl std::fmt::Display for ExperimentError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Run(error) => error.fmt(f),
            Self::NotKept(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for ExperimentError {}

/// An experiment that is to be made.
pub struct Campaign<'a> {
    /// On which map.
    pub town: &'a Town,
    /// How large.
    pub options: Options,
    /// Which of its runs.
    pub select: &'a Select<'a>,
    /// Called after each run, in any order, with their number.
    pub done: &'a (dyn Fn(usize) + Sync),
}

impl Experiment {
    pub(super) const fn new(
        name: &'static str,
        options: Options,
        jobs: fn(&str, &Town, Options) -> Vec<Job>,
    ) -> Self {
        Self { name, options, jobs, same: is_same_case, by_stage: None }
    }

    /// Its runs.
    pub fn jobs(&self, town: &Town, options: Options) -> Vec<Job> {
        (self.jobs)(self.name, town, options)
    }

    /// Makes its runs, or those of them that are selected, on the threads of this pool.
    ///
    /// Errors: settings, a route or a town that cannot be; a run that should be kept is not.
    pub fn make(&self, campaign: &Campaign<'_>) -> Result<Made, ExperimentError> {
        let &Campaign { town, options, select, done } = campaign;
        let jobs = self.jobs(town, options).into_iter().enumerate();
        let chosen = jobs.filter(|(at, job)| select.has(*at, &job.id));
        let jobs: Vec<Job> = chosen.map(|(_, job)| recorded(job, select)).collect();
        let one = |job: &Job| {
            if let Some(made) = select.made(&job.id)? {
                return Ok(made);
            }
            let run = run(job, town, select)?;
            done(jobs.len());
            select.keep(&job.id, &run)?;
            Ok(run)
        };
        let runs = jobs.par_iter().map(one).collect::<Result<Vec<Run>, ExperimentError>>()?;
        let rows = runs.chunk_by(self.same);
        let rows = match self.by_stage {
            None => rows.map(Row::of).collect(),
            Some(paper) => rows.flat_map(|runs| Row::of(runs).by_stage(runs, paper)).collect(),
        };
        Ok(Made { options, rows, runs })
    }
}

fn run(job: &Job, town: &Town, select: &Select<'_>) -> Result<Run, RunError> {
    let replay = (select.draws && job.is_drawn()).then(Replay::default);
    let watch = Watch::new(FROM, &job.settings.attacks);
    let mut beside = Beside { watch, id: &job.id, checks: Checks::default(), replay };
    let outcome = job.run(town, &mut beside)?;
    let Beside { watch, checks, replay, .. } = beside;
    let replay = replay.filter(|_| outcome.end.is_failure());
    let page = replay.map(|it| it.page(town, &job.id, job.route, &outcome));
    select.looked(&job.id, checks, page);
    Ok(Run::of(job, &outcome, &watch))
}

/// With the share of cycles that is to be checked, other ones in each scenario.
fn recorded(mut job: Job, select: &Select<'_>) -> Job {
    job.settings.recorded = Share { every: select.checked_every, first: job.settings.seed };
    job
}

/// Those who look at every run.
struct Beside<'j> {
    watch: Watch,
    id: &'j str,
    checks: Checks,
    replay: Option<Replay>,
}

impl Watcher for Beside<'_> {
    fn cycle(&mut self, truth: &Snapshot, cav: &Cav<'_>, decided: &Decided, cycle: &Cycle) {
        self.watch.see(cycle);
        self.checks.see(self.id, decided);
        if let Some(replay) = &mut self.replay {
            replay.cycle(truth, cav, decided, cycle);
        }
    }

    fn ended(&mut self, truth: &Snapshot, cav: &Cav<'_>) {
        if let Some(replay) = &mut self.replay {
            replay.ended(truth, cav);
        }
    }
}

impl Run {
    fn of(job: &Job, outcome: &Outcome, watch: &Watch) -> Self {
        let Axes { attack, lists, comes, empty_is_a_list, offered, set, detectors, left_out } =
            job.axes;
        let [i, ii, iii, iv, v] = outcome.stages;
        Self {
            id: job.id.clone(),
            attack,
            lists,
            comes,
            empty_is_a_list,
            offered,
            factor: set.map(|(factor, _)| factor),
            value: set.map(|(_, value)| value),
            detectors,
            left_out,
            variant: job.settings.variant,
            route: job.route,
            scenario: job.scenario,
            vehicles: job.vehicles,
            end: outcome.end,
            t_s: outcome.t,
            least_distance_m: Some(outcome.least_distance).filter(|it| it.is_finite()),
            is_remote_at_end: watch.remote_at.is_some_and(|t| outcome.t - t < AFTER),
            by: watch.first.map(|first| first.by),
            cycles_until: watch.cycles,
            metres_until: watch.metres,
            attacks: job.settings.attacks.iter().filter(|it| it.from <= outcome.t).count(),
            most_at_once: watch.most_at_once,
            cycles: outcome.cycles,
            several: watch.several,
            remote_mot: outcome.offloaded[0],
            remote_plan: outcome.offloaded[1],
            remote_both: watch.both,
            fallbacks: watch.fallbacks,
            lost: watch.lost,
            false_alarms: outcome.false_alarms,
            other_failures: outcome.other_failures,
            off_road: outcome.off_road,
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
        }
    }

    /// How often each stage ran, and found a safety issue.
    const fn stages(&self) -> [[u64; 2]; 5] {
        [
            [self.executions_i, self.detections_i],
            [self.executions_ii, self.detections_ii],
            [self.executions_iii, self.detections_iii],
            [self.executions_iv, self.detections_iv],
            [self.executions_v, self.detections_v],
        ]
    }
}

/// Whether nothing but route and scenario differs.
fn is_same_case(a: &Run, b: &Run) -> bool {
    let whom = |it: &Run| (it.attack, it.lists, it.comes, it.empty_is_a_list, it.offered);
    let how = |it: &Run| (it.factor, it.value, it.detectors, it.left_out, it.variant);
    whom(a) == whom(b) && how(a) == how(b)
}

/// What all runs have alike.
fn common<T: PartialEq>(runs: &[Run], of: impl Fn(&Run) -> T) -> Option<T> {
    let first = of(&runs[0]);
    runs.iter().all(|run| of(run) == first).then_some(first)
}

impl Row {
    #[expect(clippy::cast_precision_loss, reason = "counts far below 2^53")]
    fn of(all: &[Run]) -> Self {
        let (plain, attacked): (Vec<&Run>, Vec<&Run>) =
            all.iter().partition(|run| run.attack.is_none());
        let (runs, attacked) =
            if plain.is_empty() { (attacked, Vec::new()) } else { (plain, attacked) };
        let count = |is_it: fn(&Run) -> bool| runs.iter().filter(|run| is_it(run)).count();
        let sum = |of: fn(&Run) -> u64| runs.iter().map(|run| of(run)).sum::<u64>();
        let is_collided: fn(&Run) -> bool = |run| run.end == End::Collided;
        let is_remote: fn(&Run) -> bool = |run| run.end == End::Collided && run.is_remote_at_end;
        let cycles = sum(|run| run.cycles) as f64;
        let hours = cycles * seconds(PERIOD_NS) / 3600.0;
        let detected: Vec<&Run> = runs.iter().copied().filter(|run| run.by.is_some()).collect();
        let mut until: Vec<u64> = detected.iter().map(|run| run.cycles_until).collect();
        until.sort_unstable();
        let mut metres: Vec<f64> = detected.iter().map(|run| run.metres_until).collect();
        metres.sort_unstable_by(f64::total_cmp);
        let middle = detected.len().saturating_sub(1) / 2;
        let by = By::ALL.into_iter().filter_map(|by| {
            let count = detected.iter().filter(|run| run.by == Some(by)).count();
            (count > 0).then(|| format!("{} {count}", by.name()))
        });
        let first = &all[0];
        Self {
            attack: common(all, |it| it.attack).flatten(),
            lists: first.lists,
            comes: first.comes,
            empty_is_a_list: first.empty_is_a_list,
            offered: common(all, |it| it.offered),
            factor: first.factor,
            value: first.value,
            detectors: first.detectors,
            left_out: first.left_out,
            variant: first.variant,
            runs: runs.len(),
            failures: count(|run| run.end.is_failure()),
            collided: count(is_collided),
            collided_remote: count(is_remote),
            late: count(|run| run.end == End::Late),
            off_road: count(|run| run.off_road > 0),
            detected: detected.len(),
            by: by.collect::<Vec<_>>().join(", "),
            median_cycles: until.get(middle).copied(),
            median_metres: metres.get(middle).copied(),
            attacks: runs.iter().map(|run| run.attacks).sum(),
            hours,
            fallbacks: sum(|run| run.fallbacks),
            fallbacks_per_hour: sum(|run| run.fallbacks) as f64 / hours,
            lost: sum(|run| run.lost),
            false_alarms: sum(|run| run.false_alarms),
            share_several: sum(|run| run.several) as f64 / cycles,
            share_mot: sum(|run| run.remote_mot) as f64 / cycles,
            share_plan: sum(|run| run.remote_plan) as f64 / cycles,
            share_both: sum(|run| run.remote_both) as f64 / cycles,
            attacked_runs: attacked.len(),
            attacked_collided: attacked.iter().filter(|run| is_collided(run)).count(),
            attacked_collided_remote: attacked.iter().filter(|run| is_remote(run)).count(),
            stage: None,
            executions: all.iter().map(|run| run.executions_v).sum(),
            detections: all.iter().map(|run| run.detections_v).sum(),
            paper_executions: None,
            paper_detections: None,
        }
    }

    /// Once for each stage.
    fn by_stage(self, runs: &[Run], paper: [(u64, u64); 5]) -> Vec<Self> {
        let sum = |stage: usize, of: usize| runs.iter().map(|run| run.stages()[stage][of]).sum();
        let one = |(stage, (executions, detections)): (usize, (u64, u64))| Self {
            stage: Some(By::ALL[stage]),
            executions: sum(stage, 0),
            detections: sum(stage, 1),
            paper_executions: Some(executions),
            paper_detections: Some(detections),
            ..self.clone()
        };
        paper.into_iter().enumerate().map(one).collect()
    }
}
