//! H-12: the trajectory gets as far as braking takes the CAV, no farther than accelerating does, and
//! ends neither before standstill nor more than L before s_stop.

use crate::hardened::h04_horizon::{s_stop_along, ways};
use crate::input::scene::{Point, Scene};
use crate::numbers::real::Real;
use crate::report::{Rule, Witness};
use crate::stages::distances::s_b;
use crate::stages::horizon::arc_lengths;

/// No trajectory needs to be longer than this, s.
const LONGEST_NEEDED: i128 = 50;

/// b(t) - lag_tolerance <= way, s_stop - L <= last way,
/// arc length <= v_hi t + a_max t^2 / 2 + start_tolerance, and last t >= min(v_lo / a_b, 50 s).
pub fn progress_failure(scene: &Scene, trajectory: &[Point]) -> Option<Witness> {
    let p = &scene.parameters;
    let two = Real::from_integer(2);
    let t0 = i128::from(trajectory[0].t_ns);
    let (v_lo, v_hi) = speeds_at_start(scene, t0);
    let times: Vec<Real> =
        trajectory.iter().map(|point| Real::seconds(i128::from(point.t_ns) - t0)).collect();
    let last = times.len() - 1;
    let end = s_stop_along(scene, trajectory) - &scene.ego.length;
    let too_short = times.iter().zip(ways(trajectory)).enumerate().find_map(|(i, (t, way))| {
        let limit = braking(&v_lo, &p.a_b, t) - &p.lag_tolerance;
        let limit = if i < last { limit } else { limit.max(end.clone()) };
        let passes = scene.reads.at_least(&way, &limit);
        Witness::unless(passes, Rule::ArcTooShort, &way, &limit).map(|w| w.at_point(i))
    });
    let too_long = || {
        times.iter().zip(arc_lengths(trajectory)).enumerate().find_map(|(i, (t, length))| {
            let limit = &v_hi * t + &p.a_max * t.square() / &two + &p.start_tolerance;
            let passes = scene.reads.at_most(&length, &limit);
            Witness::unless(passes, Rule::ArcTooLong, &length, &limit).map(|w| w.at_point(i))
        })
    };
    let ends_too_soon = || {
        let needed = (&v_lo / &p.a_b).min(Real::from_integer(LONGEST_NEEDED));
        let passes = times[last] >= needed;
        Witness::unless(passes, Rule::EndsTooSoon, &times[last], &needed).map(|w| w.at_point(last))
    };
    too_short.or_else(too_long).or_else(ends_too_soon)
}

/// Speeds v_lo and v_hi between which the CAV can be at the time t0 of the first point, m/s: with
/// d = abs(now - t0), max(v_now - a_max d, 0) and v_now + a_b d up to now, max(v_now - a_b d, 0) and
/// v_now + a_max d after it.
pub fn speeds_at_start(scene: &Scene, t0_ns: i128) -> (Real, Real) {
    let (v_now, p) = (&scene.ego.v_now, &scene.parameters);
    let after_ns = t0_ns - i128::from(scene.now_ns);
    let d = Real::seconds(after_ns.abs());
    let (slower, faster) = if after_ns <= 0 { (&p.a_max, &p.a_b) } else { (&p.a_b, &p.a_max) };
    ((v_now - slower * &d).max(Real::zero()), v_now + faster * &d)
}

/// b(t) = v t - a_b t^2 / 2 until standstill, then s_b(v): the distance covered when braking, m.
fn braking(v: &Real, a_b: &Real, t: &Real) -> Real {
    if *t <= v / a_b { v * t - a_b * t.square() / Real::from_integer(2) } else { s_b(v, a_b) }
}
