//! The native part of the Python package `mufasa`: the implementation, its monitor, readers of drives.
//! What Python says as well or better (types, errors, JSON) is in `package/mufasa/`.
#![cfg(feature = "extension")]
// Arguments with names are Python's way to tell many of them apart; what is owned is what pyo3 gives.
#![allow(
    clippy::too_many_arguments,
    clippy::needless_pass_by_value,
    clippy::trivially_copy_pass_by_ref
)]

mod actions;
mod answers;
mod arguments;
mod decision;
mod drives;
mod errors;
mod inputs;
mod items;
mod monitor;
mod place;
mod quantities;
mod settings;
mod verified;

/// The module `mufasa._native`.
#[pyo3::pymodule]
mod _native {
    use pyo3::prelude::*;
    use pyo3::types::PyTuple;

    #[pymodule_export]
    use crate::actions::Actions;
    #[pymodule_export]
    use crate::answers::{check, svg};
    #[pymodule_export]
    use crate::decision::Decision;
    #[pymodule_export]
    use crate::drives::{Stream, streams};
    #[pymodule_export]
    use crate::monitor::Monitor;
    #[pymodule_export]
    use crate::quantities::{Gap, Time};
    #[pymodule_export]
    use crate::verified::{VerifiedTracks, VerifiedTrajectory};

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        let attacks = mufasa_drives::Attack::ON_DRIVES.map(mufasa_drives::Attack::name);
        module.add("ATTACKS", PyTuple::new(module.py(), attacks)?)?;
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
