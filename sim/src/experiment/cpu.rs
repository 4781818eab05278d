//! Processor time of the CAV's services while they run and while they are stopped, and of what makes that
//! possible: the paper's table of CPU usage.
//!
//! The same scenarios without an attack for each variant. Shares are processor time over simulated time.
//! This is the one experiment whose figures are those of a machine, and other ones in each run.

use std::time::Duration;

use mufasa::services::configuration::Group;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::job::{self, Campaign, ExperimentError, Job, Options};
use crate::cav::Cav;
use crate::cav::cost::Part;
use crate::cav::guard::{Decided, Variant};
use crate::map::Town;
use crate::run::{Cycle, Outcome, PERIOD_NS, Watcher};
use crate::services::way::seconds;
use crate::snapshot::Snapshot;

/// Its name.
pub const NAME: &str = "cpu";
/// About as long as the paper's 594.5 s of each variant.
pub const OPTIONS: Options = Options::town(6, 15, 0);

/// What came of it.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Cpu {
    /// How large it was.
    pub options: Options,
    /// The table.
    pub rows: Vec<Row>,
    /// Every run.
    pub runs: Vec<Run>,
}

/// Whose time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Who {
    /// The requester, and where there is one the monitor with its stages.
    Guard,
    /// MOT.
    Mot,
    /// ENV and TPL, which are one service here.
    EnvTpl,
}

impl Who {
    /// All.
    pub const ALL: [Self; 3] = [Self::Guard, Self::Mot, Self::EnvTpl];

    /// Its name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Guard => "requester and stages",
            Self::Mot => "MOT",
            Self::EnvTpl => "ENV and TPL",
        }
    }
}

/// One of the variant, in all runs. Times in s.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Row {
    /// What is checked.
    pub variant: Variant,
    /// Whose time.
    pub who: Who,
    /// Simulated time in which it ran.
    pub active_s: f64,
    /// Processor time of it then.
    pub active_cpu_s: f64,
    /// Simulated time in which it was stopped.
    pub inactive_s: f64,
    /// Processor time of it then.
    pub inactive_cpu_s: f64,
}

/// A run. Times in s.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Run {
    /// By which it can be repeated.
    pub id: String,
    /// What is checked.
    pub variant: Variant,
    /// Which route.
    pub route: usize,
    /// Which scenario on it.
    pub scenario: u64,
    /// Simulated time.
    pub simulated_s: f64,
    /// Processor time of the requester, and where there is one of the monitor with its stages.
    pub guard_cpu_s: f64,
    /// Simulated time with MOT on the CAV.
    pub mot_active_s: f64,
    /// Processor time of MOT in it.
    pub mot_active_cpu_s: f64,
    /// Processor time of MOT in the rest.
    pub mot_inactive_cpu_s: f64,
    /// Simulated time with ENV and TPL on the CAV.
    pub env_tpl_active_s: f64,
    /// Processor time of ENV and TPL in it.
    pub env_tpl_active_cpu_s: f64,
    /// Processor time of ENV and TPL in the rest.
    pub env_tpl_inactive_cpu_s: f64,
}

/// Time in a state, s.
#[derive(Clone, Copy, Debug, Default)]
struct Usage {
    simulated_s: f64,
    cpu_s: f64,
}

impl Usage {
    fn add(&mut self, other: Self) {
        self.simulated_s += other.simulated_s;
        self.cpu_s += other.cpu_s;
    }
}

/// Adds up the time of each cycle in the state that its services were in.
#[derive(Debug)]
struct Meter {
    ran: [bool; 2],
    before: [Duration; 3],
    guard: Usage,
    /// Of MOT and PLAN: stopped, running.
    services: [[Usage; 2]; 2],
}

impl Default for Meter {
    fn default() -> Self {
        // Everything begins on the CAV.
        let (guard, services) = (Usage::default(), [[Usage::default(); 2]; 2]);
        Self { ran: [true; 2], before: [Duration::ZERO; 3], guard, services }
    }
}

impl Watcher for Meter {
    fn cycle(&mut self, _: &Snapshot, cav: &Cav<'_>, _: &Decided, _: &Cycle) {
        let simulated_s = seconds(PERIOD_NS);
        let now = [Part::Mot, Part::Plan, Part::Guard].map(|part| cav.cost().spent(part));
        let mut spent = now
            .iter()
            .zip(self.before)
            .map(|(now, before)| now.saturating_sub(before).as_secs_f64());
        let mut usage = || Usage { simulated_s, cpu_s: spent.next().unwrap_or(0.0) };
        for (states, ran) in self.services.iter_mut().zip(self.ran) {
            states[usize::from(ran)].add(usage());
        }
        self.guard.add(usage());
        self.before = now;
        self.ran = Group::ALL.map(|group| cav.services().run(group));
    }
}

/// The runs.
pub fn jobs(town: &Town, options: Options) -> Vec<Job<()>> {
    let starts = job::starts(town, options);
    let of = |variant| {
        let job = move |&(route, scenario): &(usize, u64)| {
            Job::new(NAME, ("none", ()), (variant, route, scenario), options)
        };
        starts.iter().map(job).collect::<Vec<_>>()
    };
    Variant::ALL.into_iter().flat_map(of).collect()
}

/// Makes the runs. Errors: those of [`job::make`].
pub fn experiment(campaign: &Campaign<'_>) -> Result<Cpu, ExperimentError> {
    let &Campaign { town, options, .. } = campaign;
    let runs = job::watched(campaign, jobs(town, options), |_| Meter::default(), kept)?;
    let same = |a: &Run, b: &Run| a.variant == b.variant;
    Ok(Cpu { options, rows: runs.chunk_by(same).flat_map(rows).collect(), runs })
}

fn kept(job: &Job<()>, _: &Outcome, meter: &Meter) -> Run {
    let [[mot_stopped, mot], [env_tpl_stopped, env_tpl]] = meter.services;
    Run {
        id: job.id.clone(),
        variant: job.settings.variant,
        route: job.route,
        scenario: job.scenario,
        simulated_s: meter.guard.simulated_s,
        guard_cpu_s: meter.guard.cpu_s,
        mot_active_s: mot.simulated_s,
        mot_active_cpu_s: mot.cpu_s,
        mot_inactive_cpu_s: mot_stopped.cpu_s,
        env_tpl_active_s: env_tpl.simulated_s,
        env_tpl_active_cpu_s: env_tpl.cpu_s,
        env_tpl_inactive_cpu_s: env_tpl_stopped.cpu_s,
    }
}

/// The rows of one variant.
fn rows(runs: &[Run]) -> [Row; 3] {
    let sum = |of: fn(&Run) -> f64| runs.iter().map(of).sum::<f64>();
    let simulated_s = sum(|run| run.simulated_s);
    Who::ALL.map(|who| {
        let (active_s, active_cpu_s, inactive_cpu_s) = match who {
            Who::Guard => (simulated_s, sum(|run| run.guard_cpu_s), 0.0),
            Who::Mot => (
                sum(|run| run.mot_active_s),
                sum(|run| run.mot_active_cpu_s),
                sum(|run| run.mot_inactive_cpu_s),
            ),
            Who::EnvTpl => (
                sum(|run| run.env_tpl_active_s),
                sum(|run| run.env_tpl_active_cpu_s),
                sum(|run| run.env_tpl_inactive_cpu_s),
            ),
        };
        let (variant, inactive_s) = (runs[0].variant, simulated_s - active_s);
        Row { variant, who, active_s, active_cpu_s, inactive_s, inactive_cpu_s }
    })
}
