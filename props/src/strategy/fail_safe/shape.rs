//! Paths of every shape (`spec/hardened/H-14.md#requirements-the-path`).

use mufasa_model::input::cycle::{Cycle, Trajectory, TrajectoryPoint};

use super::super::base::{self, Frame};
use super::super::draw::Draw;

/// A path that ends early, begins elsewhere, stands for a while, bends, or is a CAV's of another size.
pub fn draw(draw: &mut Draw<'_>, cycle: &mut Cycle) {
    match draw.below(10) {
        0 | 1 => {}
        2 => shorten(draw, cycle),
        3 => shift(draw, cycle),
        4 => stand(draw, cycle),
        5 => bend(draw, cycle),
        6 => {
            bend(draw, cycle);
            shift(draw, cycle);
        }
        7 => weave(draw, cycle),
        8 => turn(draw, cycle),
        _ => resize(draw, cycle),
    }
}

fn points(cycle: &mut Cycle) -> &mut Vec<TrajectoryPoint> {
    let stamp_ns = cycle.now_ns;
    let empty = || Trajectory { stamp_ns, points: Vec::new() };
    &mut cycle.trajectory.get_or_insert_with(empty).points
}

/// Cuts the trajectory at `s_stop`, and divides its ways between two points into about equal parts, 1000 in all.
pub fn divide(cycle: &mut Cycle) {
    let (s_stop, Frame { x, y, .. }) = (base::s_stop(cycle), frame(cycle));
    let points = points(cycle);
    points.retain(|point| (point.x - x).hypot(point.y - y) < s_stop);
    let between = |[from, to]: [&TrajectoryPoint; 2], share: f64| {
        let (x, y) = (from.x + share * (to.x - from.x), from.y + share * (to.y - from.y));
        let t_ns = from.t_ns + base::to_ns(share * base::seconds(to.t_ns - from.t_ns));
        TrajectoryPoint { t_ns, x, y, ..from.clone() }
    };
    let ways: Vec<_> = points.windows(2).map(|pair| [pair[0].clone(), pair[1].clone()]).collect();
    let first = |way: usize| 1000 * way / ways.len();
    let divided = ways.iter().enumerate().flat_map(|(way, [from, to])| {
        let parts = first(way + 1) - first(way);
        (0..parts).map(move |part| between([from, to], part as f64 / parts as f64))
    });
    let last = points.last().cloned();
    *points = divided.chain(last).collect();
}

/// Ends anywhere, at least behind its first point.
fn shorten(draw: &mut Draw<'_>, cycle: &mut Cycle) {
    let points = points(cycle);
    points.truncate(draw.between(1, points.len()));
}

/// Begins ahead of the CAV, behind it or beside it.
fn shift(draw: &mut Draw<'_>, cycle: &mut Cycle) {
    let along = draw.pick(&[1.5, -1.5, 0.3, -0.3, 0.2, 0.0]);
    let aside = draw.pick(&[0.0, 0.3, -0.3, 0.45, -0.1]);
    let Frame { x, y, .. } = frame(cycle);
    let (to_x, to_y) = frame(cycle).at(along, aside);
    if along < -0.5 {
        cycle.parameters.start_tolerance = 3.0;
    }
    for point in points(cycle) {
        (point.x, point.y) = (point.x - x + to_x, point.y - y + to_y);
    }
}

/// Stands at a point, or comes back a little, for some steps.
fn stand(draw: &mut Draw<'_>, cycle: &mut Cycle) {
    let back = draw.pick(&[0.0, 0.01, 0.019]);
    let (count, Frame { cos, sin, .. }) = (draw.between(1, 3), frame(cycle));
    let points = points(cycle);
    let at = draw.below(points.len());
    let place = points[at].clone();
    for _ in 0..count {
        let (x, y) = (place.x - back * cos, place.y - back * sin);
        points.insert(at + 1, TrajectoryPoint { x, y, ..place.clone() });
    }
    let from = place.t_ns;
    for (point, step) in points[at..].iter_mut().zip(0..) {
        point.t_ns = from + 200_000_000 * step;
    }
}

