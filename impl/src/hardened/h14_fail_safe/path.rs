//! The path of the CAV: pieces and places (`spec/hardened/H-14.md#requirements-the-path`). Nothing is kept: a
//! piece says where each of its places is.
//!
//! The places of a piece are taken with the node from which it leads, not with the one to which, so
//! that all of them have one heading.

use core::ops::ControlFlow::{self, Break, Continue};

use crate::hardened::h14_fail_safe::nodes::Nodes;
use crate::hardened::h14_fail_safe::times::{Times, longest};
use crate::input::cycle::{Ego, TrajectoryPoint};
use crate::numbers::plane::Vector;
use crate::numbers::range::larger;
use crate::numbers::rounding::Real;
use crate::stages::llcc::{Pose, vector};

/// The nodes with times, in numbers with error bounds.
#[derive(Clone, Copy)]
pub(crate) struct Path<'c, 'a> {
    pub(crate) nodes: Nodes<'c, 'a>,
    pub(crate) times: Times<Real>,
}

impl<'c, 'a> Path<'c, 'a> {
    pub(crate) fn new(nodes: Nodes<'c, 'a>) -> Self {
        Self { nodes, times: Times::new(nodes.cycle) }
    }

    /// The pieces with a place, in order (H-14.6).
    pub(crate) fn pieces(&self) -> Pieces<'a> {
        let Nodes { cycle, points, .. } = self.nodes;
        let &Ego { x, y, cos, sin, .. } = &cycle.ego;
        let (at, heading) = ([x, y], [cos, sin]);
        let next =
            Node { at, heading, progress: Real::ZERO, length: Real::ZERO, before: Real::ZERO };
        self.pieces_from(Start { next: Some(next), nodes: points, first: 0 })
    }

    /// The rest of them.
    pub(crate) fn pieces_from(&self, start: Start<'a>) -> Pieces<'a> {
        let cycle = self.nodes.cycle;
        let &Ego { x, y, cos, sin, .. } = &cycle.ego;
        let s_stop = self.times.s_stop;
        let (h, longest) = (vector([cos, sin]), longest(s_stop));
        let beside = Real::new(larger(1.0, cycle.parameters.lateral_tolerance));
        let farthest = (s_stop + beside).squared();
        Pieces { start, ends: Ends { p: [x, y], h, s_stop, farthest, longest }, d: self.nodes.d }
    }
}

/// Where a piece begins.
#[derive(Clone, Copy, Debug)]
struct Node {
    at: [f64; 2],
    heading: [f64; 2],
    progress: Real,
    length: Real,
    /// The progress of the place before.
    before: Real,
}

/// Where the list of places ends: where the progress from p on is `s_stop`, or the distance above `farthest`, or the
/// length above `longest`.
#[derive(Clone, Copy, Debug)]
struct Ends {
    p: [f64; 2],
    h: Vector,
    s_stop: Real,
    /// Its square, m^2.
    farthest: Real,
    longest: Real,
}

/// Place k of n on a piece: what part of it is behind. Exact up to the division below 2^53; what is beyond that is beyond the
/// greatest length, too.
fn share(k: i64, n: i64) -> Real {
    Real::quotient(Real::integer(k).value(), Real::integer(n).value())
}

/// See `Path::pieces`.
pub(crate) struct Pieces<'p> {
    pub(crate) start: Start<'p>,
    ends: Ends,
    d: f64,
}

/// What pieces are left.
#[derive(Clone, Copy)]
pub(crate) struct Start<'p> {
    next: Option<Node>,
    nodes: &'p [TrajectoryPoint],
    first: i64,
}

/// From a node to the next one, or from the last one on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    node: Node,
    /// To the next node, or to the first place behind the last one.
    u: Vector,
    /// How much it adds to the progress and to the length, m.
    gain: Real,
    more: Real,
    /// As many places as that takes.
    n: i64,
    /// The number of the place at the node.
    pub(crate) first: i64,
    /// How many places there are, but for the last of all.
    places: i64,
    /// Where the last of all is, if it is at `s_stop` and here: this times u from the node.
    end: Option<Real>,
    /// Whether another one is the last of all, the last one here.
    is_over: bool,
    s_stop: Real,
}

