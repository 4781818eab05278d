//! Stage i: track validation (`spec/3-stages.md#stage-i-track-validation`), with H-01 and H-09.

pub(crate) mod assignment;
mod gate;
mod pairing;
pub(crate) mod pairs;
pub(crate) mod spatial_hash;

use crate::input::cycle::{Cycle, DetectionList, Profile, TrackList};
use crate::input::domain::elapsed_ns;
use crate::input::parameters::Parameters;
use crate::input::scratch::{Column, Row, Scratch};
use crate::numbers::plane::Vector;
use crate::numbers::rounding::Real;
use crate::report::{Rule, Witness};
use crate::stages::i_track_validation::assignment::assign;
use crate::stages::i_track_validation::gate::gate;
use crate::stages::i_track_validation::pairing::{Rules, certainly_pass};
use crate::stages::i_track_validation::pairs::Pairs;

/// Why stage i fails, if it does. `previous`: the list for H-09, if it is in use.
pub(crate) fn track_validation(
    cycle: &Cycle<'_>,
    tracks: &TrackList<'_>,
    detections: &DetectionList<'_>,
    previous: Option<&TrackList<'_>>,
    scratch: &mut Scratch<'_>,
) -> Option<Witness> {
    let mut paired = None;
    if !pairs_found(cycle, tracks, detections, scratch) {
        let p = [cycle.ego.x, cycle.ego.y];
        let gated = gate(p, tracks.items, detections.items, scratch.rows);
        paired = match cycle.profile {
            Profile::Paper => mean_cost(cycle, tracks, detections, gated, scratch),
            Profile::Hardened => matched_cost(cycle, tracks, detections, gated, scratch),
        };
    }
    paired.or_else(|| previous.and_then(|previous| velocity(cycle, tracks, previous)))
}

/// Whether a quick search finds pairs that keep the rules of the profile.
fn pairs_found(
    cycle: &Cycle<'_>,
    tracks: &TrackList<'_>,
    detections: &DetectionList<'_>,
    scratch: &mut Scratch<'_>,
) -> bool {
    let Parameters { theta_tr, theta_track_max, miss_budget, .. } = cycle.parameters;
    let rules = match cycle.profile {
        Profile::Paper => Rules { theta_tr, limit: f64::MAX, spare: 0 },
        Profile::Hardened => {
            let spare = usize::try_from(miss_budget).unwrap_or(0);
            Rules { theta_tr, limit: theta_track_max, spare }
        }
    };
    let columns = first(scratch.columns, detections.items.len());
    let p = [cycle.ego.x, cycle.ego.y];
    certainly_pass(p, tracks.items, detections.items, rules, columns)
}

/// H-09: `previous_tracks` when the difference of stamps is in (0, 1 s] and they are not too old
/// to be used at all.
pub(crate) fn previous_in_use<'c, 'a>(
    cycle: &'c Cycle<'a>,
    tracks: &TrackList<'_>,
    usable: bool,
) -> Option<&'c TrackList<'a>> {
    let previous = cycle.previous_tracks.as_ref()?;
    let dt_ns = elapsed_ns(previous.stamp_ns, tracks.stamp_ns);
    let in_use = cycle.profile == Profile::Hardened && usable && 0 < dt_ns && dt_ns <= SECOND_NS;
    in_use.then_some(previous)
}

const SECOND_NS: i64 = 1_000_000_000;

/// The stage of the paper: k = min(gated tracks, detections) pairs, the fewer of the two as rows.
fn mean_cost(
    cycle: &Cycle<'_>,
    tracks: &TrackList<'_>,
    detections: &DetectionList<'_>,
    gated: usize,
    scratch: &mut Scratch<'_>,
) -> Option<Witness> {
    let detected = detections.items.len();
    let k = gated.min(detected);
    if k == 0 {
        return None;
    }
    if let Some(witness) = over_limit(cycle, gated, detected) {
        return Some(witness);
    }
    let columns = first(scratch.columns, gated.max(detected));
    let lists = (tracks.items, detections.items);
    let pairs = Pairs::new(lists, gated > detected, f64::MAX, scratch.rows, columns);
    let assigned = assign(scratch.rows, k, columns, &pairs);
    if assigned < k {
        // Every row may be paired with every column: never, but if so, nothing has been shown.
        return Some(no_assignment(assigned, k));
    }
    compare_mean(cycle, &pairs, scratch.rows, columns, k)
}

