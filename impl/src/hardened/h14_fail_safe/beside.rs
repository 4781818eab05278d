//! Who keeps beside the path (`spec/hardened/H-14.md#requirements-not-examined`).
//!
//! Plain doubles decide: what is closer than `ERROR` does not keep beside, as MARGIN-18 allows. Distances
//! here err by less than 1e-5 m, and directions by less than 4e-7.

use crate::cycle::steps::{BESIDE, SEGMENT};
use crate::hardened::h14_fail_safe::path::{Path, Piece};
use crate::hardened::h14_fail_safe::work::Work;
use crate::input::cycle::{CrossSection, Ego};
use crate::numbers::range::{larger, smaller};
use crate::stages::ii_trajectory_to_map::indexed_route::{IndexedRoute, Segment};
use crate::stages::llcc::sweep::{minus, split};

/// More than what is compared here errs: m, or a part of 1.
const ERROR: f64 = 1e-5;
/// More than the direction of q errs.
const ASKEW: f64 = 4e-7;
/// What is shorter has no direction here, m.
const SHORT: f64 = 1e-9;
/// What the sine of the heading may be, and more for each m of progress: a path that bends.
pub(super) const BEND: f64 = 0.05;
pub(super) const RADIUS: f64 = 30.0;
/// The same radius for who does not come towards the CAV, m.
const STRAIGHT: f64 = 300.0;
/// Nobody keeps beside nearer to the reference path: less than the 0.1 m of MARGIN-18, m.
const NEAREST: f64 = 0.09;
/// Nor farther from it (H-14.37), m.
const FARTHEST: f64 = 20.0;
/// How far to the side, for each m that it goes, who keeps to its lane drifts.
const DRIFT: f64 = 0.1;
/// So much nearer than at p the CAV certainly may come to who keeps to its lane, m: less than the 1/8 m of H-14.43 by more
/// than two distances err.
const NEARER: f64 = 0.125 - 4.0 * ERROR;

/// An object that moves.
pub(super) struct Passing {
    /// Where it is now, and half its size, m.
    pub(super) centre: [f64; 2],
    pub(super) direction: [f64; 2],
    pub(super) half: [f64; 2],
    pub(super) velocity: [f64; 2],
    pub(super) speed: f64,
    pub(super) is_behind: bool,
    /// Whether it certainly does, at 45 degrees at most.
    pub(super) comes_towards: bool,
    /// Whether it certainly goes ahead along the CAV's heading.
    pub(super) goes_ahead: bool,
    /// H(w), s.
    pub(super) until: f64,
}

/// The CAV's path beside the reference path.
pub(super) struct Beside<'c, 'a> {
    path: Path<'c, 'a>,
    route: IndexedRoute<'c, 'a>,
    /// How far the CAV is aside of the first point (the widening of the text), m.
    aside: f64,
    /// Once they are needed.
    lane: Option<Lane>,
    straight: Option<bool>,
}

impl<'c, 'a> Beside<'c, 'a> {
    pub(super) const fn new(path: &Path<'c, 'a>, route: IndexedRoute<'c, 'a>, aside: f64) -> Self {
        Self { path: *path, route, aside, lane: None, straight: None }
    }

    /// Whether the object certainly does (H-14.36), if it does not lie across the way.
    pub(super) fn keeps(&mut self, object: &Passing, work: &Work) -> bool {
        let new = || Lane::new(&self.path, self.route, self.aside);
        let Lane { of_p_and_all, hint } = *self.lane.get_or_insert_with(new);
        let Some([of_p, of_all]) = of_p_and_all else { return false };
        if !object.comes_towards && !self.is_straight() {
            return false;
        }
        let hint = self.route.nearer(object.centre, hint);
        let looked_at = self.route.count_within(object.centre, hint);
        work.add(BESIDE.saturating_add(SEGMENT.saturating_mul(looked_at)));
        let (away, _) = self.route.about(object.centre, hint);
        // H-14.37
        if !(NEAREST..FARTHEST - ERROR).contains(&away) || !self.route.has_beside(object.centre) {
            return false;
        }
        //
        let [length, width] = object.half;
        let askew = ASKEW * (object.speed * object.until + length + width);
        let [least, greatest] = of_all.away;
        let (nearer, farther) = (least - away, away - greatest);
        let room = larger(nearer, farther) - ERROR - askew - self.sagitta(object);
        // H-14.43
        let comes_no_nearer = |side| match side {
            _ if nearer > farther => least > of_p.away[0] - NEARER,
            Some(Side::Left) => of_all.left[1] < of_p.left[1] + NEARER,
            Some(Side::Right) => of_all.left[0] > of_p.left[0] - NEARER,
            None => false,
        };
        // H-14.44
        let mut nearest = self.route.nearest(object.centre, away);
        nearest.all(|segment| {
            let keeps_lane = object.is_behind && comes_no_nearer(side(object.centre, &segment));
            needed(object, segment.towards(object.centre), keeps_lane) < room
        })
    }

