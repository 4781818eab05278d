//! What the CAV saw itself (SEEN-01 to SEEN-19, `spec/hardened/what-the-cav-saw.md`): tracks beside the CAV's own
//! detections, current and earlier ones. The tracks are the received ones, in `PlanRemote` its own.

use crate::hardened::h14_fail_safe::times::a_tyre;
use crate::input::profile::HardenedRule;
use crate::input::scene::{Detections, Object, Scene, Track, Tracks};
use crate::numbers::real::Real;
use crate::numbers::vector::Vector;
use crate::report::{Rule, Witness};

/// Ages from which and to which a list of the history is usable, ns.
const USABLE_NS: [i128; 2] = [200_000_000, 1_000_000_000];
/// The age that the reference list is nearest to, ns.
const REFERENCE_NS: i128 = 500_000_000;

/// A usable list of the history.
#[derive(Clone, Debug)]
pub struct Usable<'a> {
    /// Age: the stamp of the detections minus its own, ns.
    pub age_ns: i128,
    /// The same, s.
    pub dt: Real,
    /// In list order.
    pub items: &'a [Object],
}

/// A track beside what the CAV saw itself.
#[derive(Clone, Debug)]
pub struct Seen {
    /// Where it is when the CAV detects, m.
    pub place: Vector,
    /// Its own origin in each usable list.
    pub own_origins: Vec<Option<usize>>,
    /// Its own origin is in at least two usable lists, and it is not faster than `v_object`.
    pub is_backed: bool,
    /// The current detection that it is compared with.
    pub detection: Option<usize>,
    /// That detection is its own.
    pub owns_detection: bool,
    /// What it says of its motion is what the CAV saw.
    pub is_confirmed: bool,
}

/// The lists of the history that are at most 60 s older than now and 200 ms to 1 s older than the
/// current detections, the youngest first; none without current detections.
pub fn usable(scene: &Scene) -> Vec<Usable<'_>> {
    let Some(detections) = &scene.detections else { return Vec::new() };
    let [least, most] = USABLE_NS;
    let aged = |list: &Detections| i128::from(detections.stamp_ns) - i128::from(list.stamp_ns);
    (scene.detection_history.iter())
        .map(|list| (aged(list), &list.items))
        .filter(|(age_ns, _)| (least..=most).contains(age_ns))
        .map(|(age_ns, items)| Usable { age_ns, dt: Real::seconds(age_ns), items })
        .collect()
}

/// Of some usable lists the one whose age is nearest to 500 ms, the younger of two: of all of them it
/// is the reference list. Its index and itself.
pub fn nearest_to_reference<'a, 'b>(
    lists: impl Iterator<Item = (usize, &'b Usable<'a>)>,
) -> Option<(usize, &'b Usable<'a>)>
where
    'a: 'b,
{
    lists.min_by_key(|(_, list)| ((list.age_ns - REFERENCE_NS).abs(), list.age_ns))
}

/// place = p + v (t_D - t_T), m; p without current detections.
pub fn place(scene: &Scene, tracks: &Tracks, track: &Track) -> Vector {
    let p = &track.object.frame.origin;
    match &scene.detections {
        None => p.clone(),
        Some(Detections { stamp_ns: t_d, .. }) => {
            let t = Real::seconds(i128::from(*t_d) - i128::from(tracks.stamp_ns));
            p + &track.velocity.scaled(&t)
        }
    }
}

/// past = place - v dt, m.
pub fn past(place: &Vector, v: &Vector, dt: &Real) -> Vector {
    place - &v.scaled(dt)
}

/// How far an origin may be from the past: theta_track_max + theta_velocity dt, m.
pub fn origin_limit(scene: &Scene, dt: &Real) -> Real {
    &scene.parameters.theta_track_max + &scene.parameters.theta_velocity * dt
}

