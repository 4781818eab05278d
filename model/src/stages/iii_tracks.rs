//! Stage iii: trajectory with tracks (`spec/3-stages.md#stage-iii-trajectory-with-tracks`, H-09).

use crate::input::profile::Profile;
use crate::input::scene::{Object, Point, Scene, Track, Tracks};
use crate::numbers::real::Real;
use crate::report::{Rule, Witness};
use crate::services::configuration::Configuration;
use crate::stages::distances::{points_examined, s_cav};
use crate::stages::i_track_validation::is_held;
use crate::stages::llcc::llcc;

/// Compares the trajectory with the predicted tracks; `None` passes. `list_was_checked`: stage i
/// ran on this list in this cycle.
pub fn tracks(
    scene: &Scene,
    trajectory: &[Point],
    tracks: &Tracks,
    list_was_checked: bool,
) -> Option<Witness> {
    let s = s_cav(&scene.parameters.safety_time, &scene.ego.v_now);
    let points = points_examined(scene, trajectory, &s);
    let first = |rule: Rule, object: &dyn Fn(&Point, &Track) -> Option<Object>| {
        points.iter().enumerate().find_map(|(i, point)| {
            tracks.items.iter().find_map(|track| {
                let collision = llcc(scene, point, &object(point, track)?)?;
                Some(Witness {
                    point: Some(i),
                    track: Some(track.id),
                    ..Witness::new(rule, &collision.distance, &collision.limit)
                })
            })
        })
    };
    let stands_too = |track: &Track| {
        scene.profile == Profile::Hardened
            && scene.configuration == Configuration::AllRemote
            && !(list_was_checked && is_held(scene, tracks, track.id))
    };
    first(Rule::Collision, &|point, track| Some(predicted(track, tracks.stamp_ns, point.t_ns)))
        .or_else(|| {
            first(Rule::CollisionStanding, &|_, track| {
                stands_too(track).then(|| track.object.clone())
            })
        })
}

/// The track moved by v (t_point - stamp), of either sign, with unchanged direction.
fn predicted(track: &Track, stamp_ns: i64, t_ns: i64) -> Object {
    let dt = Real::seconds(i128::from(t_ns) - i128::from(stamp_ns));
    let mut object = track.object.clone();
    object.frame.origin = &object.frame.origin + &track.velocity.scaled(&dt);
    object
}
