//! Tracks that may as well stand still: those that the CAV's own detections do not back (H-09 of
//! `spec/3-stages.md#hardened-profile`).

use crate::input::cycle::{Cycle, DetectionList, TrackList, TrajectoryPoint};
use crate::input::profile::Profile;
use crate::input::scratch::Row;
use crate::numbers::time::elapsed_ns;
use crate::services::configuration::Configuration;
use crate::stages::llcc::sweep::MovingRectangle;
use crate::stages::llcc::{CavMotion, Collision};

/// Stage iii: whether tracks are examined as standing still, too.
pub(crate) fn examines_standing(cycle: &Cycle<'_>) -> bool {
    cycle.profile == Profile::Hardened && cycle.configuration == Configuration::AllRemote
}

/// Stage iii: the first collision with a track that is not backed, taken as standing still at its
/// place; without current detections where the list says.
pub(crate) fn collision_standing(
    cycle: &Cycle<'_>,
    points: &[TrajectoryPoint],
    tracks: &TrackList<'_>,
    detections: Option<&DetectionList<'_>>,
    rows: &[Row],
) -> Option<Collision> {
    let ahead_ns = detections.map_or(0, |list| elapsed_ns(tracks.stamp_ns, list.stamp_ns));
    let motion = CavMotion::among_standing(cycle, points, ahead_ns);
    let up_to =
        |index: usize| if rows.get(index).is_some_and(Row::is_backed) { 0 } else { usize::MAX };
    let objects = tracks.items.iter().map(MovingRectangle::track);
    motion.first_collision(objects, up_to)
}
