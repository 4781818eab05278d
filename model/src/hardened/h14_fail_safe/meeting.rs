//! Where an object that does not follow the CAV meets it (`spec/7-fail-safe.md#meeting`).

use std::cell::LazyCell;

use crate::hardened::h14_fail_safe::motions::{Motion, Named, motions};
use crate::hardened::h14_fail_safe::path::places;
use crate::hardened::h14_fail_safe::times::{Driving, Window, window};
use crate::input::scene::{Object, Point, Scene};
use crate::numbers::polyline::{Segment, beside};
use crate::numbers::real::Real;
use crate::numbers::rectangle::{Rectangle, is_swept_over, is_swept_over_between};
use crate::numbers::vector::{Frame, Vector};
use crate::report::{Rule, Witness};
use crate::stages::llcc::cav;

/// The first place at which a motion that does not follow sweeps over the CAV in its window, and of
/// these motions the first.
pub fn failure(scene: &Scene, trajectory: &[Point]) -> Option<Witness> {
    let beside_route = LazyCell::new(|| BesideRoute::new(scene, trajectory));
    let with_comes_across = |motion: Motion| {
        let comes_across = comes_across(scene, &motion);
        (motion, comes_across)
    };
    let follows = |motion: &Motion, comes_across: bool| {
        follows(scene, motion, comes_across, || beside_route.has_own_lane(scene, motion))
    };
    let mut examined: Vec<(Motion, bool)> =
        motions(scene).into_iter().map(with_comes_across).collect();
    examined.retain(|(motion, comes_across)| !follows(motion, *comes_across));
    let driving = Driving::of(scene);
    places(scene, trajectory).enumerate().find_map(|(k, place)| {
        let window = window(&scene.reads, &driving, &place.way_before, place.way_after.as_ref());
        let cav = wider(scene, trajectory, &place.pose);
        let (motion, _) = examined.iter().find(|(motion, comes_across)| {
            sweeps_over(scene, &cav, &window, motion, *comes_across)
        })?;
        let Named { track, detection, item, age_ns } = motion.named;
        let witness = Witness::new(Rule::FailSafe, &place.way, &driving.s_stop());
        let witness = Witness { track, detection, item, age_ns, ..witness };
        Some(witness.at_point(trajectory.len() + k))
    })
}

/// The rectangle of the CAV at a pose as in LLCC, with a half width that is greater by
/// a = abs((p - x_0) x h_0): a trajectory that begins beside the CAV does not say where it joins.
fn wider(scene: &Scene, trajectory: &[Point], pose: &Frame) -> Rectangle {
    let Frame { origin: x_0, direction: h_0 } = &trajectory[0].pose;
    let a = (&scene.ego.position - x_0).cross(h_0).abs();
    let cav = cav(scene, pose);
    let half_width = &cav.half_width + &a;
    Rectangle { half_width, ..cav }.with_halves(|half| scene.reads.raised(half))
}

/// Over the window, which ends at T + t_yield + abs(w) / (2 a_yield) where the CAV may stand, and at T
/// where the object comes across, the object sweeps over a point of the CAV's rectangle.
fn sweeps_over(
    scene: &Scene,
    cav: &Rectangle,
    window: &Window,
    motion: &Motion,
    comes_across: bool,
) -> bool {
    let p = &scene.parameters;
    let t_stop = Driving::of(scene).t_stop();
    let end = match &window.end {
        Some(last) => last.clone(),
        None if comes_across => t_stop,
        None => t_stop + &p.t_yield + &motion.speed / (Real::from_integer(2) * &p.a_yield),
    };
    let least = motion.r_b(&p.a_b, &(&motion.age + &window.begin));
    let most = &motion.speed * (&motion.age + end);
    let between = [least, most].map(|r| motion.moved_by(&r));
    is_swept_over_between(cav, &motion.object.rectangle(), &motion.w, &between)
}

/// w is not 0, and the rectangle of the CAV at p, half length and half width less by 0.3 m, shares a point
/// with the object as it is now and goes on.
pub fn comes_across(scene: &Scene, motion: &Motion) -> bool {
    let inner = Real::from_double(0.3);
    let cav = cav(scene, &p(scene)).with_halves(|half| scene.reads.lowered(&(half - &inner)));
    motion.w.squared() > Real::zero() && is_swept_over(&cav, &now(motion).rectangle(), &motion.w)
}

