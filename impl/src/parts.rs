//! Parts of the stages as functions of their own, for the proofs of `proofs/` alone: with the feature
//! `parts`, and no part of the interface.

use core::cmp::Ordering;

use crate::hardened::h04_horizon::plain_s_stop;
use crate::input::cycle::{
    Cycle, DetectionList, Grid, Lead, Route, TrackList, Trajectory, TrajectoryPoint,
};
use crate::input::domain::route::check_route;
use crate::input::domain::{
    CheckedBefore, check_detections, check_grid, check_lead, check_tracks, check_trajectory,
};
use crate::input::parameters::Parameters;
use crate::numbers::exact::limbs;
use crate::offloading::requester::{Action, Actions, Event, Requester, RequesterError};
use crate::stages::distances;

/// `s_b(v)` in plain doubles, m. Source: `spec/3-stages.md#distances`.
pub fn s_b(parameters: &Parameters, v: f64) -> f64 {
    distances::s_b(parameters, v)
}

/// `s_CAV` in plain doubles, m. Source: `spec/3-stages.md#distances`.
pub fn s_cav(parameters: &Parameters, v_now: f64) -> f64 {
    distances::s_cav(parameters, v_now)
}

/// `s_follow` in plain doubles, m. Source: `spec/3-stages.md#distances`.
pub fn s_follow(parameters: &Parameters, v_now: f64, v_lead: f64) -> f64 {
    distances::s_follow(parameters, v_now, v_lead)
}

/// `s_valid` in plain doubles, m. Source: `spec/3-stages.md#distances`.
pub fn s_valid(parameters: &Parameters, v_now: f64, v_lead: Option<f64>) -> f64 {
    distances::s_valid(parameters, v_now, v_lead)
}

/// Doubles below and above `s_stop`, m. Source: `spec/3-stages.md#hardened-profile`, H-04.
pub fn s_stop(cycle: &Cycle<'_>, first: &TrajectoryPoint) -> [f64; 2] {
    plain_s_stop(cycle, first)
}

/// As `Requester::step`, but what has to be done kind by kind, for MOT and PLAN: drops, releases,
/// activations and deactivations, requests. Source: `spec/2-offloading.md#fallback`.
pub fn decide(
    requester: &mut Requester<'_>,
    event: &Event,
) -> Result<[[Option<Action>; 2]; 4], RequesterError> {
    requester.decide(event)
}

/// Of the list that `Requester::step` makes of it: how long it is, and what is at a place. Source:
/// `spec/2-offloading.md#fallback`.
pub fn action_at(by_kind: [[Option<Action>; 2]; 4], at: usize) -> (usize, Option<Action>) {
    let mut actions = Actions::NONE;
    actions.extend(&by_kind);
    (actions.len(), actions.get(at).copied())
}

/// Whether the route is valid. Source: `spec/4-arithmetic.md#domain`.
pub fn route_is_valid(route: &Route<'_>) -> bool {
    check_route(route).is_ok()
}

/// Whether the lead is valid. Source: `spec/4-arithmetic.md#domain`.
pub fn lead_is_valid(lead: &Lead, now_ns: i64) -> bool {
    check_lead(lead, now_ns).is_ok()
}

/// Whether the grid is valid. Source: `spec/4-arithmetic.md#domain`.
pub fn grid_is_valid(grid: &Grid<'_>, now_ns: i64) -> bool {
    check_grid(grid, now_ns).is_ok()
}

/// Whether the detections are valid. Source: `spec/4-arithmetic.md#domain`.
pub fn detections_are_valid(list: &DetectionList<'_>, now_ns: i64) -> bool {
    let nothing = CheckedBefore { route: false, detections: &|_| false };
    check_detections(list, now_ns, &nothing).is_ok()
}

/// Whether the tracks are valid. Source: `spec/4-arithmetic.md#domain`.
pub fn tracks_are_valid(list: &TrackList<'_>, now_ns: i64, remote: bool) -> bool {
    check_tracks(Some(list), now_ns, remote).is_ok()
}

/// Whether the trajectory is valid, and if it is, whether it is young enough to be used. Source:
/// `spec/4-arithmetic.md#domain`.
pub fn trajectory_is_usable(
    trajectory: &Trajectory<'_>,
    now_ns: i64,
    remote: bool,
) -> Option<bool> {
    check_trajectory(Some(trajectory), now_ns, remote).ok()
}

/// total + summand or total - summand of integers of three limbs, and the sign of it, as `exact` has
/// them for 36. Source: `spec/4-arithmetic.md#strict-and-lax`.
pub fn sum_of_limbs(
    mut total: [u64; 3],
    summand: &[u64; 3],
    negative: bool,
) -> ([u64; 3], Ordering) {
    limbs::add(&mut total, summand, negative);
    (total, limbs::sign(&total))
}
