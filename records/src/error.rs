//! What is wrong with a line (`spec/5-interfaces.md#cycle`).

use std::fmt;

use mufasa_model::report::InvalidInput;

/// A line that is no record, or a record that cannot be answered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LineError {
    /// Number of the line, from 1.
    pub line: usize,
    /// The record's id, when it could be read.
    pub id: Option<String>,
    /// Dotted path without indices, such as `tracks.items.vx`; empty for the record itself.
    pub field: String,
    /// Index in the innermost list, if the field is in one.
    pub index: Option<usize>,
    /// What is wrong and what would be right.
    pub message: String,
}

impl LineError {
    /// The problem of a record, with its line and its id.
    pub fn new(line: usize, id: Option<String>, problem: InvalidInput) -> Self {
        let InvalidInput { field, index, message } = problem;
        Self { line, id, field, index, message }
    }

    /// Text that is no JSON; `line` is the number of its first line.
    pub fn syntax(line: usize, error: &serde_json::Error) -> Self {
        let message = format!("is not JSON: {} at column {}", text(error), error.column());
        Self::whole(line + error.line().saturating_sub(1), message)
    }

    /// A problem of a whole line that has no fields yet.
    pub fn whole(line: usize, message: String) -> Self {
        Self { line, id: None, field: String::new(), index: None, message }
    }
}

impl fmt::Display for LineError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "line {}: {}", self.line, self.message)
    }
}

impl std::error::Error for LineError {}

/// What is wrong, without the place.
pub fn text(error: &serde_json::Error) -> String {
    let place = format!(" at line {} column {}", error.line(), error.column());
    let text = error.to_string();
    text.strip_suffix(&place).map_or(text.clone(), str::to_owned)
}