    /// How much nearer to each other the object and the CAV are on a bend (H-14.42), m.
    fn sagitta(&self, object: &Passing) -> f64 {
        let radius = if object.goes_ahead { STRAIGHT } else { RADIUS };
        let ego = &self.path.nodes.cycle.ego;
        let [length, width] = object.half;
        let (half, ego) = (larger(length, width), larger(ego.length, ego.width));
        (4.0 * half * half + ego * ego) / (6.0 * radius)
    }

    /// Whether lanes certainly run straight on for who does not come towards the CAV.
    fn is_straight(&mut self) -> bool {
        let (route, ego) = (self.route, &self.path.nodes.cycle.ego);
        *self.straight.get_or_insert_with(|| !turns(route, ego, STRAIGHT))
    }
}

/// How much room an object needs along q without the sagitta (H-14.42), m. `keeps_lane`: where it drifts little.
fn needed(object: &Passing, q: [f64; 2], keeps_lane: bool) -> f64 {
    let &Passing { direction, half: [length, width], velocity, speed, until, .. } = object;
    let away = libm::sqrt(q[0] * q[0] + q[1] * q[1]);
    let drift = (velocity[0] * q[0] + velocity[1] * q[1]).abs() / away;
    // H-14.43
    let keeps_lane = keeps_lane && drift < speed * (DRIFT - ERROR);
    let [along, across] = split(direction, q);
    (along.abs() * length + across.abs() * width) / away
        + if keeps_lane { 0.0 } else { drift * until }
}

/// What the CAV covers beside the reference path, each from the least to the greatest, m.
#[derive(Clone, Copy, Debug)]
struct Covered {
    /// By the distance.
    away: [f64; 2],
    /// By how far it is to the left.
    left: [f64; 2],
}

impl Covered {
    /// Of a place for one segment: for every side that may be its, and for some.
    fn both(away: f64, side: Option<Side>, reach: f64) -> [Self; 2] {
        let [right, left] = match side {
            Some(Side::Left) => [away; 2],
            Some(Side::Right) => [-away; 2],
            None => [-away, away],
        };
        let away = [away - reach, away + reach];
        [[left - reach, right + reach], [right - reach, left + reach]]
            .map(|left| Self { away, left })
    }

    /// What one or the other covers.
    fn or(self, other: Self) -> Self {
        let or = |a: [f64; 2], b: [f64; 2]| [smaller(a[0], b[0]), larger(a[1], b[1])];
        Self { away: or(self.away, other.away), left: or(self.left, other.left) }
    }

    /// What both cover, whose least may be beyond its greatest.
    fn and(self, other: Self) -> Self {
        let and = |a: [f64; 2], b: [f64; 2]| [larger(a[0], b[0]), smaller(a[1], b[1])];
        Self { away: and(self.away, other.away), left: and(self.left, other.left) }
    }
}

/// A side of a segment.
#[derive(Clone, Copy, Debug)]
enum Side {
    Left,
    Right,
}

/// On which side of a segment a point certainly is.
fn side(x: [f64; 2], segment: &Segment) -> Option<Side> {
    let way @ [u, v] = segment.way();
    let [_, left] = split(way, minus(x, segment.from));
    if left * left <= ERROR * ERROR * (u * u + v * v) {
        None
    } else if left > 0.0 {
        Some(Side::Left)
    } else {
        Some(Side::Right)
    }
}

/// The path as it lies beside the reference path.
#[derive(Clone, Copy, Debug)]
struct Lane {
    /// What p covers whichever segment is meant, and what all places do. None where the path may bend too much, lie
    /// beyond an end of the route, or end anywhere.
    of_p_and_all: Option<[Covered; 2]>,
    /// A segment that is near.
    hint: usize,
}

