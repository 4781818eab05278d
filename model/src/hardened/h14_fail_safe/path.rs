//! The path of the CAV: from where it is along the points of the trajectory, then straight on, and the
//! places where it is examined (`spec/hardened/H-14.md#requirements-the-path`).

use std::iter::once;

use crate::hardened::h14_fail_safe::times::Driving;
use crate::input::scene::{Point, Scene};
use crate::numbers::reading::Reading;
use crate::numbers::real::Real;
use crate::numbers::vector::{Frame, Vector};

/// A place of the CAV on its path.
#[derive(Clone, Debug)]
pub struct Place {
    /// Where.
    pub pose: Frame,
    /// Its way, m.
    pub way: Real,
    /// Way of the place before it, m; 0 for the first.
    pub way_before: Real,
    /// Way of the place after it, m; none for the last.
    pub way_after: Option<Real>,
}

/// How far ahead a point is: (x - p) . h, m.
pub fn ahead(scene: &Scene, x: &Vector) -> Real {
    (x - &scene.ego.position).dot(&scene.ego.heading)
}

/// A node is more than this ahead: 1/8 m.
pub fn least_ahead() -> Real {
    Real::from_integer(1) / Real::from_integer(8)
}

/// The first point of the trajectory that is more than 1/8 m ahead.
pub fn first_ahead(scene: &Scene, trajectory: &[Point]) -> Option<usize> {
    trajectory.iter().position(|point| ahead(scene, &point.pose.origin) > least_ahead())
}

/// p with the heading of the CAV, and the points from the first one on that is ahead.
fn nodes(scene: &Scene, trajectory: &[Point]) -> Vec<Frame> {
    let ego = &scene.ego;
    let p = Frame { origin: ego.position.clone(), direction: ego.heading.clone() };
    let first = first_ahead(scene, trajectory).unwrap_or(trajectory.len());
    let points = trajectory[first..].iter().map(|point| point.pose.clone());
    once(p).chain(points).collect()
}

/// From a node a, at a way, to the next node b.
struct Piece {
    a: Frame,
    b: Frame,
    way: Real,
}

impl Piece {
    /// u = b - a, m.
    fn u(&self) -> Vector {
        &self.b.origin - &self.a.origin
    }

    /// max(u . h_a, 0), m.
    fn advance(&self) -> Real {
        self.u().dot(&self.a.direction).max(Real::zero())
    }

    /// The least integer j >= 1 with abs(u_x) <= j d and abs(u_y) <= j d.
    fn parts(&self, d: &Real) -> i64 {
        let u = self.u();
        let longer = u.x.abs().max(u.y.abs());
        (-(-(longer / d)).floor()).max(1)
    }

    /// Its places behind a; the last one is b.
    fn steps(self, d: &Real) -> impl Iterator<Item = Step> + use<> {
        let (j, u, advance) = (self.parts(d), self.u(), self.advance());
        (1..=j).map(move |k| {
            let share = integer(k) / integer(j);
            let origin = &self.a.origin + &u.scaled(&share);
            let way = &self.way + &advance * share;
            let heading = self.a.direction.clone();
            if k == j {
                Step { pose: self.b.clone(), way, heading }
            } else {
                Step { pose: Frame { origin, direction: heading.clone() }, way, heading }
            }
        })
    }
}

/// A place of the endless path: where, its way, and the heading of its piece.
struct Step {
    pose: Frame,
    way: Real,
    heading: Vector,
}

/// The pieces of the path and its last node with the way of that.
fn pieces(scene: &Scene, trajectory: &[Point]) -> (Vec<Piece>, Frame, Real) {
    let nodes = nodes(scene, trajectory);
    let mut way = Real::zero();
    let piece = |ends: &[Frame]| {
        let piece = Piece { a: ends[0].clone(), b: ends[1].clone(), way: way.clone() };
        way = &way + piece.advance();
        piece
    };
    let pieces = nodes.windows(2).map(piece).collect();
    (pieces, nodes[nodes.len() - 1].clone(), way)
}

/// d_p = min(1/4 m, L).
fn d(scene: &Scene) -> Real {
    (integer(1) / integer(4)).min(scene.ego.length.clone())
}

