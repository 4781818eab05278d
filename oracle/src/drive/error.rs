//! What can be wrong with a file, and where.

use std::fmt;
use std::path::{Path, PathBuf};

/// Why a file gives no drive: the place as precisely as it is known, and what to do about it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReadError {
    /// The file.
    pub file: PathBuf,
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
}

impl ReadError {
    /// An error about a file as a whole.
    pub fn file(file: &Path, message: impl Into<String>) -> Self {
        Self {
            file: file.to_path_buf(),
            line: None,
            element: String::new(),
            field: String::new(),
            index: None,
            message: message.into(),
        }
    }

    /// The same error at an element of the file.
    #[must_use]
    pub fn at(mut self, element: impl Into<String>, field: impl Into<String>) -> Self {
        self.element = element.into();
        self.field = field.into();
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
        write!(f, ": {}", self.message)
    }
}

impl std::error::Error for ReadError {}
