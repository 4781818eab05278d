//! A run of an experiment, as it is to be made.

use super::axes::Axes;
use super::select::Options;
use crate::attack::Kind;
use crate::cav::guard::Variant;
use crate::map::Town;
use crate::run::{Outcome, RunError, Settings, Watcher, simulate};
use crate::scenario::Scenario;

/// Scenarios of a route of which every run that fails is drawn; of the hardened profile each is.
const DRAWN: u64 = 3;

/// A run of an experiment.
#[derive(Clone, Debug)]
pub struct Job {
    /// What is special about it.
    pub axes: Axes,
    /// By which it can be repeated alone: experiment, variant, what is special, route, scenario.
    pub id: String,
    /// Which of the ego's routes.
    pub route: usize,
    /// Which scenario on it, from 0.
    pub scenario: u64,
    /// Other vehicles.
    pub vehicles: usize,
    /// All else. The seed is that of the scenario, too.
    pub settings: Settings,
}

/// A scenario of an experiment: variant, route, which it is on the route.
pub type Place = (Variant, usize, u64);

impl Job {
    /// A run as its axes say, else with the defaults of [`Settings::new`]. `name`: of the experiment; `case`: what is
    /// special about the run, in the word of its id and as values.
    pub fn new(
        name: &str,
        (word, axes): (&str, Axes),
        (variant, route, scenario): Place,
        of: Options,
    ) -> Self {
        let seed = of.seed.wrapping_add(scenario);
        let mut settings = Settings::new(variant, axes.offered.groups(), seed);
        settings.prechecks = !of.without_precheck;
        axes.apply(&mut settings);
        Self {
            axes,
            id: format!("{name}/{}/{word}/{}/{scenario}", variant.name(), of.map.route(route)),
            route,
            scenario,
            vehicles: of.vehicles,
            settings,
        }
    }

    /// Makes the run. Errors: settings, a route or a town that cannot be.
    pub fn run(&self, town: &Town, watcher: &mut impl Watcher) -> Result<Outcome, RunError> {
        // A job is made of the town's routes.
        let route = town.ego_routes().nth(self.route).unwrap_or(0);
        let scenario = Scenario::draw(town, route, self.vehicles, self.settings.seed);
        simulate(town, &scenario, &self.settings, watcher)
    }

    pub(super) fn is_drawn(&self) -> bool {
        self.settings.variant == Variant::Hardened || self.scenario < DRAWN
    }
}

/// The name of an attack, or `none`.
pub fn kind_name(kind: Option<Kind>) -> &'static str {
    kind.map_or("none", Kind::name)
}

/// The runs of a case and variant: each of the ego's routes with each scenario on it.
pub(super) fn on_each_start<'a>(
    name: &'a str,
    case: (&'a str, Axes),
    variant: Variant,
    (town, options): (&Town, Options),
) -> impl Iterator<Item = Job> + use<'a> {
    let routes = town.ego_routes().count();
    let on = move |route| (0..options.scenarios).map(move |scenario| (route, scenario));
    let job = move |(route, scenario)| Job::new(name, case, (variant, route, scenario), options);
    (0..routes).flat_map(on).map(job)
}