/// w . h > 0, all of it is behind the CAV's rear, and it comes across with abs(w x h) <= w . h, or
/// abs(w x h) <= 0.105 w . h and it `has_own_lane`.
pub fn follows(
    scene: &Scene,
    motion: &Motion,
    comes_across: bool,
    has_own_lane: impl FnOnce() -> bool,
) -> bool {
    let (reads, h) = (&scene.reads, &scene.ego.heading);
    let (along, across) = (motion.w.dot(h), motion.w.cross(h).abs());
    let narrow = Real::from_double(0.105) * &along;
    reads.greater(&along, &Real::zero())
        && is_behind(scene, motion)
        && (comes_across && reads.at_most(&across, &along)
            || reads.at_most(&across, &narrow) && has_own_lane())
}

/// All of its rectangle where it is now is behind the CAV's rear:
/// (c - c_CAV) . h + (abs(dir . h) length + abs(dir x h) width) / 2 < - L / 2.
fn is_behind(scene: &Scene, motion: &Motion) -> bool {
    let (h, two) = (&scene.ego.heading, Real::from_integer(2));
    let Object { frame: Frame { origin: c, direction: dir }, length, width } = now(motion);
    let c_cav = cav(scene, &p(scene)).frame.origin;
    let half = (dir.dot(h).abs() * length + dir.cross(h).abs() * width) / &two;
    scene.reads.less(&((&c - &c_cav).dot(h) + half), &-(&scene.ego.length / two))
}

/// The places of the CAV beside the reference path.
#[derive(Debug)]
pub struct BesideRoute {
    path: Vec<Segment>,
    /// Distance of each place to the reference path, m.
    distances: Vec<Real>,
    /// No place lies beyond an end of an open route.
    is_within_ends: bool,
}

impl BesideRoute {
    /// That of the places of a trajectory.
    pub fn new(scene: &Scene, trajectory: &[Point]) -> Self {
        let path = scene.route.reference_path();
        let places = || places(scene, trajectory).map(|place| place.pose.origin);
        Self {
            distances: places().map(|place| beside(&place, &path).distance).collect(),
            is_within_ends: places().all(|place| is_within_ends(scene, &path, &place)),
            path,
        }
    }

    /// The distance of its centre, where it is now, to the reference path differs from that of each
    /// place by more than (W + abs(dir x h) length + abs(dir . h) width) / 2, and neither it nor a place
    /// lies beyond an end.
    pub fn has_own_lane(&self, scene: &Scene, motion: &Motion) -> bool {
        let h = &scene.ego.heading;
        let Object { frame: Frame { origin: c, direction: dir }, length, width } = now(motion);
        let widths = &scene.ego.width + dir.cross(h).abs() * length + dir.dot(h).abs() * width;
        let (apart, of_c) = (widths / Real::from_integer(2), beside(&c, &self.path).distance);
        let is_apart = |place: &Real| scene.reads.greater(&(&of_c - place).abs(), &apart);
        self.is_within_ends
            && is_within_ends(scene, &self.path, &c)
            && self.distances.iter().all(is_apart)
    }
}

/// Of an open route (x - end) . (neighbour of the end - end) > 0 for both end points of the reference
/// path.
fn is_within_ends(scene: &Scene, path: &[Segment], x: &Vector) -> bool {
    let ([first, second], [before_last, last]) = (&path[0], &path[path.len() - 1]);
    let is_inside = |(end, neighbour): (&Vector, &Vector)| {
        scene.reads.greater(&(x - end).dot(&(neighbour - end)), &Real::zero())
    };
    scene.route.closed || [(first, second), (last, before_last)].into_iter().all(is_inside)
}

/// The object where it is now, moved by w age.
fn now(motion: &Motion) -> Object {
    let Object { frame: Frame { origin, direction }, .. } = &motion.object;
    let origin = origin + &motion.w.scaled(&motion.age);
    Object { frame: Frame { origin, direction: direction.clone() }, ..motion.object.clone() }
}

/// The pose of the CAV.
fn p(scene: &Scene) -> Frame {
    Frame { origin: scene.ego.position.clone(), direction: scene.ego.heading.clone() }
}
