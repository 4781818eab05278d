//! Whether an object meets the CAV (`spec/hardened/H-14.md#requirements-the-cav`, `#requirements-not-examined`, `#requirements-failure`).
//!
//! Most objects are told by the boxes of `cover` to miss it. What is left is decided place by place, by
//! `spot`; with error bounds, once an object, that it comes across the CAV or follows it.

use core::cell::LazyCell;

use crate::cycle::steps::{BOX, EXACT, NODE, PIECE, PLACE, STRETCHES, WALK};
use crate::hardened::h14_fail_safe::beside::{BEND, Beside, Passing, RADIUS};
use crate::hardened::h14_fail_safe::cover::{Clock, Cover, Covers, MOST, Object, Seen};
use crate::hardened::h14_fail_safe::motion::Motion;
use crate::hardened::h14_fail_safe::nodes::Nodes;
use crate::hardened::h14_fail_safe::path::{Path, Piece, Place, Start};
use crate::hardened::h14_fail_safe::spot::Spot;
use crate::hardened::h14_fail_safe::work::Work;
use crate::input::cycle::{Cycle, Ego, TrajectoryPoint};
use crate::numbers::plane::Vector;
use crate::numbers::range::{larger, smaller};
use crate::numbers::rectangle::{Rectangle, certainly_met};
use crate::numbers::rounding::Real;
use crate::stages::distances::s_b;
use crate::stages::ii_trajectory_to_map::indexed_route::IndexedRoute;
use crate::stages::llcc::sweep::split;
use crate::stages::llcc::{Pose, footprint, vector};

/// Where an object meets the CAV: the number of the place, its progress and `s_stop` in m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Met {
    pub(super) number: i64,
    pub(super) point: usize,
    pub(super) compared: [f64; 2],
}

/// The CAV on its path.
pub(super) struct Meeting<'c, 'a> {
    nodes: Nodes<'c, 'a>,
    trajectory: &'c [TrajectoryPoint],
    /// As wide as at the places.
    ego: Ego,
    aside: f64,
    clock: Clock,
    covers: Covers,
    route: IndexedRoute<'c, 'a>,
    /// Once they are needed.
    places: Option<Places<'c, 'a>>,
}

impl<'c, 'a> Meeting<'c, 'a> {
    pub(super) fn new(
        nodes: Nodes<'c, 'a>,
        trajectory: &'c [TrajectoryPoint],
        aside: f64,
        route: IndexedRoute<'c, 'a>,
    ) -> Self {
        let cycle = nodes.cycle;
        // H-14.26: as wide as at the places, or by less than 1e-13 of it more.
        let width = (cycle.ego.width + 2.0 * aside) * (1.0 + 1e-15);
        let (ego, clock) = (Ego { width, ..cycle.ego }, Clock::new(cycle));
        let covers = Covers::new(&ego, nodes, &clock.times);
        Self { nodes, trajectory, ego, aside, clock, covers, route, places: None }
    }

    const fn cycle(&self) -> &'c Cycle<'a> {
        self.nodes.cycle
    }

    /// As plain doubles have it.
    #[inline]
    pub(super) fn plainly(&self, motion: &Motion) -> Object {
        Object::new(&self.cycle().ego, motion, &self.clock)
    }

    /// All places as an object sees them, whatever its velocity.
    pub(super) fn seen_from(&self, motion: &Motion) -> Seen {
        self.covers.all.seen_from(&self.plainly(motion).at)
    }

    /// The box in which an item of an earlier list of that age has to be, so that an object that comes
    /// from there, no faster than that, may meet the CAV: as far as it has to go at least, in the time
    /// that it takes at the fastest, or that it has. Empty when there is no such place. With a box as far as
    /// the object goes at most, stage iv of W2 takes nearly twice as many instructions.
    pub(super) fn comes_from(&self, now: &Motion, speed: f64, dt: f64) -> [[f64; 2]; 2] {
        let ego = &self.ego;
        let latest = self.clock.longest(speed, now.age);
        let ([x, y], reach) = (now.now.centre, now.now.reach() + 1e-3);
        let to_go =
            |at: f64, [least, greatest]: [f64; 2]| [least - reach - at, greatest + reach - at];
        let [across, up] = self.covers.upright;
        let (across, up) = (to_go(x - ego.x, across), to_go(y - ego.y, up));
        let gap = |[least, greatest]: [f64; 2]| larger(larger(least, -greatest), 0.0);
        let soonest = larger(gap(across), gap(up)) / speed;
        let range = |at: f64, [least, greatest]: [f64; 2]| {
            let slowest = least / if least < 0.0 { soonest } else { latest };
            let fastest = greatest / if greatest > 0.0 { soonest } else { latest };
            let (slowest, fastest) = (larger(slowest, -speed), smaller(fastest, speed));
            [at - fastest * dt - 1e-3, at - slowest * dt + 1e-3]
        };
        [range(x, across), range(y, up)]
    }

