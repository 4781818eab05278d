//! Where an object that neither follows the CAV nor keeps beside its path meets it
//! (`spec/hardened/H-14.md#requirements-the-cav`, `#requirements-not-examined`, `#requirements-failure`).

use std::cell::LazyCell;

use crate::hardened::h14_fail_safe::motions::{Motion, Named};
use crate::hardened::h14_fail_safe::path::{Place, places};
use crate::hardened::h14_fail_safe::times::{Driving, Window, a_tyre, window};
use crate::hardened::h14_fail_safe::widening::wider_by;
use crate::input::scene::{Object, Point, Scene};
use crate::numbers::polyline::{Beside, Segment, beside, nearest_point};
use crate::numbers::real::Real;
use crate::numbers::rectangle::{Rectangle, is_swept_over, is_swept_over_between, share_a_point};
use crate::numbers::vector::{Frame, Vector};
use crate::report::{Rule, Witness};
use crate::stages::llcc::cav;

/// The first place at which a motion that is examined sweeps over the CAV in its window, and of these
/// motions the first.
pub fn failure(
    scene: &Scene,
    trajectory: &[Point],
    motions: &[Motion],
    beside_route: &LazyCell<BesideRoute, impl FnOnce() -> BesideRoute>,
) -> Option<Witness> {
    let examined: Vec<(&Motion, bool, Real)> = (motions.iter())
        .filter_map(|motion| {
            let behind = is_behind(scene, motion);
            let comes_across = comes_across(scene, motion, behind);
            let is_examined = !follows(scene, motion, comes_across, behind)
                && !beside_route.keeps_beside(scene, motion, behind);
            let margin = margin(scene, motion);
            is_examined.then_some((motion, comes_across, margin))
        })
        .collect();
    let (driving, widening) = (Driving::of(scene), wider_by(scene, trajectory));
    places(scene, trajectory).enumerate().find_map(|(k, place)| {
        let window = window(&scene.reads, &driving, &place.least, place.length_after.as_ref());
        let cav = wider(scene, &widening, &place.pose);
        let (motion, ..) = examined.iter().find(|(motion, comes_across, margin)| {
            let cav = cav.with_halves(|half| half + margin);
            sweeps_over(scene, &cav, &window, motion, *comes_across)
        })?;
        let Named { track, detection, item, age_ns } = motion.named;
        let witness = Witness::new(Rule::FailSafe, &place.progress, &driving.s_stop());
        let witness = Witness { track, detection, item, age_ns, ..witness };
        Some(witness.at_point(trajectory.len() + k))
    })
}

/// The rectangle of the CAV at a pose as in LLCC, with a half width that is greater by the widening.
pub fn wider(scene: &Scene, widening: &Real, pose: &Frame) -> Rectangle {
    let cav = cav(scene, pose);
    let half_width = &cav.half_width + widening;
    Rectangle { half_width, ..cav }
}

/// The margin of half the CAV's length and width at a place, m: strictly at least 10^-8 m + 10^-12 D, D being
/// abs(x) + abs(y) of c - p, plus abs(w) (60 s + H(w)).
fn margin(scene: &Scene, motion: &Motion) -> Real {
    let Vector { x, y } = &now(motion).frame.origin - &scene.ego.position;
    let goes = &motion.speed * (Real::from_integer(60) + h(scene, motion));
    let d = x.abs() + y.abs() + goes;
    scene.reads.m_at_least(Real::from_double(1e-8) + Real::from_double(1e-12) * d)
}

/// Over the window the object sweeps over a point of the CAV's rectangle. Where the CAV may stand the window ends at
/// H(w), and at T when the object comes across.
fn sweeps_over(
    scene: &Scene,
    cav: &Rectangle,
    window: &Window,
    motion: &Motion,
    comes_across: bool,
) -> bool {
    let end = match &window.end {
        Some(last) => last.clone(),
        None if comes_across => Driving::of(scene).t_stop(),
        None => h(scene, motion),
    };
    let least = motion.r_b(&a_tyre(&scene.parameters.a_b), &(&motion.age + &window.begin));
    let most = &motion.speed * (&motion.age + end);
    let between = [least, most].map(|r| motion.moved_by(&r));
    is_swept_over_between(cav, &motion.object.rectangle(), &motion.w, &between)
}

