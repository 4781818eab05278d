//! Records, answers and random numbers for the tests.

use mufasa_conform::reference as oracle;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde_json::Value;

/// A cycle that is accepted in both profiles: one current detection far away.
pub const CYCLE: &str = r#"{"kind": "cycle", "id": "c", "profile": "paper", "parameters": {}, "now_ns": 1000, "configuration": "AllRemote", "ego": {"x": 0, "y": 0, "cos": 1, "sin": 0, "speed": 0, "length": 4.8, "width": 1.9, "center_offset": 1.4}, "trajectory": {"stamp_ns": 900, "points": [{"t_ns": 1000, "x": 0, "y": 0, "cos": 1, "sin": 0}]}, "tracks": {"stamp_ns": 900, "items": [{"id": 7, "x": 30, "y": 0, "cos": 1, "sin": 0, "vx": 10, "vy": 0, "length": 4.5, "width": 1.8}]}, "detections": {"stamp_ns": 900, "items": [{"x": 30, "y": 0.1, "cos": 1, "sin": 0, "length": 4.5, "width": 1.8}]}, "lead": {"stamp_ns": 900, "gap": 25, "speed": 10}, "route": {"closed": false, "stations": [{"x": -10, "y": 0, "left": [-10, 2], "right": [-10, -2]}, {"x": 100, "y": 0, "left": [100, 2], "right": [100, -2]}]}, "grid": {"stamp_ns": 900, "x": -20, "y": -20, "cos": 1, "sin": 0, "resolution": 10, "width": 10, "height": 3, "occupied": "AAAAAA==", "unknown": null}, "detection_history": null}"#;

/// A trace with one event of every type.
pub const TRACE: &str = r#"{"kind": "offloading", "id": "o", "profile": "paper", "parameters": {"t_wait_ns": 10000000000}, "events": [{"t_ns": 0, "type": "offer", "station": 1, "groups": ["mot", "plan"]}, {"t_ns": 1, "type": "area", "groups": ["mot", "plan"]}, {"t_ns": 1, "type": "tick"}, {"t_ns": 2, "type": "confirm", "station": 1, "group": "mot", "session": 1}, {"t_ns": 2, "type": "reject", "station": 1, "group": "plan", "session": 2}, {"t_ns": 3, "type": "data", "station": 1, "group": "mot", "session": 1, "generated_ns": 1}, {"t_ns": 4, "type": "verdict", "verdict": "unsafe", "sessions": {"mot": 1}}, {"t_ns": 5, "type": "lost", "station": 1}, {"t_ns": 5, "type": "withdraw", "station": 1}]}"#;

/// A service set with one composition.
pub const COMPOSITION: &str = r#"{"kind": "composition", "id": "s", "services": [{"id": "det", "requires": [], "guarantees": ["detections"], "station": 0}, {"id": "mot", "requires": ["detections"], "guarantees": ["tracks"], "station": 1}], "goal": "mot", "same_station": [["env", "tpl"]], "local_only": ["control"]}"#;

/// The answer to one line.
pub fn answer(line: &str) -> Value {
    let mut answers = answers(line.as_bytes());
    assert_eq!(answers.len(), 1, "{line}");
    answers.remove(0)
}

/// The answers to an input.
pub fn answers(input: &[u8]) -> Vec<Value> {
    let mut output = Vec::new();
    oracle::run(input, &mut output, oracle::by_model).expect("memory can be written");
    let text = String::from_utf8(output).expect("answers are UTF-8");
    assert!(text.is_empty() || text.ends_with('\n'));
    text.lines().map(|line| serde_json::from_str(line).expect("answers are JSON")).collect()
}

/// Asserts that the text is refused at `field` and `index`.
pub fn refused(line: &str, field: &str, index: Option<usize>) {
    let answer = answer(line);
    assert_eq!(answer["verdict"], "error", "{line}\n{answer}");
    assert_eq!(answer["failed_stage"], Value::Null, "{answer}");
    assert_eq!(answer["error"]["field"], field, "{line}\n{answer}");
    assert_eq!(answer["error"]["index"], serde_json::json!(index), "{line}\n{answer}");
    assert_eq!(answer["error"]["line"], 1, "{answer}");
}

/// Asserts that the text is a record and is answered as one.
pub fn accepted(line: &str) -> Value {
    let answer = answer(line);
    assert!(answer.get("error").is_none(), "{line}\n{answer}");
    answer
}

/// The text with its only occurrence of `old` replaced.
pub fn with(text: &str, old: &str, new: &str) -> String {
    assert_eq!(text.matches(old).count(), 1, "{old} is to occur once in {text}");
    text.replace(old, new)
}

/// Seeded, the same everywhere.
pub struct Random(ChaCha8Rng);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0.random()
    }

    /// A number below `end`.
    pub fn below(&mut self, end: usize) -> usize {
        self.0.random_range(0..end)
    }

    /// A random byte.
    pub fn byte(&mut self) -> u8 {
        self.0.random()
    }

    /// One of the choices.
    pub fn pick<'a, T>(&mut self, choices: &'a [T]) -> &'a T {
        &choices[self.below(choices.len())]
    }
}
