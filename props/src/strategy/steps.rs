//! Steps of a trajectory at the limits of H-11 (`spec/hardened/H-11.md`): one step at a
//! time, and turns from a mark to the points behind it.

use mufasa_model::input::cycle::{Cycle, Trajectory, TrajectoryPoint};

use super::base::{self, Frame, seconds};
use super::draw::Draw;

/// A trajectory on a wide road that one limit of H-11 decides.
pub fn cycle(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle) {
    cycle.route = base::road(frame, 40.0);
    cycle.parameters.start_tolerance = 20.0;
    match draw.below(7) {
        0 | 1 => turn(draw, frame, cycle),
        2 => slide(draw, frame, cycle),
        3 => turn_of_a_step(draw, frame, cycle),
        _ => step(draw, frame, cycle),
    }
}

/// The first step at a limit of time, length, speed, direction, width, slide or turn; the CAV
/// stays where it leads.
fn step(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle) {
    cycle.ego.speed = draw.pick(&[8.0, 2.0, 5.0]);
    let length = cycle.ego.length;
    let mut dt_ns = draw.odd_ns(200_000_000);
    let (mut along, mut aside, mut turned) = (0.1, 0.0, (1.0, 0.0));
    match draw.below(8) {
        0 => dt_ns = draw.near_ns(cycle.parameters.step_max_ns),
        1 => along = draw.near(length),
        2 => {
            cycle.parameters.v_max = draw.pick(&[4.0, 2.5, 5.0]);
            along = draw.near(cycle.parameters.v_max * seconds(dt_ns));
        }
        3 | 7 => {
            // Aside, so that the first heading or the second decides.
            let turn: f64 = draw.pick(&[0.0, 0.1, -0.1]);
            turned = (turn.cos(), turn.sin());
            let limit = draw.near(0.1 * seconds(dt_ns));
            let is_first = draw.one_in(2);
            aside = turn * if is_first { 1.2 } else { -0.4 };
            along = if is_first { -limit } else { (-limit - aside * turned.1) / turned.0 };
        }
        4 => {
            // Only the reference of a long vehicle goes so far aside: half of it ahead of the
            // rear axle, in the sharpest turn.
            (cycle.ego.length, cycle.ego.width) = (12.0, draw.pick(&[2.0, 1.0]));
            let side = draw.pick(&[1.0, -1.0]);
            turned = (0.88, side * (1.0_f64 - 0.88 * 0.88).sqrt());
            (along, aside) = (1.0, side * draw.near(0.5 * cycle.ego.width));
        }
        5 => {
            // u x (h1 + h2) + L (h1 x h2)/2 = +-(L abs(h1 x h2)/2 + 0.1 u . (h1 + h2) + 0.1 + 0.02 dt)
            let turn: f64 = draw.pick(&[0.0, 0.1, -0.2, 0.3]);
            turned = (turn.cos(), turn.sin());
            along = draw.pick(&[0.5, 1.0, 1.5]);
            let side = draw.pick(&[1.0, -1.0]);
            let (sum, sine) = (1.0 + turned.0, turned.1);
            let slack = 0.5 * length * sine.abs() + 0.1 * along * sum + 0.1 + 0.02 * seconds(dt_ns);
            aside = (along * sine + 0.5 * length * sine - side * slack) / (sum + side * 0.1 * sine);
            aside = draw.near(aside);
        }
        _ => {
            let turn = draw.near(0.866).acos() * draw.pick(&[1.0, -1.0]);
            turned = (turn.cos(), turn.sin());
            (along, aside) = (1.6 * (0.5 * turn).cos(), 1.6 * (0.5 * turn).sin());
        }
    }
    let turned = frame.turn(turned);
    let (at, stop) = (frame.at(along, aside), stop_time_ns(cycle));
    let (x, y) = (frame.x, frame.y);
    let first = TrajectoryPoint { t_ns: cycle.now_ns, x, y, cos: frame.cos, sin: frame.sin };
    let mut points = vec![first];
    let mut t_ns = cycle.now_ns + dt_ns;
    loop {
        points.push(TrajectoryPoint { t_ns, x: at.0, y: at.1, cos: turned.0, sin: turned.1 });
        if t_ns - cycle.now_ns >= stop {
            break;
        }
        t_ns += 200_000_000;
    }
    cycle.trajectory = Some(Trajectory { stamp_ns: cycle.now_ns, points });
}

/// A metre straight on, then one step at the limit of its own turn; the CAV stays where it leads.
fn turn_of_a_step(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle) {
    cycle.ego.speed = draw.pick(&[2.0, 5.0]);
    let dt_ns = draw.pick(&[50_000_000, 100_000_000, 200_000_000]);
    let dt_ns = draw.odd_ns(dt_ns);
    let length = draw.pick(&[0.0, 0.1, 0.3]);
    let sine: f64 = draw.near(0.1 + 0.1 * seconds(dt_ns) + 0.5 * length);
    let angle = sine.asin() * draw.pick(&[1.0, -1.0]);
    let at = (1.0 + length * (0.5 * angle).cos(), length * (0.5 * angle).sin());
    let last = (at.0, at.1, angle.cos(), angle.sin());
    let mut points = vec![(0, (0.0, 0.0, 1.0, 0.0)), (200_000_000, (1.0, 0.0, 1.0, 0.0))];
    let more = stop_time_ns(cycle) / dt_ns + 1;
    points.extend((1..=more).map(|index| (200_000_000 + index * dt_ns, last)));
    put(frame, cycle, points);
}

