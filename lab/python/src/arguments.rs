//! Arguments that Python has in more values than Rust: what is out of range is `InvalidInput`, as any value
//! outside its domain, and no `OverflowError` or `ValueError`. Sessions and stations come from messages.

use std::time::Duration;

use pyo3::Borrowed;
use pyo3::exceptions::{PyOverflowError, PyValueError};
use pyo3::prelude::*;

use mufasa_model::input::cycle::Profile;
use mufasa_model::offloading::requester::Group;
use mufasa_model::services::configuration::Configuration;
use mufasa_records::names::Words;

use crate::errors::{invalid, word, wrong};

macro_rules! arguments {
    (by $by:path; $($(#[$doc:meta])* $name:ident($type:ty) of $field:literal;)*) => {$(
        $(#[$doc])*
        pub struct $name(pub $type);

        impl<'py> FromPyObject<'_, 'py> for $name {
            type Error = PyErr;

            fn extract(given: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
                $by(&given, $field).map(Self)
            }
        }
    )*};
}

arguments! { by value;
    /// The id of a station.
    Station(i64) of "station";
    /// The number of a session.
    Session(i64) of "session";
    /// The last session of earlier lives.
    SessionsBefore(i64) of "sessions_before";
    /// How many stations ever offer something.
    MostStations(usize) of "most_stations";
    /// The nominal period.
    Period(Duration) of "period";
    /// How long a cycle may take.
    CheckTime(Duration) of "check_time";
    /// Way, m, and time after which planning is given back.
    GivenBack((f64, Duration)) of "stall";
    /// What a step costs, ps.
    StepPs(u64) of "step_ps";
    /// A time, ns.
    Nanoseconds(i64) of "nanoseconds";
    /// A time, us.
    Microseconds(i64) of "microseconds";
    /// A time, ms.
    Milliseconds(i64) of "milliseconds";
    /// A time, s.
    Seconds(f64) of "seconds";
    /// A gap, m.
    Metres(f64) of "gap";
    /// The id of a recorded vehicle.
    EgoId(i64) of "ego";
    /// Length of planned trajectories, s.
    Horizon(f64) of "horizon_s";
    /// Of the simulated sensors.
    Seed(u64) of "seed";
    /// An attack, as `mufasa check --inject` names it.
    AttackName(String) of "attack";
    /// A record as a line.
    Line(String) of "";
}

arguments! { by named;
    /// A group by its name.
    OneGroup(Group) of "group";
    /// One of several groups by its name.
    OneOfGroups(Group) of "groups";
    /// A profile by its name.
    OneProfile(Profile) of "profile";
    /// A configuration by its name.
    OneConfiguration(Configuration) of "configuration";
}

/// A value as its type has it.
fn value<'py, T>(given: &Bound<'py, PyAny>, field: &str) -> PyResult<T>
where
    T: for<'a> FromPyObject<'a, 'py, Error = PyErr>,
{
    given.extract().map_err(|error| in_domain(given, field, error))
}

/// One of several values by its word.
fn named<T: Words>(given: &Bound<'_, PyAny>, field: &str) -> PyResult<T> {
    word(field, &value::<String>(given, field)?).map_err(invalid)
}

/// The error of a value that is of the right kind, and outside what its type can be, as `InvalidInput`.
pub fn in_domain(given: &Bound<'_, PyAny>, field: &str, error: PyErr) -> PyErr {
    let py = given.py();
    if !(error.is_instance_of::<PyOverflowError>(py) || error.is_instance_of::<PyValueError>(py)) {
        return error;
    }
    let said = error.value(py).to_string();
    let shown = given.repr().map_or_else(|_| given.get_type().to_string(), |text| text.to_string());
    let shown = mufasa_records::shown(&shown);
    invalid(wrong(field, format!("{shown} is outside its domain: {said}")))
}
