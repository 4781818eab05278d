//! Who keeps beside the path (`spec/hardened/H-14.md#requirements-not-examined`).
//!
//! An object is compared with how far places reach to the sides of the reference path, all of them
//! together: in plain doubles, of which each distance errs by less than 2e-6 m, `ERROR` being more than
//! what is compared does. Only what these leave open is compared with error bounds, and these are found
//! once for all objects.

use crate::cycle::steps::{BESIDE, PLACE, SEGMENT, SIDE};
use crate::hardened::h14_fail_safe::path::{Path, Place};
use crate::hardened::h14_fail_safe::work::Work;
use crate::input::cycle::Ego;
use crate::numbers::plane::{Vector, distance_to_segment, from_segment};
use crate::numbers::range::{larger, smaller};
use crate::numbers::rectangle::Rectangle;
use crate::numbers::rounding::Real;
use crate::stages::ii_trajectory_to_map::indexed_route::{IndexedRoute, Segment, plain_square};
use crate::stages::llcc::sweep::{minus, split};
use crate::stages::llcc::{footprint, vector};

/// More than the plain distances here err, m.
const ERROR: f64 = 1e-4;
/// What the sine of the heading may be, and more for each m of progress: a path that bends.
pub(super) const BEND: f64 = 0.05;
pub(super) const RADIUS: f64 = 30.0;
/// The same radius for who does not come towards the CAV, m.
const STRAIGHT: f64 = 300.0;
/// How far from the reference path an object may be that keeps beside, m.
const FARTHEST: f64 = 20.0;
/// How far to the side, for each m beside the path and each m that it goes, who keeps to its lane drifts.
const DRIFT: f64 = 10.0;
/// No place is so far from the reference path, m.
const FAR: Real = Real::new(1e9);

/// An object that moves.
pub(super) struct Passing {
    /// Where it is now.
    pub(super) now: Rectangle,
    pub(super) velocity: Vector,
    pub(super) speed: Real,
    pub(super) is_behind: bool,
    /// Whether it certainly does, at 45 degrees at most.
    pub(super) comes_towards: bool,
    /// `t_H`, unless it keeps to its lane, s.
    pub(super) until: Real,
}

/// The CAV's path beside the reference path.
pub(super) struct Beside<'c, 'a> {
    path: Path<'c, 'a>,
    route: IndexedRoute<'c, 'a>,
    /// How far the CAV is aside of the first point (the widening of the text), m.
    aside: Real,
    lane: Option<Lane>,
    straight: Option<bool>,
    /// See `Beside::sides`.
    sides: Option<[Real; 2]>,
}

impl<'c, 'a> Beside<'c, 'a> {
    pub(super) const fn new(path: &Path<'c, 'a>, route: IndexedRoute<'c, 'a>, aside: Real) -> Self {
        Self { path: *path, route, aside, lane: None, straight: None, sides: None }
    }

    /// Whether the object certainly does (H-14.36), if it does not lie across the way.
    pub(super) fn keeps(&mut self, object: &Passing, work: &Work) -> bool {
        let lane = *self.lane.get_or_insert_with(|| Lane::new(&self.path, self.route, self.aside));
        if lane.is_open == Some(false) || !object.comes_towards && !self.is_straight() {
            return false;
        }
        work.add(BESIDE);
        //
        let Some((away, needed)) = self.needed(object, lane.hint, work) else { return false };
        lane.has_room_for(away.value(), needed.value()).unwrap_or_else(|| {
            if lane.is_closed_up {
                let [least, greatest] = self.sides(&lane, work);
                let room = (least - away).max(away - greatest);
                return needed.certainly_below(room * away);
            }
            let has_none = |place: &Place| {
                work.add(PLACE);
                // Where it is too much nothing makes a difference.
                (work.is_too_much() || !self.has_room(place, &lane, (away, needed))).then_some(())
            };
            !self.path.pieces().any(|it| it.first_place(|_| false, has_none).is_some())
        })
    }

    /// The least `D_k` - `E_k` and the greatest `D_k` + `E_k`; of a path that may bend too much, everything.
    fn sides(&mut self, lane: &Lane, work: &Work) -> [Real; 2] {
        if let Some(sides) = self.sides {
            return sides;
        }
        let pieces = self.path.pieces();
        let mut places = pieces.flat_map(|it| (0..it.count()).map(move |k| it.place(k)));
        let found = places.try_fold([FAR, -FAR], |[least, greatest], place| {
            work.add(SIDE);
            let [away, reach] = self.reach(&place, lane).filter(|_| !work.is_too_much())?;
            Some([least.min(away - reach), greatest.max(away + reach)])
        });
        *self.sides.insert(found.unwrap_or([-FAR, FAR]))
    }

