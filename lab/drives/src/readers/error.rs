//! What can be wrong with a file, and where.

use std::fmt;
use std::path::Path;

/// Why a file gives no drive: the place as precisely as it is known, and what to do about it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReadError {
    /// The file.
    pub file: Box<Path>,
    /// Line of the file, from 1; `None` for binary files and for errors of the whole file.
    pub line: Option<u32>,
    /// The element, as a path of tag names with ids, such as `commonRoad/lanelet[12]/leftBound`.
    pub element: String,
    /// The field within the element, empty when the element itself is meant.
    pub field: String,
    /// Index within a list (points, states, rows), from 0.
    pub index: Option<usize>,
    /// What is wrong and what would be right.
    pub message: String,
    /// More lines of the same file that are wrong, too; `None` when there are none.
    pub others: Option<Box<OtherLines>>,
}

/// What is wrong with further lines of a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct OtherLines {
    /// The first of them, in their order.
    pub errors: Vec<ReadError>,
    /// How many more there are.
    pub more: usize,
}

/// Errors of one file that are told one by one.
const LINES_MAX: usize = 10;
/// Characters of a value, and of a place or a message, that are told of longer ones.
const VALUE_MAX: usize = 80;
const TEXT_MAX: usize = 480;

/// A value of a file for a message; of a long one the beginning, and how long it is.
pub(crate) fn quoted(value: &str) -> String {
    match value.char_indices().nth(VALUE_MAX) {
        None => format!("`{value}`"),
        Some((end, _)) => format!("`{}...` ({} bytes)", &value[..end], value.len()),
    }
}

/// A text without the middle of one that is too long: who refuses a file does not repeat it.
fn cut(text: String) -> String {
    let half = TEXT_MAX / 2;
    if text.len() <= TEXT_MAX {
        return text;
    }
    let (start, end) = (text.floor_char_boundary(half), text.ceil_char_boundary(text.len() - half));
    format!("{}... ({} bytes left out) ...{}", &text[..start], end - start, &text[end..])
}

impl ReadError {
    /// An error about a file as a whole.
    pub fn file(file: &Path, message: impl Into<String>) -> Self {
        Self {
            file: file.into(),
            line: None,
            element: String::new(),
            field: String::new(),
            index: None,
            message: cut(message.into()),
            others: None,
        }
    }

    /// The error of a recording, or of a drive along a map, that gives no cycle.
    pub(crate) fn no_cycle(file: &Path) -> Self {
        let message = "the drive of the CAV is shorter than braking takes (v / a_b); --keep-tail \
                       has its cycles all the same";
        Self::file(file, message)
    }

    /// What is wrong with the lines of one file: the error of one more of them joins those before it.
    pub(crate) fn join(lines: &mut Option<Self>, error: Self) {
        let Some(first) = lines else {
            *lines = Some(error);
            return;
        };
        let others = first.others.get_or_insert_default();
        if others.errors.len() + 1 < LINES_MAX {
            others.errors.push(error);
        } else {
            others.more += 1;
        }
    }

    /// The same error at an element of the file.
    #[must_use]
    pub fn at(mut self, element: impl Into<String>, field: impl Into<String>) -> Self {
        self.element = cut(element.into());
        self.field = cut(field.into());
        self
    }

    /// The same error at an index of a list.
    #[must_use]
    pub fn index(mut self, index: usize) -> Self {
        self.index = Some(index);
        self
    }

    /// The same error on a line of the file.
    #[must_use]
    pub fn line(mut self, line: u32) -> Self {
        self.line = Some(line);
        self
    }
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.file.display())?;
        if let Some(line) = self.line {
            write!(f, ":{line}")?;
        }
        if !self.element.is_empty() {
            write!(f, ": {}", self.element)?;
        }
        if !self.field.is_empty() {
            write!(f, ": {}", self.field)?;
        }
        if let Some(index) = self.index {
            write!(f, "[{index}]")?;
        }
        write!(f, ": {}", self.message)?;
        let Some(others) = &self.others else { return Ok(()) };
        for error in &others.errors {
            write!(f, "\n{error}")?;
        }
        match others.more {
            0 => Ok(()),
            1 => write!(f, "\n{}: and 1 more line", self.file.display()),
            more => write!(f, "\n{}: and {more} more lines", self.file.display()),
        }
    }
}

impl std::error::Error for ReadError {}
