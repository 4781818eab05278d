//! Parts of the stages as functions of their own, for the proofs of `proofs/` alone: with the feature
//! `parts`, and no part of the interface.

pub mod monitor;

use core::cmp::Ordering;

use crate::hardened::h07_start;
use crate::hardened::h14_fail_safe::times::Times;
use crate::input::cycle::{
    Cycle, DetectionList, Grid, Lead, Route, TrackList, Trajectory, TrajectoryPoint,
};
use crate::input::domain::route::check_route;
use crate::input::domain::{
    CheckedBefore, check_detections, check_grid, check_lead, check_tracks, check_trajectory,
};
use crate::input::parameters::Parameters;
use crate::input::profile::HardenedRule;
use crate::input::scratch::Row;
use crate::numbers::exact::limbs;
use crate::offloading::requester::{Action, Actions, Event, Requester, RequesterError};
use crate::report::Witness;
use crate::stages::distances;
use crate::stages::horizon::{self, Horizon};
use crate::stages::i_track_validation::gate;
use crate::stages::i_track_validation::places::Places;
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

/// `s_stop` in plain doubles, m. Source: `spec/hardened/H-14.md#requirements-windows`.
pub fn s_stop(cycle: &Cycle<'_>) -> f64 {
    Times::new(cycle).s_stop
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

/// How many points of the trajectory stage v examines. Source: `spec/3-stages.md#distances`.
pub fn points_examined(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> usize {
    horizon::points_examined(cycle, points, Horizon::Braking).len()
}

/// What the start of a trajectory breaks. Source: `spec/hardened/H-07.md`, H-07.
pub fn start_failure(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> Option<Witness> {
    h07_start::start_failure(cycle, points)
}

/// The indices of the first two gated tracks. Source: `spec/3-stages.md#stage-i-track-validation`.
pub fn gated_tracks(
    cycle: &Cycle<'_>,
    tracks: &TrackList<'_>,
    detections: &DetectionList<'_>,
) -> [Option<u16>; 2] {
    let mut rows = [Row::default(); 2];
    let places = if cycle.profile.has(HardenedRule::H01) {
        Places::at(tracks, detections.stamp_ns)
    } else {
        Places::standing(tracks.items)
    };
    let p = [cycle.ego.x, cycle.ego.y];
    let count = gate::gated_tracks(p, &places, detections.items, &mut rows);
    let [first, second] = rows.map(|row| row.track);
    [(count > 0).then_some(first), (count > 1).then_some(second)]
}
