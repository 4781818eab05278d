//! A collision that was found: everything to make it again.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::super::axes::{Axes, Offered};
use super::super::job::Job;
use super::danger::{Danger, LastUse};
use crate::attack::Attack;
use crate::cav::guard::Variant;
use crate::map::Town;
use crate::map::id::MapId;
use crate::run::{End, Outcome, RunError, Settings, Watcher};

/// The wait after a failure, ns, and the noise of detections, m: both less than in the other experiments, so
/// that false alarms end fewer of the attacks. No rule of the stages is changed by that.
const T_WAIT_NS: i64 = 1_000_000_000;
const POSITION_M: f64 = 0.02;

/// A run: where it starts, what is checked, and what the attacker does.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// What is checked.
    pub variant: Variant,
    /// `tau` of the hardened profile, s; less than `TAU_S` is less than A-07 asks for.
    pub tau_s: f64,
    /// Whether control drives on along what was verified however long nothing newer comes (F-47).
    #[serde(default)]
    pub drives_on: bool,
    /// What the station offers.
    pub offered: Offered,
    /// Which of the ego's routes, from 0.
    pub route: usize,
    /// Seed of the scenario, of noise and of the link.
    pub scenario: u64,
    /// Other vehicles.
    pub vehicles: usize,
    /// What the attacker does.
    pub attacks: Vec<Attack>,
    /// On which map.
    #[serde(default)]
    pub map: MapId,
}

/// A collision that does not happen in the same run without the attacks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Found {
    /// The run; shrunk, where the search was not interrupted before.
    pub case: Case,
    /// When it collides, s.
    pub t_s: f64,
    /// With whom.
    pub with: u32,
    /// How fast the CAV was in the last cycle before, m/s.
    pub speed_mps: f64,
    /// The last cycle whose remote results were used; none: none ever was.
    pub last_use: Option<LastUse>,
}

impl Found {
    /// Whether it came when the CAV could have stood, by its own services, after the last remote result that was used.
    /// Whose fault it is this does not say: what was remote may have brought the CAV to where it is in the way.
    pub fn is_after(&self) -> bool {
        self.last_use.is_none_or(|it| self.t_s > it.stands_s())
    }
}

impl Case {
    /// Makes the run.
    ///
    /// Errors: those of `run`; a route that the town does not have is a route of no vehicle there: the first.
    pub fn run(&self, town: &Town, watcher: &mut impl Watcher) -> Result<Outcome, RunError> {
        self.job().run(town, watcher)
    }

    /// As a run of an experiment.
    pub fn job(&self) -> Job {
        let &Self { route, scenario, vehicles, .. } = self;
        let mut settings = Settings::new(self.variant, self.offered.groups(), scenario);
        // Who attacks asks nobody, and what was kept stays the run that it was.
        settings.prechecks = false;
        settings.attacks.clone_from(&self.attacks);
        settings.stages.tau = self.tau_s;
        settings.drives_on = self.drives_on;
        settings.requester.t_wait_ns = T_WAIT_NS;
        settings.errors.position = POSITION_M;
        let axes = Axes { offered: self.offered, ..Axes::default() };
        Job { axes, id: self.name(), route, scenario, vehicles, settings }
    }

    /// Index of its route in the town.
    pub fn ego_route(&self, town: &Town) -> usize {
        town.ego_routes().nth(self.route).unwrap_or(0)
    }

    /// The collision, if it ends in one. Errors: those of `run`.
    pub fn collision(&self, town: &Town) -> Result<Option<Found>, RunError> {
        let mut danger = Danger::default();
        let outcome = self.run(town, &mut danger)?;
        Ok(self.found(&outcome, &danger))
    }

    /// The collision of an outcome.
    pub fn found(&self, outcome: &Outcome, danger: &Danger) -> Option<Found> {
        let with = outcome.with.filter(|_| outcome.end == End::Collided)?;
        let speed_mps = danger.last_speed();
        let last_use = danger.last_use();
        Some(Found { case: self.clone(), t_s: outcome.t, with, speed_mps, last_use })
    }

    /// When the first attack begins, s.
    pub fn begins(&self) -> f64 {
        self.attacks.iter().map(|it| it.from).fold(f64::INFINITY, f64::min)
    }

    /// Its kinds of attacks, in order and joined.
    pub fn kinds(&self) -> String {
        let mut kinds: Vec<&str> = self.attacks.iter().map(|it| it.kind.name()).collect();
        kinds.sort_unstable();
        kinds.dedup();
        kinds.join(" + ")
    }

    /// A name for files and pages.
    pub fn name(&self) -> String {
        let kinds = self.kinds().replace(" + ", "-and-");
        let (variant, offered) = (self.variant.name(), self.offered.name());
        let route = self.map.route(self.route);
        format!("{variant}-{offered}-{kinds}-{route}-{}", self.scenario)
    }
}