/// An arc on a wide road, in the same steps.
fn bend(draw: &mut Draw<'_>, cycle: &mut Cycle) {
    let curvature = draw.pick(&[0.01, -0.02, 0.05, -0.1]);
    let frame = frame(cycle);
    let speed = cycle.ego.speed;
    let points = points(cycle);
    let (mut at, mut heading, mut before) = ((0.0, 0.0), 0.0_f64, points[0].t_ns);
    for point in points {
        let step = speed * base::seconds(point.t_ns - before);
        before = point.t_ns;
        let along = heading + 0.5 * curvature * step;
        at = (at.0 + step * along.cos(), at.1 + step * along.sin());
        heading += curvature * step;
        (point.x, point.y) = frame.at(at.0, at.1);
        (point.cos, point.sin) = frame.turn((heading.cos(), heading.sin()));
    }
    cycle.route = base::road(frame, 30.0);
}

/// A turn at a junction, which is farther than `s_stop` from the CAV before it is as far ahead.
fn turn(draw: &mut Draw<'_>, cycle: &mut Cycle) {
    let (speed, radius) = draw.pick(&[(5.0, 5.0), (6.0, 6.0), (6.0, 6.5)]);
    (cycle.ego.speed, cycle.parameters.tau) = (speed, 0.4);
    let side = draw.pick(&[1.0, -1.0]);
    let (frame, now_ns) = (frame(cycle), cycle.now_ns);
    let point = |k: i64| {
        let way = 0.4 * k as f64;
        // Not at a right angle: what goes across the route is decided by rounding there (H-07.7).
        let angle = (way / radius).min(1.48);
        let beyond = way - radius * angle;
        let x = radius * angle.sin() + beyond * angle.cos();
        let (x, y) = frame.at(x, side * (radius * (1.0 - angle.cos()) + beyond * angle.sin()));
        let (cos, sin) = frame.turn((angle.cos(), side * angle.sin()));
        TrajectoryPoint { t_ns: now_ns + 100_000_000 * k, x, y, cos, sin }
    };
    *points(cycle) = (0..40).map(point).collect();
    cycle.route = base::road(frame, 30.0);
}

/// Headings to and fro, as far as H-11 lets each step turn, and points a little to either side.
fn weave(draw: &mut Draw<'_>, cycle: &mut Cycle) {
    let (share, aside) = (draw.pick(&[0.95, 0.3]), draw.pick(&[0.0, 0.01]));
    // The headings swing the front aside.
    cycle.parameters.lateral_tolerance = 1.0;
    let frame = frame(cycle);
    let points = points(cycle);
    let turn = points.windows(2).map(|pair| {
        let way = (pair[1].x - pair[0].x).hypot(pair[1].y - pair[0].y);
        0.1 + 0.1 * base::seconds(pair[1].t_ns - pair[0].t_ns) + 0.5 * way
    });
    let angle = 0.5 * (share * turn.fold(0.4, f64::min)).asin();
    for (point, k) in points.iter_mut().zip(0_u8..).skip(1) {
        let side = if k % 2 == 0 { 1.0 } else { -1.0 };
        point.x -= side * aside * frame.sin;
        point.y += side * aside * frame.cos;
        (point.cos, point.sin) = frame.turn((angle.cos(), side * angle.sin()));
    }
    cycle.route = base::road(frame, 30.0);
}

/// A tiny CAV or a huge one, which stays where its trajectory begins and ends.
fn resize(draw: &mut Draw<'_>, cycle: &mut Cycle) {
    let (length, width, speed) = draw.pick(&[
        (0.01, 0.01, 0.3),
        (0.05, 0.4, 1.0),
        (0.1, 0.2, 5.0),
        (100.0, 100.0, 8.0),
        (100.0, 0.01, 2.0),
        (0.3, 20.0, 5.0),
    ]);
    (cycle.ego.length, cycle.ego.width, cycle.ego.speed) = (length, width, speed);
    if length < 0.2 {
        cycle.ego.center_offset = 0.0;
    }
    points(cycle).truncate(1);
}

/// Where the CAV is.
pub fn frame(cycle: &Cycle) -> Frame {
    let ego = &cycle.ego;
    Frame { x: ego.x, y: ego.y, cos: ego.cos, sin: ego.sin }
}