    /// Whether the object misses the box around all places: surely when it does not come near the path (H-14.55).
    pub(super) fn is_far(&self, object: &Object) -> bool {
        self.covers.all.misses(object, &self.clock)
    }

    /// Whether boxes around stretches leave open whether it meets the CAV.
    pub(super) fn may_be_met(&self, object: &Object, work: &Work) -> bool {
        work.add(STRETCHES);
        !self.covers.miss(object, &self.clock)
    }

    /// The first place where the object may meet the CAV, if that is before the place with that number, and
    /// the object is examined.
    pub(super) fn first(
        &mut self,
        (motion, object): (&Motion, &Object),
        before: i64,
        work: &Work,
    ) -> Option<Met> {
        //
        let cycle = self.cycle();
        let exact = LazyCell::new(|| {
            work.add(EXACT);
            Exact::new(cycle, motion)
        });
        let Self { nodes, trajectory, ego, aside, clock, covers, route, places } = self;
        let places = places.get_or_insert_with(|| {
            let path = Path::new(*nodes);
            let points = trajectory.len();
            let (starts, beside) = (starts(&path, covers), Beside::new(&path, *route, *aside));
            Places { path, points, ego: *ego, starts, beside }
        });
        let boxes = (&*covers, &*clock, work);
        let comes_across = || exact.comes_across;
        let meets = |place: &Place| {
            (place.number >= before || places.meets(place, object, clock, comes_across))
                .then(|| places.met(place))
        };
        let met = places.first(object, boxes, meets)?;
        // H-14.28
        let counts = met.number < before && !work.is_too_much();
        (counts && !places.is_exempt((object, &exact), boxes)).then_some(met)
    }
}

/// The path from the first line of each stretch on.
fn starts<'a>(path: &Path<'_, 'a>, covers: &Covers) -> [Start<'a>; MOST] {
    let (mut pieces, mut line) = (path.pieces(), 0);
    let mut starts = [pieces.start; MOST];
    for (start, stretch) in starts.iter_mut().zip(covers.stretches()) {
        while line < stretch.lines[0] && pieces.next().is_some() {
            line = line.saturating_add(1);
        }
        *start = pieces.start;
    }
    starts
}

/// What lies around all places, when, and what looking there has taken.
type Boxes<'b> = (&'b Covers, &'b Clock, &'b Work);

/// The CAV at the places, with error bounds.
struct Places<'c, 'a> {
    path: Path<'c, 'a>,
    /// How many points the trajectory has.
    points: usize,
    ego: Ego,
    starts: [Start<'a>; MOST],
    beside: Beside<'c, 'a>,
}

impl<'c, 'a> Places<'c, 'a> {
    const fn cycle(&self) -> &'c Cycle<'a> {
        self.path.nodes.cycle
    }

    /// What is found at the first place where something is, of those where the object may meet the CAV.
    fn first<T>(
        &self,
        object: &Object,
        (covers, clock, work): Boxes<'_>,
        mut find: impl FnMut(&Place) -> Option<T>,
    ) -> Option<T> {
        work.add(WALK);
        let (mut done, mut next) = (0, None);
        for (start, stretch) in self.starts.iter().zip(covers.stretches()) {
            let [first, last] = stretch.lines;
            if last < done || stretch.cover.misses(object, clock) {
                continue;
            }
            // Where the walk has been already it goes on.
            let from = next.filter(|_| first < done).unwrap_or(*start);
            let mut pieces = self.path.pieces_from(from);
            for piece in (first.max(done)..=last).map_while(|_| pieces.next()) {
                work.add(PIECE);
                // What is found when it is too much makes no difference.
                let misses = |run| {
                    work.add(BOX);
                    work.is_too_much() || self.run(&piece, run, clock).misses(object, clock)
                };
                let found = piece.first_place(misses, |place| {
                    work.add(if place.number == piece.first { NODE } else { PLACE });
                    find(place)
                });
                if found.is_some() || work.is_too_much() {
                    return found;
                }
            }
            (done, next) = (last.saturating_add(1), Some(pieces.start));
        }
        None
    }

