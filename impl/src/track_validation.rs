//! Stage i: track validation (`spec/3-stages.md#stage-i-track-validation`), with H-01 and H-09.

use core::cmp::Ordering;

use crate::assignment::assign;
use crate::cycle::{Cycle, Detection, DetectionList, Profile, Track, TrackList};
use crate::exact::compare_distances;
use crate::input::elapsed_ns;
use crate::pairing::{Rules, certainly_pass};
use crate::parameters::Parameters;
use crate::plane::{Vector, distance};
use crate::rounding::Real;
use crate::scratch::{Column, NONE, Row, Scratch, short};
use crate::verdict::{Rule, Witness};

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
        let gated = gate(cycle, tracks, detections, scratch.rows);
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

/// Writes the indices of the tracks that are at most as far from the CAV as the farthest detection
/// into the rows, and returns how many; exact, and without detections r = 0.
fn gate(
    cycle: &Cycle<'_>,
    tracks: &TrackList<'_>,
    detections: &DetectionList<'_>,
    rows: &mut [Row],
) -> usize {
    let p = [cycle.ego.x, cycle.ego.y];
    let farthest = detections.items.iter().fold(p, |farthest, detection| {
        let candidate = [detection.x, detection.y];
        let farther = compare_distances(p, candidate, farthest) == Ordering::Greater;
        if farther { candidate } else { farthest }
    });
    let mut gated = 0_usize;
    for (index, track) in tracks.items.iter().enumerate() {
        let is_gated = compare_distances(p, [track.x, track.y], farthest) != Ordering::Greater;
        if let (true, Some(row)) = (is_gated, rows.get_mut(gated)) {
            row.track = short(index);
            gated = gated.saturating_add(1);
        }
    }
    gated
}

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
    let pairs =
        Pairs { tracks: tracks.items, detections: detections.items, swapped: gated > detected };
    let columns = first(scratch.columns, gated.max(detected));
    assign(scratch.rows, k, columns, |rows, row, column| {
        pairs.get(rows, row, column).map(|pair| units(pair.metres()))
    });
    compare_mean(cycle, pairs.sum(scratch.rows, columns), k)
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
    let pairs = Pairs { tracks: tracks.items, detections: detections.items, swapped: false };
    let columns = first(scratch.columns, detections.items.len().saturating_add(spare));
    let limit = cycle.parameters.theta_track_max;
    let assigned = assign(scratch.rows, gated, columns, |rows, row, column| {
        match pairs.get(rows, row, column) {
            Some(pair) => certainly_closer(pair.metres(), limit).then(|| units(pair.metres())),
            None => Some(0),
        }
    });
    if assigned == gated {
        return compare_mean(cycle, pairs.sum(scratch.rows, columns), k);
    }
    // The first track that is near no detection; else several compete, and no one of them is it.
    let lone = (0..gated).find(|&row| {
        let mut columns = 0..detections.items.len();
        !columns.any(|column| {
            let pair = pairs.get(scratch.rows, row, column);
            pair.is_some_and(|pair| certainly_closer(pair.metres(), limit))
        })
    });
    let track = lone.and_then(|row| tracks.items.get(usize::from(scratch.rows.get(row)?.track)));
    let compared = [count(assigned.saturating_sub(spare)), count(k)];
    let witness = Witness::of(Rule::NoAssignment, compared);
    Some(Witness { track: track.map(|track| track.id), ..witness })
}

/// The stage fails rather than begin an assignment of so many rows and columns, whose work is
/// min^2 max, when `work_limit` is below: one search for each, over at most min columns, each of
/// which looks at all.
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

/// Which track and detection a row and a column of the assignment stand for.
struct Pairs<'a> {
    tracks: &'a [Track],
    detections: &'a [Detection],
    /// Rows are detections, columns gated tracks.
    swapped: bool,
}

/// A track and a detection.
struct Pair<'a>(&'a Track, &'a Detection);

impl<'a> Pairs<'a> {
    /// The pair; `None` for a spare column.
    fn get(&self, rows: &[Row], row: usize, column: usize) -> Option<Pair<'a>> {
        let (track, detection) = if self.swapped { (column, row) } else { (row, column) };
        let track = self.tracks.get(usize::from(rows.get(track)?.track))?;
        Some(Pair(track, self.detections.get(detection)?))
    }

    /// The sum of the distances of all assigned pairs, m.
    fn sum(&self, rows: &[Row], columns: &[Column]) -> Real {
        columns.iter().enumerate().fold(Real::ZERO, |sum, (column, entry)| {
            let row = usize::from(entry.row);
            let pair = if entry.row == NONE { None } else { self.get(rows, row, column) };
            pair.map_or(sum, |Pair(t, d)| sum + distance([t.x, t.y], [d.x, d.y]))
        })
    }
}

impl Pair<'_> {
    /// Distance in plain doubles, m: relative error below 4 * 2^-53, for distances above 1e-130.
    fn metres(&self) -> f64 {
        let Self(track, detection) = self;
        let (dx, dy) = (track.x - detection.x, track.y - detection.y);
        libm::sqrt(dx * dx + dy * dy)
    }
}

/// Fails unless the sum is certainly below k `theta_tr`. That makes every acceptance right; that
/// nothing is rejected without need follows from the costs: those of the assignment found add up
/// to at most the least possible sum plus k * 2^-32 m and 2^-49 of it.
fn compare_mean(cycle: &Cycle<'_>, sum: Real, k: usize) -> Option<Witness> {
    let (k, theta_tr) = (Real::new(count(k)), cycle.parameters.theta_tr);
    let passes = sum.certainly_below(k * Real::new(theta_tr));
    (!passes).then(|| Witness::of(Rule::MeanCost, [sum.over(k).value(), theta_tr]))
}

/// A distance in units of 2^-32 m, rounded up so that only coinciding points cost nothing. 2^20 m
/// stand for everything farther: no mean below `theta_tr` <= 1000 m of at most 1024 pairs has a
/// distance above 1,024,000 m.
#[allow(clippy::cast_possible_truncation, reason = "the argument is within 0 and 2^52")]
fn units(metres: f64) -> i64 {
    let whole = (metres.min(1_048_576.0) * 4_294_967_296.0) as i64;
    whole.saturating_add(i64::from(metres > 0.0))
}

/// The bound covers the error of `Pair::metres`; limits are at least 1e-3 m.
fn certainly_closer(metres: f64, limit: f64) -> bool {
    metres * (1.0 + 1e-14) < limit
}

fn count(items: usize) -> f64 {
    u32::try_from(items).map_or(f64::INFINITY, f64::from)
}

/// The first `count` items; the scratch is never smaller, see `Scratch::fits`.
fn first<T>(items: &mut [T], count: usize) -> &mut [T] {
    let count = count.min(items.len());
    items.get_mut(..count).unwrap_or_default()
}
