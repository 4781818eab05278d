//! All three readings of the model at the price of one where nothing is near a threshold.

use crate::input::cycle::Cycle;
use crate::report::{InvalidInput, Reading, Report};
use crate::stages::check;

/// The reports of the strict, the exact and the lax reading (`spec/4-arithmetic.md`). Every margin
/// moves towards rejection in the one and towards acceptance in the other, so what strict accepts
/// exact accepts, and what exact accepts lax accepts, with the same outcome of every stage: a
/// reading is computed only where the one before rejects. `props/tests/readings.rs` compares with
/// readings computed one by one. `Err` is invalid local input.
pub fn readings(cycle: &Cycle) -> Result<[Report; 3], InvalidInput> {
    let strict = check(cycle, Reading::Strict)?;
    let next = |before: &Report, reading| match before.failed_stage {
        None => Ok(before.clone()),
        Some(_) => check(cycle, reading),
    };
    let exact = next(&strict, Reading::Exact)?;
    let lax = next(&exact, Reading::Lax)?;
    Ok([strict, exact, lax])
}
