//! Which stages run, in which order, and what the cycle reports (`spec/3-stages.md#schedule`).

use crate::cycle::Cycle;
use crate::scratch::Scratch;
use crate::verdict::{FailedStage, InvalidInput, Outcome, Report};

/// Decides one cycle. `Err` is invalid local input, an error to the caller; invalid remote data
/// make the cycle unsafe (`spec/3-stages.md#invalid-input`).
pub fn check(cycle: &Cycle<'_>, scratch: &mut Scratch<'_>) -> Result<Report, InvalidInput> {
    scratch.fits(cycle)?;
    // No stage is written yet, so no trajectory was compared with anything.
    let stages = [Outcome::NotScheduled; 5];
    Ok(Report { failed_stage: Some(FailedStage::NoObstacleCheck), stages, input: None })
}
