//! The rows of the table of an experiment.

use schemars::JsonSchema;
use serde::Serialize;

use super::axes::{Detectors, Factor, LeftOut, Offered};
use super::kept::Run;
use super::watch::By;
use crate::attack::Kind;
use crate::attack::means::{Comes, Lists};
use crate::cav::guard::Variant;
use crate::run::{End, PERIOD_NS};
use crate::time::seconds;

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

/// What all runs have alike.
fn common<T: PartialEq>(runs: &[Run], of: impl Fn(&Run) -> T) -> Option<T> {
    let first = of(&runs[0]);
    runs.iter().all(|run| of(run) == first).then_some(first)
}

impl Row {
    #[expect(clippy::cast_precision_loss, reason = "counts far below 2^53")]
    pub(super) fn of(all: &[Run]) -> Self {
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
    pub(super) fn by_stage(self, runs: &[Run], paper: [(u64, u64); 5]) -> Vec<Self> {
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
