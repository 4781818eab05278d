//! JSON Schemas of records, answers and vectors (`spec/5-interfaces.md#vectors`).
//!
//! Records are described by the types that read and write them, answers by those that write them.

use schemars::generate::{Contract, SchemaSettings};
use schemars::transform::{RecursiveTransform, Transform};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde_json::{Map, Value, json};

use crate::answer::{CycleAnswer, ErrorAnswer};
use crate::composition_answer::CompositionAnswer;
use crate::monitor_answer::MonitorAnswer;
use crate::offloading_answer::OffloadingAnswer;
use crate::record::composition::Composition;
use crate::record::cycle::Cycle;
use crate::record::monitor::Monitor;
use crate::record::offloading::Offloading;

/// The schema of a vector; its definitions are those of all kinds.
pub const VECTOR: &str = "vector";

/// The schemas by the stem of their file's name.
pub fn all() -> Vec<(&'static str, Value)> {
    vec![
        ("cycle", of::<Cycle>(Contract::Deserialize)),
        ("offloading", of::<Offloading>(Contract::Deserialize)),
        ("composition", of::<Composition>(Contract::Deserialize)),
        ("monitor", of::<Monitor>(Contract::Deserialize)),
        ("cycle-answer", of::<CycleAnswer>(Contract::Serialize)),
        ("offloading-answer", of::<OffloadingAnswer>(Contract::Serialize)),
        ("composition-answer", of::<CompositionAnswer>(Contract::Serialize)),
        ("monitor-answer", of::<MonitorAnswer>(Contract::Serialize)),
        ("error-answer", of::<ErrorAnswer>(Contract::Serialize)),
        (VECTOR, vector()),
    ]
}

/// The text of a schema as its file holds it: keys sorted, so that it is the same everywhere.
pub fn text(schema: &Value) -> String {
    format!("{:#}\n", sorted(schema))
}

/// The schema of what a type writes.
pub fn written<T: JsonSchema>() -> Value {
    of::<T>(Contract::Serialize)
}

fn of<T: JsonSchema>(contract: Contract) -> Value {
    let mut schema = generator(contract).into_root_schema_for::<T>();
    closed().transform(&mut schema);
    schema.to_value()
}

fn generator(contract: Contract) -> SchemaGenerator {
    let mut settings = SchemaSettings::draft2020_12();
    settings.contract = contract;
    settings.into_generator()
}

/// Unknown fields are an error.
fn closed() -> impl Transform {
    RecursiveTransform(|schema: &mut Schema| {
        spread(schema);
        if schema.get("properties").is_some() {
            schema.insert(String::from("additionalProperties"), false.into());
        }
    })
}

/// Puts the fields that all kinds of an object have into each kind, so that each can be closed.
fn spread(schema: &mut Schema) {
    let Some(object) = schema.as_object_mut().filter(|it| it.contains_key("oneOf")) else { return };
    let Some(Value::Object(fields)) = object.remove("properties") else { return };
    let required = object.remove("required").and_then(|it| it.as_array().cloned());
    let kinds = object.get_mut("oneOf").and_then(Value::as_array_mut);
    for kind in kinds.into_iter().flatten() {
        if let Some(own) = kind["properties"].as_object_mut() {
            own.extend(fields.clone());
        }
        if let Some(own) = kind["required"].as_array_mut() {
            own.extend(required.iter().flatten().cloned());
        }
    }
}

fn vector() -> Value {
    let mut records = generator(Contract::Deserialize);
    let cycle = records.subschema_for::<Cycle>();
    let offloading = records.subschema_for::<Offloading>();
    let composition = records.subschema_for::<Composition>();
    let monitor = records.subschema_for::<Monitor>();
    let mut answers = generator(Contract::Serialize);
    let cycle_answer = answers.subschema_for::<CycleAnswer>();
    let offloading_answer = answers.subschema_for::<OffloadingAnswer>();
    let composition_answer = answers.subschema_for::<CompositionAnswer>();
    let monitor_answer = answers.subschema_for::<MonitorAnswer>();
    let error = answers.subschema_for::<ErrorAnswer>();
    let mut definitions = Map::new();
    for generator in [&mut records, &mut answers] {
        for (name, definition) in generator.take_definitions(false) {
            let Ok(mut definition) = Schema::try_from(definition) else { continue };
            closed().transform(&mut definition);
            definitions.insert(name, definition.to_value());
        }
    }
    let pair = |input: &Schema, answer: &Schema| json!({"properties": {"input": input, "expect": {"anyOf": [answer, error]}}});
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Vector",
        "description": "A line with the answer that it must get.",
        "type": "object",
        "required": ["id", "requirement", "flag", "note", "input", "expect"],
        "additionalProperties": false,
        "properties": {
            "id": {
                "description": "Never changes; the id of the record, too.",
                "type": "string", "minLength": 1,
            },
            "requirement": {
                "description": "The id of a requirement of spec/, or a heading there, or a rule, or \
                                a finding.",
                "type": "string",
                "pattern": "^(spec/[1-7]-[a-z-]+\\.md#[a-z0-9-]+(\\.[0-9]+)?|[A-Z][A-Z0-9]*-[0-9]{2}(\\.[0-9]+)?)$",
            },
            "flag": {
                "description": "Whom the vector binds.",
                "type": "string",
                "pattern": "^(must|paper-only|hardened-only|interpretation I-[0-9]{2})$",
            },
            "note": {"description": "What it shows.", "type": "string", "minLength": 1},
            "input": {
                "description": "A record; or a string: a line, without its end, that is no record.",
            },
            "expect": {"description": "The exact answer."},
        },
        "oneOf": [
            pair(&cycle, &cycle_answer),
            pair(&offloading, &offloading_answer),
            pair(&composition, &composition_answer),
            pair(&monitor, &monitor_answer),
            {"properties": {"input": {"type": "string"}, "expect": error}},
        ],
        "$defs": definitions,
    })
}

/// The same with the keys of every object sorted.
fn sorted(value: &Value) -> Value {
    match value {
        Value::Object(fields) => {
            let mut keys: Vec<_> = fields.keys().collect();
            keys.sort();
            keys.into_iter().map(|key| (key.clone(), sorted(&fields[key]))).collect()
        }
        Value::Array(items) => items.iter().map(sorted).collect(),
        Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) => value.clone(),
    }
}
