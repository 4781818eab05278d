//! The composition (`spec/5-interfaces.md#composition`).

use mufasa_model::services::orchestrator::Task;
use mufasa_model::services::service as model;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::record;
use super::value::Integer;

#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "a word")]
pub enum CompositionKind {
    #[default]
    Composition,
}

record! {
    /// What the orchestrator is asked.
    Composition = Task {
        /// The services to choose from.
        services: Vec<Service>,
        /// Id of the service that is wanted.
        goal: String,
        /// Services that are to run on one station.
        #[serde(default)]
        same_station: Vec<Vec<String>>,
        /// Services that are to run on the CAV.
        #[serde(default)]
        local_only: Vec<String>,
    } + {
        /// The kind of the record.
        kind: CompositionKind,
        /// Names the record in its answer.
        id: String,
    }

    /// A service.
    Service = model::Service {
        /// Names it in compositions.
        id: String,
        /// Interfaces that it needs.
        requires: Vec<String>,
        /// Interfaces that it serves.
        guarantees: Vec<String>,
        /// Where it runs; 0 is the CAV.
        station: Integer,
    }
}
