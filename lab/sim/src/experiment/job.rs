//! The runs of an experiment, and how they are made beside each other.

use mufasa::services::configuration::Groups;
use rayon::prelude::*;
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::checks::Checks;
pub use super::select::Options;
use super::select::{NotKept, Select};
use super::watch::Watch;
use crate::attack::{Attack, Kind};
use crate::cav::Cav;
use crate::cav::guard::{Decided, Variant};
use crate::cav::recorder::Share;
use crate::map::Town;
use crate::replay::Replay;
use crate::run::{Cycle, Outcome, RunError, Settings, Watcher, simulate};
use crate::scenario::Scenario;
use crate::snapshot::Snapshot;

/// When the attack of a run begins that has one, s.
const FROM: f64 = 5.0;
/// Scenarios of a route of which every run that fails is drawn; of the hardened profile each is.
const DRAWN: u64 = 3;

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

/// A run of an experiment. `W`: what is special about it.
#[derive(Clone, Debug)]
pub struct Job<W> {
    /// What is special about it.
    pub what: W,
    /// By which it can be repeated alone: experiment, variant, what is special, route, scenario.
    pub id: String,
    /// Which of the ego's routes.
    pub route: usize,
    /// Which scenario on it, from 0.
    pub scenario: u64,
    /// Other vehicles.
    pub vehicles: usize,
    /// From when on the watcher looks for the first detection, s.
    pub watched_from: f64,
    /// All else. The seed is that of the scenario, too.
    pub settings: Settings,
}

/// A scenario of an experiment: variant, route, which it is on the route.
pub type Place = (Variant, usize, u64);

impl<W> Job<W> {
    /// A run without attacks, with everything offered and the defaults of [`Settings::new`]. `name`: of the
    /// experiment; `what`: what is special about the run, in the word of its id and as a value.
    pub fn new(
        name: &str,
        (word, what): (&str, W),
        (variant, route, scenario): Place,
        of: Options,
    ) -> Self {
        let settings = Settings::new(variant, Groups::ALL, of.seed.wrapping_add(scenario));
        Self {
            what,
            id: format!("{name}/{}/{word}/{}/{scenario}", variant.name(), of.map.route(route)),
            route,
            scenario,
            vehicles: of.vehicles,
            watched_from: 0.0,
            settings: Settings { prechecks: !of.without_precheck, ..settings },
        }
    }

    /// The same under an attack that begins 5 s after the start and lasts, if it is one; in any case it is
    /// watched from then on.
    pub fn attacked(mut self, kind: Option<Kind>) -> Self {
        let seed = self.settings.seed;
        let attack = |kind| Attack::new(kind, FROM, f64::INFINITY, seed);
        self.settings.attacks.extend(kind.map(attack));
        self.watched_from = FROM;
        self
    }

    /// The same without what is special about it.
    pub fn plain(self) -> Job<()> {
        let Self { what: _, id, route, scenario, vehicles, watched_from, settings } = self;
        Job { what: (), id, route, scenario, vehicles, watched_from, settings }
    }

    /// Makes the run. Errors: settings, a route or a town that cannot be.
    pub fn run(&self, town: &Town, watcher: &mut impl Watcher) -> Result<Outcome, RunError> {
        // A job is made of the town's routes.
        let route = town.ego_routes().nth(self.route).unwrap_or(0);
        let scenario = Scenario::draw(town, route, self.vehicles, self.settings.seed);
        simulate(town, &scenario, &self.settings, watcher)
    }

    fn is_drawn(&self) -> bool {
        self.settings.variant == Variant::Hardened || self.scenario < DRAWN
    }
}

/// A watcher, and those who look at every run.
struct Beside<'w, V> {
    watch: &'w mut V,
    id: &'w str,
    checks: Checks,
    replay: Option<Replay>,
}

impl<V: Watcher> Watcher for Beside<'_, V> {
    fn cycle(&mut self, truth: &Snapshot, cav: &Cav<'_>, decided: &Decided, cycle: &Cycle) {
        self.watch.cycle(truth, cav, decided, cycle);
        self.checks.see(self.id, decided);
        if let Some(replay) = &mut self.replay {
            replay.cycle(truth, cav, decided, cycle);
        }
    }

    fn ended(&mut self, truth: &Snapshot, cav: &Cav<'_>) {
        self.watch.ended(truth, cav);
        if let Some(replay) = &mut self.replay {
            replay.ended(truth, cav);
        }
    }
}

/// The name of an attack, or `none`.
pub fn kind_name(kind: Option<Kind>) -> &'static str {
    kind.map_or("none", Kind::name)
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

/// Makes the runs, or those of them that are selected, on the threads of this pool; what is `kept` of them in
/// their order.
///
/// Errors: settings, a route or a town that cannot be; a run that should be kept is not.
pub fn make<W: Sync + Send, R: Send + Serialize + DeserializeOwned>(
    campaign: &Campaign<'_>,
    jobs: Vec<Job<W>>,
    kept: impl Fn(&Job<W>, &Outcome, &Watch) -> R + Sync,
) -> Result<Vec<R>, ExperimentError> {
    watched(campaign, jobs, |job| Watch::new(job.watched_from), kept)
}

/// As [`make`], with a watcher of one's own for each run.
///
/// Errors: as for [`make`].
pub fn watched<W: Sync + Send, V: Watcher, R: Send + Serialize + DeserializeOwned>(
    campaign: &Campaign<'_>,
    jobs: Vec<Job<W>>,
    watcher: impl Fn(&Job<W>) -> V + Sync,
    kept: impl Fn(&Job<W>, &Outcome, &V) -> R + Sync,
) -> Result<Vec<R>, ExperimentError> {
    let &Campaign { town, select, done, .. } = campaign;
    let chosen = jobs.into_iter().enumerate().filter(|(at, job)| select.has(*at, &job.id));
    let jobs: Vec<Job<W>> = chosen.map(|(_, job)| recorded(job, select)).collect();
    let one = |job: &Job<W>| {
        if let Some(made) = select.made(&job.id)? {
            return Ok(made);
        }
        let mut watch = watcher(job);
        let replay = (select.draws && job.is_drawn()).then(Replay::default);
        let mut beside =
            Beside { watch: &mut watch, id: &job.id, checks: Checks::default(), replay };
        let outcome = job.run(town, &mut beside)?;
        done(jobs.len());
        let Beside { checks, replay, .. } = beside;
        let replay = replay.filter(|_| outcome.end.is_failure());
        let page = replay.map(|it| it.page(town, &job.id, job.route, &outcome));
        select.looked(&job.id, checks, page);
        let run = kept(job, &outcome, &watch);
        select.keep(&job.id, &run)?;
        Ok(run)
    };
    jobs.par_iter().map(one).collect()
}

/// With the share of cycles that is to be checked, other ones in each scenario.
fn recorded<W>(mut job: Job<W>, select: &Select<'_>) -> Job<W> {
    job.settings.recorded = Share { every: select.checked_every, first: job.settings.seed };
    job
}

/// Each of the ego's routes with each scenario on it.
pub fn starts(town: &Town, options: Options) -> Vec<(usize, u64)> {
    let routes = town.ego_routes().count();
    let on = |route| (0..options.scenarios).map(move |scenario| (route, scenario));
    (0..routes).flat_map(on).collect()
}
