//! Stage iii: trajectory with tracks (`spec/3-stages.md#stage-iii-trajectory-with-tracks`).

use crate::hardened::h09_standing::{collision_standing, examines_standing};
use crate::input::cycle::{Cycle, DetectionList, TrackList, Trajectory, TrajectoryPoint};
use crate::input::scratch::Row;
use crate::report::{Rule, Witness};
use crate::stages::horizon::{Horizon, PointsExamined};
use crate::stages::llcc::sweep::MovingRectangle;
use crate::stages::llcc::{CavMotion, Collision};

/// Why stage iii fails, if it does. `detections`: the current ones; `rows`: which tracks are
/// backed.
pub(crate) fn trajectory_with_tracks(
    cycle: &Cycle<'_>,
    trajectory: &Trajectory<'_>,
    tracks: &TrackList<'_>,
    detections: Option<&DetectionList<'_>>,
    rows: &[Row],
) -> Option<Witness> {
    let examined = PointsExamined::new(cycle, trajectory.points, Horizon::Cav);
    let witness = |rule, Collision { point, object, compared }| {
        let track = tracks.items.get(object).map(|track| track.id);
        Witness { track, ..Witness::of(rule, compared) }.at_point(point)
    };
    let predicted = |cycle: &Cycle<'_>, points: &[TrajectoryPoint]| {
        let motion = CavMotion::new(cycle, points, tracks.stamp_ns);
        let objects = tracks.items.iter().map(MovingRectangle::track);
        motion.first_collision(objects, |_| usize::MAX).map(|it| witness(Rule::Collision, it))
    };
    let found = predicted(cycle, examined.points).or_else(|| examined.first_beyond(predicted));
    if !examines_standing(cycle) {
        return found;
    }
    let standing = |cycle: &Cycle<'_>, points: &[TrajectoryPoint]| {
        let found = collision_standing(cycle, points, tracks, detections, rows);
        found.map(|it| witness(Rule::CollisionStanding, it))
    };
    let standing_anywhere =
        || standing(cycle, examined.points).or_else(|| examined.first_beyond(standing));
    found.or_else(standing_anywhere)
}
