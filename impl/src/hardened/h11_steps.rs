//! What the steps and turns of a trajectory have to be like to be driven (H-11 of
//! `spec/hardened/H-11.md`).

use crate::input::cycle::{Cycle, TrajectoryPoint};
use crate::input::parameters::Parameters;
use crate::numbers::plane::{Vector, same_point};
use crate::numbers::rounding::Real;
use crate::numbers::time::{elapsed_ns, seconds};
use crate::report::{Rule, Witness};

/// The first rule that some point does not certainly keep, and the first such point: of its step,
/// then of where its headings lead.
pub(crate) fn step_failure(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> Option<Witness> {
    let mut first: Option<Witness> = None;
    let mut keep_first = |index: usize, (rule, compared): (Rule, [f64; 2])| {
        if first.is_none_or(|found| rule < found.rule) {
            first = Some(Witness::of(rule, compared).at_point(index));
        }
    };
    for ((from, to), index) in steps(points).zip(1_usize..) {
        if !step_is_fine(cycle, from, to) {
            first_broken(cycle, from, to).into_iter().for_each(|broken| keep_first(index, broken));
        }
    }
    let Some(start) = points.first() else { return first };
    let mut slide = Slide::new(cycle.ego.length, start, points.len());
    for ((from, to), index) in steps(points).zip(1_usize..) {
        slide.step_plainly(from, to);
        if !slide.is_fine() {
            slide.drive_on(points, index);
            slide.broken(to).into_iter().for_each(|broken| keep_first(index, broken));
        }
    }
    first
}

/// Each point with the next one.
fn steps(points: &[TrajectoryPoint]) -> impl Iterator<Item = (&TrajectoryPoint, &TrajectoryPoint)> {
    points.iter().zip(points.iter().skip(1))
}

/// More than plain doubles err in the comparisons of one step, m: its numbers are below 2^26 m,
/// those that are compared below 2^19 m.
const STEP_ERROR: f64 = 1e-9;

/// Whether the step keeps all rules by more than plain doubles err. Without it stage ii of W1 and W2 takes
/// six times as many instructions, without `Slide::is_fine` nearly four times.
#[inline]
fn step_is_fine(cycle: &Cycle<'_>, from: &TrajectoryPoint, to: &TrajectoryPoint) -> bool {
    let dt_ns = elapsed_ns(from.t_ns, to.t_ns);
    let (x, y) = (to.x - from.x, to.y - from.y);
    let moved = libm::sqrt(x * x + y * y);
    let size = moved + STEP_ERROR;
    let (dt, length) = (seconds(dt_ns), cycle.ego.length);
    let split =
        |point: &TrajectoryPoint| [x * point.cos + y * point.sin, x * point.sin - y * point.cos];
    let ([along, aside], [along_next, aside_next]) = (split(from), split(to));
    let turned = (from.cos * to.sin - from.sin * to.cos).abs();
    let fits = |along: f64, aside: f64| {
        along >= STEP_ERROR - BACK * dt && aside.abs() + STEP_ERROR <= 0.5 * cycle.ego.width
    };
    dt_ns <= cycle.parameters.step_max_ns
        && size <= length
        && size <= cycle.parameters.v_max * dt
        && fits(along, aside)
        && fits(along_next, aside_next)
        && from.cos * to.cos + from.sin * to.sin >= LEAST_COSINE + STEP_ERROR
        && turned + STEP_ERROR <= STEP_TURN + NOISE * dt + TIGHTEST * (moved - STEP_ERROR)
}

/// m/s: a standing vehicle seems to move back so fast.
const BACK: f64 = 0.1;
/// Of a turn of a step: 30 degrees.
const LEAST_COSINE: f64 = 0.866;

/// The first rule that the step does not certainly keep, and the two numbers.
fn first_broken(
    cycle: &Cycle<'_>,
    from: &TrajectoryPoint,
    to: &TrajectoryPoint,
) -> Option<(Rule, [f64; 2])> {
    let Parameters { step_max_ns, v_max, .. } = cycle.parameters;
    let dt_ns = elapsed_ns(from.t_ns, to.t_ns);
    // H-11.1
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
    let rules = [
        // H-11.2
        (Rule::StepLength, true, at_most(size, length)),
        // H-11.3
        (Rule::StepSpeed, true, at_most(size, Real::new(v_max) * dt)),
        // H-11.4
        (Rule::StepForward, moves, at_least(u.dot(before), back)),
        (Rule::StepForward, moves, at_least(u.dot(after), back)),
        // H-11.5
        (Rule::StepLateral, true, aside(before)),
        (Rule::StepLateral, true, aside(after)),
        // H-11.6
        (Rule::StepTurn, true, at_least(before.dot(after), Real::new(LEAST_COSINE))),
        // H-11.7
        (Rule::StepTurn, true, at_most(before.cross(after).abs(), most_turned(dt, size))),
    ];
    first_of(rules)
}

/// Where headings lead from the first point on.
struct Slide<'p> {
    start: &'p TrajectoryPoint,
    /// L/2, m.
    half_length: f64,
    /// In plain doubles, and more than their comparison errs after the last step, m.
    plain: Sums<f64>,
    error: f64,
    /// The same with their errors, up to the point with this index.
    exact: Sums<Real>,
    driven: usize,
}