/// The trajectory of these times from now and places in the frame.
fn put(frame: Frame, cycle: &mut Cycle, points: Vec<(i64, (f64, f64, f64, f64))>) {
    let point = |(t_ns, (x, y, cos, sin)): (i64, (f64, f64, f64, f64))| {
        let ((x, y), (cos, sin)) = (frame.at(x, y), frame.turn((cos, sin)));
        TrajectoryPoint { t_ns: cycle.now_ns + t_ns, x, y, cos, sin }
    };
    let points = points.into_iter().map(point).collect();
    cycle.trajectory = Some(Trajectory { stamp_ns: cycle.now_ns, points });
}

/// Turns to and fro, the way aside of the last of them at the limit of the sums; the CAV stays where
/// it leads.
fn slide(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle) {
    cycle.ego.speed = draw.pick(&[2.0, 5.0]);
    let steps = draw.between(2, 5);
    let (dt_ns, turn) = (draw.pick(&[50_000_000, 100_000_000]), draw.pick(&[0.0, 0.02, 0.05]));
    let dt_ns = draw.odd_ns(dt_ns);
    let (along, side) = (draw.pick(&[0.2, 0.5]), draw.pick(&[1.0, -1.0]));
    let half_length = 0.5 * cycle.ego.length;
    let (mut at, mut before) = ((0.0, 0.0), (1.0_f64, 0.0_f64));
    // Sums of u x (h1 + h2), h1 x h2 and u . (h1 + h2).
    let (mut across, mut turned, mut way) = (0.0, 0.0, 0.0);
    let mut points = vec![(0.0, 0.0, 1.0, 0.0)];
    for index in 1..=steps {
        let angle: f64 = if index % 2 == 1 { side * turn } else { -side * turn };
        let after = (angle.cos(), angle.sin());
        let sum = (before.0 + after.0, before.1 + after.1);
        turned += before.0 * after.1 - before.1 * after.0;
        let aside = if index < steps {
            draw.pick(&[0.0, 0.03, -0.03])
        } else {
            // across + along sum.1 - aside sum.0 + half_length turned = -side limit, the limit
            // being 0.1 (way + along sum.0 + aside sum.1) and what is left.
            let t = seconds(dt_ns) * steps as f64;
            let rest = half_length * f64::abs(turned) + 0.1 + 0.02 * t;
            let limit = rest + 0.1 * (way + along * sum.0);
            let above = across + along * sum.1 + half_length * turned + side * limit;
            draw.near(above / (sum.0 - side * 0.1 * sum.1))
        };
        across += along * sum.1 - aside * sum.0;
        way += along * sum.0 + aside * sum.1;
        at = (at.0 + along, at.1 + aside);
        points.push((at.0, at.1, after.0, after.1));
        before = after;
    }
    let (last, stop) = (points[points.len() - 1], stop_time_ns(cycle));
    let more = stop / dt_ns + 1;
    points.extend((0..more).map(|_| last));
    put(frame, cycle, (0..).zip(points).map(|(index, at)| (index * dt_ns, at)).collect());
}

/// An even turn of a few steps, then straight on: about as far as to turn back, or as on the smallest circle (H-14.64).
fn turn(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle) {
    let turns_back = draw.one_in(3);
    let (steps, step_ns) =
        if turns_back { (5, 200_000_000) } else { (draw.between(2, 5), 100_000_000) };
    let step_ns = draw.odd_ns(step_ns);
    let dt = seconds(step_ns);
    let speed = if turns_back { 5.0 } else { draw.pick(&[1.0, 2.0, 3.0]) };
    let parts = steps as f64;
    // How far ahead a turn ends whose way is along the headings; a step lies along the middle of both.
    let ahead = |angle: f64| {
        let each = angle / parts;
        let middles = (0..steps).map(|k| (each * (k as f64 + 0.5)).cos());
        speed * dt / (0.5 * each).cos() * middles.sum::<f64>()
    };
    let lever = cycle.ego.center_offset.abs() + 0.5 * cycle.ego.length;
    let swung = cycle.parameters.lateral_tolerance / lever;
    let circle = (0..50).fold(0.2_f64, |angle, _| (swung + ahead(angle) / 3.0).min(1.0).asin());
    let angle = draw.near(if turns_back { std::f64::consts::FRAC_PI_2 } else { circle });
    let side = draw.pick(&[1.0, -1.0]);
    cycle.ego.speed = speed;
    let each = side * angle / parts;
    let length = speed * dt / (0.5 * each).cos();
    let total = steps + 1 + base::count(speed / cycle.parameters.a_b / dt);
    let (mut at, mut heading) = ((0.0, 0.0), 0.0_f64);
    let (mut points, mut t_ns) = (Vec::new(), cycle.now_ns);
    for index in 0..=total {
        let ((x, y), (cos, sin)) =
            (frame.at(at.0, at.1), frame.turn((heading.cos(), heading.sin())));
        points.push(TrajectoryPoint { t_ns, x, y, cos, sin });
        t_ns += step_ns;
        let turn = if index < steps { each } else { 0.0 };
        let along = heading + 0.5 * turn;
        at = (at.0 + length * along.cos(), at.1 + length * along.sin());
        heading += turn;
    }
    cycle.trajectory = Some(Trajectory { stamp_ns: cycle.now_ns, points });
}

/// Time from now until the CAV could stand, ns, rounded up.
fn stop_time_ns(cycle: &Cycle) -> i64 {
    base::to_ns(cycle.ego.speed / cycle.parameters.a_b) + 1
}
