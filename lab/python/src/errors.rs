//! The errors of `package/mufasa/_errors.py`.

use mufasa::monitor::{MonitorError, Unusual};
use mufasa_model::report::InvalidInput as Problem;
use mufasa_records::names::Words;
use pyo3::prelude::*;

/// Classes of Python.
mod classes {
    use pyo3::import_exception;

    import_exception!(mufasa._errors, ActionsNotTaken);
    import_exception!(mufasa._errors, Expired);
    import_exception!(mufasa._errors, InvalidInput);
    import_exception!(mufasa._errors, OtherMonitor);
    import_exception!(mufasa._errors, ReadError);
    import_exception!(mufasa._errors, UnreadableInputs);
    import_exception!(mufasa._errors, UnsafeCycle);
}

pub use classes::{
    ActionsNotTaken, Expired, OtherMonitor, ReadError, UnreadableInputs, UnsafeCycle,
};

/// A problem as `InvalidInput`.
pub fn invalid(problem: Problem) -> PyErr {
    let Problem { field, index, message } = problem;
    classes::InvalidInput::new_err((field, index, message))
}

/// The problem of a parameter that there is not, with the one whose name has the unit, if it is that.
pub fn named(problem: Problem) -> Problem {
    let name = problem.field.rsplit('.').next().unwrap_or_default();
    let with_unit = format!("{name}_ns");
    if !mufasa_records::record::parameters::names().contains(&with_unit) {
        return problem;
    }
    let message =
        format!("there is no such parameter; {with_unit}, an integer in nanoseconds, is one");
    Problem { message, ..problem }
}

/// A problem of a field that is in no list.
pub fn wrong(field: &str, message: impl Into<String>) -> Problem {
    Problem { field: field.to_owned(), index: None, message: message.into() }
}

/// The value of a word. Errors: a word that is none of those there are.
pub fn word<T: Words>(field: &str, found: &str) -> Result<T, Problem> {
    let value = T::ALL.iter().copied().find(|value| value.word() == found);
    value.ok_or_else(|| {
        let words: Vec<&str> = T::ALL.iter().map(|value| value.word()).collect();
        wrong(
            field,
            format!("must be {}, not {}", words.join(" or "), mufasa_records::shown(found)),
        )
    })
}

/// Why a monitor is refused, by the argument.
pub fn no_monitor(error: MonitorError) -> PyErr {
    let field = match error {
        MonitorError::Stages(_) | MonitorError::Requester(_) => "parameters",
        MonitorError::NoPeriod => "period",
        MonitorError::TimeTooShort { field, .. } | MonitorError::Unusual(Unusual { field, .. }) => {
            field.rsplit('.').next().unwrap_or(field)
        }
        MonitorError::MaxAgeBelowLMax { .. } => "max_age_ns",
        MonitorError::DtMaxNotAbovePeriod { .. } => "dt_max_ns",
        MonitorError::TauNotAbovePeriod { .. } => "tau",
        MonitorError::SessionsBefore { .. } => "sessions_before",
        MonitorError::Memory { .. } => "most_stations",
        MonitorError::Stall { .. } => "stall",
        MonitorError::TooSlow { .. } => "check_time",
    };
    let message = error.to_string();
    let message = message.trim_start_matches("settings.").trim_start_matches("requester.");
    invalid(wrong(field, message))
}
