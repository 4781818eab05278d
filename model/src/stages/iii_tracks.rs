//! Stage iii: paper Sec. IV-D, "Trajectory Validation with Tracks", Eq. (3)
//! (`spec/3-stages.md#stage-iii-trajectory-with-tracks`):
//!
//! no collision with a predicted track within s_CAV = v_now safety_time

use crate::input::scene::{Object, Point, Scene, Track, Tracks};
use crate::numbers::real::Real;
use crate::report::Witness;
use crate::stages::distances::s_cav;
use crate::stages::horizon::points_within;
use crate::stages::llcc::first_collision;

/// Compares the trajectory within s_CAV with the predicted tracks; `None` passes.
pub fn trajectory_with_tracks(
    scene: &Scene,
    trajectory: &[Point],
    tracks: &Tracks,
) -> Option<Witness> {
    let s_cav = s_cav(&scene.parameters.safety_time, &scene.ego.v_now);
    let points = points_within(scene, trajectory, &s_cav);
    let predicted = |point: &Point, track: &Track| {
        let t_ns = i128::from(point.t_ns) - i128::from(tracks.stamp_ns);
        predicted(track, &Real::seconds(t_ns))
    };
    first_collision(scene, points, &tracks.items, predicted)
        .map(|(j, witness)| Witness { track: Some(tracks.items[j].id), ..witness })
}

/// The CV model: the track moved by v t, of either sign, with unchanged direction.
fn predicted(track: &Track, t: &Real) -> Object {
    let mut object = track.object.clone();
    object.frame.origin = &object.frame.origin + &track.velocity.scaled(t);
    object
}
