//! Objects at the thresholds of the low-level collision check: touching rectangles, centre
//! distances, horizons (`spec/3-stages.md#low-level-collision-check-llcc`).

use mufasa_model::input::cycle::{Cycle, Profile, TrajectoryPoint};

use super::base::{self, Frame, Obstacle, a_tyre, s_stop, to_ns};
use super::draw::Draw;
use super::end;

/// How far a stage looks, rounded, m.
#[derive(Clone, Copy, Debug)]
pub struct Horizon {
    /// Rounded, m.
    pub metres: f64,
}

/// An object that decides a cycle with this horizon.
pub fn decisive(draw: &mut Draw<'_>, cycle: &mut Cycle, horizon: Horizon) -> Obstacle {
    let in_path = end::is_examined(cycle);
    if in_path && draw.one_in(4) {
        return end::obstacle(draw, cycle);
    }
    match draw.below(8) {
        0..=2 => touching(draw, cycle),
        3 => corner_to_corner(draw, cycle),
        4 => far_centre(draw, cycle),
        // H-14 finds what stands so near wherever the horizon is.
        _ if in_path && horizon.metres <= s_stop(cycle) + 1e-3 => end::obstacle(draw, cycle),
        _ => at_horizon(draw, cycle, horizon),
    }
}

/// The rectangle of the CAV at a trajectory point, as a frame around its centre.
pub fn footprint(cycle: &Cycle, index: usize) -> Frame {
    let at = |point: &TrajectoryPoint| {
        let TrajectoryPoint { x, y, cos, sin, .. } = *point;
        let (x, y) = Frame { x, y, cos, sin }.at(cycle.ego.center_offset, 0.0);
        Frame { x, y, cos, sin }
    };
    let points = cycle.trajectory.as_ref().map_or(&[][..], |list| &list.points);
    points.get(index).map_or(Frame { x: 0.0, y: 0.0, cos: 1.0, sin: 0.0 }, at)
}

/// A rectangle whose nearest corner or side lies on a side of the CAV's first rectangle: behind
/// it or beside it, so that later points touch no more than the first.
fn touching(draw: &mut Draw<'_>, cycle: &Cycle) -> Obstacle {
    let ego = footprint(cycle, 0);
    let (half_l, half_w) = (0.5 * cycle.ego.length, 0.5 * cycle.ego.width);
    let size = draw.pick(&[(4.5, 1.8), (2.0, 2.0), (0.6, 0.6), (0.01, 0.01), (8.0, 2.5)]);
    let turned = draw.direction();
    let (normal, reach, side) = match draw.below(3) {
        0 => ((-1.0, 0.0), half_l, half_w),
        1 => ((0.0, 1.0), half_w, half_l),
        _ => ((0.0, -1.0), half_w, half_l),
    };
    // The object's corner farthest against the normal, from the object's centre.
    let sign = |value: f64| if value > 0.0 { -0.5 } else { 0.5 };
    let forward = turned.0 * normal.0 + turned.1 * normal.1;
    let leftward = -turned.1 * normal.0 + turned.0 * normal.1;
    let (a, b) = (sign(forward) * size.0, sign(leftward) * size.1);
    let corner = (a * turned.0 - b * turned.1, a * turned.1 + b * turned.0);
    let aside = draw.pick(&[0.0, 0.5, -0.5, 0.999]) * side;
    let reach = draw.near(reach);
    let tangent = (-normal.1, normal.0);
    let at = (
        normal.0 * reach + tangent.0 * aside - corner.0,
        normal.1 * reach + tangent.1 * aside - corner.1,
    );
    obstacle(ego, at, turned, size, normal)
}

/// Parallel rectangles that touch with one corner each, or miss by a little in one axis.
fn corner_to_corner(draw: &mut Draw<'_>, cycle: &Cycle) -> Obstacle {
    let ego = footprint(cycle, 0);
    let size = draw.pick(&[(4.0, 2.0), (2.0, 2.0), (6.5, 2.5)]);
    let turned = draw.pick(&[(1.0, 0.0), (-1.0, 0.0)]);
    let a = draw.near(0.5 * (cycle.ego.length + size.0));
    let b = draw.near(0.5 * (cycle.ego.width + size.1));
    let side = draw.pick(&[1.0, -1.0]);
    obstacle(ego, (-a, side * b), turned, size, (-1.0, 0.0))
}

/// A long object that overlaps the first rectangle with its centre near `theta_obj` behind.
fn far_centre(draw: &mut Draw<'_>, cycle: &Cycle) -> Obstacle {
    let ego = footprint(cycle, 0);
    let distance = draw.near(cycle.parameters.theta_obj);
    let length = 2.0 * distance + draw.pick(&[0.0, -1.0, 3.0]);
    let (cos, sin) = draw.pick(&[(-1.0, 0.0), (-0.8, 0.6), (-0.96, -0.28)]);
    let at = (distance * cos, distance * sin);
    obstacle(ego, at, (cos, sin), (length.max(0.5), 2.5), (-1.0, 0.0))
}

