//! How many steps H-14 may take (`spec/hardened/H-14.md#requirements-failure`): what the strict model compares
//! with `work_limit`. It follows from where objects are: by the sizes of the lists alone it would be too much
//! in nearly every cycle of a drive.

use std::cell::LazyCell;

use crate::hardened::detection_history::{Usable, confirmed, nearest_to_reference, usable};
use crate::hardened::h14_fail_safe::meeting::{BesideRoute, h, is_behind, wider};
use crate::hardened::h14_fail_safe::motions::{Motion, origins};
use crate::hardened::h14_fail_safe::path::{self, Place};
use crate::hardened::h14_fail_safe::times::{Driving, a_tyre};
use crate::hardened::h14_fail_safe::widening::wider_by;
use crate::input::scene::{Object, Point, Scene};
use crate::numbers::real::Real;
use crate::numbers::rectangle::Rectangle;
use crate::numbers::vector::Vector;

/// U being the items of all usable lists: 240 + 2 U for each current detection and each item of the reference list
/// that are near each other, at most v_object dt + theta_track_max + 1 cm apart. And 2 U for each current detection, and
/// 176 + U for each item that a confirmed track may come from.
pub fn of_pairs(scene: &Scene) -> i128 {
    let (lists, confirmed) = (usable(scene), confirmed(scene));
    let u = lists.iter().map(|list| list.items.len() as i128).sum::<i128>();
    let reference = nearest_to_reference(lists.iter().enumerate()).map(|(_, list)| list);
    let near = |detection: &Object, list: &Usable| {
        let (at, p) = (&detection.frame.origin, &scene.parameters);
        let most = &p.v_object * &list.dt + &p.theta_track_max + one() / Real::from_integer(100);
        let is_near = |item: &&Object| {
            let place = &item.frame.origin;
            !at.is_far(place, &most) && at.distance(place) <= most
        };
        list.items.iter().filter(is_near).count() as i128
    };
    let of_detections =
        scene.detections.iter().flat_map(|list| &list.items).map(|detection| {
            reference.map_or(0, |list| (240 + 2 * u) * near(detection, list)) + 2 * u
        });
    let of_origins = confirmed.iter().filter_map(|(track, seen)| {
        let (_, items) = origins(scene, &lists, track, seen)?;
        Some(items.len() as i128 * (176 + u))
    });
    of_detections.sum::<i128>() + of_origins.sum::<i128>()
}

/// K being the places that the list has without an end by distance, E those whose progress is above s_stop - delta, and
/// C the cross sections: 320 for each motion; where it comes near the path, 3360 + 528 (K + E) more; where it keeps
/// beside as well, 1712 + 528 (K + E) + 32 C more.
pub fn of_motions(
    scene: &Scene,
    trajectory: &[Point],
    motions: &[Motion],
    beside_route: &LazyCell<BesideRoute, impl FnOnce() -> BesideRoute>,
) -> i128 {
    let last = Driving::of(scene).s_stop() - &scene.reads.delta;
    let places: Vec<Place> = path::places_by_length(scene, trajectory).collect();
    let k = places.len() as i128;
    let e = places.iter().filter(|place| place.progress > last).count() as i128;
    let c = scene.route.cross_sections.len() as i128;
    let path = extents(scene, trajectory);
    let (near, beside) = (3360 + 528 * (k + e), 1712 + 528 * (k + e) + 32 * c);
    let comes_near = motions.iter().filter(|motion| comes_near(scene, &path, motion));
    let keeps_beside = comes_near
        .clone()
        .filter(|motion| beside_route.keeps_beside(scene, motion, is_behind(scene, motion)));
    let [motions, near_ones, beside_ones] =
        [motions.len(), comes_near.count(), keeps_beside.count()].map(|count| count as i128);
    320 * motions + near * near_ones + beside * beside_ones
}

fn one() -> Real {
    Real::from_integer(1)
}

/// An axis, and from where to where something reaches along it, m.
struct Extent {
    axis: Vector,
    least: Real,
    greatest: Real,
}

/// How far the rectangles of the path reach along h and across it.
fn extents(scene: &Scene, trajectory: &[Point]) -> [Extent; 2] {
    let (ends, widening) = (path::ends(scene, trajectory), wider_by(scene, trajectory));
    let path: Vec<Rectangle> = ends.iter().map(|pose| wider(scene, &widening, pose)).collect();
    let h_ego = &scene.ego.heading;
    [h_ego.clone(), h_ego.left()].map(|axis| {
        let sides = path.iter().map(|cav| (cav.frame.origin.dot(&axis), cav.half_extent(&axis)));
        let least = sides.clone().map(|(at, half)| at - half).min();
        let greatest = sides.map(|(at, half)| at + half).max();
        let [least, greatest] = [least, greatest].map(|it| it.expect("a path has two ends"));
        Extent { axis, least, greatest }
    })
}

/// Neither along h nor across it is all that the object sweeps over until H(w) on one side of all rectangles of
/// the path and more than 1/10 m from them.
fn comes_near(scene: &Scene, path: &[Extent; 2], motion: &Motion) -> bool {
    let least = motion.r_b(&a_tyre(&scene.parameters.a_b), &motion.age);
    let most = &motion.speed * (&motion.age + h(scene, motion));
    let object = motion.object.rectangle();
    let moved = [least, most].map(|r| &object.frame.origin + &motion.moved_by(&r));
    path.iter().all(|Extent { axis, least, greatest }| {
        let reach = object.half_extent(axis) + one() / Real::from_integer(10);
        let at = moved.each_ref().map(|it| it.dot(axis));
        !at.iter().all(|it| it - &reach > *greatest) && !at.iter().all(|it| it + &reach < *least)
    })
}
