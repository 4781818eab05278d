//! H-14, the fail-safe rule (`spec/hardened/H-14.md`): what the CAV can always do, going on for tau at most and
//! then braking along its path, meets nobody. Reach is a rule of stage ii, the rest stands in the place
//! of stage iv.

pub mod meeting;
pub mod motions;
pub mod path;
pub mod reach;
pub mod times;

use crate::hardened::detection_history::{ambiguous_failure, usable};
use crate::hardened::h14_fail_safe::motions::all_motions;
use crate::input::scene::{Point, Scene};
use crate::report::{Reading, Stage, Witness};
use crate::services::configuration::Configuration;
use crate::stages::i_track_validation::over_work_limit;

/// Why the rule fails; `None` passes, as where the current tracks and the current detections hold no object.
pub fn failure(scene: &Scene, trajectory: &[Point]) -> Option<Witness> {
    too_close_to_call(scene)
        .or_else(|| too_many_steps(scene, trajectory))
        .or_else(|| meeting::failure(scene, trajectory))
}

/// Where stage i, which asks it elsewhere, is not scheduled.
fn too_close_to_call(scene: &Scene) -> Option<Witness> {
    let has_stage_i =
        scene.configuration != Configuration::PlanRemote && scene.profile.runs(Stage::I);
    let is_asked = !has_stage_i && scene.tracks_current && scene.detections.is_some();
    ambiguous_failure(scene, scene.tracks.as_ref().filter(|_| is_asked)?)
}

/// How many current tracks and current detections there are.
fn objects(scene: &Scene) -> [usize; 2] {
    let tracks = scene.tracks.as_ref().filter(|_| scene.tracks_current);
    let detections = scene.detections.as_ref();
    [tracks.map_or(0, |list| list.items.len()), detections.map_or(0, |list| list.items.len())]
}

/// The most motions that are examined but for what stands: the tracks, and detections times items of the
/// longest usable list, of confirmed tracks and of all detections.
pub fn most_moving(scene: &Scene) -> i128 {
    let [tracks, detections] = objects(scene).map(|count| count as i128);
    let longest = usable(scene).iter().map(|list| list.items.len() as i128).max();
    tracks + 2 * detections * longest.unwrap_or(0)
}

/// The steps of pairs alone, or with those of motions, which are not looked for where these are too many.
fn too_many_steps(scene: &Scene, trajectory: &[Point]) -> Option<Witness> {
    let pairs = steps_of_pairs(scene);
    over_work_limit(scene, pairs).or_else(|| {
        let is_strict = scene.reads.reading == Reading::Strict;
        let motions = if is_strict { steps_of_motions(scene, trajectory) } else { 0 };
        over_work_limit(scene, pairs + motions)
    })
}

/// detections * max(items of the longest usable list, 1) * (512 + 8 * items of all usable lists).
pub fn steps_of_pairs(scene: &Scene) -> i128 {
    let [_, detections] = objects(scene).map(|count| count as i128);
    let lists: Vec<i128> = usable(scene).iter().map(|list| list.items.len() as i128).collect();
    let longest = lists.iter().copied().max().unwrap_or(0).max(1);
    detections * longest * (512 + 8 * lists.iter().sum::<i128>())
}

/// motions * (1280 + 768 * (places + points) + 32 * cross sections).
pub fn steps_of_motions(scene: &Scene, trajectory: &[Point]) -> i128 {
    let along = path::count(scene, trajectory) + trajectory.len() as i128;
    let cross_sections = scene.route.cross_sections.len() as i128;
    all_motions(scene).len() as i128 * (1280 + 768 * along + 32 * cross_sections)
}

/// What the model compares: (places + points) times tracks, plus detections times items of the longest usable list (at least 1)
/// times (items of all usable lists + places + points).
pub fn comparisons(scene: &Scene, trajectory: &[Point]) -> i128 {
    let [tracks, detections] = objects(scene).map(|count| count as i128);
    let lists: Vec<i128> = usable(scene).iter().map(|list| list.items.len() as i128).collect();
    let longest = lists.iter().copied().max().unwrap_or(0).max(1);
    let along = path::count(scene, trajectory) + trajectory.len() as i128;
    along * tracks + detections * longest * (lists.iter().sum::<i128>() + along)
}