/// A new trajectory with one point at the horizon, and an object that only this one hits.
pub fn at_horizon(draw: &mut Draw<'_>, cycle: &mut Cycle, horizon: Horizon) -> Obstacle {
    let hardened = cycle.profile == Profile::HARDENED;
    let speed = cycle.ego.speed;
    let spacing = (0.15 * speed).clamp(0.05, 0.8 * cycle.ego.length);
    let reach = draw.near(horizon.metres).max(0.0);
    let most = if hardened { 40 } else { draw.between(2, 8) };
    let steps = base::count(reach / spacing).clamp(1, most);
    let behind = draw.between(1, 2);
    let hit = steps;
    let (now_ns, ego) = (cycle.now_ns, cycle.ego.clone());
    let road = Frame { x: ego.x, y: ego.y, cos: ego.cos, sin: ego.sin };
    // A wider one leaves the road.
    let zigzag = !hardened && 0.28 * reach / (steps as f64) < 5.5 && draw.one_in(3);
    let pace = 1.0 / speed.max(0.5);
    // H-11 does not let a trajectory take so long. What moves so long needs room.
    let may_last = !hardened && base::has_room(road);
    let slowly = if may_last && draw.one_in(4) { draw.range(0.0, 6.0).exp2() } else { 1.0 };
    let all = reach + behind as f64 * spacing;
    let pace = pace * slowly.min(50.0 / (all * pace)).max(1.0);
    let Some(trajectory) = &mut cycle.trajectory else {
        return touching(draw, cycle);
    };
    trajectory.points.clear();
    let tail = if hardened { steps + behind + braking_steps(speed) } else { steps + behind };
    let slant = |i: usize| if i % 2 == 1 { 1.0 } else { 0.0 };
    for i in 0..=tail {
        let arc = if i <= steps {
            reach * i as f64 / steps as f64
        } else {
            reach + (i - steps) as f64 * spacing
        };
        let step = reach / steps as f64;
        let (along, aside) = if zigzag { (0.96 * arc, 0.28 * step * slant(i)) } else { (arc, 0.0) };
        let (x, y) = road.at(along, aside);
        let t_ns = now_ns + to_ns(arc * pace);
        let Frame { cos, sin, .. } = road;
        trajectory.points.push(TrajectoryPoint { t_ns, x, y, cos, sin });
    }
    later(&mut trajectory.points);
    // Half a step of overlap at the hit, half a step free before it.
    let before = footprint(cycle, hit - 1);
    let at = footprint(cycle, hit);
    let advance = ((at.x - before.x) * road.cos + (at.y - before.y) * road.sin).max(1e-3);
    let size = (1.0, 3.0);
    let ahead = 0.5 * (ego.length + size.0) - 0.5 * advance;
    let mut found = obstacle(at, (ahead, 0.0), (1.0, 0.0), size, (1.0, 0.0));
    found.point = hit;
    found
}

/// Steps of 150 ms that cover the braking time at a deceleration of 4 m/s^2 or more.
fn braking_steps(speed: f64) -> usize {
    base::count(speed / 4.0 / 0.15)
}

/// Makes times strictly increase.
fn later(points: &mut [TrajectoryPoint]) {
    let mut last = i64::MIN;
    for point in points {
        point.t_ns = point.t_ns.max(last.saturating_add(1));
        last = point.t_ns;
    }
}

/// The horizon of iii (`s_CAV`).
pub fn horizon_of_tracks(cycle: &Cycle) -> Horizon {
    Horizon { metres: cycle.parameters.safety_time * cycle.ego.speed }
}

/// The horizon of iv (`s_valid`).
pub fn horizon_of_detections(cycle: &Cycle) -> Horizon {
    if cycle.lead.is_some() { Horizon { metres: s_follow(cycle) } } else { horizon_of_grid(cycle) }
}

/// The horizon of v (`s_b`).
pub fn horizon_of_grid(cycle: &Cycle) -> Horizon {
    Horizon { metres: cycle.ego.speed.powi(2) / (2.0 * cycle.parameters.a_b) }
}

/// `s_follow`, rounded, m; the lead counts as standing when there is none.
pub fn s_follow(cycle: &Cycle) -> f64 {
    let (p, v) = (&cycle.parameters, cycle.ego.speed);
    let lead = cycle.lead.as_ref().map_or(0.0, |lead| lead.speed);
    ((v * v - lead * lead) / (2.0 * p.a_b)).max(0.0) + p.safety_time * v
}

/// `s_react + s_since`, rounded, m; without a lead that of one that stands and is measured now.
pub fn least_gap(cycle: &Cycle) -> f64 {
    let (speed, stamp_ns) =
        cycle.lead.as_ref().map_or((0.0, cycle.now_ns), |lead| (lead.speed, lead.stamp_ns));
    let (a_tyre, age) = (a_tyre(&cycle.parameters), (cycle.now_ns - stamp_ns) as f64 / 1e9);
    let s_react = (s_stop(cycle) - speed * speed / (2.0 * a_tyre)).max(0.0);
    s_react + cycle.ego.speed * age + a_tyre * age * age / 2.0
}

/// The object at a place of the CAV's rectangle's frame.
fn obstacle(
    ego: Frame,
    at: (f64, f64),
    turned: (f64, f64),
    size: (f64, f64),
    away: (f64, f64),
) -> Obstacle {
    let (x, y) = ego.at(at.0, at.1);
    let (cos, sin) = ego.turn(turned);
    let norm = cos.hypot(sin);
    // Two directions that are not quite unit vectors multiply out of the domain.
    let (cos, sin) = if (norm - 1.0).abs() > 4e-7 { (cos / norm, sin / norm) } else { (cos, sin) };
    let size = (size.0.clamp(0.01, 100.0), size.1);
    Obstacle { frame: Frame { x, y, cos, sin }, size, point: 0, away: ego.turn(away) }
}

/// A road so wide that no trajectory of these generators leaves it.
pub fn widen(cycle: &mut Cycle, frame: Frame) {
    let end = base::end_of_road(&cycle.ego, &cycle.parameters);
    cycle.route = base::road_to(frame, 6.0, end);
}