    /// Whether lanes certainly run straight on for who does not come towards the CAV.
    fn is_straight(&mut self) -> bool {
        let (route, ego) = (self.route, &self.path.nodes.cycle.ego);
        *self.straight.get_or_insert_with(|| !turns(route, ego, STRAIGHT))
    }

    /// D, and what has to be less than the room beside the CAV times D; of several nearest points of the
    /// reference path the most. `None` where the object certainly keeps beside nothing.
    fn needed(&self, object: &Passing, hint: usize, work: &Work) -> Option<(Real, Real)> {
        let Rectangle { centre, direction, length, width } = object.now;
        let [length, width] = [length, width].map(|size| Real::new(0.5 * size));
        let away = self.route.nearest(centre, hint);
        let [x, y] = [centre.x.value(), centre.y.value()];
        let near = self.route.segments([x, y], away.value()).count();
        work.add(SEGMENT.saturating_mul(u64::try_from(near).unwrap_or(u64::MAX)));
        // H-14.37
        let is_near = away.certainly_at_most(Real::new(FARTHEST));
        if !is_near || !Real::ZERO.certainly_below(away) || !self.route.certainly_has_beside(centre)
        {
            return None;
        }
        let most = (object.speed * away).over(Real::new(DRIFT));
        let mut needed = Real::ZERO;
        self.route.each_nearest(centre, away, |segment| {
            for q in from_segment(centre, segment.from, segment.to).into_iter().flatten() {
                let drift = object.velocity.dot(q).abs();
                // H-14.43
                let keeps_lane = object.is_behind && drift.certainly_at_most(most);
                let drifts = if keeps_lane { Real::ZERO } else { drift * object.until };
                let reach = direction.dot(q).abs() * length + direction.cross(q).abs() * width;
                needed = needed.max(reach + drifts);
            }
        });
        Some((away, needed))
    }

    /// Whether there certainly is room at a place.
    fn has_room(&self, place: &Place, lane: &Lane, (away, needed): (Real, Real)) -> bool {
        self.reach(place, lane).is_some_and(|[from, reach]| {
            // H-14.42
            needed.certainly_below(((away - from).abs() - reach) * away)
        })
    }

    /// `D_k` and the most `E_k` of a place, where the path certainly bends little and lies beyond no end of
    /// the route.
    fn reach(&self, place: &Place, lane: &Lane) -> Option<[Real; 2]> {
        let ego = &self.path.nodes.cycle.ego;
        let (h, h_k) = (vector([ego.cos, ego.sin]), vector(place.pose.heading));
        // H-14.41
        let most = Real::new(BEND) + place.progress.over(Real::new(RADIUS));
        let centre = footprint(ego, &place.pose).centre;
        if !h.cross(h_k).abs().certainly_at_most(most) || !self.route.certainly_has_beside(centre) {
            return None;
        }
        let nearest = self.route.nearest(centre, lane.hint);
        let mut extent = Real::ZERO;
        self.route.each_nearest(centre, nearest, |segment| {
            let g = Vector::between(segment.from, segment.to);
            let [length, width] = [ego.length, ego.width].map(|size| Real::new(0.5 * size));
            // H-14.42
            let across = h_k.dot(g).abs() * width + h_k.cross(g).abs() * length;
            extent = extent.max(across.over(g.norm()));
        });
        Some([nearest, extent + self.aside])
    }
}

/// How far places reach to the sides of the reference path. Asked of each place instead, stage iv of W3 takes
/// a quarter more instructions.
#[derive(Clone, Copy, Debug)]
struct Lane {
    /// The least `D_k` - `E_k` and the greatest `D_k` + `E_k`: with the most and with the least `E_k` that may
    /// be, m.
    outer: [f64; 2],
    inner: [f64; 2],
    /// Whether the path bends little everywhere, and lies beyond no end of the route, if that is certain.
    is_open: Option<bool>,
    /// Whether nothing is between two places that follow each other: then room beside all of them is on
    /// one side of all.
    is_closed_up: bool,
    /// A segment that is near.
    hint: usize,
}

impl Lane {
    fn new(path: &Path<'_, '_>, route: IndexedRoute<'_, '_>, aside: Real) -> Self {
        let &Ego { x, y, .. } = &path.nodes.cycle.ego;
        let none = [f64::MAX, f64::MIN];
        let mut lane =
            Self { outer: none, inner: none, is_open: Some(true), is_closed_up: true, hint: 0 };
        if turns(route, &path.nodes.cycle.ego, RADIUS) {
            return Self { is_open: Some(false), ..lane };
        }
        route.in_corridor([x, y], &mut lane.hint);
        let mut before = [f64::MIN, f64::MAX];
        for piece in path.pieces() {
            for k in 0..piece.count() {
                let Some(place) = piece.plainly(k) else {
                    (lane.is_open, lane.is_closed_up) = (None, false);
                    continue;
                };
                lane.add(
                    &path.nodes.cycle.ego,
                    [place, piece.heading()],
                    route,
                    (aside, &mut before),
                );
                if lane.is_open == Some(false) {
                    return lane;
                }
            }
        }
        lane
    }

