//! The path of the CAV: from where it is along the points of the trajectory, then straight on, and the
//! places where it is examined (`spec/hardened/H-14.md#requirements-the-path`).

use std::iter::{from_fn, once};

use crate::hardened::h14_fail_safe::times::Driving;
use crate::input::scene::{Point, Scene};
use crate::numbers::real::Real;
use crate::numbers::vector::{Frame, Vector};

/// A place of the CAV on its path.
#[derive(Clone, Debug)]
pub struct Place {
    /// Where.
    pub pose: Frame,
    /// Its progress, m.
    pub progress: Real,
    /// The least progress of it, of the place before it and of the place after it, at least 0, m.
    pub least: Real,
    /// The length up to it, m.
    pub length: Real,
    /// The length at the place after it, m; none for the last.
    pub length_after: Option<Real>,
    /// u of its piece, m, behind the last node d_p along the heading, and the progress at which that piece ends, m; none
    /// for p.
    pub piece: Option<(Vector, Real)>,
}

/// How far ahead a point is, its progress: (x - p) . h, m.
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

/// The length above which a place is the last, and fails `reach`: 2 s_stop + 1 m.
pub fn greatest_length(scene: &Scene) -> Real {
    integer(2) * Driving::of(scene).s_stop() + integer(1)
}

/// The distance from p above which a place is the last: s_stop + max(1 m, lateral_tolerance).
pub fn farthest(scene: &Scene) -> Real {
    Driving::of(scene).s_stop() + integer(1).max(scene.parameters.lateral_tolerance.clone())
}

/// p with the heading of the CAV, and the points from the first one on that is ahead.
pub fn nodes(scene: &Scene, trajectory: &[Point]) -> Vec<Frame> {
    let ego = &scene.ego;
    let p = Frame { origin: ego.position.clone(), direction: ego.heading.clone() };
    let first = first_ahead(scene, trajectory).unwrap_or(trajectory.len());
    let points = trajectory[first..].iter().map(|point| point.pose.clone());
    once(p).chain(points).collect()
}

/// From a node a, at a length, to the next node b.
struct Piece {
    a: Frame,
    b: Frame,
    length: Real,
}

impl Piece {
    /// u = b - a, m.
    fn u(&self) -> Vector {
        &self.b.origin - &self.a.origin
    }

    /// By what the length grows: abs(u . h_a) + abs(u x h_a), m.
    fn growth(&self) -> Real {
        let (u, h_a) = (self.u(), &self.a.direction);
        u.dot(h_a).abs() + u.cross(h_a).abs()
    }

    /// The least integer j >= 1 with abs(u_x) <= j d and abs(u_y) <= j d.
    fn parts(&self, d: &Real) -> i64 {
        let u = self.u();
        let longer = u.x.abs().max(u.y.abs());
        (-(-(longer / d)).floor()).max(1)
    }

    /// The length at b.
    fn length_at_b(&self) -> Real {
        &self.length + self.growth()
    }

    /// Its places behind a; the last one is b.
    fn steps(self, scene: &Scene) -> impl Iterator<Item = Step> {
        let (j, u, growth) = (self.parts(&d(scene)), self.u(), self.growth());
        let end = ahead(scene, &self.b.origin);
        (1..=j).map(move |k| {
            let share = integer(k) / integer(j);
            let origin = &self.a.origin + &u.scaled(&share);
            let length = &self.length + &growth * share;
            let heading = self.a.direction.clone();
            let pose =
                if k == j { self.b.clone() } else { Frame { origin, direction: heading.clone() } };
            let piece = Some((u.clone(), end.clone()));
            Step { progress: ahead(scene, &pose.origin), pose, length, heading, piece }
        })
    }
}

/// A place of the endless path: where, its progress, its length, the heading of its piece, and its piece.
#[derive(Clone)]
struct Step {
    pose: Frame,
    progress: Real,
    length: Real,
    heading: Vector,
    piece: Option<(Vector, Real)>,
}

/// The pieces of the path, and its last node with the length at that.
fn pieces(scene: &Scene, trajectory: &[Point]) -> (Vec<Piece>, Frame, Real) {
    let nodes = nodes(scene, trajectory);
    let mut length = Real::zero();
    let piece = |ends: &[Frame]| {
        let piece = Piece { a: ends[0].clone(), b: ends[1].clone(), length: length.clone() };
        length = piece.length_at_b();
        piece
    };
    let pieces = nodes.windows(2).map(piece).collect();
    (pieces, nodes[nodes.len() - 1].clone(), length)
}

/// d_p = min(1/4 m, L).
fn d(scene: &Scene) -> Real {
    (integer(1) / integer(4)).min(scene.ego.length.clone())
}

