//! Rules of the hardened stage ii about the trajectory itself: H-07 (start), H-11, H-12
//! (`spec/3-stages.md#hardened-profile`).

use crate::input::scene::{Point, Scene};
use crate::numbers::real::Real;
use crate::numbers::vector::Vector;
use crate::report::{Rule, Witness};
use crate::stages::distances::{arc_lengths, s_b, scene_s_stop, ways};

/// H-12: no trajectory needs to be longer than this, s.
const LONGEST_NEEDED: i128 = 50;

/// H-07: the trajectory starts now and here.
pub fn start_failure(scene: &Scene, trajectory: &[Point]) -> Option<Witness> {
    let start = &trajectory[0];
    let age_ns = i128::from(scene.now_ns) - i128::from(start.t_ns);
    let max_age = i128::from(scene.parameters.max_age_ns);
    if age_ns.abs() > max_age {
        let (age, limit) = (Real::seconds(age_ns.abs()), Real::seconds(max_age));
        return Some(Witness { point: Some(0), ..Witness::new(Rule::StartTime, &age, &limit) });
    }
    let driven = &scene.ego.v_now * Real::seconds(age_ns.max(0));
    let limit = &scene.parameters.start_tolerance + driven;
    let distance = (&start.pose.origin - &scene.ego.position).length();
    (distance > &limit - &scene.m)
        .then(|| Witness { point: Some(0), ..Witness::new(Rule::StartPosition, &distance, &limit) })
}

/// H-11: every step is one that a vehicle of this size can drive.
pub fn step_failure(scene: &Scene, trajectory: &[Point]) -> Option<Witness> {
    const RULES: [fn(&Scene, &Step) -> Option<Witness>; 6] =
        [step_time, step_length, step_speed, step_forward, step_lateral, step_turn];
    let steps: Vec<Step> =
        trajectory.windows(2).map(|pair| Step::new(&pair[0], &pair[1])).collect();
    RULES.iter().find_map(|rule| {
        steps.iter().enumerate().find_map(|(i, step)| {
            rule(scene, step).map(|witness| Witness { point: Some(i + 1), ..witness })
        })
    })
}

/// A step between consecutive points: duration, displacement u and both headings.
struct Step<'a> {
    dt_ns: i128,
    u: Vector,
    headings: [&'a Vector; 2],
}

impl<'a> Step<'a> {
    fn new(from: &'a Point, to: &'a Point) -> Self {
        Self {
            dt_ns: i128::from(to.t_ns) - i128::from(from.t_ns),
            u: &to.pose.origin - &from.pose.origin,
            headings: [&from.pose.direction, &to.pose.direction],
        }
    }
}

fn witness_if(fails: bool, rule: Rule, left: &Real, right: &Real) -> Option<Witness> {
    fails.then(|| Witness::new(rule, left, right))
}

/// dt <= step_max
fn step_time(scene: &Scene, step: &Step) -> Option<Witness> {
    let step_max = i128::from(scene.parameters.step_max_ns);
    let (dt, limit) = (Real::seconds(step.dt_ns), Real::seconds(step_max));
    witness_if(step.dt_ns > step_max, Rule::StepTime, &dt, &limit)
}

/// abs(u) <= L
fn step_length(scene: &Scene, step: &Step) -> Option<Witness> {
    let (length, limit) = (step.u.length(), &scene.ego.length);
    witness_if(length > limit - &scene.m, Rule::StepLength, &length, limit)
}

/// abs(u) <= v_max dt
fn step_speed(scene: &Scene, step: &Step) -> Option<Witness> {
    let length = step.u.length();
    let limit = &scene.parameters.v_max * Real::seconds(step.dt_ns);
    witness_if(length > &limit - &scene.m, Rule::StepSpeed, &length, &limit)
}

/// u . heading >= 0 for both headings; a step of length 0 passes in every reading.
fn step_forward(scene: &Scene, step: &Step) -> Option<Witness> {
    let stands = step.u.squared() == Real::zero();
    step.headings.iter().find_map(|heading| {
        let along = step.u.dot(heading);
        witness_if(!stands && along < scene.m, Rule::StepForward, &along, &Real::zero())
    })
}

