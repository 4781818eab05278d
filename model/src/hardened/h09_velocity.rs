//! H-09: velocities fit the displacement since the last list; in `AllRemote` a track without such a list
//! may as well stand still.

use crate::input::scene::{Point, Scene, Tracks};
use crate::numbers::real::Real;
use crate::report::{Rule, Witness};
use crate::services::configuration::Configuration;
use crate::stages::llcc::first_collision;

/// abs(p - p_prev - v dt) <= theta_velocity dt for every track whose id the previous list holds.
pub fn velocity_failure(scene: &Scene, tracks: &Tracks) -> Option<Witness> {
    let (previous, dt) = previous_list(scene, tracks)?;
    tracks.items.iter().find_map(|track| {
        let before = previous.items.iter().find(|before| before.id == track.id)?;
        let moved = &track.object.frame.origin - &before.object.frame.origin;
        let error = (&moved - &track.velocity.scaled(&dt)).length();
        let limit = &scene.parameters.theta_velocity * &dt;
        let passes = scene.reads.at_most(&error, &limit);
        let witness = Witness::unless(passes, Rule::Velocity, &error, &limit)?;
        Some(Witness { track: Some(track.id), ..witness })
    })
}

/// In `AllRemote` the first collision with a track as standing still, if its id is not held: none is
/// when stage i did not check this list in this cycle, or there is no previous list.
pub fn collision_standing(
    scene: &Scene,
    points: &[Point],
    tracks: &Tracks,
    list_was_checked: bool,
) -> Option<Witness> {
    if scene.configuration != Configuration::AllRemote {
        return None;
    }
    let previous = previous_list(scene, tracks).filter(|_| list_was_checked);
    let is_held = |id: i64| {
        previous.as_ref().is_some_and(|(list, _)| list.items.iter().any(|track| track.id == id))
    };
    let standing: Vec<_> = tracks.items.iter().filter(|track| !is_held(track.id)).collect();
    let rule = Rule::CollisionStanding;
    first_collision(scene, rule, points, &standing, |_, track| track.object.clone())
        .map(|(j, witness)| Witness { track: Some(standing[j].id), ..witness })
}

/// The previous list and the time from its stamp to that of the received one, when that is usable.
fn previous_list<'a>(scene: &'a Scene, tracks: &Tracks) -> Option<(&'a Tracks, Real)> {
    let previous = scene.previous_tracks.as_ref()?;
    let dt_ns = i128::from(tracks.stamp_ns) - i128::from(previous.stamp_ns);
    (0 < dt_ns && dt_ns <= 1_000_000_000).then(|| (previous, Real::seconds(dt_ns)))
}
