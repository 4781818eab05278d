//! H-14, the fail-safe rule (`spec/hardened/H-14.md`): what the CAV can always do, going on for tau at most and
//! then braking along its path, meets nobody. Reach and road are rules of stage ii, the rest stands in the
//! place of stage iv.

pub mod excess;
pub mod meeting;
pub mod motions;
pub mod path;
pub mod reach;
pub mod returns;
pub mod road;
pub mod times;
pub mod widening;
pub mod work;

use std::cell::LazyCell;

use crate::hardened::detection_history::{ambiguous_failure, usable};
use crate::hardened::h14_fail_safe::meeting::BesideRoute;
use crate::hardened::h14_fail_safe::motions::all_motions;
use crate::input::scene::{Point, Scene};
use crate::report::{Stage, Witness};
use crate::services::configuration::Configuration;
use crate::stages::i_track_validation::over_work_limit;

/// Why the rule fails; `None` passes, as where the current tracks and the current detections hold no object.
pub fn failure(scene: &Scene, trajectory: &[Point]) -> Option<Witness> {
    let motions = LazyCell::new(|| all_motions(scene));
    let beside_route = LazyCell::new(|| BesideRoute::new(scene, trajectory));
    let of_motions = || work::of_motions(scene, trajectory, &motions, &beside_route);
    too_close_to_call(scene)
        .or_else(|| too_much_work(scene, of_motions))
        .or_else(|| meeting::failure(scene, trajectory, &motions, &beside_route))
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

/// The work of pairs alone, or with that of motions, which are not looked for where pairs are too many.
fn too_much_work(scene: &Scene, of_motions: impl FnOnce() -> i128) -> Option<Witness> {
    if !scene.reads.is_strict() {
        return None;
    }
    let pairs = work::of_pairs(scene);
    over_work_limit(scene, pairs).or_else(|| over_work_limit(scene, pairs + of_motions()))
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
