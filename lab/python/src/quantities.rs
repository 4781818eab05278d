//! Times and gaps: bare numbers are neither (`spec/monitor.md#monitor`).

use mufasa::monitor::{Gap as NativeGap, Time as NativeTime, TimeError};
use pyo3::prelude::*;

use crate::arguments::{Metres, Microseconds, Milliseconds, Nanoseconds, Seconds};
use crate::errors::{invalid, wrong};
use crate::items;

/// A point in time on the CAV's one monotonic clock.
#[pyclass(frozen, eq, ord, hash, from_py_object, module = "mufasa")]
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Time {
    pub time: NativeTime,
}

fn of(time: Result<NativeTime, TimeError>) -> PyResult<Time> {
    let time = time.map_err(|error| invalid(wrong(error.unit, error.to_string())))?;
    Ok(Time { time })
}

#[pymethods]
impl Time {
    /// So many nanoseconds after the clock's start.
    #[staticmethod]
    fn from_nanoseconds(ns: Nanoseconds) -> Self {
        Self { time: NativeTime::from_nanoseconds(ns.0) }
    }

    /// So many microseconds after the clock's start.
    #[staticmethod]
    fn from_microseconds(us: Microseconds) -> PyResult<Self> {
        of(NativeTime::from_microseconds(us.0))
    }

    /// So many milliseconds after the clock's start.
    #[staticmethod]
    fn from_milliseconds(ms: Milliseconds) -> PyResult<Self> {
        of(NativeTime::from_milliseconds(ms.0))
    }

    /// So many seconds after the clock's start, to about the nearest nanosecond.
    #[staticmethod]
    fn from_seconds(seconds: Seconds) -> PyResult<Self> {
        of(NativeTime::from_seconds(seconds.0))
    }

    /// Nanoseconds after the clock's start.
    #[getter]
    fn nanoseconds(&self) -> i64 {
        self.time.as_nanoseconds()
    }

    fn __repr__(&self) -> String {
        format!("Time.from_nanoseconds({})", self.time.as_nanoseconds())
    }
}

/// The gap to the leading vehicle, bumper to bumper along the reference path.
#[pyclass(frozen, eq, from_py_object, module = "mufasa")]
#[derive(Clone, Copy, PartialEq)]
pub struct Gap {
    pub gap: NativeGap,
}

#[pymethods]
impl Gap {
    /// Measured from the CAV's front bumper to the rear bumper of the leading vehicle, m.
    #[staticmethod]
    fn between_bumpers(metres: Metres) -> Self {
        Self { gap: NativeGap::between_bumpers(metres.0) }
    }

    /// Measured from the CAV's reference point to the rear bumper of the leading vehicle, m.
    #[staticmethod]
    fn from_reference_point(metres: Metres, ego: &Bound<'_, PyAny>) -> PyResult<Self> {
        let ego = items::item(ego, "ego").map_err(invalid)?;
        Ok(Self { gap: NativeGap::from_reference_point(metres.0, &ego) })
    }

    /// m.
    #[getter]
    fn metres(&self) -> f64 {
        self.gap.metres()
    }

    fn __repr__(&self) -> String {
        format!("Gap.between_bumpers({:?})", self.gap.metres())
    }
}
