//! Readers of drives.

use std::path::PathBuf;

use mufasa_drives::{Injection, Options, ReadError as Refused, Sensor, Tail};
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;

use crate::arguments::{AttackName, EgoId, Horizon, OneConfiguration, OneProfile, Seed};
use crate::errors::{ReadError, invalid, wrong};

/// The cycles of a drive, each made when it is asked for.
#[pyclass(frozen, module = "mufasa._native")]
pub struct Stream {
    stream: mufasa_drives::Stream,
}

#[pymethods]
impl Stream {
    /// Short name, unique among the drives of one call.
    #[getter]
    fn name(&self) -> &str {
        &self.stream.name
    }

    /// Files that it was read from.
    #[getter]
    fn source(&self) -> &str {
        &self.stream.source
    }

    /// Decisions of the reader.
    #[getter]
    fn notes(&self) -> Vec<String> {
        self.stream.notes.clone()
    }

    /// How many cycles it has.
    #[getter]
    fn count(&self) -> usize {
        self.stream.count()
    }

    /// The record of a cycle as JSON. Errors: `IndexError` behind the last; `ReadError`: it cannot be
    /// read again.
    fn line(&self, py: Python<'_>, index: usize) -> PyResult<String> {
        if index >= self.stream.count() {
            return Err(PyIndexError::new_err("the drive has no such cycle"));
        }
        let line = py.detach(|| {
            let cycle = self.stream.cycle(index)?;
            Ok(mufasa_records::cycle_to_line(&cycle.id, &cycle.cycle))
        });
        line.map_err(refused)
    }

    /// The same drive under attack. Errors: `InvalidInput`: no attack, or one that changes nothing.
    fn attacked(&self, py: Python<'_>, attack: AttackName) -> PyResult<Self> {
        let wrong = |error: String| invalid(wrong("attack", error));
        let injection: Injection = attack.0.parse().map_err(|it| wrong(format!("{it}")))?;
        let attacked = py.detach(|| mufasa_drives::inject(&self.stream, &injection));
        Ok(Self { stream: attacked.map_err(|error| wrong(error.to_string()))? })
    }
}

/// The drives of files. Errors: `ReadError` for the first file that gives none.
#[pyfunction]
pub fn streams(
    py: Python<'_>,
    paths: Vec<PathBuf>,
    profile: OneProfile,
    configuration: OneConfiguration,
    ego: Option<EgoId>,
    horizon_s: Horizon,
    keep_tail: bool,
    seed: Seed,
) -> PyResult<Vec<Stream>> {
    let options = Options {
        profile: profile.0,
        configuration: configuration.0,
        ego: ego.map(|it| it.0),
        horizon_s: horizon_s.0,
        tail: if keep_tail { Tail::Keep } else { Tail::Stop },
        sensor: Sensor { seed: seed.0, ..Sensor::default() },
        ..Options::default()
    };
    let drives = py.detach(|| mufasa_drives::streams(&paths, &options));
    drives.into_iter().map(|drive| drive.map(|stream| Stream { stream }).map_err(refused)).collect()
}

fn refused(error: Refused) -> PyErr {
    let text = error.to_string();
    let Refused { file, line, element, field, index, message, others: _ } = error;
    let file = file.display().to_string();
    ReadError::new_err((text, file, line, element, field, index, message))
}
