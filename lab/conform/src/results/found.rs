//! A class of disagreements, with the record that shows it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use serde_json::value::RawValue;

use crate::judge::class::Class;
use crate::judge::explain::Told;

/// So many cases of a class are made small at most.
pub const CASES_OF_A_CLASS: usize = 6;

/// A case is small when it has so many objects; of a class without a small one further cases are
/// made small, too.
const SMALL: usize = 3;

/// A class of disagreements with its smallest case.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Found {
    /// The class.
    pub class: Class,
    /// Its name, which is the id of the record below.
    pub id: String,
    /// How many vectors and cases of it.
    pub count: u64,
    /// The vectors among them, by name.
    pub vectors: Vec<String>,
    /// Number of the first case in the campaign; null where there are vectors alone.
    pub first: Option<u64>,
    /// Place of the vector or case that is shown, among all that the campaign asks: vectors come first.
    pub at: u64,
    /// Its name: that of the first, or of a later one that led to fewer objects.
    pub name: String,
    /// Of a vector, what it is about; empty for a case.
    pub about: String,
    /// What was answered and what is right, in the shrunk case.
    pub told: Told,
    /// Whether the record shows the class alone, in a fresh process, and was shrunk.
    pub shrunk: bool,
    /// Where it was not: why.
    pub why: Option<NotShrunk>,
    /// Where it does not show it alone: the lines that a fresh process has to be asked before.
    pub before: Vec<String>,
    /// Objects, events or services of the shrunk case.
    pub size: usize,
    /// What `size` counts.
    pub unit: String,
    /// The shrunk record; a line that is no JSON as a string.
    #[schemars(with = "serde_json::Value")]
    pub record: Box<RawValue>,
    /// Of a shard: what came of each vector and case of the class that was tried, for `merge` to choose from.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tried: Vec<Found>,
}

/// Why a record was not made small.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum NotShrunk {
    /// Asked alone, it did not show the class.
    NotAlone,
    /// Other classes of the same rule were.
    Limit,
    /// The time for it was over.
    Time,
    /// The campaign was interrupted.
    Interrupted,
}

impl Found {
    /// Whether it was tried to make it small.
    pub fn is_tried(&self) -> bool {
        self.shrunk || self.why == Some(NotShrunk::NotAlone)
    }

    /// The line that was asked.
    pub fn line(&self) -> String {
        let text = self.record.get();
        serde_json::from_str(text).unwrap_or_else(|_| text.to_owned())
    }

    /// The margin that the record sets itself, m, as it is written there (`parameters.delta`).
    pub fn delta(&self) -> Option<String> {
        let record: Value = serde_json::from_str(self.record.get()).ok()?;
        record.pointer("/parameters/delta").map(ToString::to_string)
    }

    /// How many of the CAV's earlier detections are in the record (`detection_history`); `size` does not count them.
    pub fn history(&self) -> usize {
        let record: Value = serde_json::from_str(self.record.get()).unwrap_or_default();
        let lists = record.get("detection_history").and_then(Value::as_array);
        let items = |list: &Value| list["items"].as_array().map_or(0, Vec::len);
        lists.map_or(0, |lists| lists.iter().map(items).sum())
    }

    /// An integer in the record that no double is, the first.
    pub fn rounded(&self) -> Option<i64> {
        rounded(&serde_json::from_str(self.record.get()).ok()?)
    }

    /// Whether no further case of its class is tried.
    pub fn is_small(&self) -> bool {
        self.shrunk && self.size <= SMALL
    }

    /// The same class in other shards. Of what was tried there that is shown which one run would have come to.
    pub fn with(self, other: &Self) -> Self {
        let first = self.first.into_iter().chain(other.first).min();
        let count = self.count + other.count;
        let mut vectors = [self.vectors.as_slice(), &other.vectors].concat();
        vectors.sort_unstable();
        let class = self.class.clone();
        let of = |found: &Self| match found.tried.as_slice() {
            [] => vec![found.clone()],
            tried => tried.to_vec(),
        };
        let mut tried = [of(&self), of(other)].concat();
        tried.sort_by_key(|it| (!it.is_tried(), it.at));
        let shown = best(&tried).cloned().unwrap_or(self);
        Self { class, count, vectors, first, tried, ..shown }
    }

    /// Which of two cases of a class says more: the lower.
    fn rank(&self) -> (bool, bool, usize) {
        (!self.shrunk, self.before.is_empty(), self.size)
    }

    /// The lines of its sequence, the record's last, where the record does not show it alone.
    pub fn sequence(&self) -> Option<String> {
        let lines = self.before.iter().cloned().chain([self.line()]);
        (!self.before.is_empty()).then(|| lines.map(|line| line + "\n").collect())
    }
}

fn rounded(value: &Value) -> Option<i64> {
    match value {
        Value::Number(number) => number.as_i64().filter(|it| {
            #[expect(clippy::cast_precision_loss, clippy::cast_possible_truncation)]
            // it is asked whether
            let read = *it as f64 as i128;
            read != i128::from(*it)
        }),
        Value::Array(items) => items.iter().find_map(rounded),
        Value::Object(fields) => fields.values().find_map(rounded),
        Value::Null | Value::Bool(_) | Value::String(_) => None,
    }
}

/// Of what came of the vectors and cases of a class, in their order, what says most: of equals the first. None
/// counts behind a small one, nor beyond the most that a run tries.
pub fn best(tried: &[Found]) -> Option<&Found> {
    let mut best: Option<&Found> = None;
    for found in tried.iter().take(CASES_OF_A_CLASS) {
        let says_more = |known: &Found| found.is_tried() && found.rank() < known.rank();
        if best.is_none_or(says_more) {
            best = Some(found);
        }
        if found.is_small() || found.class.breach.is_broken() {
            break;
        }
    }
    best
}