/// The tracks in their order, each beside what the CAV saw itself.
pub fn seen(scene: &Scene, tracks: &Tracks) -> Vec<Seen> {
    let p = &scene.parameters;
    let lists = usable(scene);
    let places: Vec<Vector> = tracks.items.iter().map(|t| place(scene, tracks, t)).collect();
    let origins_in = |list: &Usable| -> Vec<Option<usize>> {
        let limit = origin_limit(scene, &list.dt);
        let origin = |(track, place): (&Track, &Vector)| {
            let (item, distance) =
                nearest(&past(place, &track.velocity, &list.dt), list.items, &limit)?;
            (distance <= limit).then_some(item)
        };
        tracks.items.iter().zip(&places).map(origin).collect()
    };
    let origins: Vec<Vec<Option<usize>>> = lists.iter().map(origins_in).collect();
    let detection = |place: &Vector| {
        let items = &scene.detections.as_ref()?.items;
        let (item, distance) = nearest(place, items, &p.theta_track_max)?;
        (distance < p.theta_track_max).then_some(item)
    };
    let detections: Vec<Option<usize>> = places.iter().map(detection).collect();
    let beside = |(i, (track, place)): (usize, (&Track, Vector))| {
        let own_origins: Vec<_> = origins.iter().map(|origins| own(origins, i)).collect();
        let is_slow = track.velocity.length() <= p.v_object;
        let is_backed = is_slow && own_origins.iter().flatten().count() >= 2;
        let detection = detections[i];
        let owns_detection = own(&detections, i).is_some();
        let is_confirmed =
            is_backed && owns_detection && is_along(scene, &track.velocity, detection);
        Seen { place, own_origins, is_backed, detection, owns_detection, is_confirmed }
    };
    tracks.items.iter().zip(places).enumerate().map(beside).collect()
}

/// The confirmed tracks of a current list, in their order. Their detections are explained, and no
/// others.
pub fn confirmed(scene: &Scene) -> Vec<(&Track, Seen)> {
    match &scene.tracks {
        Some(tracks) if scene.tracks_current => {
            let seen = tracks.items.iter().zip(seen(scene, tracks));
            seen.filter(|(_, seen)| seen.is_confirmed).collect()
        }
        Some(_) | None => Vec::new(),
    }
}

/// The list of a confirmed track: the one nearest to 500 ms among those that hold its own origin.
pub fn list_of(lists: &[Usable], seen: &Seen) -> Option<usize> {
    let holds = |(k, _): &(usize, &Usable)| seen.own_origins[*k].is_some();
    nearest_to_reference(lists.iter().enumerate().filter(holds)).map(|(k, _)| k)
}

/// How far an object may have been from d - w dt' at the age dt' of a list, for its w over dt is a mean:
/// a_tyre dt' abs(dt' - dt) / 2, m.
fn off_the_mean(scene: &Scene, dt: &Real, other: &Real) -> Real {
    a_tyre(&scene.parameters.a_b) * other * (other - dt).abs() / Real::from_integer(2)
}

/// How far from d - w dt' an item of a list of age dt' supports a pair over dt:
/// max(theta_track_max, 0.3 m) + a_tyre dt' abs(dt' - dt) / 2, m.
pub fn supports_within(scene: &Scene, dt: &Real, other: &Real) -> Real {
    scene.parameters.theta_track_max.clone().max(stands_within()) + off_the_mean(scene, dt, other)
}

/// How far from d - w dt' an item of a list of age dt' shows a pair over dt: 0.3 m + a_tyre dt' abs(dt' - dt) / 2, m.
pub fn shown_within(scene: &Scene, dt: &Real, other: &Real) -> Real {
    stands_within() + off_the_mean(scene, dt, other)
}

/// abs(d - d') <= v_object dt, d' being an item of a list of age dt.
fn is_reached(scene: &Scene, d: &Object, before: &Object, dt: &Real) -> bool {
    is_within(scene, &d.frame.origin, before, &(&scene.parameters.v_object * dt))
}

