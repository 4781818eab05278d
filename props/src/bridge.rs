//! The only conversion between the types of the model and those of the implementation.
//!
//! Structs are taken apart without `..` and enums matched without a catch-all: a field or variant
//! that only one of the two crates has breaks the build.

mod cycle;
mod requester;
mod verdict;

pub use self::cycle::{Owned, cycle_parameters, profile_to_impl, to_impl};
pub use self::requester::{
    action_from_impl, configuration_from_impl, event_to_impl, group_to_impl, groups_to_impl,
    parameters_to_impl, source_from_impl, state_from_impl,
};
pub use self::verdict::{invalid_input_from_impl, report_from_impl};
pub use crate::conformance::{Answer, Disagreement, conforms, stage_conforms};

use mufasa::input::scratch::{Column, Row, Scratch, Sizes};
use mufasa_model::input::cycle::Cycle;
use mufasa_model::report::{InvalidInput, Report};

/// The implementation's answer to one cycle, with scratch of exactly the size it asks for
/// (`spec/4-arithmetic.md#conformance-of-an-implementation`). `Err` is invalid local input.
pub fn check_impl(cycle: &Cycle) -> Result<Report, InvalidInput> {
    let owned = to_impl(cycle);
    let borrowed = owned.borrow();
    let sizes = Sizes::for_cycle(&borrowed);
    let mut rows = vec![Row::default(); sizes.rows];
    let mut columns = vec![Column::default(); sizes.columns];
    let mut scratch = Scratch::new(&mut rows, &mut columns);
    match mufasa::stages::check(&borrowed, &mut scratch) {
        Ok(report) => Ok(report_from_impl(&report)),
        Err(problem) => Err(invalid_input_from_impl(&problem)),
    }
}
