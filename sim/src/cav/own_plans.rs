//! The CAV's own plans, examined as those of a station are: an experiment for finding F-48.
//!
//! In `Local` no stage runs, and what follows a fallback is trusted. Here each own plan of such a cycle goes through
//! the hardened stages as in PlanRemote, with the CAV's own tracks, detections and grid; where one fails, control
//! brakes. H-14 examines the way to a stop against own tracks and own detections, the grid what neither shows.

use mufasa::input::cycle::{Ego, Route, Track, TrajectoryPoint};
use mufasa::input::parameters::Parameters;
use mufasa::input::profile::Profile;
use mufasa::input::scratch::{Column, Row, Scratch, Sizes};
use mufasa::services::configuration::Configuration;
use mufasa::stages::check;

use super::assembled::{self, Chosen, Fixed, Stamped};
use super::seen::Seen;
use super::sensing::Sensed;
use crate::services::way::seconds;

/// What own plans are examined with.
#[derive(Debug)]
pub struct OwnPlans {
    fixed: Fixed,
    /// Plans before this time pass unexamined, s.
    from: f64,
    seen: Seen,
    rows: Vec<Row>,
    columns: Vec<Column>,
    /// How many were examined, and how many of them failed.
    pub counts: [u64; 2],
}

impl OwnPlans {
    /// Nothing seen yet. `route`: the CAV's, whole; `from`: when examining begins, s.
    pub fn new(parameters: Parameters, route: &Route<'_>, from: f64) -> Self {
        let route = (route.closed, route.cross_sections.to_vec());
        Self {
            fixed: Fixed { profile: Profile::Hardened, parameters, route },
            from,
            seen: Seen::default(),
            rows: vec![Row::default(); Sizes::MAX.rows],
            columns: vec![Column::default(); Sizes::MAX.columns],
            counts: [0, 0],
        }
    }

    /// Whether a plan passes the stages.
    pub(super) fn passes(
        &mut self,
        moment: (i64, Ego),
        sensed: &Sensed,
        tracks: Option<Stamped<'_, Track>>,
        points: &[TrajectoryPoint],
    ) -> bool {
        if seconds(moment.0) < self.from {
            return true;
        }
        let history = self.seen.history(sensed.stamp_ns);
        let chosen = Chosen { tracks, points: Some((moment.0, points)) };
        let configuration = Configuration::PlanRemote;
        let cycle = assembled::cycle(&self.fixed, configuration, moment, sensed, chosen, &history);
        let report = check(&cycle, &mut Scratch::new(&mut self.rows, &mut self.columns));
        let passes = report.is_ok_and(|report| report.failed_stage.is_none());
        let [examined, failed] = &mut self.counts;
        *examined += 1;
        *failed += u64::from(!passes);
        passes
    }

    /// Keeps what was measured, for later cycles.
    pub(super) fn see(&mut self, sensed: &Sensed) {
        self.seen.see(sensed);
    }
}