/// Whether a detection d may come from an item d', given by list and index: abs(d - d') <= v_object dt
/// and, when there are other lists, one of them has an item that supports it.
pub fn may_come_from(scene: &Scene, lists: &[Usable], d: &Object, [k, item]: [usize; 2]) -> bool {
    let list = &lists[k];
    let before = &list.items[item];
    let w = velocity(d, before, &list.dt);
    let supports =
        |other: &Usable| had_it(scene, other, d, &w, &supports_within(scene, &list.dt, &other.dt));
    let mut others = lists.iter().enumerate().filter(|(other, _)| *other != k).peekable();
    is_reached(scene, d, before, &list.dt)
        && (others.peek().is_none() || others.any(|(_, other)| supports(other)))
}

/// Whether a detection d was seen to come from an item d', given by list and index: abs(d - d') <= v_object dt and each
/// other list has an item that shows it.
pub fn was_seen_to_come_from(
    scene: &Scene,
    lists: &[Usable],
    d: &Object,
    [k, item]: [usize; 2],
) -> bool {
    let dt = &lists[k].dt;
    let limit = |other: &Real| shown_within(scene, dt, other);
    is_reached(scene, d, &lists[k].items[item], dt)
        && each_other_had_it(scene, lists, d, [k, item], limit)
}

/// How far from what stood its items are at most: 0.3 m.
pub fn stands_within() -> Real {
    Real::from_double(0.3)
}

/// The current detection stood: there are two usable lists or more, and each has an item at distance <= 0.3 m from it.
pub fn has_stood(scene: &Scene, lists: &[Usable], d: &Object) -> bool {
    let (place, limit) = (&d.frame.origin, stands_within());
    let is_near = |item: &Object| {
        !place.is_far(&item.frame.origin, &scene.reads.lowered(&limit))
            && scene.reads.at_most(&place.distance(&item.frame.origin), &limit)
    };
    lists.len() >= 2 && lists.iter().all(|list| list.items.iter().any(is_near))
}

/// A detection d moved evenly from an item d', given by list and index: each other list has an item at distance <= 0.3 m
/// from d - w dt'.
pub fn moved_evenly(scene: &Scene, lists: &[Usable], d: &Object, [k, item]: [usize; 2]) -> bool {
    each_other_had_it(scene, lists, d, [k, item], |_| stands_within())
}

/// Each list but that of d', of age dt', has an item at distance <= limit(dt') from d - w dt'.
fn each_other_had_it(
    scene: &Scene,
    lists: &[Usable],
    d: &Object,
    [k, item]: [usize; 2],
    limit: impl Fn(&Real) -> Real,
) -> bool {
    let w = velocity(d, &lists[k].items[item], &lists[k].dt);
    let had = |other: &Usable| had_it(scene, other, d, &w, &limit(&other.dt));
    lists.iter().enumerate().all(|(other, list)| other == k || had(list))
}

/// A list of age dt' has an item at distance <= limit from d - w dt'.
fn had_it(scene: &Scene, list: &Usable, d: &Object, w: &Vector, limit: &Real) -> bool {
    let then = past(&d.frame.origin, w, &list.dt);
    list.items.iter().any(|item| is_within(scene, &then, item, limit))
}

/// w = (d - d') / dt, m/s.
pub fn velocity(d: &Object, before: &Object, dt: &Real) -> Vector {
    let moved = &d.frame.origin - &before.frame.origin;
    Vector { x: moved.x / dt, y: moved.y / dt }
}

/// The item is at most `limit` from the point, or nearly so, m.
pub fn is_within(scene: &Scene, point: &Vector, item: &Object, limit: &Real) -> bool {
    let place = &item.frame.origin;
    !point.is_far(place, &scene.reads.raised(limit))
        && scene.reads.may_be_at_most(&point.distance(place), limit)
}

/// What is the i-th's and no other's.
fn own(all: &[Option<usize>], i: usize) -> Option<usize> {
    all[i].filter(|item| all.iter().filter(|other| **other == Some(*item)).count() == 1)
}

