//! The composition record (`spec/5-interfaces.md#composition`).

use mufasa_model::report::InvalidInput;
use mufasa_model::services::orchestrator::{Task, TaskError};
use mufasa_model::services::service::{Service, ServiceError, ServiceRule};

use crate::walk::Value;

/// Reads a composition; `record` is an object with `kind` composition.
pub fn composition(record: Value<'_, '_>) -> Result<Task, InvalidInput> {
    let [_, _, services, goal, same_station, local_only] =
        record.object(["kind", "id", "services", "goal", "same_station", "local_only"])?;
    Ok(Task {
        services: services.list(service)?,
        goal: goal.string()?,
        same_station: same_station.present().map_or(Ok(Vec::new()), |lists| lists.list(strings))?,
        local_only: local_only.present().map_or(Ok(Vec::new()), strings)?,
    })
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

fn service(value: Value<'_, '_>) -> Result<Service, InvalidInput> {
    let [id, requires, guarantees, station] =
        value.object(["id", "requires", "guarantees", "station"])?;
    Ok(Service {
        id: id.string()?,
        requires: strings(requires)?,
        guarantees: strings(guarantees)?,
        station: station.integer()?,
    })
}

fn strings(value: Value<'_, '_>) -> Result<Vec<String>, InvalidInput> {
    value.list(|element| element.string())
}