/// The places of a path without an end.
fn endless(scene: &Scene, trajectory: &[Point]) -> impl Iterator<Item = Step> {
    let d = d(scene);
    let (pieces, node, length) = pieces(scene, trajectory);
    let p = Frame { origin: scene.ego.position.clone(), direction: scene.ego.heading.clone() };
    let heading = p.direction.clone();
    let zero = Real::zero();
    let p = Step { pose: p, progress: zero.clone(), length: zero, heading, piece: None };
    let on_pieces = pieces.into_iter().flat_map(|piece| piece.steps(scene));
    let behind = (1..).map(move |k| {
        let far = integer(k) * &d;
        let origin = &node.origin + &node.direction.scaled(&far);
        let (progress, heading) = (ahead(scene, &origin), node.direction.clone());
        let pose = Frame { origin, direction: heading.clone() };
        let piece = Some((heading.scaled(&d), progress.clone()));
        Step { pose, progress, length: &length + far, heading, piece }
    });
    once(p).chain(on_pieces).chain(behind)
}

/// The items up to the first that is the last one.
fn up_to<T>(
    mut items: impl Iterator<Item = T>,
    is_last: impl Fn(&T) -> bool,
) -> impl Iterator<Item = T> {
    let mut is_over = false;
    from_fn(move || {
        let item = if is_over { None } else { items.next() }?;
        is_over = is_last(&item);
        Some(item)
    })
}

/// How long the path is, and how far from p, up to the places of a list: it ends with the first one beyond.
#[derive(Clone)]
struct End<'a> {
    p: &'a Vector,
    /// The greatest length, m.
    greatest: Real,
    /// The greatest distance from p, m; none for the places that the work counts.
    farthest: Option<Real>,
}

impl<'a> End<'a> {
    /// 2 s_stop + 1 m, and s_stop + max(1 m, lateral_tolerance), both moved.
    fn new(scene: &'a Scene, by_distance: bool, moved: impl Fn(&Real) -> Real) -> Self {
        let farthest = by_distance.then(|| moved(&farthest(scene)));
        Self { p: &scene.ego.position, greatest: moved(&greatest_length(scene)), farthest }
    }

    /// A list ends with this place: its length is above the greatest, or its distance from p.
    fn is_at(&self, place: &Vector, length: &Real) -> bool {
        // Along x and along y together it is no nearer: no squares where that is clear.
        let is_beyond = |farthest: &Real| {
            let away = place - self.p;
            away.x.abs() + away.y.abs() > *farthest && away.squared() > farthest.square()
        };
        *length > self.greatest || self.farthest.as_ref().is_some_and(is_beyond)
    }
}

/// The places up to the first that is beyond the end. The first whose progress is above s_stop, if it comes before or
/// there, gives its place to the last one.
fn ended<'a>(
    steps: impl Iterator<Item = Step> + 'a,
    s_stop: Real,
    end: End<'a>,
) -> impl Iterator<Item = Step> + 'a {
    let last_at = s_stop.clone();
    let is_last =
        move |step: &Step| step.progress > s_stop || end.is_at(&step.pose.origin, &step.length);
    let mut before: Option<Step> = None;
    up_to(steps, is_last).map(move |b| {
        let here = match before.take() {
            Some(a) if b.progress > last_at => last(&a, &b, &last_at),
            _ => b,
        };
        before.insert(here).clone()
    })
}

/// The point between a and b at which the progress is s_stop: a + share (b - a), the share being
/// (s_stop - progress of a) / (progress of b - progress of a), with the heading of the piece.
fn last(a: &Step, b: &Step, s_stop: &Real) -> Step {
    let share = (s_stop - &a.progress) / (&b.progress - &a.progress);
    let origin = &a.pose.origin + &(&b.pose.origin - &a.pose.origin).scaled(&share);
    let length = &a.length + (&b.length - &a.length) * share;
    let heading = b.heading.clone();
    let pose = Frame { origin, direction: heading.clone() };
    Step { pose, progress: s_stop.clone(), length, heading, piece: b.piece.clone() }
}

/// The places with what they know of their neighbours.
fn with_neighbours(steps: impl Iterator<Item = Step>) -> impl Iterator<Item = Place> {
    let mut steps = steps.peekable();
    let mut before = Real::zero();
    from_fn(move || {
        let Step { pose, progress, length, piece, .. } = steps.next()?;
        let before = std::mem::replace(&mut before, progress.clone());
        let (here, after) = (before.min(progress.clone()), steps.peek());
        let least = after.map_or(here.clone(), |after| here.min(after.progress.clone()));
        let length_after = after.map(|after| after.length.clone());
        Some(Place { pose, progress, least: least.max(Real::zero()), length, length_after, piece })
    })
}

/// The places in their order: up to the last one, at s_stop, if none before is too long or too far from p. Laxly they
/// end before the first whose progress is above s_stop + m, behind p at least, and have the windows of the exact model.
pub fn places<'a>(scene: &'a Scene, trajectory: &'a [Point]) -> impl Iterator<Item = Place> + 'a {
    listed(scene, trajectory, true)
}

/// The places that the list has without an end by distance, which the work counts.
pub fn places_by_length<'a>(
    scene: &'a Scene,
    trajectory: &'a [Point],
) -> impl Iterator<Item = Place> + 'a {
    listed(scene, trajectory, false)
}

