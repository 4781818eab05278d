//! Parts of the answers to cycles (`spec/5-interfaces.md#cycle`).

use mufasa_model::report::{Rule, Witness};
use schemars::JsonSchema;
use serde::Serialize;

use crate::record::value::Word;

/// A problem in remote data.
#[derive(Clone, Debug, PartialEq, Eq, JsonSchema, Serialize)]
pub struct InputProblem {
    /// Dotted path without indices.
    pub field: String,
    /// Index in the innermost list.
    pub index: Option<usize>,
}

/// A witness; keys that its rule has no use for are left out.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct WitnessAnswer {
    /// The rule that was broken.
    pub rule: Word<Rule>,
    /// Index of the trajectory point.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub point: Option<usize>,
    /// Id of the track.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub track: Option<i64>,
    /// Index of the detection.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub detection: Option<usize>,
    /// Index of the item in a list of the detection history.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub item: Option<usize>,
    /// Age of that list.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub age_ns: Option<i64>,
    /// Index of the segment of the reference path.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub segment: Option<usize>,
    /// Index of the disk.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub disk: Option<usize>,
    /// Column and row of the grid cell.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cell: Option<[i64; 2]>,
    /// The two numbers that were compared, as shortest round-trip decimals.
    pub compared: [String; 2],
}

impl WitnessAnswer {
    /// The witness that the model gives.
    pub fn new(witness: &Witness) -> Self {
        Self {
            rule: Word(witness.rule),
            point: witness.point,
            track: witness.track,
            detection: witness.detection,
            item: witness.item,
            age_ns: witness.age_ns,
            segment: witness.segment,
            disk: witness.disk,
            cell: witness.cell.map(|(column, row)| [column, row]),
            compared: witness.compared.map(decimal),
        }
    }
}

/// The shortest decimal that reads back to the double; `nan`, `inf` or `-inf`.
pub fn decimal(value: f64) -> String {
    if value.is_nan() { String::from("nan") } else { value.to_string() }
}
