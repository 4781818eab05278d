//! Stage iii: trajectory with tracks (`spec/3-stages.md#stage-iii-trajectory-with-tracks`).

use crate::input::cycle::{Cycle, TrackList, Trajectory};
use crate::report::{Rule, Witness};
use crate::stages::horizon::{Horizon, points_examined};
use crate::stages::llcc::sweep::MovingRectangle;
use crate::stages::llcc::{CavMotion, Collision};

/// Why stage iii fails, if it does.
pub(crate) fn trajectory_with_tracks(
    cycle: &Cycle<'_>,
    trajectory: &Trajectory<'_>,
    tracks: &TrackList<'_>,
) -> Option<Witness> {
    // S3-02
    let points = points_examined(cycle, trajectory.points, Horizon::Cav);
    let motion = CavMotion::new(cycle, points, tracks.stamp_ns);
    let found = motion.first_collision(tracks.items.iter().map(MovingRectangle::track));
    found.map(|Collision { point, object, compared }| {
        let track = tracks.items.get(object).map(|track| track.id);
        Witness { track, ..Witness::of(Rule::Collision, compared) }.at_point(point)
    })
}