/// A place, and where the CAV has been before and is after.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// 0 is that of the CAV now.
    pub(crate) number: i64,
    pub(crate) pose: Pose,
    pub(crate) progress: Real,
    /// The least progress of the place and its neighbours, from 0 on.
    pub(crate) least: Real,
    /// The length at the place after, if there is one.
    pub(crate) after: Option<Real>,
}

impl Place {
    /// As what point of the trajectory a witness counts it (H-14.9).
    pub(crate) fn point(&self, points: usize) -> usize {
        points.saturating_add(usize::try_from(self.number).unwrap_or(usize::MAX))
    }
}

impl Iterator for Pieces<'_> {
    type Item = Piece;

    /// Where it is open whether a node is beyond `s_stop`, the last place is on the piece to it, and the
    /// node and what follows are there, too. Where it is open where on the piece that is, all its places are within what
    /// rounding leaves open of `s_stop`.
    fn next(&mut self) -> Option<Piece> {
        let node = self.start.next.take()?;
        let (Ends { h, s_stop, .. }, d, heading) = (self.ends, self.d, vector(node.heading));
        let to = self.start.nodes.split_first();
        // H-14.59
        let (u, n, more) = match to {
            Some((to, _)) => {
                let u = Vector::between(node.at, [to.x, to.y]);
                // H-14.3
                let n = steps(greatest(node.at, [to.x, to.y]), d).max(1);
                (u, n, u.dot(heading).abs() + u.cross(heading).abs())
            }
            // H-14.5
            None => (heading.times(Real::new(d)), 1, Real::new(d)),
        };
        // H-14.2
        let gain = u.dot(h);
        let (progress, length, first) =
            (node.progress + gain, node.length + more, self.start.first);
        let (places, end, is_over) = (n, None, false);
        let mut piece = Piece { node, u, gain, more, n, first, places, end, is_over, s_stop };
        let ends = to.is_none() || !progress.certainly_at_most(s_stop);
        let most = if to.is_some() { n } else { i64::MAX };
        if ends && gain.value() > 0.0 {
            let share = (s_stop - node.progress).over(gain);
            if share.off() * Real::integer(n).value() < 0.5 {
                // H-14.7
                let is_beyond = |k| s_stop.certainly_below(piece.progress(k));
                piece.places = piece.first_with(share, 1, is_beyond).min(most);
                piece.end = Some(share);
            }
        }
        let beyond = piece.first_beyond(self.ends, to.map(|(to, _)| [to.x, to.y]));
        if beyond < piece.places || piece.end.is_none() && to.is_none() {
            piece.places = beyond.saturating_add(1);
            (piece.end, piece.is_over) = (None, true);
            return Some(piece);
        }
        if let Some((to, rest)) = to.filter(|_| !ends || progress.possibly_at_most(s_stop)) {
            let (at, heading) = ([to.x, to.y], [to.cos, to.sin]);
            let before = piece.progress(n.saturating_sub(1));
            self.start.next = Some(Node { at, heading, progress, length, before });
            self.start.nodes = rest;
            self.start.first = first.saturating_add(piece.count());
        }
        Some(piece)
    }
}

/// The greater of the two parts of the way from one point to another; exact.
fn greatest(from: [f64; 2], to: [f64; 2]) -> Real {
    let [x, y] = [Real::difference(to[0], from[0]).abs(), Real::difference(to[1], from[1]).abs()];
    if y.certainly_below(x) { x } else { y }
}

