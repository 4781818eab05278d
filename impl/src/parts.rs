//! Parts of the stages as functions of their own, for the proofs of `proofs/` alone: with the feature
//! `parts`, and no part of the interface.

pub mod monitor;
pub mod steps;

use core::cmp::Ordering;

use crate::hardened::h07_start;
use crate::hardened::h14_fail_safe::times::Times;
use crate::input::cycle::{Cycle, DetectionList, Grid, Lead, Route, TrackList, Trajectory};
use crate::input::domain::route::check_route;
use crate::input::domain::{
    CheckedBefore, check_detections, check_grid, check_lead, check_tracks, check_trajectory,
};
use crate::input::parameters::Parameters;
use crate::input::scratch::Row;
use crate::numbers::exact::limbs;
use crate::numbers::time::elapsed_ns;
use crate::offloading::requester::{Action, Actions, Event, Requester, RequesterError};
use crate::stages::distances;
use crate::stages::horizon;
use crate::stages::i_track_validation::gate;
use crate::stages::v_grid_map::bitmap::Bitmap;

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

/// What `s_follow` is in plain doubles of `s_b(v_now)`, `s_b(v_lead)` and `s_CAV`, m. Source: `spec/3-stages.md#distances`.
pub fn follow(ways: [f64; 2], s_cav: f64) -> f64 {
    distances::follow(ways, s_cav)
}

/// Speed after `tau`, the way until then, and `s_stop`, in plain doubles, m/s and m. Source:
/// `spec/hardened/H-14.md#requirements-windows`.
pub fn stop(cycle: &Cycle<'_>) -> [f64; 3] {
    let Times { v_tau, s_tau, s_stop, .. } = Times::new(cycle);
    [v_tau, s_tau, s_stop]
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

/// total + summand or total - summand of integers of so many limbs, and the sign of it, as `exact` has
/// them for 36. Source: `spec/4-arithmetic.md#strict-and-lax`.
pub fn sum_of_limbs<const N: usize>(
    mut total: [u64; N],
    summand: &[u64; N],
    negative: bool,
) -> ([u64; N], Ordering) {
    limbs::add(&mut total, summand, negative);
    (total, limbs::sign(&total))
}

/// The product of integers of two limbs, as `exact` has it for 18. Source:
/// `spec/4-arithmetic.md#strict-and-lax`.
pub fn product_of_limbs(a: &[u64; 2], b: &[u64; 2]) -> [u64; 4] {
    limbs::product(a, b)
}

/// The 57 bits from this one on, in a word whose other bits are not set. Source: `spec/5-interfaces.md#cycle`.
pub fn bits_from(bits: &[u8], bit: i64) -> Option<u64> {
    Bitmap { bits, width: 0, height: 0 }.bits_from(bit)
}

/// The first set cell of a row from one column to another, in a bitmap of so many columns and rows.
/// Source: `spec/5-interfaces.md#cycle`.
pub fn first_in_row(
    bits: &[u8],
    [width, height]: [i64; 2],
    row: i64,
    [from, to]: [i64; 2],
) -> Option<i64> {
    Bitmap { bits, width, height }.first_in_row(row, from, to)
}

/// Whether no cell of a row is set from one column to before another. Source:
/// `spec/5-interfaces.md#cycle`.
pub fn row_is_free(
    bits: &[u8],
    [width, height]: [i64; 2],
    row: i64,
    [from, end]: [i64; 2],
) -> bool {
    Bitmap { bits, width, height }.row_is_free(row, from, end)
}

/// Column and row of the first set cell around another one, and the square of their distance, which is
/// at most `most`. Source: `spec/3-stages.md#stage-v-trajectory-with-grid-map`.
pub fn cell_within(
    bits: &[u8],
    [width, height]: [i64; 2],
    [column, row]: [i64; 2],
    most: i64,
) -> Option<[i64; 3]> {
    let found = Bitmap { bits, width, height }.within(column, row, most);
    found.map(|near| [near.column, near.row, near.squared])
}

/// Whether a way of plain doubles is within a horizon between these two; `None`: they cannot tell. Source:
/// `spec/3-stages.md#distances`.
pub fn plainly_within(arc: f64, horizon: [f64; 2]) -> Option<bool> {
    horizon::plainly_within(arc, horizon)
}

/// How many of three points are examined, by whether the second and the third are within the horizon. Source:
/// `spec/3-stages.md#distances`.
pub fn points_examined(is_within: [Option<bool>; 2]) -> Option<usize> {
    horizon::prefix(is_within.into_iter())
}

/// Whether a trajectory whose first point has this time starts about now. Source: `spec/hardened/H-07.md`, H-07.
pub fn starts_in_time(t_ns: i64, now_ns: i64, max_age_ns: i64) -> bool {
    h07_start::is_in_time(elapsed_ns(t_ns, now_ns), max_age_ns)
}

/// Of three tracks, the indices of the first two gated ones. Source: `spec/3-stages.md#stage-i-track-validation`.
pub fn gated_tracks(is_gated: [bool; 3]) -> [Option<u16>; 2] {
    let mut rows = [Row::default(); 2];
    let listed = gate::list(is_gated.into_iter(), &mut rows);
    let [first, second] = rows.map(|row| row.track);
    [(listed > 0).then_some(first), (listed > 1).then_some(second)]
}
