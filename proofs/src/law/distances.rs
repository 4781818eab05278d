//! Laws of the distances (`spec/3-stages.md#distances`), as far as a verdict shows them.

use mufasa::input::cycle::Cycle;
use mufasa::report::{Outcome, Report, Rule};

/// A gap of at most `s_CAV` never passes: `s_follow` is never below `s_CAV`, whatever the lead's
/// speed. Of cycles in which nothing before the gap fails and the gap is compared.
pub fn s_follow_is_never_below_s_cav(cycle: &Cycle<'_>, report: &Report) -> bool {
    let Some(lead) = cycle.lead else { return true };
    let s_cav = next_below(cycle.parameters.safety_time * cycle.ego.speed);
    lead.gap > s_cav || failed_by_gap(report)
}

/// Whoever may follow at a gap may follow at a larger one; `nearer` and `farther` differ in
/// nothing but the gap.
pub fn a_larger_gap_is_never_worse(nearer: &Report, farther: &Report) -> bool {
    failed_by_gap(nearer) || !failed_by_gap(farther)
}

/// Behind a faster lead one may follow as near as behind a slower one, to within the bound on the
/// rounding error; the two differ in nothing but the lead's speed, and in the gap by that bound.
pub fn s_follow_falls_with_v_lead(slower: &Report, faster: &Report) -> bool {
    failed_by_gap(slower) || !failed_by_gap(faster)
}

/// Whether stage iv failed because of the gap.
pub fn failed_by_gap(report: &Report) -> bool {
    matches!(&report.stages[3], Outcome::Failed(witness) if witness.rule == Rule::Gap)
}

/// The largest double below a positive one; any other one itself. The product of which it is taken may have been
/// rounded up.
pub fn next_below(value: f64) -> f64 {
    if value > 0.0 { f64::from_bits(value.to_bits() - 1) } else { value }
}
