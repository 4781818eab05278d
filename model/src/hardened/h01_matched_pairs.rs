//! H-01: all gated tracks but miss_budget are matched, each with a detection closer than
//! theta_track_max.

use crate::input::scene::{Scene, Track};
use crate::numbers::assignment::{Costs, count};
use crate::numbers::real::Real;
use crate::report::{Rule, Witness};

/// What stage i assigns: the pairs closer than theta_track_max, k' = max(gated tracks - miss_budget, 0),
/// and the columns that its work counts: the detections and min(miss_budget, gated tracks) misses.
pub fn to_assign(scene: &Scene, costs: Costs, detections: usize) -> (Costs, usize, usize) {
    let gated = costs.len();
    let budget = usize::try_from(scene.parameters.miss_budget).unwrap_or(0);
    let k = gated.saturating_sub(budget);
    let theta_track_max = &scene.parameters.theta_track_max;
    let close = |cost: &Real| scene.reads.less(cost, theta_track_max);
    let costs =
        costs.into_iter().map(|row| row.into_iter().map(|c| c.filter(close)).collect()).collect();
    (costs, k, detections + budget.min(gated))
}

/// Fewer pairs than k': the witness names the first gated track without a detection close to it.
pub fn no_assignment(gated: &[&Track], costs: &Costs, pairs: usize, k: usize) -> Witness {
    let unmatched = costs.iter().position(|row| row.iter().all(Option::is_none));
    Witness {
        track: unmatched.map(|row| gated[row].id),
        ..Witness::new(Rule::NoAssignment, &count(pairs), &count(k))
    }
}
