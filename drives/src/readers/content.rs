//! What a file holds, by its bytes and not by its name.

use std::path::Path;

use crate::readers::error::{ReadError, quoted};
use crate::readers::xml_parts::Parts;
use crate::readers::{formats, npy};

/// A file by what it holds.
pub(crate) enum Content {
    Scenario(String),
    Solution(String),
    Map(Vec<u8>),
    Lines(String),
}

impl Content {
    /// Recognises the bytes of a file.
    pub(crate) fn of(path: &Path, bytes: Vec<u8>) -> Result<Self, ReadError> {
        if bytes.starts_with(npy::MAGIC) {
            return Ok(Self::Map(bytes));
        }
        if let Some(message) = formats::foreign(&bytes) {
            return Err(ReadError::file(path, message));
        }
        let text = String::from_utf8(bytes).map_err(|e| {
            let message = format!("no format that is read, and no text ({e}); {}", formats::READ);
            ReadError::file(path, message)
        })?;
        // A byte order mark is no content.
        let text = text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text);
        match text.trim_start().chars().next() {
            Some('{') => return Ok(Self::Lines(text)),
            Some('<') => {}
            _ => {
                let message = format!("neither XML nor JSON Lines; {}", formats::READ);
                return Err(ReadError::file(path, message));
            }
        }
        match Parts::of(path, &text)?.root(|root| Ok(root.name().to_owned()))?.as_str() {
            "commonRoad" => Ok(Self::Scenario(text)),
            "CommonRoadSolution" => Ok(Self::Solution(text)),
            other => {
                let message = format!(
                    "{} is neither `commonRoad` nor `CommonRoadSolution`; {}",
                    quoted(other),
                    formats::READ
                );
                Err(ReadError::file(path, message))
            }
        }
    }
}