/// The places of a path without an end.
fn endless(scene: &Scene, trajectory: &[Point]) -> impl Iterator<Item = Step> + use<> {
    let d = d(scene);
    let (pieces, node, way) = pieces(scene, trajectory);
    let p = Frame { origin: scene.ego.position.clone(), direction: scene.ego.heading.clone() };
    let p = Step { pose: p, way: Real::zero(), heading: scene.ego.heading.clone() };
    let on_pieces = {
        let d = d.clone();
        pieces.into_iter().flat_map(move |piece| piece.steps(&d))
    };
    let behind = (1..).map(move |k| {
        let far = integer(k) * &d;
        let origin = &node.origin + &node.direction.scaled(&far);
        let heading = node.direction.clone();
        Step { pose: Frame { origin, direction: heading.clone() }, way: &way + far, heading }
    });
    once(p).chain(on_pieces).chain(behind)
}

/// The places in their order. The last one is where the way is s_stop; strictly those with s_stop < way
/// <= s_stop + m are examined, too, before it and in its window; laxly the last one is the last whose
/// way is at most s_stop + m.
pub fn places(scene: &Scene, trajectory: &[Point]) -> impl Iterator<Item = Place> {
    let s_stop = Driving::of(scene).s_stop();
    let end = scene.reads.raised(&s_stop);
    let mut steps = endless(scene, trajectory);
    let mut next = steps.next();
    let mut way_before = Real::zero();
    let mut at_the_end: Vec<Place> = Vec::new();
    let all = std::iter::from_fn(move || {
        let Some(o) = next.take() else { return at_the_end.pop() };
        let q = steps.next()?;
        let before = std::mem::replace(&mut way_before, o.way.clone());
        let place = |step: &Step, way_before: &Real, way_after: Option<&Real>| Place {
            pose: step.pose.clone(),
            way: step.way.clone(),
            way_before: way_before.clone(),
            way_after: way_after.cloned(),
        };
        if q.way <= s_stop {
            let here = place(&o, &before, Some(&q.way));
            next = Some(q);
            return Some(here);
        }
        let here = place(&o, &before, Some(&s_stop));
        let last = place(&last(&o, &q, &s_stop), &o.way, None);
        let beyond = once(q).chain(steps.by_ref()).take_while(|step| step.way <= end);
        at_the_end = beyond.map(|step| place(&step, &o.way, None)).chain(once(last)).collect();
        at_the_end.reverse();
        Some(here)
    });
    let reads = &scene.reads;
    let s_stop = Driving::of(scene).s_stop();
    let is_within =
        move |(k, place): &(usize, Place)| *k == 0 || reads.may_be_at_most(&place.way, &s_stop);
    all.enumerate().take_while(is_within).map(|(_, place)| place)
}

/// The point between o and q at which the way is s_stop:
/// o + ((s_stop - way of o) / (way of q - way of o)) (q - o), with the heading of the piece.
fn last(o: &Step, q: &Step, s_stop: &Real) -> Step {
    let share = (s_stop - &o.way) / (&q.way - &o.way);
    let beyond = &q.pose.origin - &o.pose.origin;
    let origin = &o.pose.origin + &beyond.scaled(&share);
    let pose = Frame { origin, direction: q.heading.clone() };
    Step { pose, way: s_stop.clone(), heading: q.heading.clone() }
}

/// Both ends of each piece that begins at most 1 cm beyond s_stop, with its heading; behind the last node, it and
/// the point at s_stop + 1 cm.
pub fn ends(scene: &Scene, trajectory: &[Point]) -> Vec<Frame> {
    let most = Driving::of(scene).s_stop() + integer(1) / integer(100);
    let (pieces, node, way) = pieces(scene, trajectory);
    let behind = (way <= most).then(|| Frame {
        origin: node.point(&(&most - &way), &Real::zero()),
        direction: node.direction.clone(),
    });
    let in_reach = pieces.into_iter().take_while(|piece| piece.way <= most);
    let of_pieces = in_reach.flat_map(|Piece { a, b, .. }| {
        let b = Frame { origin: b.origin, direction: a.direction.clone() };
        [a, b]
    });
    of_pieces.chain(behind.into_iter().flat_map(|end| [node.clone(), end])).collect()
}

/// How many places there are, without going through them.
pub fn count(scene: &Scene, trajectory: &[Point]) -> i128 {
    let end = scene.reads.raised(&Driving::of(scene).s_stop());
    let last = i128::from(scene.reads.reading != Reading::Lax);
    let d = d(scene);
    let (pieces, _, way) = pieces(scene, trajectory);
    let mut count = 1 + last;
    for piece in pieces {
        let (j, advance) = (piece.parts(&d), piece.advance());
        if &piece.way + &advance > end {
            let most = (end - piece.way) * integer(j) / advance;
            return count + i128::from(most.floor()).max(0);
        }
        count += i128::from(j);
    }
    count + i128::from(((end - way) / d).floor()).max(0)
}

fn integer(n: i64) -> Real {
    Real::from_integer(n.into())
}
