//! Things that the CAV may not wait for, at the thresholds of H-13 (c)
//! (`spec/3-stages.md#hardened-profile`): they are met behind what is examined of every pair.

use mufasa_model::input::cycle::{Cycle, TrajectoryPoint};

use super::base::{self, Frame, Obstacle, seconds, to_ns};
use super::draw::Draw;
use super::obstacle::{footprint, horizon_of_moving};

/// What decides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Decides {
    /// Whether the thing is met.
    Meeting,
    /// Whether the CAV may wait at the last point that is examined of every pair.
    Waiting,
    /// Whether it may wait at the first point.
    First,
}

/// A trajectory that goes on behind what is examined of every pair, and a thing that would be met
/// there; its velocity, m/s.
pub fn decisive(draw: &mut Draw<'_>, cycle: &mut Cycle) -> (Obstacle, (f64, f64)) {
    let last = drive_on(draw, cycle);
    let point = last + draw.between(1, 3);
    let [first, before, met] = [0, last, point].map(|i| footprint(cycle, i));
    let decides = draw.pick(&[Decides::Meeting, Decides::Waiting, Decides::First]);
    let size = draw.pick(&[(4.5, 1.8), (4.0, 2.0), (8.0, 2.5), (0.6, 0.6)]);
    let half = (0.5 * cycle.ego.length, 0.5 * cycle.ego.width);
    let (cos, sin, speed) = match decides {
        Decides::Meeting | Decides::Waiting => across(draw),
        Decides::First => {
            let passes = draw.range(0.2, 1.8) * (half.1 + 0.5 * size.1);
            along(draw, (passes / distance(first, met)).clamp(-0.9, 0.9), cycle.ego.speed)
        }
    };
    // It goes along its frame; its own direction is another at times.
    let way = Frame { cos, sin, ..met };
    let (cos, sin) = met.turn((way.cos, way.sin));
    let norm = cos.hypot(sin);
    let way = Frame { cos: cos / norm, sin: sin / norm, ..met };
    let turned = match decides {
        Decides::Waiting | Decides::First if draw.one_in(4) => draw.direction(),
        _ => (way.cos, way.sin),
    };
    let thing = Frame { x: met.x, y: met.y, cos: turned.0, sin: turned.1 };
    let half_of_thing = (0.5 * size.0, 0.5 * size.1);
    let left = (-way.sin, way.cos);
    // How far apart the centres are when the two touch, along and across its way.
    let apart =
        |cav: Frame, axis: (f64, f64)| reach(cav, half, axis) + reach(thing, half_of_thing, axis);
    let across_of = |from: Frame, to: Frame| (to.x - from.x) * left.0 + (to.y - from.y) * left.1;
    let (along, aside) = match decides {
        Decides::Meeting => {
            let (most, moved) = (apart(before, left), across_of(before, met));
            let aside = draw.range(-0.9, 0.9) * (most - 0.5 * moved.abs()).max(0.0);
            (-draw.near(apart(met, (way.cos, way.sin))), aside - 0.5 * moved)
        }
        Decides::Waiting | Decides::First => {
            let at = if decides == Decides::First { first } else { before };
            let moved = across_of(at, met);
            let aside = draw.near(apart(at, left)).copysign(moved) - moved;
            (draw.range(-0.5, 0.5) * apart(met, (way.cos, way.sin)), aside)
        }
    };
    let (x, y) = way.at(along, aside);
    let away = (-way.cos, -way.sin);
    let found = Obstacle { frame: Frame { x, y, ..thing }, size, point, away };
    (found, (speed * way.cos, speed * way.sin))
}

/// A straight trajectory, or one along an arc, at constant speed; the index of the last point that is
/// examined of every pair.
fn drive_on(draw: &mut Draw<'_>, cycle: &mut Cycle) -> usize {
    if cycle.ego.speed < 2.0 {
        cycle.ego.speed = draw.pick(&[5.0, 8.0, 10.0]);
    }
    let speed = cycle.ego.speed;
    let step_s = f64::min(draw.pick(&[0.1, 0.2, 0.15]), 0.9 * cycle.ego.length / speed);
    let (step_s, step) = (seconds(to_ns(step_s)), speed * seconds(to_ns(step_s)));
    let last = base::count(horizon_of_moving(cycle).metres / step + draw.range(0.0, 0.9));
    let count = last + 5 + base::count(speed / cycle.parameters.a_b / step_s);
    let whole = step * count as f64;
    // At most 3.5 m aside, at most 4 m/s^2.
    let radius = (whole * whole / 7.0).max(speed * speed / 4.0).max(15.0);
    let curvature = draw.pick(&[0.0, 0.0, 1.0 / radius, -1.0 / radius]);
    let (now_ns, ego) = (cycle.now_ns, &cycle.ego);
    let road = Frame { x: ego.x, y: ego.y, cos: ego.cos, sin: ego.sin };
    let point = |i: usize| {
        let arc = step * i as f64;
        let (cos, sin) = ((curvature * arc).cos(), (curvature * arc).sin());
        let on_arc =
            if curvature == 0.0 { (arc, 0.0) } else { (sin / curvature, (1.0 - cos) / curvature) };
        let ((x, y), (cos, sin)) = (road.at(on_arc.0, on_arc.1), road.turn((cos, sin)));
        TrajectoryPoint { t_ns: now_ns + to_ns(step_s * i as f64), x, y, cos, sin }
    };
    if let Some(trajectory) = &mut cycle.trajectory {
        trajectory.points = (0..=count).map(point).collect();
    }
    last
}

/// Across the CAV's way, in its frame, and a speed, m/s.
fn across(draw: &mut Draw<'_>) -> (f64, f64, f64) {
    let side = draw.pick(&[1.0, -1.0]);
    let (cos, sin) = draw.pick(&[(0.0, 1.0), (0.0, 1.0), (0.6, 0.8), (-0.6, 0.8), (-0.28, 0.96)]);
    (cos, side * sin, draw.pick(&[8.0, 3.0, 15.0, 25.0, 60.0]))
}

/// Nearly along the CAV's way and faster, or against it.
fn along(draw: &mut Draw<'_>, sin: f64, speed: f64) -> (f64, f64, f64) {
    let sin = sin * draw.pick(&[1.0, -1.0]);
    let cos = (1.0 - sin * sin).sqrt();
    if draw.one_in(2) {
        (cos, sin, speed + draw.pick(&[8.0, 15.0, 40.0]))
    } else {
        (-cos, sin, draw.pick(&[8.0, 3.0, 15.0]))
    }
}

/// How far a rectangle reaches from its centre along an axis, m.
fn reach(frame: Frame, (l, w): (f64, f64), axis: (f64, f64)) -> f64 {
    let Frame { cos, sin, .. } = frame;
    l * (cos * axis.0 + sin * axis.1).abs() + w * (cos * axis.1 - sin * axis.0).abs()
}

fn distance(a: Frame, b: Frame) -> f64 {
    (a.x - b.x).hypot(a.y - b.y)
}