fn listed<'a>(
    scene: &'a Scene,
    trajectory: &'a [Point],
    by_distance: bool,
) -> impl Iterator<Item = Place> + 'a {
    let (reads, s_stop) = (&scene.reads, Driving::of(scene).s_stop());
    let end = End::new(scene, by_distance, |it| reads.raised(it));
    let exact = End::new(scene, by_distance, Real::clone);
    let first = if reads.is_strict() { end.clone() } else { exact };
    let steps = ended(endless(scene, trajectory), s_stop.clone(), first);
    let moved = end.clone();
    let is_last = move |place: &Place| moved.is_at(&place.pose.origin, &place.length);
    let all = up_to(with_neighbours(steps), is_last).flat_map(move |place| {
        let is_last = reads.is_strict() && place.length_after.is_none();
        if is_last { with_beyond(scene, trajectory, &end, place) } else { vec![place] }
    });
    let is_within = move |(k, place): &(usize, Place)| {
        *k == 0 || reads.may_be_at_most(&place.progress, &s_stop)
    };
    all.enumerate().take_while(is_within).map(|(_, place)| place)
}

/// What the strict model examines before the last place, and that: the places from the first whose progress is above
/// s_stop up to the first whose progress is above s_stop + m, if none before is beyond the end. Their window is that of
/// the last place, from the least progress of all of them on.
fn with_beyond(scene: &Scene, trajectory: &[Point], end: &End, last: Place) -> Vec<Place> {
    let (reads, s_stop) = (&scene.reads, Driving::of(scene).s_stop());
    let is_last = |step: &Step| end.is_at(&step.pose.origin, &step.length);
    let beyond = up_to(endless(scene, trajectory), is_last)
        .skip_while(|step| step.progress <= s_stop)
        .take_while(|step| reads.may_be_at_most(&step.progress, &s_stop))
        .map(|Step { pose, progress, length, piece, .. }| Place {
            pose,
            progress,
            length,
            piece,
            ..last.clone()
        });
    let mut places: Vec<Place> = beyond.chain(once(last.clone())).collect();
    let least = places.iter().map(|place| place.progress.clone()).min();
    let least = least.map_or(last.least.clone(), |it| it.min(last.least).max(Real::zero()));
    places.iter_mut().for_each(|place| place.least = least.clone());
    places
}

/// Both ends of each piece, with its heading, up to the first piece that ends more than 1 cm beyond s_stop; without such
/// a piece the last node, too, and the point straight on from it at the length 2 s_stop + 1.01 m.
pub fn ends(scene: &Scene, trajectory: &[Point]) -> Vec<Frame> {
    let s_stop = Driving::of(scene).s_stop();
    let most = &s_stop + integer(1) / integer(100);
    let (pieces, node, length) = pieces(scene, trajectory);
    let is_last = |piece: &Piece| ahead(scene, &piece.b.origin) > most;
    let straight = integer(2) * s_stop + Real::from_double(1.01) - length;
    let behind = (!pieces.iter().any(is_last)).then(|| Frame {
        origin: node.point(&straight.max(Real::zero()), &Real::zero()),
        direction: node.direction.clone(),
    });
    let of_pieces = up_to(pieces.into_iter(), is_last).flat_map(|Piece { a, b, .. }| {
        let b = Frame { origin: b.origin, direction: a.direction.clone() };
        [a, b]
    });
    of_pieces.chain(behind.into_iter().flat_map(|end| [node.clone(), end])).collect()
}

/// How many places the exact model has without an end by distance, not going through them: an upper bound of how many
/// it has.
pub fn count(scene: &Scene, trajectory: &[Point]) -> i128 {
    let d = d(scene);
    let (pieces, node, length) = pieces(scene, trajectory);
    // p and the last one.
    let mut count = 2;
    for piece in pieces {
        let j = integer(piece.parts(&d));
        let (part, growth) = (piece.u().scaled(&(integer(1) / &j)), piece.growth() / &j);
        let within = within(scene, &piece.a.origin, &piece.length, &part, &growth);
        match within.filter(|most| *most < j) {
            Some(most) => return count + i128::from(most.floor()),
            None => count += i128::from(j.floor()),
        }
    }
    let within = within(scene, &node.origin, &length, &node.direction.scaled(&d), &d);
    count + within.map_or(0, |most| i128::from(most.floor()))
}

/// How many steps from a point at a length, of which each makes the length grow, keep to s_stop and to the greatest
/// length; none where all do.
fn within(
    scene: &Scene,
    from: &Vector,
    length: &Real,
    step: &Vector,
    growth: &Real,
) -> Option<Real> {
    let progress = step.dot(&scene.ego.heading);
    let s_stop = Driving::of(scene).s_stop();
    let by = |left: Real, each: &Real| (*each > Real::zero()).then(|| left / each);
    let both =
        [by(s_stop - ahead(scene, from), &progress), by(greatest_length(scene) - length, growth)];
    both.into_iter().flatten().min()
}

fn integer(n: i64) -> Real {
    Real::from_integer(n.into())
}
