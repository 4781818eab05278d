//! H-04: stages iii, iv and v look as far as the CAV needs to stop, beyond the end of the trajectory, too.

use std::ops::RangeInclusive;

use crate::input::scene::{Point, Scene};
use crate::numbers::real::Real;
use crate::numbers::vector::Frame;
use crate::stages::distances::s_b;

/// s_stop = e + v tau + a_max tau^2 / 2 + (v + a_max tau)^2 / (2 a_b), m.
pub fn s_stop(e: &Real, v_now: &Real, tau: &Real, a_max: &Real, a_b: &Real) -> Real {
    let reaction = v_now * tau + a_max * tau.square() / Real::from_integer(2);
    e + reaction + s_b(&(v_now + a_max * tau), a_b)
}

/// e: where the CAV is ahead of the first point, (p - first point) . first heading > 0, its distance
/// from there, m; else 0.
pub fn e(scene: &Scene, trajectory: &[Point]) -> Real {
    let first = &trajectory[0].pose;
    let driven = &scene.ego.position - &first.origin;
    let is_ahead = scene.reads.may_be_greater(&driven.dot(&first.direction), &Real::zero());
    if is_ahead { driven.length() } else { Real::zero() }
}

/// s_stop from the first point of the trajectory on, m.
pub fn s_stop_along(scene: &Scene, trajectory: &[Point]) -> Real {
    let p = &scene.parameters;
    s_stop(&e(scene, trajectory), &scene.ego.v_now, &p.tau, &p.a_max, &p.a_b)
}

/// The way from the first point to each point, m: the sum of max(u . heading, 0) over the steps u up
/// to it, the heading being that of the step's first point.
pub fn ways(trajectory: &[Point]) -> Vec<Real> {
    let mut ways = vec![Real::zero()];
    for step in trajectory.windows(2) {
        let u = &step[1].pose.origin - &step[0].pose.origin;
        let along = u.dot(&step[0].pose.direction).max(Real::zero());
        ways.push(ways[ways.len() - 1].clone() + along);
    }
    ways
}

/// Places of the CAV: points of the trajectory, and behind its end its last point moved on.
#[derive(Debug)]
pub struct Places<'a> {
    points: &'a [Point],
    beyond: Option<Beyond<'a>>,
}

/// The centre of the CAV at multiples of a length from the last pose.
#[derive(Debug)]
struct Beyond<'a> {
    last: &'a Point,
    center_offset: &'a Real,
    length: Real,
    multiples: RangeInclusive<i64>,
}

impl<'a> Places<'a> {
    /// Points of the trajectory alone.
    pub fn of(points: &'a [Point]) -> Self {
        Self { points, beyond: None }
    }

    /// How many there are.
    pub fn count(&self) -> i128 {
        self.points.len() as i128 + self.count_beyond()
    }

    /// How many of them are behind the end of the trajectory.
    pub fn count_beyond(&self) -> i128 {
        let beyond = self.beyond.as_ref().map(|beyond| &beyond.multiples);
        beyond.map_or(0, |k| i128::from(*k.end()) - i128::from(*k.start()) + 1)
    }

    /// How many of them are points of the trajectory: its first ones.
    pub fn count_points(&self) -> usize {
        self.points.len()
    }

    /// One after the other.
    pub fn iter(&self) -> impl Iterator<Item = Point> {
        let beyond = self.beyond.iter();
        let beyond = beyond.flat_map(|it| it.multiples.clone().map(|k| it.place(k)));
        self.points.iter().cloned().chain(beyond)
    }
}

impl Beyond<'_> {
    /// The last point with `center_offset` replaced by the k-th multiple.
    fn place(&self, k: i64) -> Point {
        let ahead = Real::from_integer(k.into()) * &self.length - self.center_offset;
        let origin = self.last.pose.point(&ahead, &Real::zero());
        let direction = self.last.pose.direction.clone();
        Point { t_ns: self.last.t_ns, pose: Frame { origin, direction } }
    }
}

/// The points with way <= (1 + 1e-6) max(s, s_stop), the first with way > (1 + 1e-6) s_stop, and the
/// places beyond the end of a trajectory that ends before s_stop.
pub fn places_to_s_stop<'a>(scene: &'a Scene, trajectory: &'a [Point], s: &Real) -> Places<'a> {
    places_within(scene, trajectory, s, &s_stop_along(scene, trajectory))
}

/// The points with way <= (1 + 1e-6) max(s, t), the first with way > (1 + 1e-6) t, and the places
/// beyond the end.
pub fn places_within<'a>(
    scene: &'a Scene,
    trajectory: &'a [Point],
    s: &Real,
    t: &Real,
) -> Places<'a> {
    let ways = ways(trajectory);
    let within = |s: &Real| {
        let horizon = s * (Real::from_integer(1) + Real::from_double(1e-6));
        ways.iter().filter(|way| scene.reads.may_be_at_most(way, &horizon)).count().max(1)
    };
    let count = within(s).max(within(t) + 1);
    let points = &trajectory[..count.min(trajectory.len())];
    Places { points, beyond: beyond(scene, trajectory) }
}

/// Each k/4 m above center_offset up to the first that is not below center_offset + s_stop - way; for
/// a CAV shorter than 1/4 m each multiple of its length.
fn beyond<'a>(scene: &'a Scene, trajectory: &'a [Point]) -> Option<Beyond<'a>> {
    let last = &trajectory[trajectory.len() - 1];
    let way = &ways(trajectory)[trajectory.len() - 1];
    let s_stop = s_stop_along(scene, trajectory);
    if !scene.reads.may_be_less(way, &s_stop) {
        return None;
    }
    let center_offset = &scene.ego.center_offset;
    let quarter = Real::from_integer(1) / Real::from_integer(4);
    let length = quarter.min(scene.ego.length.clone());
    let end = scene.reads.raised(&(center_offset + (s_stop - way)));
    let first = (center_offset / &length).floor() + 1;
    let last_k = -(-(end / &length)).floor();
    let multiples = first..=last_k.max(first);
    Some(Beyond { last, center_offset, length, multiples })
}
