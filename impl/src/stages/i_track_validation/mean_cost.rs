//! The limits of an assignment: its work and its mean cost
//! (`spec/3-stages.md#stage-i-track-validation`).

use crate::input::cycle::Cycle;
use crate::input::scratch::{Column, Row};
use crate::numbers::rounding::Real;
use crate::report::{Rule, Witness};
use crate::stages::i_track_validation::pairs::Pairs;

/// Fails unless the sum is certainly below k `theta_tr`. That makes every acceptance right; that
/// nothing is rejected without need follows from the costs: those of the assignment found add up
/// to at most the least possible sum plus k * 2^-32 m and 2^-49 of it.
pub(crate) fn mean_cost_failure(
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
    // S1-06
    let passes = are_pairs && sum.certainly_below(k * Real::new(theta_tr));
    (!passes).then(|| witness(sum.over(k).value()))
}

/// The stage fails rather than begin an assignment of so many rows and columns, whose work is
/// min^2 max, when `work_limit` is below: one search for each, over at most min rows, each of
/// which looks at all columns.
pub(crate) fn over_work_limit(cycle: &Cycle<'_>, rows: usize, columns: usize) -> Option<Witness> {
    let (least, most) = (rows.min(columns), rows.max(columns));
    // S1-07
    let work = least.saturating_mul(least).saturating_mul(most);
    let (work, limit) = (i64::try_from(work).unwrap_or(i64::MAX), cycle.parameters.work_limit);
    let compared = [work, limit].map(|steps| Real::integer(steps).value());
    // S1-08
    (work > limit).then(|| Witness::of(Rule::WorkLimit, compared))
}

/// Fewer rows got a column than have to.
pub(crate) fn no_assignment(assigned: usize, k: usize) -> Witness {
    Witness::of(Rule::NoAssignment, [count(assigned), count(k)])
}

/// The first `count` columns; the scratch is never smaller, see `Scratch::fits`.
pub(crate) fn columns_of(columns: &mut [Column], count: usize) -> &mut [Column] {
    let count = count.min(columns.len());
    columns.get_mut(..count).unwrap_or_default()
}

fn count(items: usize) -> f64 {
    u32::try_from(items).map_or(f64::INFINITY, f64::from)
}
