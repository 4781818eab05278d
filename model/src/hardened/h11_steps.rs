//! H-11: every step of the trajectory, its way aside, and every turn over half a second are such that a
//! vehicle of this size can drive them.

use crate::hardened::h04_horizon::ways;
use crate::input::scene::{Point, Scene};
use crate::numbers::real::Real;
use crate::numbers::vector::Vector;
use crate::report::{Rule, Witness};

/// From a mark to the next one at least, ns.
const MARK_NS: i128 = 500_000_000;

/// A vehicle of this size can drive every step, the way aside and every turn: the first rule that some
/// step or some point breaks.
pub fn step_failure(scene: &Scene, trajectory: &[Point]) -> Option<Witness> {
    const OF_STEPS: [fn(&Scene, &Step) -> Option<Witness>; 6] =
        [step_time, step_length, step_speed, step_forward, step_lateral, step_turn];
    const OF_TURNS: [fn(&Scene, &Turn) -> Option<Witness>; 3] =
        [turn_reversed, turn_on_the_spot, turn_hard];
    let steps: Vec<Step> = steps(trajectory).collect();
    let turns = turns(trajectory);
    let at = |i: usize, failure: Option<Witness>| failure.map(|witness| witness.at_point(i + 1));
    let of_steps = OF_STEPS
        .iter()
        .find_map(|rule| steps.iter().enumerate().find_map(|(i, step)| at(i, rule(scene, step))));
    of_steps.or_else(|| slide_failure(scene, trajectory)).or_else(|| {
        OF_TURNS.iter().find_map(|rule| {
            turns.iter().enumerate().find_map(|(i, turn)| at(i, rule(scene, turn)))
        })
    })
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

/// From its mark to a point: time t and way w, headings hm and h.
struct Turn<'a> {
    t: Real,
    w: Real,
    headings: [&'a Vector; 2],
}

/// Every point after the first against its mark, the last mark before it: the marks are the first
/// point and each first point at least 0.5 s after the mark before it.
fn turns(trajectory: &[Point]) -> Vec<Turn<'_>> {
    let ways = ways(trajectory);
    let t_ns = |i: usize| i128::from(trajectory[i].t_ns);
    let mut mark = 0;
    let mut turns = Vec::new();
    for i in 1..trajectory.len() {
        turns.push(Turn {
            t: Real::seconds(t_ns(i) - t_ns(mark)),
            w: &ways[i] - &ways[mark],
            headings: [&trajectory[mark].pose.direction, &trajectory[i].pose.direction],
        });
        if t_ns(i) - t_ns(mark) >= MARK_NS {
            mark = i;
        }
    }
    turns
}

/// hm . h >= 0
fn turn_reversed(scene: &Scene, turn: &Turn) -> Option<Witness> {
    let product = turn.headings[0].dot(turn.headings[1]);
    let passes = scene.reads.at_least(&product, &Real::zero());
    Witness::unless(passes, Rule::TurnReversed, &product, &Real::zero())
}

/// abs(hm x h) <= 0.05 + 0.1 t + 0.5 w: no vehicle turns on the spot.
fn turn_on_the_spot(scene: &Scene, turn: &Turn) -> Option<Witness> {
    let turned = turn.headings[0].cross(turn.headings[1]).abs();
    let [a, b, c] = [0.05, 0.1, 0.5].map(Real::from_double);
    let limit = a + b * &turn.t + c * &turn.w;
    let passes = scene.reads.at_most(&turned, &limit);
    Witness::unless(passes, Rule::TurnOnTheSpot, &turned, &limit)
}

/// Where abs(hm x h) > 0.1: abs(hm x h) w <= 0.1 w + 11.5 t^2, no harder than tyres hold.
fn turn_hard(scene: &Scene, turn: &Turn) -> Option<Witness> {
    let turned = turn.headings[0].cross(turn.headings[1]).abs();
    let [noise, grip] = [0.1, 11.5].map(Real::from_double);
    if !scene.reads.may_be_greater(&turned, &noise) {
        return None;
    }
    let (aside, limit) = (&turned * &turn.w, noise * &turn.w + grip * turn.t.square());
    let passes = scene.reads.at_most(&aside, &limit);
    Witness::unless(passes, Rule::TurnHard, &aside, &limit)
}