/// w is not 0, and the inner rectangle shares a point with the object as it is now and goes on.
pub fn comes_across(scene: &Scene, motion: &Motion, behind: bool) -> bool {
    let inner = inner(scene, behind).with_halves(|half| scene.reads.lowered(half));
    motion.w.squared() > Real::zero() && is_swept_over(&inner, &now(motion).rectangle(), &motion.w)
}

/// The rectangle of the CAV at p, its front moved in by 0.3 m, its other sides by the inset: min(0.3 m, s_b(v)),
/// 0 for an object that is behind.
pub fn inner(scene: &Scene, behind: bool) -> Rectangle {
    let (front, two) = (Real::from_double(0.3), Real::from_integer(2));
    let inset = if behind { Real::zero() } else { Driving::of(scene).s_b().min(front.clone()) };
    let Rectangle { frame, half_length, half_width } = cav(scene, &p(scene));
    let back = -((&front - &inset) / &two);
    Rectangle {
        frame: Frame { origin: frame.point(&back, &Real::zero()), ..frame },
        half_length: half_length - (&front + &inset) / &two,
        half_width: half_width - inset,
    }
}

/// w . h > 0 and all of its rectangle where it is now is behind the CAV's rear:
/// (c - c_CAV) . h + (abs(dir . h) length + abs(dir x h) width) / 2 < - L / 2.
pub fn is_behind(scene: &Scene, motion: &Motion) -> bool {
    let (reads, h, two) = (&scene.reads, &scene.ego.heading, Real::from_integer(2));
    let Object { frame: Frame { origin: c, direction: dir }, length, width } = now(motion);
    let c_cav = cav(scene, &p(scene)).frame.origin;
    let half = (dir.dot(h).abs() * length + dir.cross(h).abs() * width) / &two;
    reads.greater(&motion.w.dot(h), &Real::zero())
        && reads.less(&((&c - &c_cav).dot(h) + half), &-(&scene.ego.length / two))
}

/// It goes the CAV's way or the opposite way, as far as a bend of 30 m radius allows:
/// abs(w x h) <= abs(w) (0.05 + abs(c - p) / 30 m).
pub fn goes_along(scene: &Scene, motion: &Motion) -> bool {
    let (w, h, p) = (&motion.w, &scene.ego.heading, &scene.ego.position);
    let c = now(motion).frame.origin;
    let bend = Real::from_double(0.05) + c.distance(p) / Real::from_integer(30);
    scene.reads.at_most(&w.cross(h).abs(), &(&motion.speed * bend))
}

/// It is behind, comes across, goes along, and has abs(w x h) <= w . h.
pub fn follows(scene: &Scene, motion: &Motion, comes_across: bool, behind: bool) -> bool {
    let h = &scene.ego.heading;
    let (along, across) = (motion.w.dot(h), motion.w.cross(h).abs());
    behind && comes_across && goes_along(scene, motion) && scene.reads.at_most(&across, &along)
}

/// The path of the CAV beside the route.
#[derive(Debug)]
pub struct BesideRoute {
    reference_path: Vec<Segment>,
    /// The least D_k - E_k of all places, m.
    a: Real,
    /// The greatest D_k + E_k of all places, m.
    b: Real,
    /// Of p alone the greatest D_0 - E_0, m.
    a_0: Real,
    /// C and C_0, m, for an object on the left and for one on the right.
    c_and_c_0: [[Real; 2]; 2],
    /// The rectangle of the CAV at each place.
    cavs: Vec<Rectangle>,
    /// No c_k lies beyond an end of an open route, and the path bends as the route does.
    is_along: bool,
    /// The route bends with R = 300 m, for who goes the CAV's way.
    bends_little: bool,
    /// The same with R = 30 m, for who comes towards it: abs(w x h) <= - w . h.
    bends: bool,
}

