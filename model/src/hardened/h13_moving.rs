//! H-13: stage iv also examines detections as moving, the way that the CAV saw them move.

pub mod seen_twice;
pub mod waiting;

use crate::hardened::detection_history::{
    Seen, Usable, confirmed, nearest_to_reference, origin_limit, past, usable,
};
use crate::hardened::h04_horizon::{Places, places_within, s_stop_along};
use crate::hardened::h13_moving::seen_twice::{Pair, object_at, velocity};
use crate::hardened::h13_moving::waiting::collision_beyond;
use crate::input::scene::{Detections, Object, Point, Scene, Track};
use crate::numbers::real::Real;
use crate::numbers::vector::Vector;
use crate::report::{Rule, Witness};
use crate::stages::i_track_validation::over_work_limit;
use crate::stages::llcc::first_collision;

/// The first collision of stage iv with a detection as moving: in the order point, (a) confirmed
/// tracks before (b) unexplained or disputed detections, items.
pub fn collision_moving(
    scene: &Scene,
    trajectory: &[Point],
    detections: &Detections,
) -> Option<Witness> {
    let lists = usable(scene);
    let places = places(scene, trajectory);
    let work = work(&lists, detections, trajectory, &places)?;
    if let Some(witness) = over_work_limit(scene, work) {
        return Some(witness);
    }
    let pairs = pairs(scene, &lists, &detections.items);
    let object = |point: &Point, pair: &Pair| object_at(detections, pair, point);
    let within = first_collision(scene, Rule::CollisionMoving, places.iter(), &pairs, object);
    let (pair, witness) = match within {
        Some((j, witness)) => (pairs[j], witness),
        None => collision_beyond(scene, trajectory, detections, &places, &pairs)?,
    };
    let Pair { detection, item, list } = pair;
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

/// Detections times items of the longest usable list times (items of all usable lists + points of the
/// trajectory + places beyond its end); none without a usable list.
pub fn work(
    lists: &[Usable],
    detections: &Detections,
    trajectory: &[Point],
    places: &Places,
) -> Option<i128> {
    let items = || lists.iter().map(|list| list.items.len());
    let longest = items().max()?;
    let pairs = detections.items.len() as i128 * longest as i128;
    let all = items().sum::<usize>() + trajectory.len();
    Some(pairs * (all as i128 + places.count_beyond()))
}

/// What stage iv examines as moving.
pub fn pairs<'a>(scene: &Scene, lists: &'a [Usable<'a>], detections: &[Object]) -> Vec<Pair<'a>> {
    let confirmed = confirmed(scene);
    let of_tracks = confirmed.iter().flat_map(|(track, seen)| of_track(scene, lists, track, seen));
    let examined = unexplained_or_disputed(scene, lists, detections, &confirmed);
    let of_detections =
        examined.into_iter().flat_map(|d| of_detection(scene, lists, &detections[d], d));
    of_tracks.chain(of_detections).collect()
}

/// (a) The detection of a confirmed track and each item at distance <= theta_track_max +
/// theta_velocity dt from its past, in the list of the track.
fn of_track<'a>(
    scene: &Scene,
    lists: &'a [Usable<'a>],
    track: &Track,
    seen: &Seen,
) -> Vec<Pair<'a>> {
    let Some((k, detection)) = list_of(lists, seen).zip(seen.detection) else { return Vec::new() };
    let list = &lists[k];
    let past = past(&seen.place, &track.velocity, &list.dt);
    let limit = origin_limit(scene, &list.dt);
    let is_near = |item: &usize| is_within(scene, &past, &list.items[*item], &limit);
    (0..list.items.len()).filter(is_near).map(|item| Pair { detection, item, list }).collect()
}

/// (b) A detection and each item of the reference list that it may come from.
fn of_detection<'a>(
    scene: &Scene,
    lists: &'a [Usable<'a>],
    d: &Object,
    detection: usize,
) -> Vec<Pair<'a>> {
    let Some((k, list)) = nearest_to_reference(lists.iter().enumerate()) else { return Vec::new() };
    let is_pair = |item: &usize| may_come_from(scene, lists, d, [k, *item]);
    (0..list.items.len()).filter(is_pair).map(|item| Pair { detection, item, list }).collect()
}

/// The detections that (b) examines: those that no confirmed track explains, and those whose track
/// may have taken the past of one of them.
fn unexplained_or_disputed(
    scene: &Scene,
    lists: &[Usable],
    detections: &[Object],
    confirmed: &[(&Track, Seen)],
) -> Vec<usize> {
    let track_of = |d: &usize| confirmed.iter().find(|(_, seen)| seen.detection == Some(*d));
    let (explained, unexplained): (Vec<usize>, Vec<usize>) =
        (0..detections.len()).partition(|d| track_of(d).is_some());
    let is_disputed = |d: &usize| {
        let Some((_, seen)) = track_of(d) else { return false };
        let Some(k) = list_of(lists, seen) else { return false };
        let Some(origin) = seen.own_origins[k] else { return false };
        let came = |other: &usize| may_come_from(scene, lists, &detections[*other], [k, origin]);
        unexplained.iter().any(came)
    };
    let disputed = explained.into_iter().filter(is_disputed);
    let mut examined: Vec<usize> = unexplained.iter().copied().chain(disputed).collect();
    examined.sort_unstable();
    examined
}

/// The list of a confirmed track: the one nearest to 500 ms among those that hold its own origin.
fn list_of(lists: &[Usable], seen: &Seen) -> Option<usize> {
    let holds = |(k, _): &(usize, &Usable)| seen.own_origins[*k].is_some();
    nearest_to_reference(lists.iter().enumerate().filter(holds)).map(|(k, _)| k)
}

/// Whether a detection d may come from an item d' of a list, given by their places: abs(d - d') <=
/// v_object dt and, when there are other lists, one of them has an item at distance <=
/// theta_track_max from d - w dt'.
fn may_come_from(scene: &Scene, lists: &[Usable], d: &Object, [k, item]: [usize; 2]) -> bool {
    let (list, p) = (&lists[k], &scene.parameters);
    let before = &list.items[item];
    let w = velocity(d, before, &list.dt);
    let supports = |other: &Usable| {
        let then = past(&d.frame.origin, &w, &other.dt);
        other.items.iter().any(|item| is_within(scene, &then, item, &p.theta_track_max))
    };
    let mut others = lists.iter().enumerate().filter(|(other, _)| *other != k).peekable();
    is_within(scene, &d.frame.origin, before, &(&p.v_object * &list.dt))
        && (others.peek().is_none() || others.any(|(_, other)| supports(other)))
}

/// The item is at most `limit` from the point, or nearly so, m.
fn is_within(scene: &Scene, point: &Vector, item: &Object, limit: &Real) -> bool {
    let place = &item.frame.origin;
    !point.is_far(place, &scene.reads.raised(limit))
        && scene.reads.may_be_at_most(&point.distance(place), limit)
}
