//! How often each stage runs and finds a safety issue: the paper's last table.
//!
//! Scenarios with up to the given number of vehicles, a wait of 2 s after a failure, and the three attacks of
//! the paper at random times. MOT is offered on the first two thirds of the way and PLAN on the last two, so
//! that each configuration has a third; the paper says that its areas differ, not where they are.

use mufasa::services::configuration::Group;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::axes::Axes;
use super::job::Job;
use super::made::Experiment;
use super::select::Options;
use crate::attack::{Attack, Kind};
use crate::cav::guard::Variant;
use crate::map::Town;
use crate::settings::Areas;

/// As large as the paper's; a row is a stage in all runs of a variant.
pub const STAGES: Experiment = Experiment {
    same: |a, b| a.variant == b.variant,
    by_stage: Some(PAPER),
    ..Experiment::new("stages", Options::town(4, 30, 0), jobs)
};
/// Executions and detections of the five stages in the paper.
pub const PAPER: [(u64, u64); 5] = [(1386, 24), (582, 3), (216, 15), (76, 1), (188, 0)];
/// The wait after a failure, ns.
const T_WAIT_NS: i64 = 2_000_000_000;
/// Attacks until then, s: no run is longer.
const UNTIL: f64 = 130.0;
/// How long nobody attacks, and how long an attack lasts, s: at least, and at most.
const PAUSE: (f64, f64) = (2.0, 6.0);
const LASTS: (f64, f64) = (1.0, 4.0);

/// The runs: the routes by turns, the vehicles from half of the most on.
fn jobs(name: &str, town: &Town, options: Options) -> Vec<Job> {
    let routes: Vec<usize> = town.ego_routes().collect();
    let mut jobs = Vec::new();
    for variant in [Variant::Paper, Variant::Hardened] {
        for (scenario, route) in (0..options.scenarios).zip((0..routes.len()).cycle()) {
            let place = (variant, route, scenario);
            let mut job = Job::new(name, ("random", Axes::default()), place, options);
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
