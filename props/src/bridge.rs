//! The only conversion between the types of the model and those of the implementation.
//!
//! Structs are taken apart without `..` and enums matched without a catch-all: a field or variant
//! that only one of the two crates has breaks the build.

/// Functions from one enum to another with the same variants. What a variant holds goes over as it
/// is, or by the function behind the colon.
macro_rules! same_variants {
    ($(
        $(#[$doc:meta])*
        $visibility:vis fn $name:ident($from:ty) -> $to:ty {
            $(
                $variant:ident
                $(($inner:ident: $convert:path))?
                $({ $($field:ident $(: $change:path)?),* })?,
            )*
        }
    )*) => {$(
        $(#[$doc])*
        $visibility fn $name(value: $from) -> $to {
            type From = $from;
            type To = $to;
            match value {
                $(From::$variant $(($inner))? $({ $($field),* })? => {
                    To::$variant $(($convert($inner)))? $({ $($field $(: $change($field))?),* })?
                })*
            }
        }
    )*};
}

/// Functions from one enum to another with the same variants, and back.
macro_rules! both_ways {
    ($(
        $(#[$doc:meta])* $visibility:vis fn $name:ident($from:ty),
        $(#[$back_doc:meta])* $back_visibility:vis fn $back:ident($to:ty) {
            $($variant:ident $(($inner:ident: $convert:path, $convert_back:path))?,)*
        }
    )*) => { same_variants! {$(
        $(#[$doc])*
        $visibility fn $name($from) -> $to { $($variant $(($inner: $convert))?,)* }

        $(#[$back_doc])*
        $back_visibility fn $back($to) -> $from { $($variant $(($inner: $convert_back))?,)* }
    )*} };
}

/// Functions from one struct to another with the same fields.
macro_rules! same_fields {
    ($($(#[$doc:meta])* $visibility:vis fn $name:ident($from:ty) -> $to:ty { $($field:ident),* })*) => {$(
        $(#[$doc])*
        $visibility fn $name(value: &$from) -> $to {
            type From = $from;
            type To = $to;
            let From { $($field),* } = *value;
            To { $($field),* }
        }
    )*};
}

mod cycle;
mod monitor;
mod profile;
mod requester;
mod verdict;

pub use self::cycle::{
    Owned, cycle_parameters, from_impl, point_from_impl, route_to_impl, to_impl, track_from_impl,
};
pub use self::monitor::{Bridged, brake_from_impl, lent, settings_to_impl};
pub use self::profile::{profile_from_impl, profile_to_impl, rule_to_impl};
pub use self::requester::{
    action_from_impl, configuration_from_impl, event_to_impl, group_from_impl, group_to_impl,
    groups_to_impl, parameters_from_impl, parameters_to_impl, source_from_impl, state_from_impl,
};
pub use self::verdict::{
    invalid_input_from_impl, outcome_from_impl, report_from_impl, report_to_impl, stage_to_impl,
};
pub use crate::conformance::{Answer, Disagreement, conforms, stage_conforms};

use mufasa::cycle::ValidCycle;
use mufasa::input::cycle::Cycle as ImplCycle;
use mufasa::input::scratch::{Column, Row, Scratch, Sizes};
use mufasa_model::hardened::h02_h05_h10_schedule::schedule;
use mufasa_model::input::cycle::Cycle;
use mufasa_model::report::{InvalidInput, Outcome, Report, Stage};
use mufasa_model::stages::Scheduled;

/// The implementation's answer to one cycle, with scratch of exactly the size it asks for
/// (`spec/4-arithmetic.md#conformance-of-an-implementation`). `Err` is invalid local input.
pub fn check_impl(cycle: &Cycle) -> Result<Report, InvalidInput> {
    with_impl(cycle, |cycle, scratch| match mufasa::cycle::check(cycle, scratch) {
        Ok(report) => Ok(report_from_impl(&report)),
        Err(problem) => Err(invalid_input_from_impl(&problem)),
    })
}

/// The stages of the configuration of which each, run on its own, finds a safety issue, to the
/// implementation; none in a cycle with invalid input.
pub fn failing_alone(cycle: &Cycle) -> Vec<Stage> {
    let schedule = schedule(cycle.profile, cycle.configuration);
    let scheduled = schedule.into_iter().filter(|entry| entry.scheduled != Scheduled::Never);
    with_impl(cycle, |cycle, scratch| {
        let Ok(valid) = ValidCycle::new(cycle, None, scratch) else { return Vec::new() };
        let mut fails = |stage: &Stage| {
            let outcome = valid.stage(stage_to_impl(*stage), scratch);
            matches!(outcome_from_impl(outcome), Outcome::Failed(_))
        };
        scheduled.map(|entry| entry.stage).filter(|stage| fails(stage)).collect()
    })
}

/// Runs a job on the cycle in the types of the implementation, with scratch of the size it asks for.
pub fn with_impl<T>(cycle: &Cycle, job: impl FnOnce(&ImplCycle<'_>, &mut Scratch<'_>) -> T) -> T {
    let owned = to_impl(cycle);
    let history = owned.history();
    let borrowed = owned.borrow(&history);
    let sizes = Sizes::for_cycle(&borrowed);
    let mut rows = vec![Row::default(); sizes.rows];
    let mut columns = vec![Column::default(); sizes.columns];
    job(&borrowed, &mut Scratch::new(&mut rows, &mut columns))
}