/// The least n with length <= n d (H-14.3); exact. A quotient in plain doubles is below
/// 2^33, so that it errs by less than 1e-5; the length, a difference of two doubles, and the product have no error, so that
/// their order is certain.
#[allow(clippy::cast_possible_truncation, reason = "below 2^33")]
fn steps(length: Real, d: f64) -> i64 {
    let nearest = libm::floor(length.value() / d + 0.5);
    let fewer = nearest as i64;
    let fits = length.certainly_at_most(Real::new(nearest) * Real::new(d));
    if fits { fewer } else { fewer.saturating_add(1) }
}

impl Piece {
    /// The number of places.
    pub(crate) fn count(&self) -> i64 {
        self.places.saturating_add(i64::from(self.end.is_some()))
    }

    /// The least k from `least` on of which that holds; `share` of u leads to about there.
    #[allow(
        clippy::cast_possible_truncation,
        reason = "what is above is as good as without an end"
    )]
    fn first_with(&self, share: Real, least: i64, holds: impl Fn(i64) -> bool) -> i64 {
        let guess = libm::floor(share.value() * Real::integer(self.n).value()) as i64;
        let mut near = guess.max(least)..=guess.saturating_add(2).max(least);
        near.find(|&k| holds(k)).unwrap_or(guess.saturating_add(3).max(least))
    }

    /// The first place that certainly has a greater length than the longest or is farther from p than the farthest; none
    /// of a piece with an end is beyond n (H-14.60). Of places in a line the squared distance is convex, and no more than
    /// that of the node or of the end of the piece.
    fn first_beyond(
        &self,
        Ends { p, farthest: limit, longest, .. }: Ends,
        to: Option<[f64; 2]>,
    ) -> i64 {
        let is_endless = to.is_none();
        // Plain doubles err by less than 1e-15 of these squares.
        let near = limit.value() * (1.0 - 1e-9);
        let is_near = |at: [f64; 2]| {
            let (x, y) = (at[0] - p[0], at[1] - p[1]);
            x * x + y * y <= near
        };
        let is_clear = to.is_some_and(|to| is_near(self.node.at) && is_near(to));
        let from_p = Vector::between(p, self.node.at);
        let is_far = |k: i64| {
            let away = from_p + self.u.times(share(k, self.n));
            limit.certainly_below(away.dot(away))
        };
        let mut beyond = if is_endless { i64::MAX } else { self.n };
        if !is_clear && is_far(0) {
            return 0;
        }
        if is_endless || !is_clear && is_far(self.n) {
            let (along, squared) = (from_p.dot(self.u), self.u.dot(self.u));
            let left = along.squared() + squared * (limit - from_p.dot(from_p));
            let share = (left.max(Real::ZERO).sqrt() - along).over(squared);
            beyond = self.first_with(share, 1, is_far).min(beyond);
        }
        if is_endless || !(self.node.length + self.more).certainly_at_most(longest) {
            let share = (longest - self.node.length).over(self.more);
            let is_long = |k| longest.certainly_below(self.length(k));
            beyond = self.first_with(share, 0, is_long).min(beyond);
        }
        beyond
    }

    fn share(&self, k: i64) -> Real {
        match self.end {
            Some(end) if k >= self.places => end,
            _ => share(k, self.n),
        }
    }

    /// The progress of place k, except the last one.
    fn progress(&self, k: i64) -> Real {
        let Node { progress, .. } = self.node;
        if k == 0 { progress } else { progress + self.gain * share(k, self.n) }
    }

    /// The length at a place of this piece (H-14.59).
    pub(crate) fn length_at(&self, place: &Place) -> Real {
        self.length(place.number.saturating_sub(self.first))
    }

    /// The length at place k.
    fn length(&self, k: i64) -> Real {
        let Node { length, .. } = self.node;
        if k == 0 { length } else { length + self.more * self.share(k) }
    }

    /// Place k from the node on (H-14.4), the last one of all with the heading of its piece
    /// (H-14.8).
    pub(crate) fn place(&self, k: i64) -> Place {
        let (next, s_stop) = (k.saturating_add(1), self.s_stop);
        let is_end = |k: i64| self.end.is_some() && k >= self.places;
        let is_last = is_end(k) || self.is_over && next >= self.places;
        let progress = |k: i64| if is_end(k) { s_stop } else { self.progress(k) };
        let before = if k == 0 { self.node.before } else { progress(k.saturating_sub(1)) };
        let here = progress(k);
        let after = if is_last { here } else { progress(next) };
        let node = vector(self.node.at);
        Place {
            number: self.first.saturating_add(k),
            pose: Pose {
                at: if k == 0 { node } else { node + self.u.times(self.share(k)) },
                heading: self.node.heading,
            },
            progress: here,
            least: before.min(here).min(after).max(Real::ZERO),
            after: (!is_last).then(|| self.length(next)),
        }
    }

    /// Between which two places, x and y from another point, and length, all of these certainly are; in
    /// plain doubles. The last one is somewhere behind the one before.
    pub(crate) fn between(&self, [first, last]: [i64; 2], [x, y]: [f64; 2]) -> [[f64; 3]; 2] {
        let first = first.min(self.places.saturating_sub(1)).max(0);
        [first, last].map(|k| {
            let share = Real::integer(k).value() / Real::integer(self.n).value();
            [
                (self.node.at[0] - x) + self.u.x.value() * share,
                (self.node.at[1] - y) + self.u.y.value() * share,
                self.node.length.value() + self.more.value() * share,
            ]
        })
    }

    /// Place k in plain doubles, from another point.
    pub(crate) fn plainly(&self, k: i64, [x, y]: [f64; 2]) -> [f64; 2] {
        let (share, [node_x, node_y]) = (self.share(k).value(), self.node.at);
        [(node_x - x) + self.u.x.value() * share, (node_y - y) + self.u.y.value() * share]
    }

    /// Whether it certainly does not reach `s_stop`, or where it does is known to 1e-6 m (MARGIN-18, MARGIN-19).
    pub(crate) fn has_certain_end(&self) -> bool {
        let k = self.n.max(self.count().saturating_sub(1));
        if self.progress(k).certainly_below(self.s_stop) || self.is_over && self.count() == 1 {
            return true;
        }
        let [x, y] = [self.u.x, self.u.y].map(|it| it.value().abs());
        let share = (self.s_stop - self.node.progress).over(self.gain);
        x + y < 1e-6 || self.gain.value() > 0.0 && share.off() * (x + y) < 1e-6
    }

    pub(crate) const fn heading(&self) -> [f64; 2] {
        self.node.heading
    }

    /// The first place where `find` finds something. `is_free`: whether it certainly finds nothing from
    /// the first to the last of these places.
    pub(crate) fn first_place<T>(
        &self,
        mut is_free: impl FnMut([i64; 2]) -> bool,
        mut find: impl FnMut(&Place) -> Option<T>,
    ) -> Option<T> {
        let find = |(), k| find(&self.place(k)).map_or(Continue(()), Break);
        self.over_places((), |(), run| is_free(run), find).break_value()
    }

    /// Goes over its places with `next`, except where `is_free` says that nothing changes from the first to the last of these.
    pub(crate) fn over_places<T, B>(
        &self,
        mut so_far: T,
        mut is_free: impl FnMut(&T, [i64; 2]) -> bool,
        mut next: impl FnMut(T, i64) -> ControlFlow<B, T>,
    ) -> ControlFlow<B, T> {
        let count = self.count();
        let (mut at, mut size) = (0_i64, count);
        while at < count {
            let end = at.saturating_add(size).min(count);
            let last = end.saturating_sub(1);
            if is_free(&so_far, [at, last]) {
                at = end;
                size = size.saturating_mul(2);
            } else if last > at {
                size = end.saturating_sub(at) >> 1;
            } else {
                so_far = next(so_far, at)?;
                at = end;
            }
        }
        Continue(so_far)
    }
}

#[cfg(test)]
mod tests;
