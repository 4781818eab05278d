//! Which objects are examined, and how they move (`spec/hardened/H-14.md#requirements-motions`).

use crate::hardened::detection_history::{
    Seen, Usable, confirmed, has_stood, is_within, list_of, may_come_from, moved_evenly,
    nearest_to_reference, origin_limit, past, stands_within, usable, velocity,
    was_seen_to_come_from,
};
use crate::hardened::h14_fail_safe::times::a_tyre;
use crate::input::scene::{Detections, Object, Scene, Track, Tracks};
use crate::numbers::real::Real;
use crate::numbers::vector::Vector;
use crate::stages::distances::s_b;

/// An object at the time of its list, and its velocity.
#[derive(Clone, Debug)]
pub struct Motion {
    /// Its rectangle at the time of its list.
    pub object: Object,
    /// Now minus that time, s.
    pub age: Real,
    /// w, m/s.
    pub w: Vector,
    /// abs(w), m/s.
    pub speed: Real,
    /// w_least, its least speed at the time of its list, m/s.
    pub w_least: Real,
    /// What a witness names.
    pub named: Named,
}

/// Where a motion is from: a track, a detection as it stands, or a detection and the item d' of a list of
/// the history.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Named {
    /// Id of the track.
    pub track: Option<i64>,
    /// Index of the detection.
    pub detection: Option<usize>,
    /// Index of d' in its list.
    pub item: Option<usize>,
    /// Age of that list, ns.
    pub age_ns: Option<i64>,
}

impl Motion {
    /// One whose w is that at the time of its list.
    fn new(scene: &Scene, object: &Object, stamp_ns: i64, w: Vector, named: Named) -> Self {
        let age = Real::seconds(i128::from(scene.now_ns) - i128::from(stamp_ns));
        let speed = w.length();
        Self { object: object.clone(), age, w_least: speed.clone(), speed, w, named }
    }

    /// The same where w is the mean over the time dt before that of its list.
    fn over(self, scene: &Scene, dt: &Real) -> Self {
        Self { w_least: w_least(&self.speed, &a_tyre(&scene.parameters.a_b), dt), ..self }
    }

    /// r_b(t) = w_least t - a_tyre t^2 / 2 up to t = w_least / a_tyre, and s_tyre(w_least) from then on, m.
    pub fn r_b(&self, a_tyre: &Real, t: &Real) -> Real {
        if a_tyre * t <= self.w_least {
            &self.w_least * t - a_tyre * t.square() / Real::from_integer(2)
        } else {
            s_b(&self.w_least, a_tyre)
        }
    }

    /// r w / abs(w), m; 0 where w is.
    pub fn moved_by(&self, r: &Real) -> Vector {
        let squared = self.w.squared();
        if squared == Real::zero() {
            return self.w.clone();
        }
        self.w.scaled(&(r * &self.speed / squared))
    }
}

/// max(mean - a_tyre dt / 2, 0), m/s: no object is slower after a time dt that it drove with this mean.
pub fn w_least(mean: &Real, a_tyre: &Real, dt: &Real) -> Real {
    (mean - a_tyre * dt / Real::from_integer(2)).max(Real::zero())
}

/// All that is examined, in the order of the text.
pub fn all_motions(scene: &Scene) -> Vec<Motion> {
    let of_tracks = scene.tracks.iter().filter(|_| scene.tracks_current).flat_map(|list| {
        let motion = |track| of_track(scene, list, track);
        list.items.iter().map(motion)
    });
    let of_detections = scene.detections.iter().flat_map(|list| of_detections(scene, list));
    of_tracks.chain(of_detections).collect()
}

/// A track with its own velocity.
fn of_track(scene: &Scene, list: &Tracks, track: &Track) -> Motion {
    let (w, named) = (track.velocity.clone(), Named { track: Some(track.id), ..Named::default() });
    Motion::new(scene, &track.object, list.stamp_ns, w, named)
}

/// The detections as the CAV saw them move, also where they may stand, and those that nothing explains as
/// standing.
fn of_detections(scene: &Scene, list: &Detections) -> Vec<Motion> {
    let lists = usable(scene);
    let confirmed = confirmed(scene);
    let moving = pairs(scene, list, &lists, &confirmed).map(|pair| {
        let d = &list.items[pair.detection];
        let w = velocity(d, &pair.list.items[pair.item], &pair.list.dt);
        let named = Named {
            track: None,
            detection: Some(pair.detection),
            item: Some(pair.item),
            age_ns: i64::try_from(pair.list.age_ns).ok(),
        };
        Motion::new(scene, d, list.stamp_ns, w, named).over(scene, &pair.list.dt)
    });
    let unexplained = (0..list.items.len()).filter(|d| explained_by(&confirmed, *d).is_none());
    let standing = unexplained.map(|d| {
        let w = Vector { x: Real::zero(), y: Real::zero() };
        let named = Named { detection: Some(d), ..Named::default() };
        Motion::new(scene, &list.items[d], list.stamp_ns, w, named)
    });
    moving.chain(standing).collect()
}

