//! Reach: the excess of no point that is no node and of no place is above lateral_tolerance, the path is not too long,
//! no place is turned farther than an arc to it, no point that is no node leads back by more than 1/8 m, and the path does
//! not come back (`spec/hardened/H-14.md#requirements-reach`).

use crate::hardened::h14_fail_safe::excess::{
    aside, is_aside, is_aside_or_turned, no_nodes, of_place, of_point,
};
use crate::hardened::h14_fail_safe::meeting::big_m;
use crate::hardened::h14_fail_safe::path::{
    Place, ahead, first_ahead, greatest_length, least_ahead, places,
};
use crate::hardened::h14_fail_safe::returns;
use crate::hardened::h14_fail_safe::times::Driving;
use crate::input::profile::HardenedRule;
use crate::input::scene::{Point, Scene};
use crate::numbers::real::Real;
use crate::report::{Rule, Witness};

/// The excess of a point that is no node, or of a place other than p, is above lateral_tolerance, or the length at a
/// place is above 2 s_stop + 1 m, or a place is turned farther than an arc to it, or a point that is no node is more than
/// 1/8 m less ahead than a point before it; or, after all of these, the path comes back.
pub fn failure(scene: &Scene, trajectory: &[Point]) -> Option<Witness> {
    let of_points = no_nodes(scene, trajectory)
        .zip(ways_back(scene, trajectory))
        .map(|(x, back)| {
            excess_failure(scene, is_aside(scene, x), || of_point(scene, x))
                .or_else(|| back_failure(scene, &back))
        })
        .enumerate();
    let of_places = places(scene, trajectory).map(|place| {
        let is_asked = is_aside_or_turned(scene, &place.pose);
        excess_failure(scene, is_asked, || of_place(scene, &place.pose))
            .or_else(|| length_failure(scene, &place))
            .or_else(|| heading_failure(scene, &place))
    });
    let mut all = of_points.chain((trajectory.len()..).zip(of_places).skip(1));
    all.find_map(|(i, failure)| Some(failure?.at_point(i)))
        .or_else(|| returns::failure(scene, trajectory))
}

/// excess <= lateral_tolerance. Where it may not be above 0 it is not worked out, if 0 passes.
fn excess_failure(
    scene: &Scene,
    may_be_above_0: bool,
    excess: impl FnOnce() -> Real,
) -> Option<Witness> {
    let (reads, limit) = (&scene.reads, &scene.parameters.lateral_tolerance);
    if !may_be_above_0 && reads.at_most(&Real::zero(), limit) {
        return None;
    }
    let excess = excess();
    Witness::unless(reads.at_most(&excess, limit), Rule::Reach, &excess, limit)
}

/// length <= 2 s_stop + 1 m.
fn length_failure(scene: &Scene, place: &Place) -> Option<Witness> {
    let (length, greatest) = (&place.length, greatest_length(scene));
    let is_short = scene.reads.at_most(length, &greatest);
    Witness::unless(is_short, Rule::Reach, length, &greatest)
}

/// h . h_k > 0, and f abs(h x h_k) <= 0.17 f + 2 abs(a_x) + 0.5 m with f = max(f_x, 0).
fn heading_failure(scene: &Scene, place: &Place) -> Option<Witness> {
    let (reads, h, h_k) = (&scene.reads, &scene.ego.heading, &place.pose.direction);
    let (along, zero) = (h.dot(h_k), Real::zero());
    if !reads.greater(&along, &zero) {
        return Some(Witness::new(Rule::Reach, &along, &zero));
    }
    let f = place.progress.clone().max(zero);
    let aside = aside(scene, &place.pose.origin).abs();
    let [turn, offset] = [0.17, 0.5].map(Real::from_double);
    let (turned, limit) =
        (&f * h.cross(h_k).abs(), turn * &f + Real::from_integer(2) * aside + offset);
    Witness::unless(reads.at_most(&turned, &limit), Rule::Reach, &turned, &limit)
}

/// back <= 1/8 m: how much less ahead a point that is no node is than a point before it.
fn back_failure(scene: &Scene, back: &Real) -> Option<Witness> {
    let eighth = least_ahead();
    Witness::unless(scene.reads.at_most(back, &eighth), Rule::Reach, back, &eighth)
}

/// Of each point that is no node, by how much its progress is below the greatest of its own and of all points before
/// it, m: 0 where none before is farther ahead.
fn ways_back(scene: &Scene, trajectory: &[Point]) -> impl Iterator<Item = Real> {
    no_nodes(scene, trajectory).scan(None, |farthest: &mut Option<Real>, x| {
        let progress = ahead(scene, x);
        *farthest = farthest.take().max(Some(progress.clone()));
        Some(farthest.clone()? - progress)
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
