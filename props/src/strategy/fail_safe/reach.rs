//! Paths at the bound of what tyres can do, and points that are nodes of the path, or just are not
//! (`spec/hardened/H-14.md#requirements-reach`).

use mufasa_model::input::cycle::{Cycle, Trajectory, TrajectoryPoint};

use super::super::base;
use super::super::draw::Draw;
use super::path::Path;
use super::shape;

/// A turn on the spot, where the CAV may stand: straight on from there `s_stop` is about as far as a path may be long (H-14.61).
fn long(draw: &mut Draw<'_>, cycle: &Cycle, path: &Path, side: f64) -> Trajectory {
    let (road, s_stop) = (shape::frame(cycle), base::s_stop(cycle));
    let first = (path.s_b() + draw.pick(&[0.01, 0.5, 0.9]) * (s_stop - path.s_b())).max(0.13);
    let slope = (s_stop - first) / draw.near(2.0 * s_stop + 1.0 - first);
    let angle = if draw.one_in(4) { 1.7 } else { slope.clamp(0.0, 1.0).acos() };
    let points = (0_i32..=32).map(|k| {
        let (x, y) = road.at(first, 0.0);
        let turned = side * angle * f64::from(k) / 32.0;
        let (cos, sin) = road.turn((turned.cos(), turned.sin()));
        TrajectoryPoint { t_ns: cycle.now_ns + i64::from(k), x, y, cos, sin }
    });
    Trajectory { stamp_ns: cycle.now_ns, points: points.collect() }
}

/// A trajectory beside the CAV that one place of its path, or its first point, decides.
pub fn cycle(draw: &mut Draw<'_>, cycle: &mut Cycle) {
    cycle.route = base::road(shape::frame(cycle), 20.0);
    (cycle.parameters.start_tolerance, cycle.parameters.lateral_tolerance) = (40.0, 20.0);
    let path = Path::of(cycle);
    let side = draw.pick(&[1.0, -1.0]);
    if draw.one_in(4) {
        return cycle.trajectory = Some(long(draw, cycle, &path, side));
    }
    let bound = |f: f64| 0.5 + 0.17 * f + 5.75 * path.last(f.min(path.s_b())).powi(2);
    let (first, aside) = match draw.below(4) {
        // Ahead by 1/8 m: too far aside for that, or for nothing else.
        0 => (draw.near(0.125), draw.pick(&[0.57, 0.3])),
        // Where the CAV may stand, to which nothing binds it.
        1 => (draw.near(path.s_b()).max(0.2), bound(path.s_b()) + 0.5),
        _ => {
            let first = draw.pick(&[0.2, 0.5, 0.9]) * path.s_b().max(0.3);
            (first, draw.near(bound(first)))
        }
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
