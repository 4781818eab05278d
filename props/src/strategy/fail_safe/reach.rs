//! Paths at the bound of what the CAV can drive, and points that are nodes of the path, or just are not
//! (`spec/hardened/H-14.md#requirements-reach`).

use mufasa_model::input::cycle::{Cycle, Trajectory, TrajectoryPoint};

use super::super::base;
use super::super::draw::Draw;
use super::path::{circle, lever};
use super::shape;

/// A slow CAV weaves, no more than a slide may be, and the path is about as long as it may be at `s_stop` (H-14.61).
fn long(draw: &mut Draw<'_>, cycle: &mut Cycle, side: f64) -> Vec<TrajectoryPoint> {
    (cycle.ego.speed, cycle.parameters.tau) = (draw.pick(&[0.1, 0.5]), 0.5);
    let moves = draw.pick(&[16_u8, 20]);
    let aside = draw.near(base::s_stop(cycle) + 1.0) / f64::from(2 * moves - 1);
    let turn = |k: u8| {
        let aside = if k == 0 { 0.0 } else { side * aside };
        (0.2 + 0.02 * f64::from(k), if k.is_multiple_of(2) { -aside } else { aside }, 0.0)
    };
    [(0.0, 0.0, 0.0)].into_iter().chain((0..=moves).map(turn)).map(|it| point(cycle, it)).collect()
}

/// A heading that is turned about as far as one may be where it is (H-14.62, H-14.64), and back.
fn turned(draw: &mut Draw<'_>, cycle: &Cycle, side: f64) -> Vec<TrajectoryPoint> {
    let (first, aside) = (draw.pick(&[0.3, 0.7, 2.0, 4.0]), draw.pick(&[0.0, 0.1]));
    let swung = circle(cycle, first)[1] + cycle.parameters.lateral_tolerance / lever(cycle);
    let sine = draw.near(f64::min(0.17 + (2.0 * aside + 0.5) / first, swung));
    let angle = sine.clamp(0.0, 1.0).asin();
    let turn = |k: i32| (first, aside, side * angle * (1.0 - f64::from(k.abs()) / 32.0));
    let start = [(0.0, 0.0, 0.0), (0.5 * first, 0.5 * aside, 0.0)];
    let rest = (-32..=32).map(turn).chain([(first + 0.5, aside, 0.0)]);
    start.into_iter().chain(rest).map(|it| point(cycle, it)).collect()
}

/// Ahead of the CAV, to the left of it, and turned to the left; its time comes later.
fn point(cycle: &Cycle, (ahead, aside, turned): (f64, f64, f64)) -> TrajectoryPoint {
    let road = shape::frame(cycle);
    let ((x, y), (cos, sin)) = (road.at(ahead, aside), road.turn((turned.cos(), turned.sin())));
    TrajectoryPoint { t_ns: 0, x, y, cos, sin }
}

/// A trajectory beside the CAV that one place of its path, or its first point, decides.
pub fn cycle(draw: &mut Draw<'_>, cycle: &mut Cycle) {
    cycle.route = base::road(shape::frame(cycle), 20.0);
    (cycle.parameters.start_tolerance, cycle.parameters.lateral_tolerance) =
        (40.0, draw.pick(&[0.5, 2.0]));
    let side = draw.pick(&[1.0, -1.0]);
    if draw.one_in(3) {
        let mut points =
            if draw.one_in(2) { long(draw, cycle, side) } else { turned(draw, cycle, side) };
        for (point, k) in points.iter_mut().zip(0..) {
            point.t_ns = cycle.now_ns + 20_000_000 * k;
        }
        cycle.trajectory = Some(Trajectory { stamp_ns: cycle.now_ns, points });
        return;
    }
    let bound = |f: f64| cycle.parameters.lateral_tolerance + circle(cycle, f)[0];
    let s_stop = base::s_stop(cycle);
    let (first, aside) = if draw.below(3) == 0 {
        // Ahead by 1/8 m.
        (draw.near(0.125), draw.near(bound(0.125)))
    } else {
        let first = draw.pick(&[0.2, 0.5, 0.9]) * s_stop.max(0.3);
        (first, draw.near(bound(first)))
    };
    let road = shape::frame(cycle);
    let step = draw.pick(&[0.9, 0.5]) * cycle.ego.length.min(4.0);
    let count = draw.between(1, 4);
    let point = |k: usize| {
        let (x, y) = road.at(first + step * k as f64, side * aside);
        let t_ns = cycle.now_ns + 200_000_000 * i64::try_from(k).unwrap_or(0);
        TrajectoryPoint { t_ns, x, y, cos: road.cos, sin: road.sin }
    };
    let points = (0..count).map(point).collect();
    cycle.trajectory = Some(Trajectory { stamp_ns: cycle.now_ns, points });
}