impl BesideRoute {
    /// That of the places of a trajectory.
    pub fn new(scene: &Scene, trajectory: &[Point]) -> Self {
        // A closing segment of length 0 is none.
        let mut reference_path = scene.route.reference_path();
        reference_path.retain(|[from, to]| from != to);
        let places: Vec<Place> = places(scene, trajectory).collect();
        let widening = wider_by(scene, trajectory);
        let covered = |places: &[Place]| covered_across(scene, &reference_path, places, &widening);
        let (all, of_p) = (covered(&places), covered(&places[..1]));
        let a = least(all.iter().map(Covered::near));
        let b = greatest(all.iter().map(Covered::far));
        let a_0 = greatest(of_p.iter().map(Covered::near));
        let c_and_c_0 = [1, -1].map(|s| [greatest(towards(s, &all)), least(towards(s, &of_p))]);
        let is_along = places.iter().all(|Place { pose, progress, .. }| {
            let Frame { origin: c_k, direction: h_k } = cav(scene, pose).frame;
            is_within_ends(scene, &reference_path, &c_k) && bends(scene, &h_k, progress)
        });
        let cavs = places.iter().map(|place| wider(scene, &widening, &place.pose)).collect();
        let [bends_little, bends] = [300, 30].map(|r| route_bends(scene, &reference_path, r));
        Self { reference_path, a, b, a_0, c_and_c_0, cavs, is_along, bends_little, bends }
    }

    /// w is not 0, it goes along, 0 < D <= 20 m, nothing of it is where the path leads, and nothing comes there,
    /// measured along the route:
    /// (max(A - D, D - B) - M - sagitta) D > (abs(dir . q) length + abs(dir x q) width) / 2 + abs(w . q) t_H.
    /// Strictly D > 0.1 m, and max(A - D, D - B) is less by 10^-6 abs(w) H(w), too.
    pub fn keeps_beside(&self, scene: &Scene, motion: &Motion, behind: bool) -> bool {
        let (w, h_ego, zero) = (&motion.w, &scene.ego.heading, Real::zero());
        if w.squared() == zero {
            return false;
        }
        let object = now(motion).rectangle();
        let Object { frame: Frame { origin: c, direction: dir }, length, width } = now(motion);
        let (d, nearest) = nearest(scene, &self.reference_path, &c);
        let comes_towards = scene.reads.at_most(&w.cross(h_ego).abs(), &-w.dot(h_ego));
        let [least_d, rounded] = if scene.reads.is_strict() {
            let rounded = Real::from_double(1e-6) * &motion.speed * h(scene, motion);
            [Real::from_double(0.1), rounded]
        } else {
            [zero.clone(), zero]
        };
        let room = big_m(scene) + rounded + sagitta(scene, motion);
        let apart = (&self.a - &d).max(&d - &self.b) - room;
        let is_apart = |segment: &&Segment| {
            let q = &c - &nearest_point(&c, segment);
            let half = (dir.dot(&q).abs() * &length + dir.cross(&q).abs() * &width)
                / Real::from_integer(2);
            let sides = sides(scene, &c, segment);
            &apart * &d > half + w.dot(&q).abs() * self.t_h(scene, motion, &q, &d, &sides, behind)
        };
        let margin = margin(scene, motion);
        let lies_across =
            |cav: &Rectangle| share_a_point(&cav.with_halves(|half| half + &margin), &object);
        d > least_d
            && d <= Real::from_integer(20) - big_m(scene)
            && goes_along(scene, motion)
            && self.is_along
            && if comes_towards { self.bends } else { self.bends_little }
            && is_within_ends(scene, &self.reference_path, &c)
            && nearest.iter().all(is_apart)
            && !self.cavs.iter().any(lies_across)
    }