/// The confirmed track whose detection it is.
fn explained_by<'a>(confirmed: &'a [(&Track, Seen)], d: usize) -> Option<&'a (&'a Track, Seen)> {
    confirmed.iter().find(|(_, seen)| seen.detection == Some(d))
}

/// The detections and items that are examined as moving.
pub fn pairs<'a>(
    scene: &'a Scene,
    list: &'a Detections,
    lists: &'a [Usable<'a>],
    confirmed: &'a [(&Track, Seen)],
) -> impl Iterator<Item = Pair<'a>> {
    let of_tracks = confirmed
        .iter()
        .flat_map(move |(track, seen)| of_confirmed(scene, lists, list, track, seen));
    let of_all = (0..list.items.len())
        .flat_map(move |d| of_detection(scene, lists, list, d, explained_by(confirmed, d)));
    of_tracks.chain(of_all)
}

/// An item of a list is taken of a detection d: where d stood, one at distance <= 0.3 m, or one from which d moved
/// evenly.
fn is_taken(scene: &Scene, lists: &[Usable], d: &Object, [k, item]: [usize; 2]) -> bool {
    is_within(scene, &d.frame.origin, &lists[k].items[item], &stands_within())
        || !has_stood(scene, lists, d)
        || moved_evenly(scene, lists, d, [k, item])
}

/// A detection d and an item d' of an earlier list, of which w = (d - d') / dt.
#[derive(Clone, Copy, Debug)]
pub struct Pair<'a> {
    /// Index of d.
    pub detection: usize,
    /// Index of d' in its list.
    pub item: usize,
    /// That list.
    pub list: &'a Usable<'a>,
}

/// The list of a confirmed track, and the items of it at distance <= theta_track_max + theta_velocity dt from its past.
pub fn origins(
    scene: &Scene,
    lists: &[Usable],
    track: &Track,
    seen: &Seen,
) -> Option<(usize, Vec<usize>)> {
    let k = list_of(lists, seen)?;
    let is_near = |item: &usize| is_near_past(scene, &lists[k], track, seen, *item);
    Some((k, (0..lists[k].items.len()).filter(is_near).collect()))
}

/// An item of a list is at distance <= theta_track_max + theta_velocity dt from the past of a track.
fn is_near_past(scene: &Scene, list: &Usable, track: &Track, seen: &Seen, item: usize) -> bool {
    let past = past(&seen.place, &track.velocity, &list.dt);
    is_within(scene, &past, &list.items[item], &origin_limit(scene, &list.dt))
}

/// The detection of a confirmed track and each of these items; where d stood, each of them that is taken.
fn of_confirmed<'a>(
    scene: &Scene,
    lists: &'a [Usable<'a>],
    detections: &Detections,
    track: &Track,
    seen: &Seen,
) -> Vec<Pair<'a>> {
    let Some((k, items)) = origins(scene, lists, track, seen) else { return Vec::new() };
    let Some(detection) = seen.detection else { return Vec::new() };
    let (d, list) = (&detections.items[detection], &lists[k]);
    let taken = items.into_iter().filter(|item| is_taken(scene, lists, d, [k, *item]));
    taken.map(|item| Pair { detection, item, list }).collect()
}

/// A detection d and each item d' of the reference list that is at distance <= theta_track_max from d (d may
/// stand), or that d may come from where it is unexplained, or was seen to come from where it is explained; where d
/// stood, of these those that are taken. Not those near the past of the track that explains d: of them each that is
/// taken is a pair with d already.
fn of_detection<'a>(
    scene: &Scene,
    lists: &'a [Usable<'a>],
    detections: &Detections,
    detection: usize,
    by: Option<&(&Track, Seen)>,
) -> Vec<Pair<'a>> {
    let Some((k, list)) = nearest_to_reference(lists.iter().enumerate()) else { return Vec::new() };
    let d = &detections.items[detection];
    let theta_track_max = &scene.parameters.theta_track_max;
    let comes_from = if by.is_some() { was_seen_to_come_from } else { may_come_from };
    let is_candidate = |item: &usize| {
        is_within(scene, &d.frame.origin, &list.items[*item], theta_track_max)
            || comes_from(scene, lists, d, [k, *item])
    };
    let of_list = by.filter(|(_, seen)| list_of(lists, seen) == Some(k));
    let is_of_track = |item: &usize| {
        of_list.is_some_and(|(track, seen)| is_near_past(scene, list, track, seen, *item))
    };
    let is_pair = |item: &usize| {
        is_taken(scene, lists, d, [k, *item]) && is_candidate(item) && !is_of_track(item)
    };
    (0..list.items.len()).filter(is_pair).map(|item| Pair { detection, item, list }).collect()
}
