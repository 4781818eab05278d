//! H-13: stage iv also examines detections as moving, the way that the CAV saw them move.

use crate::hardened::detection_history::{
    Seen, Usable, confirmed, nearest_to_reference, origin_limit, past, usable,
};
use crate::hardened::h04_horizon::{Places, places_within, s_stop_along};
use crate::input::scene::{Detections, Object, Point, Scene, Track};
use crate::numbers::real::Real;
use crate::numbers::vector::{Frame, Vector};
use crate::report::{Rule, Witness};
use crate::stages::i_track_validation::over_work_limit;
use crate::stages::llcc::first_collision;

/// A detection d and the item d' of an earlier list that it may have come from, by their indices.
#[derive(Clone, Copy, Debug)]
pub struct Pair<'a> {
    /// Of the current detection.
    pub detection: usize,
    /// Of the item of the list.
    pub item: usize,
    /// The list.
    pub list: &'a Usable<'a>,
}

/// The first collision of stage iv with a detection as moving: in the order point, (a) confirmed
/// tracks before (b) unexplained detections, items.
pub fn collision_moving(
    scene: &Scene,
    trajectory: &[Point],
    detections: &Detections,
) -> Option<Witness> {
    let lists = usable(scene);
    let places = places(scene, trajectory);
    let work = work(&lists, detections, &places)?;
    if let Some(witness) = over_work_limit(scene, work) {
        return Some(witness);
    }
    let pairs = pairs(scene, &lists, &detections.items);
    let object = |point: &Point, pair: &Pair| {
        let t_ns = i128::from(point.t_ns) - i128::from(detections.stamp_ns);
        let d = &detections.items[pair.detection];
        let w = velocity(d, &pair.list.items[pair.item], &pair.list.dt);
        let origin = &d.frame.origin + &w.scaled(&Real::seconds(t_ns));
        Object { frame: Frame { origin, direction: d.frame.direction.clone() }, ..d.clone() }
    };
    let (j, witness) =
        first_collision(scene, Rule::CollisionMoving, places.iter(), &pairs, object)?;
    let Pair { detection, item, list } = pairs[j];
    let age_ns = i64::try_from(list.age_ns).ok();
    Some(Witness { detection: Some(detection), item: Some(item), age_ns, ..witness })
}

/// The places with way <= (1 + 1e-6) (s_stop + tau_motion v_now), the next one, and those beyond the
/// end of the trajectory up to s_stop.
pub fn places<'a>(scene: &'a Scene, trajectory: &'a [Point]) -> Places<'a> {
    let longer = &scene.parameters.tau_motion * &scene.ego.v_now;
    let horizon = s_stop_along(scene, trajectory) + longer;
    places_within(scene, trajectory, &horizon, &horizon)
}

/// Detections times items of the longest usable list times (items of all usable lists + places);
/// none without a usable list.
pub fn work(lists: &[Usable], detections: &Detections, places: &Places) -> Option<i128> {
    let items = || lists.iter().map(|list| list.items.len());
    let longest = items().max()?;
    let pairs = detections.items.len() as i128 * longest as i128;
    Some(pairs * (items().sum::<usize>() as i128 + places.count()))
}

/// w = (d - d') / dt, m/s.
fn velocity(d: &Object, before: &Object, dt: &Real) -> Vector {
    let moved = &d.frame.origin - &before.frame.origin;
    Vector { x: moved.x / dt, y: moved.y / dt }
}

/// What stage iv examines as moving.
pub fn pairs<'a>(scene: &Scene, lists: &'a [Usable<'a>], detections: &[Object]) -> Vec<Pair<'a>> {
    let confirmed = confirmed(scene);
    let is_explained = |d: &usize| confirmed.iter().any(|(_, seen)| seen.detection == Some(*d));
    let unexplained: Vec<usize> = (0..detections.len()).filter(|d| !is_explained(d)).collect();
    let of_tracks = confirmed.iter().flat_map(|(track, seen)| of_track(scene, lists, track, seen));
    let of_detections =
        unexplained.into_iter().flat_map(|d| of_detection(scene, lists, detections, d));
    of_tracks.chain(of_detections).collect()
}

/// (a) The detection of a confirmed track and each item at distance <= theta_track_max +
/// theta_velocity dt from its past, in the list nearest to 500 ms among those that hold its own origin.
fn of_track<'a>(
    scene: &Scene,
    lists: &'a [Usable<'a>],
    track: &Track,
    seen: &Seen,
) -> Vec<Pair<'a>> {
    let holds = |(k, _): &(usize, &Usable)| seen.own_origins[*k].is_some();
    let Some((_, list)) = nearest_to_reference(lists.iter().enumerate().filter(holds)) else {
        return Vec::new();
    };
    let Some(detection) = seen.detection else { return Vec::new() };
    let past = past(&seen.place, &track.velocity, &list.dt);
    let limit = origin_limit(scene, &list.dt);
    let is_near = |item: &usize| is_within(scene, &past, &list.items[*item], &limit);
    (0..list.items.len()).filter(is_near).map(|item| Pair { detection, item, list }).collect()
}

/// (b) An unexplained detection and each item of the reference list with abs(d - d') <= v_object dt
/// that has support: when there are other usable lists, one of them has an item at distance <=
/// theta_track_max from d - w dt'.
fn of_detection<'a>(
    scene: &Scene,
    lists: &'a [Usable<'a>],
    detections: &[Object],
    detection: usize,
) -> Vec<Pair<'a>> {
    let Some((reference, list)) = nearest_to_reference(lists.iter().enumerate()) else {
        return Vec::new();
    };
    let (d, p) = (&detections[detection], &scene.parameters);
    let others: Vec<&Usable> =
        lists.iter().enumerate().filter(|(k, _)| *k != reference).map(|(_, list)| list).collect();
    let has_support = |before: &Object| {
        let w = velocity(d, before, &list.dt);
        let supports = |other: &&Usable| {
            let then = past(&d.frame.origin, &w, &other.dt);
            other.items.iter().any(|item| is_within(scene, &then, item, &p.theta_track_max))
        };
        others.is_empty() || others.iter().any(supports)
    };
    let limit = &p.v_object * &list.dt;
    let is_pair = |item: &usize| {
        let before = &list.items[*item];
        is_within(scene, &d.frame.origin, before, &limit) && has_support(before)
    };
    (0..list.items.len()).filter(is_pair).map(|item| Pair { detection, item, list }).collect()
}

/// The item is at most `limit` from the point, or nearly so, m.
fn is_within(scene: &Scene, point: &Vector, item: &Object, limit: &Real) -> bool {
    let place = &item.frame.origin;
    !point.is_far(place, &scene.reads.raised(limit))
        && scene.reads.may_be_at_most(&point.distance(place), limit)
}