    /// t_H = H(w), but 0 for who is behind, drifts by at most abs(w . q) <= abs(w) D (1/10 - M), and to whom the CAV
    /// comes no nearer than at p, s.
    fn t_h(
        &self,
        scene: &Scene,
        motion: &Motion,
        q: &Vector,
        d: &Real,
        sides: &[i128],
        behind: bool,
    ) -> Real {
        let tenth = Real::from_integer(1) / Real::from_integer(10);
        let drifts_little = motion.w.dot(q).abs() <= &motion.speed * d * (tenth - big_m(scene));
        if behind && drifts_little && self.comes_no_nearer(scene, d, sides) {
            return Real::zero();
        }
        h(scene, motion)
    }

    /// A >= A_0 - (1/8 m - M) where A - D >= D - B; where not, c is on a side, and C <= C_0 + (1/8 m - M).
    fn comes_no_nearer(&self, scene: &Scene, d: &Real, sides: &[i128]) -> bool {
        let Self { a, b, a_0, c_and_c_0: [left, right], .. } = self;
        let eighth = Real::from_integer(1) / Real::from_integer(8) - big_m(scene);
        let is_within = |[c, c_0]: &[Real; 2]| *c <= c_0 + &eighth;
        match sides {
            _ if a - d >= d - b => *a >= a_0 - eighth,
            [1] => is_within(left),
            [-1] => is_within(right),
            _ => false,
        }
    }
}

/// M, the margin of who keeps beside and of where the path ends: strictly the greater of m and 0.0001, else m.
pub fn big_m(scene: &Scene) -> Real {
    scene.reads.m_at_least(Real::from_double(0.0001))
}

/// The sides of a segment on which a point counts: 1, left of g, where g x (x - a) > N abs(g), -1, right of it, where
/// that is < - N abs(g), and both where neither. N is M strictly, else 0.
fn sides(scene: &Scene, x: &Vector, [a, b]: &Segment) -> Vec<i128> {
    let g = b - a;
    let n = if scene.reads.is_strict() { big_m(scene) } else { Real::zero() };
    let (across, bound) = (g.cross(&(x - a)), n * g.length());
    match across {
        _ if across > bound => vec![1],
        _ if across < -bound => vec![-1],
        _ => vec![1, -1],
    }
}

/// What the CAV covers across a nearest segment at a place: D_k and E_k, m, and the sides of c_k.
struct Covered {
    d_k: Real,
    e_k: Real,
    sides: Vec<i128>,
}

impl Covered {
    /// D_k - E_k, m.
    fn near(&self) -> Real {
        &self.d_k - &self.e_k
    }

    /// D_k + E_k, m.
    fn far(&self) -> Real {
        &self.d_k + &self.e_k
    }
}

/// Each s D_k + E_k for an object on that side, m.
fn towards(side: i128, covered: &[Covered]) -> impl Iterator<Item = Real> {
    covered.iter().flat_map(move |Covered { d_k, e_k, sides }| {
        sides.iter().map(move |of_cav| Real::from_integer(side * of_cav) * d_k + e_k)
    })
}

/// That of each place, of several nearest segments with each.
fn covered_across(
    scene: &Scene,
    path: &[Segment],
    places: &[Place],
    widening: &Real,
) -> Vec<Covered> {
    let covered = places.iter().flat_map(|place| {
        let Frame { origin: c_k, direction: h_k } = cav(scene, &place.pose).frame;
        let (d_k, nearest) = nearest(scene, path, &c_k);
        nearest.into_iter().map(move |segment @ [from, to]| {
            let e_k = e_k(scene, &h_k, &(to - from)) + widening;
            Covered { d_k: d_k.clone(), e_k, sides: sides(scene, &c_k, segment) }
        })
    });
    covered.collect()
}

fn least(each: impl Iterator<Item = Real>) -> Real {
    each.min().expect("p is a place, and a segment is the nearest")
}

fn greatest(each: impl Iterator<Item = Real>) -> Real {
    each.max().expect("p is a place, and a segment is the nearest")
}

/// E_k without the widening: (abs(h_k . g) W + abs(h_k x g) L) / (2 abs(g)), m.
fn e_k(scene: &Scene, h_k: &Vector, g: &Vector) -> Real {
    let twice = h_k.dot(g).abs() * &scene.ego.width + h_k.cross(g).abs() * &scene.ego.length;
    twice * g.length() / (Real::from_integer(2) * g.squared())
}

