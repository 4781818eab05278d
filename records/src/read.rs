//! Reading a record from its text.

use mufasa_model::input::cycle::Cycle;
use mufasa_model::report::InvalidInput;
use mufasa_model::services::orchestrator::Task;
use serde::Deserialize;

use crate::names::Kind;
use crate::record::monitor::Sequence;
use crate::record::offloading::{Offloading, Trace};
use crate::record::value::Word;
use crate::record::{Recorded, composition, cycle, from_object, monitor};
use crate::typed::from_json;

/// A record of one of the kinds of `spec/5-interfaces.md`.
#[derive(Clone, Debug, PartialEq)]
pub enum Record {
    /// `kind` cycle.
    Cycle {
        /// Its id.
        id: String,
        /// The cycle.
        cycle: Box<Cycle>,
    },
    /// `kind` offloading.
    Offloading {
        /// Its id.
        id: String,
        /// The trace.
        trace: Trace,
    },
    /// `kind` composition.
    Composition {
        /// Its id.
        id: String,
        /// What to compose.
        task: Task,
    },
    /// `kind` monitor.
    Monitor {
        /// Its id.
        id: String,
        /// Settings, events and cycles.
        sequence: Box<Sequence>,
    },
}

/// What every record begins with.
#[derive(Deserialize)]
#[serde(remote = "Self", expecting = "an object")]
struct Head {
    kind: Word<Kind>,
    id: String,
}

/// What a record is answered by.
#[derive(Deserialize)]
#[serde(remote = "Self")]
struct Name {
    id: String,
}

from_object!(Head, Name);

/// Reads a record. The text is JSON wherever the error is.
pub fn record(json: &str) -> Result<Record, InvalidInput> {
    let Head { kind: Word(kind), id } = from_json(json)?;
    Ok(match kind {
        Kind::Cycle => {
            Record::Cycle { id, cycle: Box::new(from_json::<cycle::Cycle>(json)?.try_into()?) }
        }
        Kind::Offloading => {
            Record::Offloading { id, trace: from_json::<Offloading>(json)?.try_into()? }
        }
        Kind::Composition => {
            let record: composition::Composition = from_json(json)?;
            Record::Composition { id, task: record.into_model() }
        }
        Kind::Monitor => {
            let sequence = Box::new(from_json::<monitor::Monitor>(json)?.into_model());
            Record::Monitor { id, sequence }
        }
    })
}

/// The id of a record, whatever else is wrong with it.
pub fn id(json: &str) -> Option<String> {
    serde_json::from_str(json).ok().map(|Name { id }| id)
}
