//! Where an object that does not follow the CAV meets it (`spec/7-fail-safe.md#meeting`).

use crate::hardened::h14_fail_safe::motions::{Motion, Named, motions};
use crate::hardened::h14_fail_safe::path::{Place, places};
use crate::hardened::h14_fail_safe::times::{Driving, Window, window};
use crate::input::scene::{Object, Point, Scene};
use crate::numbers::polyline::beside;
use crate::numbers::real::Real;
use crate::numbers::rectangle::{is_swept_over, is_swept_over_between};
use crate::numbers::vector::{Frame, Vector};
use crate::report::{Rule, Witness};
use crate::stages::llcc::cav;

/// The first place at which a motion that does not follow sweeps over the CAV in its window, and of
/// these motions the first.
pub fn failure(scene: &Scene, trajectory: &[Point]) -> Option<Witness> {
    let keeps_offset = std::cell::LazyCell::new(|| keeps_offset(scene, trajectory));
    let examined: Vec<(Motion, bool)> = (motions(scene).into_iter())
        .map(|motion| {
            let comes_across = comes_across(scene, &motion);
            (motion, comes_across)
        })
        .filter(|(motion, comes_across)| !follows(scene, motion, *comes_across, || *keeps_offset))
        .collect();
    let driving = Driving::of(scene);
    places(scene, trajectory).enumerate().find_map(|(k, place)| {
        let window = window(&scene.reads, &driving, &place.way_before, place.way_after.as_ref());
        let meets = |(motion, comes_across): &&(Motion, bool)| {
            sweeps_over(scene, &place, &window, motion, *comes_across)
        };
        let (motion, _) = examined.iter().find(meets)?;
        let witness = Witness::new(Rule::FailSafe, &place.way, &driving.s_stop());
        let Named { track, detection, item, age_ns } = motion.named;
        let witness = Witness { track, detection, item, age_ns, ..witness };
        Some(witness.at_point(trajectory.len() + k))
    })
}

/// Over the window, which ends at T + t_yield + abs(w) / (2 a_yield) where the CAV may stand, and at T
/// where the object comes across, the object sweeps over a point of the CAV's rectangle.
fn sweeps_over(
    scene: &Scene,
    place: &Place,
    window: &Window,
    motion: &Motion,
    comes_across: bool,
) -> bool {
    let p = &scene.parameters;
    let t_stop = Driving::of(scene).t_stop();
    let end = match &window.end {
        Some(last) => last.clone(),
        None if comes_across => t_stop,
        None => t_stop + &p.t_yield + &motion.speed / (Real::from_integer(2) * &p.a_yield),
    };
    let least = motion.r_b(&p.a_b, &(&motion.age + &window.begin));
    let most = &motion.speed * (&motion.age + end);
    let between = [least, most].map(|r| motion.moved_by(&r));
    let cav = cav(scene, &place.pose).with_halves(|half| scene.reads.raised(half));
    is_swept_over_between(&cav, &motion.object.rectangle(), &motion.w, &between)
}

/// w is not 0, and the rectangle of the CAV at p, half length and half width less by 0.3 m, shares a point
/// with the object as it is now and goes on.
pub fn comes_across(scene: &Scene, motion: &Motion) -> bool {
    let inner = Real::from_double(0.3);
    let cav = cav(scene, &p(scene)).with_halves(|half| scene.reads.lowered(&(half - &inner)));
    motion.w.squared() > Real::zero() && is_swept_over(&cav, &now(motion).rectangle(), &motion.w)
}

/// w . h > 0, all of it is behind the CAV's rear, and it comes across with abs(w x h) <= w . h, or
/// abs(w x h) <= 0.105 w . h and the CAV `keeps_offset`.
pub fn follows(
    scene: &Scene,
    motion: &Motion,
    comes_across: bool,
    keeps_offset: impl FnOnce() -> bool,
) -> bool {
    let (reads, h) = (&scene.reads, &scene.ego.heading);
    let (along, across) = (motion.w.dot(h), motion.w.cross(h).abs());
    let narrow = Real::from_double(0.105) * &along;
    reads.greater(&along, &Real::zero())
        && is_behind(scene, motion)
        && (comes_across && reads.at_most(&across, &along)
            || reads.at_most(&across, &narrow) && keeps_offset())
}

/// All of its rectangle where it is now is behind the CAV's rear:
/// (c - c_CAV) . h + (abs(dir . h) length + abs(dir x h) width) / 2 < - L / 2.
fn is_behind(scene: &Scene, motion: &Motion) -> bool {
    let (h, two) = (&scene.ego.heading, Real::from_integer(2));
    let Object { frame: Frame { origin: c, direction: dir }, length, width } = now(motion);
    let c_cav = cav(scene, &p(scene)).frame.origin;
    let half = (dir.dot(h).abs() * length + dir.cross(h).abs() * width) / &two;
    scene.reads.less(&((&c - &c_cav).dot(h) + half), &-(&scene.ego.length / two))
}

/// The distance to the reference path of each place differs from that of p by at most 0.2 m.
pub fn keeps_offset(scene: &Scene, trajectory: &[Point]) -> bool {
    let path = scene.route.reference_path();
    let distance = |point: &Vector| beside(point, &path).distance;
    let (of_p, most) = (distance(&scene.ego.position), Real::from_double(0.2));
    let differs_little =
        |place: Place| scene.reads.at_most(&(distance(&place.pose.origin) - &of_p).abs(), &most);
    places(scene, trajectory).all(differs_little)
}

/// The object where it is now, moved by w age.
fn now(motion: &Motion) -> Object {
    let Object { frame: Frame { origin, direction }, .. } = &motion.object;
    let origin = origin + &motion.w.scaled(&motion.age);
    Object { frame: Frame { origin, direction: direction.clone() }, ..motion.object.clone() }
}

/// The pose of the CAV.
fn p(scene: &Scene) -> Frame {
    Frame { origin: scene.ego.position.clone(), direction: scene.ego.heading.clone() }
}