/// (the longer side of the object ^2 + that of the CAV ^2) / (6 R), R = 300 m where w . h > m, 30 m where not, m.
fn sagitta(scene: &Scene, motion: &Motion) -> Real {
    let goes_the_same_way = scene.reads.greater(&motion.w.dot(&scene.ego.heading), &Real::zero());
    let r = Real::from_integer(if goes_the_same_way { 300 } else { 30 });
    let (object, ego) = (&motion.object, &scene.ego);
    let longer = |a: &Real, b: &Real| a.clone().max(b.clone()).square();
    let both = longer(&object.length, &object.width) + longer(&ego.length, &ego.width);
    both / (Real::from_integer(6) * r)
}

/// H(w) = max(T, tau + t_yield + abs(w) / (2 a_yield)), s: who comes later can still stop.
pub fn h(scene: &Scene, motion: &Motion) -> Real {
    let p = &scene.parameters;
    let braking = &motion.speed / (Real::from_integer(2) * &p.a_yield);
    Driving::of(scene).t_stop().max(&p.tau + &p.t_yield + braking)
}

/// Each segment g_i of the reference path has abs(h x g_i) <= abs(g_i) (0.05 + (distance of p from g_i) / R - M) - m:
/// the route bends; it does not turn off or change lanes near the CAV.
fn route_bends(scene: &Scene, path: &[Segment], r: i128) -> bool {
    let Frame { origin: p, direction: h } = p(scene);
    let distances = beside(&p, path).distances;
    path.iter().zip(distances).all(|([from, to], distance)| {
        let g_i = to - from;
        let bend = Real::from_double(0.05) + distance / Real::from_integer(r) - big_m(scene);
        scene.reads.at_most(&h.cross(&g_i).abs(), &(g_i.length() * bend))
    })
}

/// abs(h x h_k) <= 0.05 + progress / 30 m - M.
fn bends(scene: &Scene, h_k: &Vector, progress: &Real) -> bool {
    let limit = Real::from_double(0.05) + progress / Real::from_integer(30);
    scene.ego.heading.cross(h_k).abs() <= limit - big_m(scene)
}

/// The distance of a point to the reference path, m, and its segments at that distance; strictly those at
/// most the greater of m and 10^-5 m farther, too.
fn nearest<'a>(scene: &Scene, path: &'a [Segment], point: &Vector) -> (Real, Vec<&'a Segment>) {
    let Beside { distance, distances, .. } = beside(point, path);
    let nearly = || scene.reads.nearly(&distance);
    let most = if scene.reads.is_strict() { nearly() } else { distance.clone() };
    let is_near = |(_, far): &(&Segment, &Real)| **far <= most;
    let nearest = path.iter().zip(&distances).filter(is_near).map(|(segment, _)| segment);
    (distance.clone(), nearest.collect())
}

/// Of an open route (x - end) . g > M abs(g) + m for both end points of the reference path, g being the next point - end.
fn is_within_ends(scene: &Scene, path: &[Segment], x: &Vector) -> bool {
    let ([first, second], [before_last, last]) = (&path[0], &path[path.len() - 1]);
    let is_inside = |(end, neighbour): (&Vector, &Vector)| {
        let g = neighbour - end;
        scene.reads.greater(&(x - end).dot(&g), &(big_m(scene) * g.length()))
    };
    scene.route.closed || [(first, second), (last, before_last)].into_iter().all(is_inside)
}

/// The object where it is now, moved by w age.
pub fn now(motion: &Motion) -> Object {
    let Object { frame: Frame { origin, direction }, .. } = &motion.object;
    let origin = origin + &motion.w.scaled(&motion.age);
    Object { frame: Frame { origin, direction: direction.clone() }, ..motion.object.clone() }
}

/// The pose of the CAV.
fn p(scene: &Scene) -> Frame {
    Frame { origin: scene.ego.position.clone(), direction: scene.ego.heading.clone() }
}
