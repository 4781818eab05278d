//! Times and gaps: bare numbers are neither (`spec/monitor.md#monitor`).

use mufasa::monitor::{Gap as NativeGap, Time as NativeTime, TimeError};
use pyo3::prelude::*;

use crate::arguments::{Metres, Microseconds, Milliseconds, Nanoseconds, Seconds};
use crate::errors::{invalid, wrong};
use crate::items;

/// A point in time on the CAV's one monotonic clock: the same clock for all that reaches one monitor, stamps
/// of stations included. A bare number is not a time.
///
/// What does not fit into 64 bits of nanoseconds raises ``InvalidInput``.
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

    /// To about the nearest nanosecond.
    #[staticmethod]
    fn from_seconds(seconds: Seconds) -> PyResult<Self> {
        of(NativeTime::from_seconds(seconds.0))
    }

    /// Nanoseconds after the clock's start.
    #[getter]
    fn nanoseconds(&self) -> i64 {
        self.time.as_nanoseconds()
    }

    /// To the nearest microseconds, which is what ``timedelta`` has; exact are ``nanoseconds``.
    fn __sub__<'py>(&self, py: Python<'py>, value: Self) -> PyResult<Bound<'py, PyAny>> {
        let ns = |time: &Self| i128::from(time.time.as_nanoseconds());
        let zero = py.import("datetime")?.getattr("timedelta")?.call0()?;
        let microsecond = zero.getattr("resolution")?;
        microsecond.mul(ns(self) - ns(&value))?.div(1_000)
    }

    fn __repr__(&self) -> String {
        format!("Time.from_nanoseconds({})", self.time.as_nanoseconds())
    }
}

/// The free distance along the reference path to the leading vehicle, bumper to bumper. A bare number is no
/// gap: measured from elsewhere it is wrong by metres.
#[pyclass(frozen, eq, from_py_object, module = "mufasa")]
#[derive(Clone, Copy, PartialEq)]
pub struct Gap {
    pub gap: NativeGap,
}

#[pymethods]
impl Gap {
    /// From the CAV's front bumper to the rear bumper of the leading vehicle.
    #[staticmethod]
    fn between_bumpers(metres: Metres) -> Self {
        Self { gap: NativeGap::between_bumpers(metres.0) }
    }

    /// From the CAV's reference point (``ego.x``, ``ego.y``) to that rear bumper.
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