impl Lane {
    fn new(path: &Path<'_, '_>, route: IndexedRoute<'_, '_>, aside: f64) -> Self {
        let ego = &path.nodes.cycle.ego;
        let mut hint = 0;
        route.in_corridor([ego.x, ego.y], &mut hint);
        if turns(route, ego, RADIUS) {
            return Self { of_p_and_all: None, hint };
        }
        let pieces = path.pieces();
        let mut places = pieces.flat_map(|piece| (0..piece.count()).map(move |k| (piece, k)));
        let of_p_and_all = places.try_fold(None, |both: Option<[Covered; 2]>, place| {
            let each = covered(ego, place, &route, aside, &mut hint)?;
            Some(Some(match both {
                None => each.reduce(|[of_p, all], [also, it]| [of_p.and(also), all.or(it)])?,
                Some([of_p, all]) => [of_p, each.fold(all, |all, [_, it]| all.or(it))],
            }))
        });
        Self { of_p_and_all: of_p_and_all.flatten(), hint }
    }
}

/// What the CAV covers at a place for each nearest segment: for every side that may be its, and for some; none where the path
/// may bend too much, lie beyond an end of the route, or end anywhere. `hint`: a segment that is near.
fn covered<'r>(
    ego: &'r Ego,
    (piece, k): (Piece, i64),
    route: &'r IndexedRoute<'_, '_>,
    aside: f64,
    hint: &mut usize,
) -> Option<impl Iterator<Item = [Covered; 2]> + 'r> {
    let ([x, y], [cos, sin]) = (piece.plainly(k, [0.0; 2]), piece.heading());
    let centre = [x + ego.center_offset * cos, y + ego.center_offset * sin];
    let h = [ego.cos, ego.sin];
    let ([progress, _], [_, turned]) =
        (split(h, minus([x, y], [ego.x, ego.y])), split(h, [cos, sin]));
    // H-14.41; H-14.39
    let bends_little = turned.abs() < BEND + progress / RADIUS - ERROR;
    if !bends_little || !route.has_beside(centre) || k == 0 && !piece.has_certain_end() {
        return None;
    }
    let (away, near) = route.about(centre, *hint);
    *hint = near;
    Some(route.nearest(centre, away).map(move |segment| {
        let reach = extent(ego, [cos, sin], &segment) + aside;
        Covered::both(away, side(centre, &segment), reach)
    }))
}

/// Whether a segment of the route may turn more than a bend of that radius does (H-14.40), m; none
/// that is farther away can.
fn turns(route: IndexedRoute<'_, '_>, ego: &Ego, radius: f64) -> bool {
    let p = [ego.x, ego.y];
    route.segments(p, radius).any(|segment| {
        let [_, across] = split([ego.cos, ego.sin], segment.way());
        let most = BEND + libm::sqrt(segment.square_to(p)) / radius - ERROR;
        across.abs() + SHORT > segment.length() * most
    })
}

/// Half the extent of the CAV across a segment (`E_k` without the widening), m.
fn extent(ego: &Ego, heading: [f64; 2], segment: &Segment) -> f64 {
    let [along, across] = split(heading, segment.way()).map(f64::abs);
    let length = segment.length();
    let extent = 0.5 * (along * ego.width + across * ego.length) / length;
    // Of what is shorter the square underflows; in the strict model a route with it turns.
    if length > 1e-100 { extent } else { f64::MAX }
}

impl<'a> IndexedRoute<'_, 'a> {
    /// Whether a place certainly lies beyond neither end of the reference path, if it has ends (H-14.39).
    fn has_beside(&self, [x, y]: [f64; 2]) -> bool {
        self.ends().all(|(end, next)| {
            let (u, v) = (next.x - end.x, next.y - end.y);
            (x - end.x) * u + (y - end.y) * v > ERROR * (u.abs() + v.abs()) + SHORT
        })
    }

    /// The ends of an open route, each with the reference point next to it (H-14.39).
    fn ends(&self) -> impl Iterator<Item = (&'a CrossSection, &'a CrossSection)> {
        let (cross_sections, last) = (self.route.cross_sections, self.pairs());
        let ends = [[0, 1], [last, last.saturating_sub(1)]];
        let open = ends.into_iter().take(if self.route.closed { 0 } else { 2 });
        open.filter_map(move |[end, next]| cross_sections.get(end).zip(cross_sections.get(next)))
    }
}