    /// With one more place, and the heading. `before`: how far the one before reaches.
    fn add(
        &mut self,
        ego: &Ego,
        [[x, y], [cos, sin]]: [[f64; 2]; 2],
        route: IndexedRoute<'_, '_>,
        (aside, before): (Real, &mut [f64; 2]),
    ) {
        let centre = [x + ego.center_offset * cos, y + ego.center_offset * sin];
        let [progress, _] = split([ego.cos, ego.sin], minus([x, y], [ego.x, ego.y]));
        let more = (ego.cos * sin - ego.sin * cos).abs() - BEND - progress / RADIUS;
        let bends_little = if more.abs() > ERROR { Some(more < 0.0) } else { None };
        self.is_open = both(self.is_open, both(bends_little, route.plainly_has_beside(centre)));
        let (away, near) = route.about(centre, self.hint);
        self.hint = near;
        let extents = extents(ego, [cos, sin], route, (centre, away));
        let [outer, inner] = extents.map(|extent| {
            let reach = extent + aside.value();
            [away - reach, away + reach]
        });
        (self.outer, self.inner) = (joined(self.outer, outer), joined(self.inner, inner));
        self.is_closed_up &= inner[0] < before[1] - ERROR && before[0] < inner[1] - ERROR;
        *before = inner;
    }

    /// Whether there is room beside all places for what is so far from the reference path, if that is
    /// certain.
    fn has_room_for(&self, away: f64, needed: f64) -> Option<bool> {
        let needed = needed / away;
        let room = |[least, greatest]: [f64; 2]| larger(least - away, away - greatest) - needed;
        let has_room = self.is_open == Some(true) && room(self.outer) > ERROR;
        let has_none = self.is_closed_up && room(self.inner) < -ERROR;
        if has_room || has_none { Some(has_room) } else { None }
    }
}

/// Whether a segment of the route may turn more than a bend of that radius does (H-14.40), m; none
/// that is farther away can. Plain doubles tell most.
fn turns(route: IndexedRoute<'_, '_>, ego: &Ego, radius: f64) -> bool {
    let (p, h) = (Vector::new(ego.x, ego.y), vector([ego.cos, ego.sin]));
    route.segments([ego.x, ego.y], radius).any(|Segment { from, to, index }| {
        let (x, y) = (to[0] - from[0], to[1] - from[1]);
        let (length, across) = (libm::sqrt(x * x + y * y), (ego.cos * y - ego.sin * x).abs());
        let room = length * (BEND + route.at_most([ego.x, ego.y], index) / radius) - across;
        if room.abs() > ERROR * length {
            return room < 0.0;
        }
        let g = Vector::between(from, to);
        let most = Real::new(BEND) + distance_to_segment(p, from, to).over(Real::new(radius));
        !h.cross(g).abs().certainly_at_most(g.norm() * most)
    })
}

/// The most and the least of half the extent of the CAV across segments that may be nearest, m.
fn extents(
    ego: &Ego,
    [cos, sin]: [f64; 2],
    route: IndexedRoute<'_, '_>,
    (centre, away): ([f64; 2], f64),
) -> [f64; 2] {
    let (mut most, mut least) = (0.0, f64::MAX);
    let reach = away + ERROR;
    let near = route.segments(centre, reach);
    near.filter(|it| plain_square(centre, it) <= reach * reach).for_each(|segment| {
        let (x, y) = (segment.to[0] - segment.from[0], segment.to[1] - segment.from[1]);
        let (along, across) = ((cos * x + sin * y).abs(), (cos * y - sin * x).abs());
        let extent = 0.5 * (along * ego.width + across * ego.length) / libm::sqrt(x * x + y * y);
        (most, least) = (larger(most, extent), smaller(least, extent));
    });
    [most, least]
}

/// Whether both are so, if that is known.
fn both(one: Option<bool>, other: Option<bool>) -> Option<bool> {
    match (one, other) {
        (Some(false), _) | (_, Some(false)) => Some(false),
        (Some(true), Some(true)) => Some(true),
        (None, _) | (_, None) => None,
    }
}

fn joined([a, b]: [f64; 2], [c, d]: [f64; 2]) -> [f64; 2] {
    [smaller(a, c), larger(b, d)]
}
