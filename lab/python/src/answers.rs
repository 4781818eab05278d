//! One record checked by the implementation (`spec/5-interfaces.md#cycle`).

use mufasa_drives::check::words;
use mufasa_drives::pictures::{Content, picture};
use mufasa_model::input::cycle::Cycle;
use mufasa_model::report::{InvalidInput, Report};
use mufasa_props::bridge;
use mufasa_records::answer::CycleAnswer;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use serde::Serialize;

use crate::arguments::{Line, OneProfile};
use crate::errors::invalid;

/// Checks the record of a cycle, given as a line.
///
/// Errors: `InvalidInput`: no record of a cycle, or invalid local input.
#[pyfunction]
pub fn check(
    py: Python<'_>,
    record: Line,
    profile: Option<OneProfile>,
) -> PyResult<Bound<'_, PyAny>> {
    let (id, _, report) = checked(py, &record, profile)?;
    verdict(py, id, report)
}

/// The picture of a cycle, given as a line, as SVG. Errors: those of `check`.
#[pyfunction]
pub fn svg(py: Python<'_>, record: Line, profile: Option<OneProfile>) -> PyResult<String> {
    let (title, cycle, report) = checked(py, &record, profile)?;
    let subtitle = words::answer(&Ok(report.clone()));
    Ok(picture(&Content { title, subtitle, cycle: &cycle, report: &report }))
}

fn checked(
    py: Python<'_>,
    record: &Line,
    profile: Option<OneProfile>,
) -> PyResult<(String, Cycle, Report)> {
    let (id, mut cycle) = mufasa_records::cycle_from_line(&record.0, 1).map_err(|error| {
        let (field, index, message) = (error.field, error.index, error.message);
        invalid(InvalidInput { field, index, message })
    })?;
    if let Some(profile) = profile {
        cycle.profile = profile.0;
    }
    let report = py.detach(|| bridge::check_impl(&cycle)).map_err(invalid)?;
    Ok((id, cycle, report))
}

/// The report as a `Verdict` of Python.
pub fn verdict(py: Python<'_>, id: String, report: Report) -> PyResult<Bound<'_, PyAny>> {
    // The implementation has one reading; Python leaves out what the answer says of the others.
    let (strict, lax) = (report.clone(), report.clone());
    of_json(py, "of_answer", &CycleAnswer::new(id, report, &strict, &lax))
}

/// What a function of `mufasa._verdict` makes of an answer as JSON.
pub fn of_json<'py>(
    py: Python<'py>,
    function: &str,
    answer: &impl Serialize,
) -> PyResult<Bound<'py, PyAny>> {
    let answer = serde_json::to_string(answer);
    let answer = answer.map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
    py.import("mufasa._verdict")?.getattr(function)?.call1((answer,))
}
