//! Stage iv beside stage iii: detections that confirmed tracks explain count as standing less far
//! than the others (H-10 of `spec/3-stages.md#hardened-profile`).

use crate::hardened::detection_history::DetectionHistory;
use crate::input::cycle::{Cycle, TrackList, Trajectory};
use crate::input::profile::Profile;
use crate::input::scratch::{Column, Row, Scratch};
use crate::numbers::range::larger;
use crate::services::configuration::Configuration;
use crate::stages::horizon::{Horizon, PointsExamined};

/// The current detections that confirmed tracks of a current list explain.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Explained {
    /// How many they are.
    pub(crate) count: usize,
    /// Of these tracks, whose rows say whether they are confirmed.
    tracks: usize,
    /// The square of the speed of the fastest, m^2/s^2.
    pub(crate) fastest: f64,
}

impl Explained {
    /// Without a usable list there is none. `tracks`: the received ones when they are current. In
    /// `Column::potential`, which stage i does not use any more, stands which track may explain the
    /// detection with the index of the column; whether it does, its row says.
    pub(crate) fn new(
        history: &DetectionHistory<'_, '_>,
        tracks: Option<&TrackList<'_>>,
        scratch: &mut Scratch<'_>,
    ) -> Self {
        let tracks = match (history.reference(), tracks) {
            (Some(_), Some(list)) => list.items,
            (_, _) => &[],
        };
        let mut found = Self { count: 0, tracks: tracks.len(), fastest: 0.0 };
        for ((track, row), index) in tracks.iter().zip(scratch.rows.iter()).zip(0_i64..) {
            let Some(item) = row.confirmed_by() else { continue };
            if let Some(column) = scratch.columns.get_mut(usize::from(item)) {
                // A detection confirms one track at most.
                column.potential = index;
                found.count = found.count.saturating_add(1);
                found.fastest = larger(found.fastest, track.vx * track.vx + track.vy * track.vy);
            }
        }
        found
    }

    /// The track that explains a detection.
    #[inline]
    pub(crate) fn by(&self, detection: usize, rows: &[Row], columns: &[Column]) -> Option<usize> {
        let track = usize::try_from(columns.get(detection)?.potential).ok()?;
        let row = rows.get(track).filter(|_| track < self.tracks)?;
        (usize::from(row.confirmed_by()?) == detection).then_some(track)
    }
}

/// At how many points of the trajectory stage iv examines explained detections as standing; `None`
/// where it treats them as any others. Where there are any, a track list is current, so that in
/// `AllRemote` stage iii ran in this cycle if stage iv does.
pub(crate) fn points_of_explained(
    cycle: &Cycle<'_>,
    trajectory: &Trajectory<'_>,
    explained: &Explained,
) -> Option<usize> {
    let beside_stage_iii = cycle.profile == Profile::Hardened
        && cycle.configuration == Configuration::AllRemote
        && explained.count > 0;
    let examined = || PointsExamined::new(cycle, trajectory.points, Horizon::Stop);
    beside_stage_iii.then(|| examined().points.len())
}
