//! Overrides of single parameters of a monitor by the names of `spec/` (`spec/5-interfaces.md#monitor`).

use mufasa::monitor::Settings;
use mufasa_props::bridge;
use mufasa_records::record;
use pyo3::prelude::*;
use serde_json::Map;

use crate::arguments::in_domain;
use crate::errors::{invalid, named, wrong};

/// The settings with these overrides; what they leave out is the default, of `tau` and `dt_max_ns` that of the settings.
///
/// Errors: `InvalidInput`: no parameter, or one outside of its domain.
pub fn overridden(mut settings: Settings, parameters: &Bound<'_, PyAny>) -> PyResult<Settings> {
    let json = parameters.py().import("json")?.getattr("dumps")?.call1((parameters,));
    let json = json.map_err(|error| in_domain(parameters, "parameters", error))?;
    let mut object: Map<_, _> = serde_json::from_str(&json.extract::<String>()?)
        .map_err(|error| invalid(wrong("parameters", error.to_string())))?;
    object.entry("tau").or_insert_with(|| settings.stages.tau.into());
    object.entry("dt_max_ns").or_insert_with(|| settings.requester.dt_max_ns.into());
    let (stages, requester) =
        record::parameters::settings(object).map_err(|it| invalid(named(it)))?;
    settings.stages = bridge::cycle_parameters(&stages);
    settings.requester = bridge::parameters_to_impl(&requester);
    Ok(settings)
}
