//! Data of a safe cycle, which cannot be read any more once the monitor has taken another call.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use mufasa::input::cycle::{Track, TrackList, Trajectory, TrajectoryPoint};
use mufasa::monitor::{Time as NativeTime, Verified};
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyList;

use crate::errors::{Expired, OtherMonitor};
use crate::quantities::Time;

/// How many calls a monitor has taken.
#[derive(Clone, Default)]
pub struct Calls {
    count: Arc<AtomicU64>,
}

impl Calls {
    /// Another one: what was verified before has expired.
    pub fn begin(&self) {
        self.count.fetch_add(1, Ordering::Relaxed);
    }

    /// The one that goes on.
    pub fn current(&self) -> Call {
        Call { calls: self.clone(), number: self.count.load(Ordering::Relaxed) }
    }
}

/// A call of a monitor.
pub struct Call {
    calls: Calls,
    number: u64,
}

impl Call {
    /// Errors: `Expired`: there was a later one.
    pub fn is_last(&self) -> PyResult<()> {
        if self.calls.current().number == self.number {
            return Ok(());
        }
        Err(Expired::new_err(
            "the monitor has taken an event or another cycle since; take what its last cycle gives",
        ))
    }

    /// Errors: `OtherMonitor`: it is another monitor's; `Expired`.
    pub fn is_last_of(&self, calls: &Calls) -> PyResult<()> {
        if Arc::ptr_eq(&self.calls.count, &calls.count) {
            return self.is_last();
        }
        Err(OtherMonitor::new_err("verified by another monitor; take what this one's cycle gives"))
    }
}

macro_rules! verified {
    ($($(#[$doc:meta])* $name:ident of $list:ident {
        $items:ident: $item:ident($($field:ident),*)
        $({ $field_of_own:ident: $type_of_own:ty; $($method:tt)* })?
    })*) => {$(
        $(#[$doc])*
        #[pyclass(frozen, module = "mufasa")]
        pub struct $name {
            pub call: Call,
            stamp: Time,
            station: i64,
            items: Vec<$item>,
            $($field_of_own: $type_of_own,)?
        }

        impl $name {
            pub fn new(call: Call, data: &Verified<'_, $list<'_>>) -> Self {
                let stamp = Time { time: NativeTime::from_nanoseconds(data.stamp_ns) };
                let (station, items) = (data.source().station(), data.$items.to_vec());
                $(let $field_of_own = data.$field_of_own().map(|time| Time { time });)?
                Self { call, stamp, station, items, $($field_of_own)? }
            }
        }

        #[pymethods]
        impl $name {
            /// When it was made, or what it is valid for.
            #[getter]
            fn stamp(&self) -> PyResult<Time> {
                self.call.is_last().map(|()| self.stamp)
            }

            /// The station that it comes from; 0 is the CAV.
            #[getter]
            fn station(&self) -> PyResult<i64> {
                self.call.is_last().map(|()| self.station)
            }

            /// What it holds, as named tuples.
            #[getter]
            fn $items<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
                self.call.is_last()?;
                let class = py.import("mufasa._types")?.getattr(stringify!($item))?;
                let item = |it: &$item| class.call1(($(it.$field,)*));
                let items: PyResult<Vec<_>> = self.items.iter().map(item).collect();
                PyList::new(py, items?)
            }

            /// For numpy: a structured array, or with a ``dtype`` of numbers a plain N x k one.
            #[pyo3(signature = (dtype = None, copy = None))]
            fn __array__<'py>(
                &self,
                py: Python<'py>,
                dtype: Option<Bound<'py, PyAny>>,
                copy: Option<bool>,
            ) -> PyResult<Bound<'py, PyAny>> {
                if copy == Some(false) {
                    return Err(PyValueError::new_err("verified data are copied"));
                }
                let items = self.$items(py)?;
                let kind = |name| (name, if matches!(name, "id" | "t_ns") { "i8" } else { "f8" });
                let columns = || [$(stringify!($field)),*].map(kind).into_bound_py_any(py);
                let dtype = dtype.map_or_else(columns, Ok)?;
                py.import("numpy")?.call_method1("array", (items, dtype))
            }

            fn __repr__(&self) -> String {
                let (name, count) = (stringify!($name), self.items.len());
                match self.call.is_last() {
                    Ok(()) => format!("{name}({count} {}, station={})", stringify!($items), self.station),
                    Err(_) => format!("{name}(expired)"),
                }
            }

            $($($method)*)?
        }
    )*};
}

verified! {
    /// Tracks of a station that a safe cycle has compared with what the CAV sees. Everything raises
    /// ``Expired`` from the monitor's next call on.
    VerifiedTracks of TrackList { items: Track(id, x, y, cos, sin, vx, vy, length, width) }

    /// A trajectory that a safe cycle has checked: what control follows should take nothing else. Everything
    /// raises ``Expired`` from the monitor's next call on.
    VerifiedTrajectory of Trajectory {
        points: TrajectoryPoint(t_ns, x, y, cos, sin)
        {
            brake_by: Option<Time>;

            /// By when control has to brake along it, with at least ``a_b``, unless a later cycle has given one or,
            /// in Local, there is a plan of the CAV's own: what was examined covers no more. None in the paper profile.
            #[getter]
            fn brake_by(&self) -> PyResult<Option<Time>> {
                self.call.is_last().map(|()| self.brake_by)
            }
        }
    }
}
