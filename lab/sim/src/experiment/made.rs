//! An experiment: how its runs are made, and its table.

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Serialize;
use thiserror::Error;

use super::axes::FROM;
use super::checks::Checks;
use super::job::Job;
use super::kept::{Run, is_same_case};
use super::row::Row;
use super::select::{NotKept, Options, Select};
use super::watch::Watch;
use crate::cav::Cav;
use crate::cav::guard::Decided;
use crate::map::Town;
use crate::replay::Replay;
use crate::run::{Cycle, RunError, Watcher};
use crate::settings::Share;
use crate::snapshot::Snapshot;

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

/// Why an experiment could not be made.
#[derive(Debug, Error)]
#[error(transparent)]
pub enum ExperimentError {
    /// Settings, a route or a town that cannot be.
    Run(#[from] RunError),
    /// A run that was made before is not there.
    NotKept(#[from] NotKept),
}

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