/// Over steps u with headings h1 and h2.
#[derive(Clone, Copy, Debug)]
struct Sums<N> {
    /// Of u x (h1 + h2), m.
    aside: N,
    /// Of u . (h1 + h2), m.
    along: N,
    /// Of h1 x h2.
    bent: N,
}

/// What a point may lie beside where the headings lead, both together, for each m along them.
const SLIDE: f64 = 0.1;
/// The same anywhere, m.
const SLIDE_STILL: f64 = 0.1;
/// The same for each s, m.
const SLIDE_DRIFT: f64 = 0.02;

/// By this times (n + 4)^2 (L + 1) plain doubles err less in the comparison after n steps, if all
/// of them keep the rules before it; else one of those is broken, and this one does not matter.
///
/// With e = 2^-53: abs(u) <= L, headings are at most 1 + 5e-7 long, so that a term of `aside` or
/// `along` is at most 2.1 L and rounded four times (both factors, their product, the sum of two),
/// and each sum so far is at most 2.1 L n: n terms and n additions err by at most
/// 2.1 L n (n + 4) e, those of `bent` by 1.1 n (n + 4) e. In the comparison `aside` counts once,
/// `along` a tenth, `bent` L/2 on either side: 3.5 L n (n + 4) e. Its own at most ten roundings are
/// of numbers up to 3 L n + 1: (30 L + 10) n e. Together less than 8 (n + 4)^2 (L + 1) e, and 8 e is
/// less than 1e-15.
const SLIDE_ERROR: f64 = 1e-15;

impl<'p> Slide<'p> {
    fn new(length: f64, start: &'p TrajectoryPoint, count: usize) -> Self {
        let n = f64::from(i32::try_from(count).unwrap_or(i32::MAX)) + 4.0;
        let error = SLIDE_ERROR * n * n * (length + 1.0);
        let plain = Sums { aside: 0.0, along: 0.0, bent: 0.0 };
        let exact = Sums { aside: Real::ZERO, along: Real::ZERO, bent: Real::ZERO };
        Self { start, half_length: 0.5 * length, plain, error, exact, driven: 0 }
    }

    #[inline]
    fn step_plainly(&mut self, from: &TrajectoryPoint, to: &TrajectoryPoint) {
        let (x, y) = (to.x - from.x, to.y - from.y);
        let (cos, sin) = (from.cos + to.cos, from.sin + to.sin);
        self.plain.aside += x * sin - y * cos;
        self.plain.along += x * cos + y * sin;
        self.plain.bent += from.cos * to.sin - from.sin * to.cos;
    }

    /// Whether the point, up to which the plain sums go, keeps the rule by more than they err, even
    /// without what the time leaves open, which is little.
    #[inline]
    fn is_fine(&self) -> bool {
        let Sums { aside, along, bent } = self.plain;
        let bent = self.half_length * bent;
        let most = bent.abs() + SLIDE * along + SLIDE_STILL;
        (aside + bent).abs() + self.error <= most
    }

    /// Brings the sums with their errors up to a point.
    fn drive_on(&mut self, points: &[TrajectoryPoint], index: usize) {
        for (from, to) in steps(points.get(self.driven..=index).unwrap_or_default()) {
            let u = Vector::between([from.x, from.y], [to.x, to.y]);
            let [before, after] = [from, to].map(heading);
            let (both, Sums { aside, along, bent }) = (before + after, self.exact);
            self.exact = Sums {
                aside: aside + u.cross(both),
                along: along + u.dot(both),
                bent: bent + before.cross(after),
            };
        }
        self.driven = index;
    }

    /// The rule and the two numbers, if the point, up to which the sums go, does not certainly keep
    /// it.
    fn broken(&self, point: &TrajectoryPoint) -> Option<(Rule, [f64; 2])> {
        let Sums { aside, along, bent } = self.exact;
        let t = Real::seconds(elapsed_ns(self.start.t_ns, point.t_ns));
        let bent = Real::new(self.half_length) * bent;
        let left_open = Real::new(SLIDE_STILL) + Real::new(SLIDE_DRIFT) * t;
        // H-11.8
        let most = bent.abs() + Real::new(SLIDE) * along + left_open;
        first_of([(Rule::Slide, true, at_most((aside + bent).abs(), most))])
    }
}

/// What measuring leaves open of the turn of a step, whatever the time and the way.
const STEP_TURN: f64 = 0.1;
/// What it leaves open for each s, or where a vehicle drives.
const NOISE: f64 = 0.1;
/// For each m of the way: no vehicle has a smaller turning circle.
const TIGHTEST: f64 = 0.5;
/// The bound on the sine of the turn of a step of this time and length.
fn most_turned(t: Real, size: Real) -> Real {
    Real::new(STEP_TURN) + Real::new(NOISE) * t + Real::new(TIGHTEST) * size
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