/// abs(u x heading) <= W/2 for both headings
fn step_lateral(scene: &Scene, step: &Step) -> Option<Witness> {
    let limit = &scene.ego.width / Real::from_integer(2);
    step.headings.iter().find_map(|heading| {
        let sideways = step.u.cross(heading).abs();
        witness_if(sideways > &limit - &scene.m, Rule::StepLateral, &sideways, &limit)
    })
}

/// heading . heading >= 0.866, and the bounds of `turn_failure`
fn step_turn(scene: &Scene, step: &Step) -> Option<Witness> {
    let limit = Real::from_double(0.866);
    let product = step.headings[0].dot(step.headings[1]);
    witness_if(product < &limit + &scene.m, Rule::StepTurn, &product, &limit)
        .or_else(|| turn_failure(scene, step))
}

/// abs(heading x heading) <= 0.5 abs(u) + 0.1 dt, and times abs(u) <= a_b dt^2; equal headings
/// pass in every reading.
fn turn_failure(scene: &Scene, step: &Step) -> Option<Witness> {
    if step.headings[0] == step.headings[1] {
        return None;
    }
    let turned = step.headings[0].cross(step.headings[1]).abs();
    let (length, dt) = (step.u.length(), Real::seconds(step.dt_ns));
    let curve = Real::from_double(0.5) * &length + Real::from_double(0.1) * &dt;
    let swerve = &scene.parameters.a_b * dt.square();
    witness_if(turned > &curve - &scene.m, Rule::StepTurn, &turned, &curve).or_else(|| {
        let aside = &turned * &length;
        witness_if(aside > &swerve - &scene.m, Rule::StepTurn, &aside, &swerve)
    })
}

/// H-12: the trajectory neither lags behind what braking covers nor outruns what accelerating
/// covers, and ends neither before standstill nor more than L before s_stop.
pub fn end_failure(scene: &Scene, trajectory: &[Point]) -> Option<Witness> {
    let parameters = &scene.parameters;
    let (a_b, a_max) = (&parameters.a_b, &parameters.a_max);
    let two = Real::from_integer(2);
    let t0 = i128::from(trajectory[0].t_ns);
    let d = Real::seconds((i128::from(scene.now_ns) - t0).abs());
    let v_lo = (&scene.ego.v_now - a_max * &d).max(Real::zero());
    let v_hi = &scene.ego.v_now + a_b * &d;
    let braking = &v_lo / a_b;
    // b(t): distance covered in the time t when braking from v_lo.
    let b = |t: &Real| {
        if *t <= braking { &v_lo * t - a_b * t.square() / &two } else { s_b(&v_lo, a_b) }
    };
    let times: Vec<Real> =
        trajectory.iter().map(|point| Real::seconds(i128::from(point.t_ns) - t0)).collect();
    let end = scene_s_stop(scene, trajectory) - &scene.ego.length;
    let too_short = times.iter().zip(ways(trajectory)).enumerate().find_map(|(i, (t, way))| {
        let limit = b(t) - &parameters.start_tolerance;
        let limit = if i + 1 < times.len() { limit } else { limit.max(end.clone()) };
        let failure = witness_if(way < &limit + &scene.m, Rule::ArcTooShort, &way, &limit);
        failure.map(|witness| Witness { point: Some(i), ..witness })
    });
    let too_long = || {
        times.iter().zip(arc_lengths(trajectory)).enumerate().find_map(|(i, (t, length))| {
            let limit = &v_hi * t + a_max * t.square() / &two + &parameters.start_tolerance;
            let failure = witness_if(length > &limit - &scene.m, Rule::ArcTooLong, &length, &limit);
            failure.map(|witness| Witness { point: Some(i), ..witness })
        })
    };
    let ends_too_soon = || {
        let needed = (&v_lo / a_b).min(Real::from_integer(LONGEST_NEEDED));
        let last = &times[times.len() - 1];
        let failure = witness_if(*last < needed, Rule::EndsTooSoon, last, &needed);
        failure.map(|witness| Witness { point: Some(times.len() - 1), ..witness })
    };
    too_short.or_else(too_long).or_else(ends_too_soon)
}
