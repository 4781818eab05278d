//! What a vehicle counts while it drives, and what is said of it at the end.

use std::fmt;
use std::time::Duration;

use mufasa::report::{InvalidInput, Report};
use mufasa::services::configuration::{Configuration, Group};
use mufasa_props::bridge;
use mufasa_records::names;
use schemars::JsonSchema;
use serde::Serialize;

use super::log::{Coverage, Entry, What};
use crate::traffic::{Counts, Traffic, add};

/// Hears every entry of the log.
pub type Listener = Box<dyn FnMut(&Entry) + Send>;

/// What is counted; over several lives of a vehicle.
#[derive(Default)]
pub struct Tally {
    summary: Summary,
    latencies_ns: [Vec<i64>; 2],
    monitor_ns: Vec<i64>,
    coverage: Coverage,
    listener: Option<Listener>,
}

impl fmt::Debug for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Tally").field("summary", &self.summary).finish_non_exhaustive()
    }
}

/// What a vehicle did.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct Summary {
    /// Whether it was ended before the drives had, as by Ctrl-C: what follows is of the time until then.
    pub interrupted: bool,
    /// Drives begun.
    pub drives: u64,
    /// Cycles decided.
    pub cycles: u64,
    /// Those in which everything was local and nothing was checked.
    pub local: u64,
    /// Those that were checked and safe.
    pub safe: u64,
    /// Those that were not, by what failed: `input`, a stage, `no_obstacle_check`, or `error`.
    pub unsafe_by_stage: Counts,
    /// Cycles before which the drive was held, because this computer was more than 20 ms late.
    pub paused: u64,
    /// Cycles in which a remote result reached control.
    pub offloaded: u64,
    /// Time of these cycles, s.
    pub offloaded_s: f64,
    /// Returns of both groups to the local services for an unsafe cycle.
    pub fallbacks: u64,
    /// Sessions that ended, by the reason: `late`, `from the future` and `silent` are violations of the
    /// quality of service.
    pub left: Counts,
    /// Remote results that reached control.
    pub used: u64,
    /// Those of them that no safe decision of their session covers, by the reason: there must be none.
    pub uncovered: Counts,
    /// Local services that were started and stopped.
    pub local_services: Counts,
    /// From the making of a result to its arrival, of those accepted: tracks.
    pub latency_tracks: Spread,
    /// The same of trajectories.
    pub latency_trajectories: Spread,
    /// What the monitor takes in a cycle.
    pub monitor: Spread,
    /// What went to and fro.
    #[serde(flatten)]
    pub traffic: Traffic,
}

/// How a time is spread, us; 0 where nothing was measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct Spread {
    /// How many there are.
    pub count: u64,
    /// Half are at most this.
    pub p50_us: f64,
    /// 99 of 100 are at most this.
    pub p99_us: f64,
    /// All are at most this.
    pub max_us: f64,
}

impl Spread {
    /// Of times in ns.
    #[allow(clippy::cast_precision_loss, reason = "times of hours at most, and for people to read")]
    fn of(times_ns: &[i64]) -> Self {
        let mut sorted = times_ns.to_vec();
        sorted.sort_unstable();
        let at = |percent: usize| {
            let place = (sorted.len() * percent).div_ceil(100).saturating_sub(1);
            sorted.get(place).map_or(0.0, |ns| *ns as f64 / 1e3)
        };
        Self { count: sorted.len() as u64, p50_us: at(50), p99_us: at(99), max_us: at(100) }
    }
}

impl Tally {
    /// Counts, and lets every entry of the log be heard.
    pub fn heard_by(listener: Listener) -> Self {
        Self { listener: Some(listener), ..Self::default() }
    }

    /// What was counted so far.
    pub fn summary(&self) -> Summary {
        let [mot, plan] = &self.latencies_ns;
        Summary {
            latency_tracks: Spread::of(mot),
            latency_trajectories: Spread::of(plan),
            monitor: Spread::of(&self.monitor_ns),
            ..self.summary.clone()
        }
    }

    /// It ends before its drives do.
    pub fn interrupt(&mut self) {
        self.summary.interrupted = true;
    }

    pub(super) fn began(&mut self, now_ns: i64) {
        self.summary.drives += 1;
        self.note(now_ns, What::Began);
    }

    /// Logs what happened, and looks whether a result that is used is covered.
    pub(super) fn note(&mut self, at_ns: i64, what: What) {
        let entry = Entry { at_ns, what };
        if let Err(why) = self.coverage.take(&entry) {
            add(&mut self.summary.uncovered, &why.to_string());
        }
        if let What::Left { why, .. } = &entry.what {
            add(&mut self.summary.left, why);
        }
        if let Some(listener) = &mut self.listener {
            listener(&entry);
        }
    }

    pub(super) fn decided(
        &mut self,
        now_ns: i64,
        cycle: usize,
        configuration: Configuration,
        safe: bool,
        report: &Result<Report, InvalidInput>,
        took: Duration,
    ) {
        self.monitor_ns.push(i64::try_from(took.as_nanos()).unwrap_or(i64::MAX));
        let failed = match report {
            Ok(report) => bridge::report_from_impl(report).failed_stage.map(names::failed_stage),
            Err(_) => Some("error"),
        };
        let summary = &mut self.summary;
        summary.cycles += 1;
        match failed {
            Some(failed) => {
                add(&mut summary.unsafe_by_stage, failed);
                summary.fallbacks += u64::from(configuration != Configuration::Local);
            }
            None if configuration == Configuration::Local => summary.local += 1,
            None => summary.safe += 1,
        }
        let failed = failed.map(str::to_owned);
        let configuration = format!("{configuration:?}");
        self.note(now_ns, What::Decided { cycle, configuration, safe, failed });
    }

    /// Remote results of a cycle that reached control; one cycle has several.
    pub(super) fn used(&mut self, now_ns: i64, period_ns: i64, used: Vec<What>) {
        if used.is_empty() {
            return;
        }
        self.summary.offloaded += 1;
        #[allow(clippy::cast_precision_loss, reason = "10 s at most")]
        let period_s = period_ns as f64 * 1e-9;
        self.summary.offloaded_s += period_s;
        for what in used {
            self.summary.used += 1;
            self.note(now_ns, what);
        }
    }

    pub(super) fn paused(&mut self) {
        self.summary.paused += 1;
    }

    pub(super) fn accepted(&mut self, group: Group, latency_ns: i64) {
        let [mot, plan] = &mut self.latencies_ns;
        match group {
            Group::Mot => mot.push(latency_ns),
            Group::Plan => plan.push(latency_ns),
        }
    }

    pub(super) fn local_services(&mut self, what: &str) {
        add(&mut self.summary.local_services, what);
    }

    pub(super) fn traffic(&mut self) -> &mut Traffic {
        &mut self.summary.traffic
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spread_is_that_of_nearest_ranks() {
        let times: Vec<i64> = (1..=200).rev().map(|us| us * 1_000).collect();
        let spread = Spread::of(&times);
        assert_eq!(
            (spread.count, spread.p50_us, spread.p99_us, spread.max_us),
            (200, 100.0, 198.0, 200.0)
        );
        assert_eq!(Spread::of(&[]), Spread::default());
    }
}
