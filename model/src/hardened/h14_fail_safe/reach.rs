//! Reach: no place, and no point that is no node, is farther aside than tyres can carry the CAV, the path is not
//! too long, and no place is turned farther than an arc to it (`spec/hardened/H-14.md#requirements-reach`).

use crate::hardened::h14_fail_safe::meeting::big_m;
use crate::hardened::h14_fail_safe::path::{
    Place, ahead, first_ahead, greatest_length, least_ahead, places,
};
use crate::hardened::h14_fail_safe::times::Driving;
use crate::input::profile::HardenedRule;
use crate::input::scene::{Point, Scene};
use crate::numbers::real::Real;
use crate::numbers::vector::Vector;
use crate::report::{Rule, Witness};

/// A point before the first node, or a place other than p, with f < s_b(v) is farther aside than
/// 0.5 m + 0.17 f + 5.75 t^2, or the length at a place is above 2 s_stop + 1 m, or a place is turned
/// farther than an arc to it.
pub fn failure(scene: &Scene, trajectory: &[Point]) -> Option<Witness> {
    let first_node = first_ahead(scene, trajectory).unwrap_or(trajectory.len());
    let points = trajectory[..first_node].iter();
    let of_points = points.map(|point| aside_failure(scene, &point.pose.origin)).enumerate();
    let of_places = places(scene, trajectory).map(|place| {
        let aside = aside_failure(scene, &place.pose.origin);
        let length = || length_failure(scene, &place);
        aside.or_else(length).or_else(|| heading_failure(scene, &place))
    });
    let mut all = of_points.chain((trajectory.len()..).zip(of_places).skip(1));
    all.find_map(|(i, failure)| Some(failure?.at_point(i)))
}

/// f = max((x - p) . h, 0) and abs((x - p) x h), m.
fn ahead_and_aside(scene: &Scene, x: &Vector) -> [Real; 2] {
    let aside = (x - &scene.ego.position).cross(&scene.ego.heading).abs();
    [ahead(scene, x).max(Real::zero()), aside]
}

/// abs((x - p) x h) <= 0.5 m + 0.17 f + 5.75 m/s^2 t^2, t that of braking with a_b up to f, where f < s_b(v).
fn aside_failure(scene: &Scene, x: &Vector) -> Option<Witness> {
    let driving = Driving::of(scene);
    let [f, aside] = ahead_and_aside(scene, x);
    if !scene.reads.may_be_less(&f, &driving.s_b()) {
        return None;
    }
    let [offset, turn, grip] = [0.5, 0.17, 5.75].map(Real::from_double);
    let limit = offset + turn * &f + grip * driving.braking_with(driving.a_b, &f).square();
    Witness::unless(scene.reads.at_most(&aside, &limit), Rule::Reach, &aside, &limit)
}

/// length <= 2 s_stop + 1 m.
fn length_failure(scene: &Scene, place: &Place) -> Option<Witness> {
    let (length, greatest) = (&place.length, greatest_length(scene));
    let is_short = scene.reads.at_most(length, &greatest);
    Witness::unless(is_short, Rule::Reach, length, &greatest)
}

/// h . h_k > 0, f abs(h x h_k) <= 0.17 f + 2 d + 0.5 m, and abs(h x h_k) <= 0.17 + f/3 m.
fn heading_failure(scene: &Scene, place: &Place) -> Option<Witness> {
    let (reads, h, h_k) = (&scene.reads, &scene.ego.heading, &place.pose.direction);
    let (along, zero) = (h.dot(h_k), Real::zero());
    if !reads.greater(&along, &zero) {
        return Some(Witness::new(Rule::Reach, &along, &zero));
    }
    let [f, d] = ahead_and_aside(scene, &place.pose.origin);
    let [turn, offset] = [0.17, 0.5].map(Real::from_double);
    let sine = h.cross(h_k).abs();
    let arc = (&f * &sine, &turn * &f + Real::from_integer(2) * d + offset);
    let circle = (sine, turn + f / Real::from_integer(3));
    [arc, circle].into_iter().find_map(|(turned, limit)| {
        Witness::unless(reads.at_most(&turned, &limit), Rule::Reach, &turned, &limit)
    })
}

/// `spec/4-arithmetic.md#strict-and-lax`: of the first point that is more than 1/8 m ahead, or one before
/// it, the strict reading cannot say whether it is; H-04 and H-14 look at the places that follow.
pub fn ambiguous_failure(scene: &Scene, trajectory: &[Point]) -> Option<Witness> {
    let is_asked = scene.profile.has(HardenedRule::H04) || scene.profile.has(HardenedRule::H14);
    if !is_asked || !scene.reads.is_strict() {
        return None;
    }
    let count = first_ahead(scene, trajectory).map_or(trajectory.len(), |first| first + 1);
    trajectory[..count].iter().enumerate().find_map(|(i, point)| {
        let (f, least) = (ahead(scene, &point.pose.origin), least_ahead());
        let is_clear = (&f - &least).abs() > scene.reads.delta;
        Witness::unless(is_clear, Rule::Ambiguous, &f, &least).map(|witness| witness.at_point(i))
    })
}

/// `spec/4-arithmetic.md#strict-and-lax`: a piece that ends at a progress above s_stop - M has not
/// u . h > M (abs(u_x) + abs(u_y)), so that the strict reading cannot say where the path reaches s_stop.
pub fn ambiguous_end_failure(scene: &Scene, trajectory: &[Point]) -> Option<Witness> {
    if !scene.profile.has(HardenedRule::H14) || !scene.reads.is_strict() {
        return None;
    }
    let (m, s_stop) = (big_m(scene), Driving::of(scene).s_stop());
    places(scene, trajectory).enumerate().find_map(|(k, place)| {
        let (u, _) = place.piece.filter(|(_, end)| *end > &s_stop - &m)?;
        let (along, least) = (u.dot(&scene.ego.heading), &m * (u.x.abs() + u.y.abs()));
        let failure = Witness::unless(along > least, Rule::Ambiguous, &along, &least)?;
        Some(failure.at_point(trajectory.len() + k))
    })
}
