//! The answer to a composition (`spec/5-interfaces.md#composition`).

use mufasa_model::report::InvalidInput;
use mufasa_model::services::composition::Composition;
use mufasa_model::services::orchestrator::{Answer, NoComposition, Rule, TaskError};
use mufasa_model::services::service::{ServiceError, ServiceRule};
use schemars::JsonSchema;
use serde::Serialize;

use crate::record::value::Word;

/// Every composition, or why there is none.
#[derive(Clone, Debug, PartialEq, Eq, JsonSchema, Serialize)]
pub struct CompositionAnswer {
    /// Id of the record.
    pub id: String,
    /// The compositions, sorted.
    pub compositions: Vec<CompositionEntry>,
    /// `None` exactly when there is a composition.
    pub none: Option<NoneEntry>,
}

/// One composition; every list is sorted bytewise.
#[derive(Clone, Debug, PartialEq, Eq, JsonSchema, Serialize)]
pub struct CompositionEntry {
    /// Ids of the services.
    pub members: Vec<String>,
    /// Provider, interface, consumer.
    pub links: Vec<[String; 3]>,
    /// Provider, consumer.
    pub switches: Vec<[String; 2]>,
    /// Whether there is a switch.
    pub distributed: bool,
}

/// Why there is no composition.
#[derive(Clone, Debug, PartialEq, Eq, JsonSchema, Serialize)]
#[serde(untagged)]
pub enum NoneEntry {
    /// Nobody guarantees the requirement.
    Requirement {
        /// The interface.
        requirement: String,
        /// The service that requires it.
        service: String,
    },
    /// A rule stands in the way.
    Rule {
        /// `same_station`, `local_only` or `acyclic`.
        rule: Word<Rule>,
    },
}

impl CompositionAnswer {
    /// The answer of the orchestrator to the record `id`.
    pub fn new(id: String, answer: Answer) -> Self {
        Self {
            id,
            compositions: answer.compositions.into_iter().map(entry).collect(),
            none: answer.none.map(none),
        }
    }
}

/// Where in the record a task breaks a rule. Of an interface listed twice the index is that of
/// the service.
pub fn problem(error: &TaskError) -> InvalidInput {
    let (field, index) = match error {
        TaskError::UnknownGoal(_) => ("goal", None),
        TaskError::TooManyChoices => ("services", None),
        TaskError::Services(ServiceError { index, rule, .. }) => (field(rule), *index),
    };
    InvalidInput { field: field.to_owned(), index, message: error.to_string() }
}

fn field(rule: &ServiceRule) -> &'static str {
    match rule {
        ServiceRule::EmptySet | ServiceRule::LocalServiceLeft | ServiceRule::LocalServiceCame => {
            "services"
        }
        ServiceRule::IdTwice => "services.id",
        ServiceRule::RequirementTwice(_) => "services.requires",
        ServiceRule::GuaranteeTwice(_) => "services.guarantees",
        ServiceRule::NegativeStation(_) => "services.station",
    }
}

fn entry(composition: Composition) -> CompositionEntry {
    CompositionEntry {
        members: composition.members,
        links: composition
            .links
            .into_iter()
            .map(|link| [link.provider, link.interface, link.consumer])
            .collect(),
        switches: composition.switches.into_iter().map(<[String; 2]>::from).collect(),
        distributed: composition.distributed,
    }
}

fn none(reason: NoComposition) -> NoneEntry {
    match reason {
        NoComposition::Requirement { requirement, service } => {
            NoneEntry::Requirement { requirement, service }
        }
        NoComposition::Rule(broken) => NoneEntry::Rule { rule: Word(broken) },
    }
}
