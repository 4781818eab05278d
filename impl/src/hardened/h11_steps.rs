//! What the steps and turns of a trajectory have to be like to be driven (H-11 of
//! `spec/3-stages.md#hardened-profile`).

use crate::hardened::h04_horizon::{plain_way, way};
use crate::input::cycle::{Cycle, TrajectoryPoint};
use crate::input::parameters::Parameters;
use crate::numbers::plane::{Vector, same_point};
use crate::numbers::rounding::Real;
use crate::numbers::time::{elapsed_ns, seconds};
use crate::report::{Rule, Witness};

/// The first rule that some point does not certainly keep, and the first such point: of its step,
/// then against its mark.
pub(crate) fn step_failure(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> Option<Witness> {
    let mut first: Option<Witness> = None;
    let mut keep_first = |index: usize, (rule, compared): (Rule, [f64; 2])| {
        if first.is_none_or(|found| rule < found.rule) {
            first = Some(Witness::of(rule, compared).at_point(index));
        }
    };
    for ((from, to), index) in points.iter().zip(points.iter().skip(1)).zip(1_usize..) {
        if !step_is_fine(cycle, from, to) {
            first_broken(cycle, from, to).into_iter().for_each(|broken| keep_first(index, broken));
        }
    }
    let Some(start) = points.first() else { return first };
    let mut turn = Turn::since(0, start);
    for ((from, to), index) in points.iter().zip(points.iter().skip(1)).zip(1_usize..) {
        turn.plain_way += plain_way(from, to);
        if !turn.is_fine(to) {
            turn.drive_on(points, index);
            turn.first_broken(to).into_iter().for_each(|broken| keep_first(index, broken));
        }
        if elapsed_ns(turn.mark.t_ns, to.t_ns) >= BETWEEN_MARKS_NS {
            turn = Turn::since(index, to);
        }
    }
    first
}

/// More than plain doubles err in the comparisons of one step, m: its numbers are below 2^26 m,
/// those that are compared below 2^19 m.
const STEP_ERROR: f64 = 1e-9;

/// Whether the step keeps all rules by more than plain doubles err.
#[inline]
fn step_is_fine(cycle: &Cycle<'_>, from: &TrajectoryPoint, to: &TrajectoryPoint) -> bool {
    let dt_ns = elapsed_ns(from.t_ns, to.t_ns);
    let (x, y) = (to.x - from.x, to.y - from.y);
    let size = libm::sqrt(x * x + y * y) + STEP_ERROR;
    let (dt, length) = (seconds(dt_ns), cycle.ego.length);
    let split =
        |point: &TrajectoryPoint| [x * point.cos + y * point.sin, x * point.sin - y * point.cos];
    let ([along, aside], [along_next, aside_next]) = (split(from), split(to));
    let fits = |along: f64, aside: f64| {
        along >= STEP_ERROR - BACK * dt && aside.abs() + STEP_ERROR <= 0.5 * cycle.ego.width
    };
    let bent = 0.5 * length * (from.cos * to.sin - from.sin * to.cos);
    let slide = (aside + aside_next + bent).abs();
    dt_ns <= cycle.parameters.step_max_ns
        && size <= length
        && size <= cycle.parameters.v_max * dt
        && fits(along, aside)
        && fits(along_next, aside_next)
        && from.cos * to.cos + from.sin * to.sin >= LEAST_COSINE + STEP_ERROR
        && slide + STEP_ERROR <= bent.abs() + SLIDE * (along + along_next) + DRIFT * dt
}

/// m/s: a standing vehicle seems to move back so fast.
const BACK: f64 = 0.1;
/// Of a turn of a step: 30 degrees.
const LEAST_COSINE: f64 = 0.866;
/// What a step may lie beside its headings, both together, for each m along them.
const SLIDE: f64 = 0.1;
/// The same for each s, m.
const DRIFT: f64 = 0.4;

/// The first rule that the step does not certainly keep, and the two numbers.
fn first_broken(
    cycle: &Cycle<'_>,
    from: &TrajectoryPoint,
    to: &TrajectoryPoint,
) -> Option<(Rule, [f64; 2])> {
    let Parameters { step_max_ns, v_max, .. } = cycle.parameters;
    let dt_ns = elapsed_ns(from.t_ns, to.t_ns);
    if dt_ns > step_max_ns {
        let compared = [dt_ns, step_max_ns].map(|time_ns| Real::seconds(time_ns).value());
        return Some((Rule::StepTime, compared));
    }
    let (at, next) = ([from.x, from.y], [to.x, to.y]);
    let [before, after] = [from, to].map(heading);
    let (u, dt) = (Vector::between(at, next), Real::seconds(dt_ns));
    let (size, length) = (u.norm(), Real::new(cycle.ego.length));
    // An empty step leads nowhere.
    let moves = !same_point(at, next);
    let back = -(Real::new(BACK) * dt);
    let aside = |heading| at_most(u.cross(heading).abs(), Real::new(0.5 * cycle.ego.width));
    let (both, bent) = (before + after, length * before.cross(after) * Real::new(0.5));
    let slide = at_most(
        (u.cross(both) + bent).abs(),
        bent.abs() + Real::new(SLIDE) * u.dot(both) + Real::new(DRIFT) * dt,
    );
    let rules = [
        (Rule::StepLength, true, at_most(size, length)),
        (Rule::StepSpeed, true, at_most(size, Real::new(v_max) * dt)),
        (Rule::StepForward, moves, at_least(u.dot(before), back)),
        (Rule::StepForward, moves, at_least(u.dot(after), back)),
        (Rule::StepLateral, true, aside(before)),
        (Rule::StepLateral, true, aside(after)),
        (Rule::StepTurn, true, at_least(before.dot(after), Real::new(LEAST_COSINE))),
        (Rule::StepSlide, moves, slide),
    ];
    first_of(rules)
}

/// The way from a mark on: the last mark before a point, marks being the first point and each first
/// one at least so much later than the mark before it.
struct Turn<'p> {
    mark: &'p TrajectoryPoint,
    /// In plain doubles, m.
    plain_way: f64,
    /// The same with its error, up to the point with this index.
    way: Real,
    driven: usize,
}