/// The item nearest to a point, the first of several, and its distance, m; items that are surely
/// farther than `limit` need not be looked at.
fn nearest(point: &Vector, items: &[Object], limit: &Real) -> Option<(usize, Real)> {
    let near = items.iter().enumerate().filter(|(_, it)| !point.is_far(&it.frame.origin, limit));
    let distances = near.map(|(i, item)| (i, item.frame.origin.distance(point)));
    distances.min_by(|(_, a), (_, b)| a.cmp(b))
}

/// If the detection is longer than 1 m: abs(v x direction) <= theta_velocity + abs(v) / 10.
fn is_along(scene: &Scene, v: &Vector, detection: Option<usize>) -> bool {
    sideways(scene, v, detection).is_none_or(|[sideways, limit]| sideways <= limit)
}

/// abs(v x direction) and its limit, m/s, if the detection is longer than 1 m.
fn sideways(scene: &Scene, v: &Vector, detection: Option<usize>) -> Option<[Real; 2]> {
    let detection = &scene.detections.as_ref()?.items[detection?];
    let is_long = detection.length > Real::from_integer(1);
    let limit = &scene.parameters.theta_velocity + v.length() / Real::from_integer(10);
    is_long.then(|| [v.cross(&detection.frame.direction).abs(), limit])
}

/// `spec/4-arithmetic.md#strict-and-lax`: these comparisons do not move, so the strict reading fails
/// where one of them is too close to call, for some track, when a rule that rests on them is in force.
pub fn ambiguous_failure(scene: &Scene, tracks: &Tracks) -> Option<Witness> {
    let ambiguous = |(track, seen): (&Track, &Seen)| {
        let [left, right] = too_close(scene, track, seen)?;
        let witness = Witness::new(Rule::Ambiguous, &left, &right);
        Some(Witness { track: Some(track.id), ..witness })
    };
    let is_asked = scene.profile.has(HardenedRule::H01) || scene.profile.has(HardenedRule::H14);
    if !is_asked || !scene.reads.is_strict() {
        return None;
    }
    tracks.items.iter().zip(&seen(scene, tracks)).find_map(ambiguous)
}

/// Two numbers whose comparison for this track is too close to call.
fn too_close(scene: &Scene, track: &Track, seen: &Seen) -> Option<[Real; 2]> {
    let p = &scene.parameters;
    let apart = |[a, b]: &[Real; 2]| (a - b).abs() > scene.reads.delta;
    let speed = [track.velocity.length(), p.v_object.clone()];
    if !apart(&speed) {
        return Some(speed);
    }
    let in_list = |list: &Usable| {
        let past = past(&seen.place, &track.velocity, &list.dt);
        unclear(scene, &past, list.items, &origin_limit(scene, &list.dt))
    };
    let in_detections = || {
        let items = &scene.detections.as_ref()?.items;
        unclear(scene, &seen.place, items, &p.theta_track_max)
    };
    let is_asked = seen.is_backed && seen.owns_detection;
    let along = || sideways(scene, &track.velocity, seen.detection.filter(|_| is_asked));
    (usable(scene).iter().find_map(in_list))
        .or_else(in_detections)
        .or_else(|| along().filter(|numbers| !apart(numbers)))
}

/// The distance of the nearest item is within delta of its bound, or at most the bound + delta while
/// another item, not at the same position, is at most delta farther.
fn unclear(scene: &Scene, point: &Vector, items: &[Object], bound: &Real) -> Option<[Real; 2]> {
    let delta = &scene.reads.delta;
    let reach = bound + delta;
    let far = &reach + delta;
    let near = items.iter().map(|item| &item.frame.origin).filter(|it| !point.is_far(it, &far));
    let distances: Vec<_> = near.map(|place| (place, place.distance(point))).collect();
    let (nearest, least) = distances.iter().min_by(|(_, a), (_, b)| a.cmp(b))?;
    if (least - bound).abs() <= *delta {
        return Some([least.clone(), bound.clone()]);
    }
    let as_near =
        distances.iter().find(|(place, other)| place != nearest && other - least <= *delta)?;
    (*least <= reach).then(|| [least.clone(), as_near.1.clone()])
}
