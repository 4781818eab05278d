//! Stage iii: trajectory with tracks (`spec/3-stages.md#stage-iii-trajectory-with-tracks`).

use crate::hardened::h09_velocity::{collision_standing, examines_standing};
use crate::input::cycle::{Cycle, TrackList, Trajectory};
use crate::report::{Rule, Witness};
use crate::stages::horizon::{Horizon, PointsExamined};
use crate::stages::llcc::sweep::MovingRectangle;
use crate::stages::llcc::{CavMotion, Collision};

/// Why stage iii fails, if it does. `held` is the list whose ids H-09 counts as held: the previous
/// tracks that stage i used in this cycle, if any.
pub(crate) fn trajectory_with_tracks(
    cycle: &Cycle<'_>,
    trajectory: &Trajectory<'_>,
    tracks: &TrackList<'_>,
    held: Option<&TrackList<'_>>,
) -> Option<Witness> {
    let examined = PointsExamined::new(cycle, trajectory.points, Horizon::Cav);
    let motion = CavMotion::new(cycle, examined.points, tracks.stamp_ns);
    let witness = |rule, Collision { point, object, compared }| {
        let track = tracks.items.get(object).map(|track| track.id);
        Witness { track, ..Witness::of(rule, compared) }.at_point(point)
    };
    let predicted = |motion: &CavMotion<'_, '_>| {
        let objects = tracks.items.iter().map(MovingRectangle::track);
        motion.first_collision(objects, |_| true).map(|it| witness(Rule::Collision, it))
    };
    let beyond = |find: &dyn Fn(&CavMotion<'_, '_>) -> Option<Witness>| {
        examined.first_beyond(|cycle, points| find(&CavMotion::new(cycle, points, tracks.stamp_ns)))
    };
    let found = predicted(&motion).or_else(|| beyond(&predicted));
    if !examines_standing(cycle) {
        return found;
    }
    let standing = |motion: &CavMotion<'_, '_>| {
        collision_standing(motion, tracks, held).map(|it| witness(Rule::CollisionStanding, it))
    };
    found.or_else(|| standing(&motion)).or_else(|| beyond(&standing))
}
