//! How many steps H-14 may take (`spec/hardened/H-14.md#requirements-failure`): what the strict model compares
//! with `work_limit`. It follows from where objects are: by the sizes of the lists alone it would be too much
//! in nearly every cycle of a drive.

use std::cell::LazyCell;

use crate::hardened::detection_history::{confirmed, is_within, nearest_to_reference, usable};
use crate::hardened::h14_fail_safe::meeting::{BesideRoute, h, is_behind, wider};
use crate::hardened::h14_fail_safe::motions::{Motion, all_motions};
use crate::hardened::h14_fail_safe::path;
use crate::input::scene::{Point, Scene};
use crate::numbers::real::Real;
use crate::numbers::rectangle::Rectangle;

/// 240 + U for each current detection and item of a usable list that are at most v_object dt + theta_track_max
/// apart, where the list is the reference list or the detection is unexplained; U are the items of all usable
/// lists.
pub fn of_pairs(scene: &Scene) -> i128 {
    let lists = usable(scene);
    let each = 240 + lists.iter().map(|list| list.items.len() as i128).sum::<i128>();
    let reference = nearest_to_reference(lists.iter().enumerate()).map(|(k, _)| k);
    let confirmed = confirmed(scene);
    let detections = scene.detections.iter().flat_map(|list| list.items.iter().enumerate());
    let pairs = detections.flat_map(|(d, detection)| {
        let is_explained = confirmed.iter().any(|(_, seen)| seen.detection == Some(d));
        let is_asked = move |(k, _): &(usize, _)| Some(*k) == reference || !is_explained;
        lists.iter().enumerate().filter(is_asked).map(move |(_, list)| {
            let p = &scene.parameters;
            let (at, most) = (&detection.frame.origin, &p.v_object * &list.dt + &p.theta_track_max);
            list.items.iter().filter(|item| is_within(scene, at, item, &most)).count() as i128
        })
    });
    each * pairs.sum::<i128>()
}

/// 320 for each motion; where it comes near the path, 960 more and 400 for each place; where it keeps beside as
/// well, 320 more, 560 for each place and 32 for each cross section.
pub fn of_motions(scene: &Scene, trajectory: &[Point]) -> i128 {
    let places = path::count(scene, trajectory);
    let near = 960 + 400 * places;
    let beside = 320 + 560 * places + 32 * scene.route.cross_sections.len() as i128;
    let ends = path::ends(scene, trajectory);
    let path: Vec<Rectangle> = ends.iter().map(|pose| wider(scene, trajectory, pose)).collect();
    let beside_route = LazyCell::new(|| BesideRoute::new(scene, trajectory));
    let of_motion = |motion: &Motion| {
        if !comes_near(scene, &path, motion) {
            return 320;
        }
        let keeps_beside = beside_route.keeps_beside(scene, motion, is_behind(scene, motion));
        320 + near + if keeps_beside { beside } else { 0 }
    };
    all_motions(scene).iter().map(of_motion).sum()
}

/// Neither along h nor across it is all that the object sweeps over until H(w) more than 1/10 m beyond the
/// rectangles of the path.
fn comes_near(scene: &Scene, path: &[Rectangle], motion: &Motion) -> bool {
    let h_ego = &scene.ego.heading;
    let least = motion.r_b(&scene.parameters.a_b, &motion.age);
    let most = &motion.speed * (&motion.age + h(scene, motion));
    let object = motion.object.rectangle();
    let moved = [least, most].map(|r| &object.frame.origin + &motion.moved_by(&r));
    [h_ego, &h_ego.left()].into_iter().all(|axis| {
        let reach = object.half_extent(axis) + Real::from_integer(1) / Real::from_integer(10);
        let at = moved.each_ref().map(|it| it.dot(axis));
        let is_beyond = |greatest: Real| at.iter().all(|it| it - &reach > greatest);
        let is_before = |least: Real| at.iter().all(|it| it + &reach < least);
        let sides = path.iter().map(|cav| (cav.frame.origin.dot(axis), cav.half_extent(axis)));
        let greatest = sides.clone().map(|(at, half)| at + half).max();
        let least = sides.map(|(at, half)| at - half).min();
        !greatest.is_some_and(is_beyond) && !least.is_some_and(is_before)
    })
}