/// H-01: k' = gated tracks less the budget. The budget is spare columns that cost nothing, so that
/// a minimal assignment of all gated tracks is a minimal choice of k' pairs; pairs beyond k' are of
/// coinciding points and add nothing to the sum.
fn matched_cost(
    cycle: &Cycle<'_>,
    tracks: &TrackList<'_>,
    detections: &DetectionList<'_>,
    gated: usize,
    scratch: &mut Scratch<'_>,
) -> Option<Witness> {
    let spare = usize::try_from(cycle.parameters.miss_budget).unwrap_or(0).min(gated);
    let k = gated.saturating_sub(spare);
    if k == 0 {
        return None;
    }
    if let Some(witness) = over_limit(cycle, gated, detections.items.len().saturating_add(spare)) {
        return Some(witness);
    }
    let columns = first(scratch.columns, detections.items.len().saturating_add(spare));
    let lists = (tracks.items, detections.items);
    let limit = cycle.parameters.theta_track_max;
    let pairs = Pairs::new(lists, false, limit, scratch.rows, columns);
    let assigned = assign(scratch.rows, gated, columns, &pairs);
    if assigned == gated {
        return compare_mean(cycle, &pairs, scratch.rows, columns, k);
    }
    // The first track that is near no detection; else several compete, and no one of them is it.
    let lone = pairs.lone(scratch.rows, gated).and_then(|index| tracks.items.get(index));
    let witness = no_assignment(assigned.saturating_sub(spare), k);
    Some(Witness { track: lone.map(|track| track.id), ..witness })
}

fn no_assignment(assigned: usize, k: usize) -> Witness {
    Witness::of(Rule::NoAssignment, [count(assigned), count(k)])
}

/// The stage fails rather than begin an assignment of so many rows and columns, whose work is
/// min^2 max, when `work_limit` is below: one search for each, over at most min rows, each of
/// which looks at all columns.
fn over_limit(cycle: &Cycle<'_>, rows: usize, columns: usize) -> Option<Witness> {
    let (least, most) = (rows.min(columns), rows.max(columns));
    let work = least.saturating_mul(least).saturating_mul(most);
    let (work, limit) = (i64::try_from(work).unwrap_or(i64::MAX), cycle.parameters.work_limit);
    let compared = [work, limit].map(|steps| Real::integer(steps).value());
    (work > limit).then(|| Witness::of(Rule::WorkLimit, compared))
}

/// H-09: abs(p - `p_prev` - v dt) <= `theta_velocity` dt for every track whose id is held.
fn velocity(
    cycle: &Cycle<'_>,
    tracks: &TrackList<'_>,
    previous: &TrackList<'_>,
) -> Option<Witness> {
    let dt = Real::seconds(elapsed_ns(previous.stamp_ns, tracks.stamp_ns));
    let limit = Real::new(cycle.parameters.theta_velocity) * dt;
    let mut hint = 0_usize;
    tracks.items.iter().find_map(|track| {
        // Trackers keep their order, so that most tracks follow one another in both lists.
        if previous.items.get(hint).is_none_or(|held| held.id != track.id) {
            hint = previous.items.iter().position(|held| held.id == track.id)?;
        }
        let held = previous.items.get(hint)?;
        hint = hint.saturating_add(1);
        // Plain doubles err by less than 2^-22 m.
        let (x, y) =
            (track.x - held.x - track.vx * dt.value(), track.y - held.y - track.vy * dt.value());
        let least = limit.value() - 1e-6;
        if least > 0.0 && x * x + y * y < least * least {
            return None;
        }
        let moved = Vector::between([held.x, held.y], [track.x, track.y]);
        let off = (moved - Vector::new(track.vx, track.vy).times(dt)).norm();
        let witness = Witness::of(Rule::Velocity, [off.value(), limit.value()]);
        let fits = off.certainly_at_most(limit);
        (!fits).then_some(Witness { track: Some(track.id), ..witness })
    })
}

/// Fails unless the sum is certainly below k `theta_tr`. That makes every acceptance right; that
/// nothing is rejected without need follows from the costs: those of the assignment found add up
/// to at most the least possible sum plus k * 2^-32 m and 2^-49 of it.
fn compare_mean(
    cycle: &Cycle<'_>,
    pairs: &Pairs<'_>,
    rows: &[Row],
    columns: &[Column],
    k: usize,
) -> Option<Witness> {
    let theta_tr = cycle.parameters.theta_tr;
    let witness = |mean: f64| Witness::of(Rule::MeanCost, [mean, theta_tr]);
    let plain = pairs.plain_sum(rows, columns) / count(k);
    if plain > theta_tr * (1.0 + 1e-12) {
        return Some(witness(plain));
    }
    let are_pairs = pairs.are_one_to_one(rows, columns, k);
    let (sum, k) = (pairs.sum(rows, columns), Real::new(count(k)));
    let passes = are_pairs && sum.certainly_below(k * Real::new(theta_tr));
    (!passes).then(|| witness(sum.over(k).value()))
}

fn count(items: usize) -> f64 {
    u32::try_from(items).map_or(f64::INFINITY, f64::from)
}

/// The first `count` items; the scratch is never smaller, see `Scratch::fits`.
fn first<T>(items: &mut [T], count: usize) -> &mut [T] {
    let count = count.min(items.len());
    items.get_mut(..count).unwrap_or_default()
}
