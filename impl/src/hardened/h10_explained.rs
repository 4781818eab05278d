//! Stage iv beside stage iii: detections that confirmed tracks explain count as standing less far
//! than the others (H-10 of `spec/3-stages.md#hardened-profile`).

use crate::hardened::detection_history::DetectionHistory;
use crate::input::cycle::{Cycle, TrackList, Trajectory};
use crate::input::profile::Profile;
use crate::input::scratch::{Column, Row, Scratch};
use crate::services::configuration::Configuration;
use crate::stages::horizon::{Horizon, PointsExamined};

/// In `Column::potential`, which stage i does not use any more: whether the detection with the
/// index of the column is explained.
const UNEXPLAINED: i64 = 0;
const EXPLAINED: i64 = 1;

impl Column {
    /// Whether the detection with the index of this column is explained, after `mark_explained`.
    pub(crate) const fn is_explained(&self) -> bool {
        self.potential == EXPLAINED
    }
}

/// Marks the current detections that confirmed tracks of a current list explain; how many they are.
/// Without a usable list there is none, and nothing is marked. `tracks`: the received ones when they
/// are current.
pub(crate) fn mark_explained(
    history: &DetectionHistory<'_, '_>,
    tracks: Option<&TrackList<'_>>,
    scratch: &mut Scratch<'_>,
) -> usize {
    if history.reference().is_none() {
        return 0;
    }
    let count = history.detections.map_or(0, |list| list.items.len());
    scratch.columns.iter_mut().take(count).for_each(|column| column.potential = UNEXPLAINED);
    let tracks = tracks.map_or(0, |list| list.items.len());
    let mut explained = 0_usize;
    for item in scratch.rows.iter().take(tracks).filter_map(Row::confirmed_by) {
        if let Some(column) = scratch.columns.get_mut(usize::from(item)) {
            // A detection confirms one track at most.
            column.potential = EXPLAINED;
            explained = explained.saturating_add(1);
        }
    }
    explained
}

/// At how many points of the trajectory stage iv examines explained detections as standing; `None`
/// where it treats them as any others. Where there are any, a track list is current, so that in
/// `AllRemote` stage iii ran in this cycle if stage iv does.
pub(crate) fn points_of_explained(
    cycle: &Cycle<'_>,
    trajectory: &Trajectory<'_>,
    explained: usize,
) -> Option<usize> {
    let beside_stage_iii = cycle.profile == Profile::Hardened
        && cycle.configuration == Configuration::AllRemote
        && explained > 0;
    let examined = || PointsExamined::new(cycle, trajectory.points, Horizon::Stop);
    beside_stage_iii.then(|| examined().points.len())
}