const BETWEEN_MARKS_NS: i64 = 500_000_000;

/// What measuring leaves open of a turn, whatever the time and the way.
const STILL_TURN: f64 = 0.05;
/// What it leaves open for each s, or where a vehicle drives.
const NOISE: f64 = 0.1;
/// For each m of the way: no vehicle has a smaller turning circle.
const TIGHTEST: f64 = 0.5;
/// What tyres hold, m/s^2.
const TYRES: f64 = 11.5;

impl<'p> Turn<'p> {
    const fn since(index: usize, mark: &'p TrajectoryPoint) -> Self {
        Self { mark, plain_way: 0.0, way: Real::ZERO, driven: index }
    }

    /// Whether the point keeps the rules by more than plain doubles err: steps that are longer than
    /// 100 m break another rule.
    #[inline]
    fn is_fine(&self, point: &TrajectoryPoint) -> bool {
        let (mark, w) = (self.mark, self.plain_way);
        let t = seconds(elapsed_ns(mark.t_ns, point.t_ns));
        let turned = (mark.cos * point.sin - mark.sin * point.cos).abs();
        let w_error = STEP_ERROR * (1.0 + w);
        mark.cos * point.cos + mark.sin * point.sin >= STEP_ERROR
            && turned + STEP_ERROR <= STILL_TURN + NOISE * t + TIGHTEST * (w - w_error)
            && (turned + STEP_ERROR <= NOISE
                || (turned - NOISE + STEP_ERROR) * (w + w_error) + STEP_ERROR <= TYRES * t * t)
    }

    /// Brings the way with its error up to a point.
    fn drive_on(&mut self, points: &[TrajectoryPoint], index: usize) {
        let steps = points.iter().zip(points.iter().skip(1));
        let new = steps.take(index).skip(self.driven);
        self.way = new.fold(self.way, |sum, (from, to)| sum + way(from, to));
        self.driven = index;
    }

    /// The first rule that the point, up to which the way goes, does not certainly keep, and the
    /// two numbers.
    fn first_broken(&self, point: &TrajectoryPoint) -> Option<(Rule, [f64; 2])> {
        let [before, after] = [self.mark, point].map(heading);
        let t = Real::seconds(elapsed_ns(self.mark.t_ns, point.t_ns));
        let (w, turned, noise) = (self.way, before.cross(after).abs(), Real::new(NOISE));
        let most = Real::new(STILL_TURN) + noise * t + Real::new(TIGHTEST) * w;
        let is_hard = !turned.certainly_at_most(noise);
        let held = noise * w + Real::new(TYRES) * t.squared();
        first_of([
            (Rule::TurnReversed, true, at_least(before.dot(after), Real::ZERO)),
            (Rule::TurnOnTheSpot, true, at_most(turned, most)),
            (Rule::TurnHard, is_hard, at_most(turned * w, held)),
        ])
    }
}

fn heading(point: &TrajectoryPoint) -> Vector {
    Vector::new(point.cos, point.sin)
}

/// Two numbers that are compared, and whether the rule is certainly kept.
type Compared = (Real, Real, bool);

fn at_most(value: Real, limit: Real) -> Compared {
    (value, limit, value.certainly_at_most(limit))
}

fn at_least(value: Real, limit: Real) -> Compared {
    (value, limit, limit.certainly_at_most(value))
}

/// The first rule that applies and is not kept.
fn first_of<const N: usize>(rules: [(Rule, bool, Compared); N]) -> Option<(Rule, [f64; 2])> {
    let broken = rules.into_iter().find(|&(_, applies, (.., is_kept))| applies && !is_kept);
    broken.map(|(rule, _, (value, limit, _))| (rule, [value.value(), limit.value()]))
}