    /// The box around some places of a piece.
    fn run(&self, piece: &Piece, run: [i64; 2], clock: &Clock) -> Cover {
        let ego = &self.ego;
        let [[x, y, _], [to_x, to_y, length]] = piece.between(run, [ego.x, ego.y]);
        let h = [self.cycle().ego.cos, self.cycle().ego.sin];
        let [from, to] = [[x, y], [to_x, to_y]].map(|at| split(h, at)[0]);
        let mut cover = Cover::new(piece.heading());
        cover.lasts_for([smaller(from, to), length], &clock.times);
        cover.add(ego, [[x, y], [to_x, to_y]], piece.heading());
        cover
    }

    /// Whether the object may sweep over a point of the CAV's rectangle in the window of the place.
    fn meets(
        &self,
        place: &Place,
        object: &Object,
        clock: &Clock,
        comes_across: impl FnOnce() -> bool,
    ) -> bool {
        let times = &self.path.times;
        // H-14.45; H-14.11
        let (spot, start) = (Spot::new(&self.ego, place), times.plainly_first(place.least));
        let meets = |end: f64| !spot.is_missed(object, [start, end], clock);
        // H-14.12
        if let Some(after) = place.after.filter(|after| after.certainly_below(times.s_tyre)) {
            return meets(times.plainly_last(after));
        }
        // H-14.13
        meets(clock.until_yielded(object.speed))
            && (!comes_across() || meets(times.until_stop.value()))
    }

    fn met(&self, place: &Place) -> Met {
        // H-14.50
        let compared = [place.progress, self.path.times.s_stop].map(Real::value);
        Met { number: place.number, point: place.point(self.points), compared }
    }

    /// Whether the object certainly goes along, and follows the CAV or keeps beside its path.
    fn is_exempt(&mut self, (object, exact): (&Object, &Exact), boxes: Boxes<'_>) -> bool {
        let ego = &self.cycle().ego;
        let (h, w) = (vector([ego.cos, ego.sin]), exact.velocity);
        let (along, across) = (w.dot(h), w.cross(h).abs());
        let from = exact.now.centre - vector([ego.x, ego.y]);
        // H-14.34
        let most = Real::new(BEND) + from.norm().over(Real::new(RADIUS));
        // H-14.37
        if !exact.moves || !across.certainly_at_most(exact.speed * most) {
            return false;
        }
        // H-14.35; H-14.36; A-23
        if exact.is_behind && exact.comes_across && across.certainly_at_most(along) {
            return true;
        }
        let plain = |it: Vector| [it.x.value(), it.y.value()];
        let Rectangle { centre, direction, length, width } = exact.now;
        let passing = Passing {
            centre: plain(centre),
            direction: plain(direction),
            half: [length, width].map(|size| 0.5 * size),
            velocity: plain(exact.velocity),
            speed: exact.speed.value(),
            is_behind: exact.is_behind,
            comes_towards: across.certainly_at_most(-along),
            goes_ahead: Real::ZERO.certainly_below(along),
            until: self.until_yielded(exact.speed).value(),
        };
        self.beside.keeps(&passing, boxes.2) && !self.may_lie_across(&object.standing(from), boxes)
    }

    /// Whether an object that stands may share a point with the CAV at some place (H-14.38).
    fn may_lie_across(&self, object: &Object, boxes: Boxes<'_>) -> bool {
        let touches = |place: &Place| {
            (!Spot::new(&self.ego, place).is_missed(object, [0.0; 2], boxes.1)).then_some(())
        };
        self.first(object, boxes, touches).is_some()
    }

