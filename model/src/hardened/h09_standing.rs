//! H-09: in `AllRemote` a track that is not backed may as well stand still.

use crate::hardened::detection_history::seen;
use crate::input::scene::{Object, Point, Scene, Tracks};
use crate::numbers::vector::Frame;
use crate::report::{Rule, Witness};
use crate::services::configuration::Configuration;
use crate::stages::llcc::first_collision;

/// In `AllRemote` the first collision with a track that is not backed, standing still at its place (at
/// x without current detections).
pub fn collision_standing(
    scene: &Scene,
    points: impl Iterator<Item = Point>,
    tracks: &Tracks,
) -> Option<Witness> {
    if scene.configuration != Configuration::AllRemote {
        return None;
    }
    let standing: Vec<(i64, Object)> = (tracks.items.iter().zip(seen(scene, tracks)))
        .filter(|(_, seen)| !seen.is_backed)
        .map(|(track, seen)| {
            let direction = track.object.frame.direction.clone();
            let frame = Frame { origin: seen.place, direction };
            (track.id, Object { frame, ..track.object.clone() })
        })
        .collect();
    let rule = Rule::CollisionStanding;
    first_collision(scene, rule, points, &standing, |_, (_, object)| object.clone())
        .map(|(j, witness)| Witness { track: Some(standing[j].0), ..witness })
}
