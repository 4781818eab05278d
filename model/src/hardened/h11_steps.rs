//! H-11: every step of the trajectory and its way aside are such that a vehicle of this size can drive
//! them.

use crate::input::scene::{Point, Scene};
use crate::numbers::real::Real;
use crate::numbers::vector::Vector;
use crate::report::{Rule, Witness};

/// A vehicle of this size can drive every step, and the way aside: the first rule that some step or
/// some point breaks.
pub fn step_failure(scene: &Scene, trajectory: &[Point]) -> Option<Witness> {
    const RULES: [fn(&Scene, &Step) -> Option<Witness>; 6] =
        [step_time, step_length, step_speed, step_forward, step_lateral, step_turn];
    let steps: Vec<Step> = steps(trajectory).collect();
    let first = |rule: &fn(&Scene, &Step) -> Option<Witness>| {
        let mut steps = steps.iter().enumerate();
        steps.find_map(|(i, step)| Some(rule(scene, step)?.at_point(i + 1)))
    };
    RULES.iter().find_map(first).or_else(|| slide_failure(scene, trajectory))
}

/// A step between consecutive points: duration, displacement u and headings h1 and h2.
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

    /// Its length is 0.
    fn stands(&self) -> bool {
        self.u.squared() == Real::zero()
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

/// u . h >= -0.1 dt for both headings; a step of length 0 passes in every reading.
fn step_forward(scene: &Scene, step: &Step) -> Option<Witness> {
    let limit = -(Real::from_double(0.1) * Real::seconds(step.dt_ns));
    step.headings.iter().find_map(|heading| {
        let along = step.u.dot(heading);
        let passes = step.stands() || scene.reads.at_least(&along, &limit);
        Witness::unless(passes, Rule::StepForward, &along, &limit)
    })
}

/// abs(u x h) <= W/2 for both headings
fn step_lateral(scene: &Scene, step: &Step) -> Option<Witness> {
    let limit = &scene.ego.width / Real::from_integer(2);
    step.headings.iter().find_map(|heading| {
        let sideways = step.u.cross(heading).abs();
        let passes = scene.reads.at_most(&sideways, &limit);
        Witness::unless(passes, Rule::StepLateral, &sideways, &limit)
    })
}

/// h1 . h2 >= 0.866 and abs(h1 x h2) <= 0.1 + 0.1 dt + 0.5 abs(u)
fn step_turn(scene: &Scene, step: &Step) -> Option<Witness> {
    let [h1, h2] = step.headings;
    let (product, least) = (h1.dot(h2), Real::from_double(0.866));
    let turned = h1.cross(h2).abs();
    let [still, drift, tightest] = [0.1, 0.1, 0.5].map(Real::from_double);
    let most = still + drift * Real::seconds(step.dt_ns) + tightest * step.u.length();
    let far =
        Witness::unless(scene.reads.at_least(&product, &least), Rule::StepTurn, &product, &least);
    far.or_else(|| {
        Witness::unless(scene.reads.at_most(&turned, &most), Rule::StepTurn, &turned, &most)
    })
}

/// The steps one after the other.
fn steps(trajectory: &[Point]) -> impl Iterator<Item = Step<'_>> {
    trajectory.windows(2).map(|pair| Step::new(&pair[0], &pair[1]))
}

/// Where the headings do not lead: the first such point.
pub fn slide_failure(scene: &Scene, trajectory: &[Point]) -> Option<Witness> {
    let mut aside = ways_aside(trajectory).enumerate();
    aside.find_map(|(i, aside)| Some(slide(scene, &aside)?.at_point(i + 1)))
}

/// From the first point to another one: time t, and the sums over the steps of u x (h1 + h2), of
/// h1 x h2, and of u . (h1 + h2).
#[derive(Clone)]
struct WayAside {
    t_ns: i128,
    across: Real,
    turned: Real,
    along: Real,
}

/// Those of every point after the first.
fn ways_aside(trajectory: &[Point]) -> impl Iterator<Item = WayAside> {
    let none =
        WayAside { t_ns: 0, across: Real::zero(), turned: Real::zero(), along: Real::zero() };
    steps(trajectory).scan(none, |aside, step| {
        let ([h1, h2], u) = (step.headings, &step.u);
        let sum = h1 + h2;
        *aside = WayAside {
            t_ns: aside.t_ns + step.dt_ns,
            across: &aside.across + u.cross(&sum),
            turned: &aside.turned + h1.cross(h2),
            along: &aside.along + u.dot(&sum),
        };
        Some(aside.clone())
    })
}

/// abs(sum of u x (h1 + h2) + L/2 sum of h1 x h2)
///     <= L/2 abs(sum of h1 x h2) + 0.1 sum of u . (h1 + h2) + 0.1 + 0.02 t: the headings lead there.
fn slide(scene: &Scene, aside: &WayAside) -> Option<Witness> {
    let [share, still, drift] = [0.1, 0.1, 0.02].map(Real::from_double);
    let turned = &scene.ego.length * &aside.turned / Real::from_integer(2);
    let sideways = (&aside.across + &turned).abs();
    let slack = share * &aside.along + still + drift * Real::seconds(aside.t_ns);
    let limit = turned.abs() + slack;
    let passes = scene.reads.at_most(&sideways, &limit);
    Witness::unless(passes, Rule::Slide, &sideways, &limit)
}
