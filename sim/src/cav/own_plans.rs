//! The CAV's own plans, examined as those of a station are: an experiment for finding F-48.
//!
//! In `Local` no stage runs, and what follows a fallback is trusted. Here each own plan of such a cycle goes through
//! the hardened stages as in PlanRemote, with the CAV's own tracks, detections and grid; where one fails, control
//! brakes. H-14 examines the way to a stop against own tracks and own detections, the grid what neither shows.

use mufasa::input::cycle::{Ego, Route, Track, TrackList, TrajectoryPoint};
use mufasa::input::parameters::Parameters;
use mufasa::input::profile::Profile;
use mufasa::services::configuration::Configuration;

use super::asking::{Asking, Known};
use super::assembled::Stamped;
use super::sensing::Sensed;
use crate::services::way::seconds;

/// What own plans are examined with.
#[derive(Debug)]
pub struct OwnPlans {
    asking: Asking,
    /// Plans before this time pass unexamined, s.
    from: f64,
    /// How many were examined, and how many of them failed.
    pub counts: [u64; 2],
}

impl OwnPlans {
    /// Nothing seen yet. `route`: the CAV's, whole; `from`: when examining begins, s.
    pub fn new(parameters: Parameters, route: &Route<'_>, from: f64) -> Self {
        Self { asking: Asking::new(Profile::Hardened, parameters, route), from, counts: [0, 0] }
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
        let known = Known::of(Configuration::PlanRemote, moment, sensed);
        let tracks = tracks.map(|(stamp_ns, items)| TrackList { stamp_ns, items });
        let passes = self.asking.first(&known, tracks, moment.0, [points]).is_some();
        let [examined, failed] = &mut self.counts;
        *examined += 1;
        *failed += u64::from(!passes);
        passes
    }

    /// Keeps what was measured, for later cycles.
    pub(super) fn see(&mut self, sensed: &Sensed) {
        self.asking.see(sensed.stamp_ns, &sensed.detections);
    }
}
