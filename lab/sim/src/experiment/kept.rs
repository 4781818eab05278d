//! What is kept of each run of an experiment.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::axes::{Axes, Detectors, Factor, LeftOut, Offered};
use super::job::Job;
use super::watch::{By, Watch};
use crate::attack::Kind;
use crate::attack::means::{Comes, Lists};
use crate::cav::guard::Variant;
use crate::run::{End, Outcome};

/// A collision this soon after something was remote is one of offloading, s: the CAV stops within it from any speed
/// that it has here.
const AFTER: f64 = 3.0;

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

impl Run {
    pub(super) fn of(job: &Job, outcome: &Outcome, watch: &Watch) -> Self {
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
    pub(super) const fn stages(&self) -> [[u64; 2]; 5] {
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
pub(super) fn is_same_case(a: &Run, b: &Run) -> bool {
    let whom = |it: &Run| (it.attack, it.lists, it.comes, it.empty_is_a_list, it.offered);
    let how = |it: &Run| (it.factor, it.value, it.detectors, it.left_out, it.variant);
    whom(a) == whom(b) && how(a) == how(b)
}