    /// H(w) = max(T, tau + `t_yield` + abs(w) / (2 `a_yield`)), s.
    fn until_yielded(&self, speed: Real) -> Real {
        let parameters = &self.cycle().parameters;
        let [tau, t_yield, a_yield] =
            [parameters.tau, parameters.t_yield, parameters.a_yield].map(Real::new);
        //
        let yielded = tau + t_yield + speed.over(a_yield + a_yield);
        self.path.times.until_stop.max(yielded)
    }
}

/// By how much the front of the inner rectangle is moved in, and its other sides at most, m.
const INNER: f64 = 0.3;

/// An object with error bounds.
struct Exact {
    /// Now.
    now: Rectangle,
    /// m/s; 0 where that makes no difference.
    velocity: Vector,
    speed: Real,
    /// Whether it does, however little.
    moves: bool,
    /// Whether it certainly is.
    is_behind: bool,
    /// Whether it certainly does.
    comes_across: bool,
}

impl Exact {
    fn new(cycle: &Cycle<'_>, motion: &Motion) -> Self {
        /// What is slower moves less than 2^-290 m.
        const SLOW: f64 = f64::from_bits((1023 - 400) << 52);
        let velocity = motion.velocity();
        let moves = [velocity.x, velocity.y].iter().any(|it| it.value().abs() > 0.0);
        let is_slow = velocity.x.magnitude() < SLOW && velocity.y.magnitude() < SLOW;
        let stays = Real::ZERO.widened(if is_slow { SLOW } else { 0.0 });
        let velocity = if is_slow { Vector { x: stays, y: stays } } else { velocity };
        let (speed, age) =
            (if is_slow { stays } else { velocity.norm() }, Real::seconds(motion.age_ns));
        let at = motion.now.displaced(vector([0.0; 2]));
        let now = Rectangle { centre: at.centre + velocity.times(age), ..at };
        let is_behind = is_behind(&cycle.ego, &now, velocity);
        let comes_across = !is_slow && comes_across(cycle, &now, velocity, is_behind);
        Self { now, velocity, speed, moves, is_behind, comes_across }
    }
}

/// Whether the object certainly goes the CAV's way, and all of it is behind the CAV's rear
/// (H-14.29).
fn is_behind(ego: &Ego, now: &Rectangle, velocity: Vector) -> bool {
    let (h, cav) = (vector([ego.cos, ego.sin]), footprint(ego, &Pose::of_cav(ego)));
    let Rectangle { centre, direction, length, width } = *now;
    let [length, width] = [length, width].map(|size| Real::new(0.5 * size));
    let reach = direction.dot(h).abs() * length + direction.cross(h).abs() * width;
    let front = (centre - cav.centre).dot(h) + reach;
    Real::ZERO.certainly_below(velocity.dot(h))
        && front.certainly_below(Real::new(-0.5 * ego.length))
}

/// Whether the object certainly shares a point with the inner rectangle, now or later (H-14.33).
///
/// The one here lies inside that of the text, and reaches less than 1e-9 m less far: each side is moved in
/// by 5e-10 m more, and no side is rounded by 1e-12 m. What b errs by is below 1e-15 m: `s_b(v)` is rounded
/// twice, by less than 2^-51 of it, and counts up to 0.3 m alone (what underflows is below 1e-290 m); the
/// minimum errs by no more than `s_b(v)`. The sizes, up to 100 m, are rounded by less than 1e-13 m, the way
/// back by less than 1e-15 m, and the sum of the centre and that bounds its own error.
fn comes_across(cycle: &Cycle<'_>, now: &Rectangle, velocity: Vector, is_behind: bool) -> bool {
    let ego = &cycle.ego;
    // H-14.31
    let b = if is_behind { 0.0 } else { smaller(INNER, s_b(&cycle.parameters, ego.speed)) };
    // H-14.30
    let (length, width) = (ego.length - (INNER + b) - 1e-9, ego.width - (b + b) - 1e-9);
    let cav = footprint(ego, &Pose::of_cav(ego));
    let back = cav.direction.times(Real::new(0.5 * (b - INNER)));
    let inner = Rectangle { centre: cav.centre + back, length, width, ..cav };
    // H-14.32
    length > 0.0 && width > 0.0 && certainly_met(&inner, now, velocity)
}
