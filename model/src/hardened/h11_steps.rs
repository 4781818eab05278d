//! H-11: every step of the trajectory is one that a vehicle of this size can drive.

use crate::input::scene::{Point, Scene};
use crate::numbers::real::Real;
use crate::numbers::vector::Vector;
use crate::report::{Rule, Witness};

/// Every step is one that a vehicle of this size can drive: the first rule of which some step fails.
pub fn step_failure(scene: &Scene, trajectory: &[Point]) -> Option<Witness> {
    const RULES: [fn(&Scene, &Step) -> Option<Witness>; 6] =
        [step_time, step_length, step_speed, step_forward, step_lateral, step_turn];
    let steps: Vec<Step> =
        trajectory.windows(2).map(|pair| Step::new(&pair[0], &pair[1])).collect();
    RULES.iter().find_map(|rule| {
        steps
            .iter()
            .enumerate()
            .find_map(|(i, step)| rule(scene, step).map(|witness| witness.at_point(i + 1)))
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

/// dt <= step_max
fn step_time(scene: &Scene, step: &Step) -> Option<Witness> {
    let step_max = i128::from(scene.parameters.step_max_ns);
    let (dt, limit) = (Real::seconds(step.dt_ns), Real::seconds(step_max));
    Witness::unless(step.dt_ns <= step_max, Rule::StepTime, &dt, &limit)
}

/// abs(u) <= L
fn step_length(scene: &Scene, step: &Step) -> Option<Witness> {
    let (length, limit) = (step.u.length(), &scene.ego.length);
    Witness::unless(scene.reads.at_most(&length, limit), Rule::StepLength, &length, limit)
}

/// abs(u) <= v_max dt
fn step_speed(scene: &Scene, step: &Step) -> Option<Witness> {
    let length = step.u.length();
    let limit = &scene.parameters.v_max * Real::seconds(step.dt_ns);
    Witness::unless(scene.reads.at_most(&length, &limit), Rule::StepSpeed, &length, &limit)
}

/// u . heading >= 0 for both headings; a step of length 0 passes in every reading.
fn step_forward(scene: &Scene, step: &Step) -> Option<Witness> {
    let stands = step.u.squared() == Real::zero();
    step.headings.iter().find_map(|heading| {
        let along = step.u.dot(heading);
        let passes = stands || scene.reads.at_least(&along, &Real::zero());
        Witness::unless(passes, Rule::StepForward, &along, &Real::zero())
    })
}

/// abs(u x heading) <= W/2 for both headings
fn step_lateral(scene: &Scene, step: &Step) -> Option<Witness> {
    let limit = &scene.ego.width / Real::from_integer(2);
    step.headings.iter().find_map(|heading| {
        let sideways = step.u.cross(heading).abs();
        Witness::unless(
            scene.reads.at_most(&sideways, &limit),
            Rule::StepLateral,
            &sideways,
            &limit,
        )
    })
}

/// heading . heading >= 0.866, and the bounds of `turn_failure`
fn step_turn(scene: &Scene, step: &Step) -> Option<Witness> {
    let limit = Real::from_double(0.866);
    let product = step.headings[0].dot(step.headings[1]);
    Witness::unless(scene.reads.at_least(&product, &limit), Rule::StepTurn, &product, &limit)
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
    Witness::unless(scene.reads.at_most(&turned, &curve), Rule::StepTurn, &turned, &curve).or_else(
        || {
            let aside = &turned * &length;
            Witness::unless(scene.reads.at_most(&aside, &swerve), Rule::StepTurn, &aside, &swerve)
        },
    )
}
