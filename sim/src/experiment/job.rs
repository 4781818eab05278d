//! The runs of an experiment, and how they are made beside each other.

use mufasa::services::configuration::Groups;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Serialize;

use super::watch::Watch;
use crate::attack::Kind;
use crate::cav::guard::Variant;
use crate::map::Town;
use crate::run::{Outcome, RunError, Settings, simulate};
use crate::scenario::Scenario;

/// How large an experiment is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Options {
    /// Scenarios of each combination; on each of the two routes, where the experiment uses both.
    pub scenarios: u64,
    /// Other vehicles of a scenario, or the most of them.
    pub vehicles: usize,
    /// The first scenario's seed; the others follow.
    pub seed: u64,
}

/// A run of an experiment.
#[derive(Clone, Debug)]
pub struct Job {
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

impl Job {
    /// A run without attacks, with everything offered and the defaults of [`Settings::new`]. `name`: of the
    /// experiment; `what`: what is special about the run.
    pub fn new(name: &str, what: &str, (variant, route, scenario): Place, of: Options) -> Self {
        Self {
            id: format!("{name}/{}/{what}/{route}/{scenario}", variant.name()),
            route,
            scenario,
            vehicles: of.vehicles,
            watched_from: 0.0,
            settings: Settings::new(variant, Groups::ALL, of.seed.wrapping_add(scenario)),
        }
    }

    /// The kind of its attack, if it has one.
    pub fn kind(&self) -> Option<Kind> {
        self.settings.attacks.first().map(|attack| attack.kind)
    }
}

/// The name of an attack, or `none`.
pub fn kind_name(kind: Option<Kind>) -> &'static str {
    kind.map_or("none", Kind::name)
}

/// Whether a run has this id, or an id that begins with these parts; every run, where nothing is named.
pub fn is_chosen(job: &Job, only: Option<&str>) -> bool {
    let rest = only.map_or(Some(""), |only| job.id.strip_prefix(only));
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
}

/// Makes the runs on the threads of this pool; what came of them in their order. `done`: called after each, in
/// any order, with their number.
///
/// Errors: settings, a route or a town that cannot be.
pub fn make(
    town: &Town,
    jobs: &[Job],
    done: impl Fn(usize) + Sync,
) -> Result<Vec<(Outcome, Watch)>, RunError> {
    let routes: Vec<usize> = town.ego_routes().collect();
    let one = |job: &Job| {
        let seed = job.settings.seed;
        let scenario = Scenario::draw(town, routes[job.route], job.vehicles, seed);
        let mut watch = Watch::new(job.watched_from);
        let outcome = simulate(town, &scenario, &job.settings, &mut watch)?;
        done(jobs.len());
        Ok((outcome, watch))
    };
    jobs.par_iter().map(one).collect()
}

/// Each of the ego's routes with each scenario on it.
pub fn starts(town: &Town, options: Options) -> Vec<(usize, u64)> {
    let routes = town.ego_routes().count();
    let on = |route| (0..options.scenarios).map(move |scenario| (route, scenario));
    (0..routes).flat_map(on).collect()
}
