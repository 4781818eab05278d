//! What a file holds, by its bytes and not by its name.

use std::io::{BufRead, Cursor};
use std::path::Path;

use crate::readers::error::{ReadError, quoted};
use crate::readers::source::Unpacked;
use crate::readers::xml::Document;
use crate::readers::{formats, npy};

/// A file by what it holds.
pub(crate) enum Content {
    Scenario(String),
    Solution(String),
    Map(Vec<u8>),
    Lines(Box<dyn BufRead>),
}

impl Content {
    /// Recognises a file by its first bytes. Lines are left to be read; all else is read as a whole.
    pub(crate) fn of(path: &Path, mut file: Unpacked) -> Result<Self, ReadError> {
        if are_lines(file.peek_text()) {
            return Ok(Self::Lines(Box::new(file.reader())));
        }
        let bytes = file.bytes().map_err(|error| ReadError::file(path, error.to_string()))?;
        if bytes.starts_with(npy::MAGIC) {
            return Ok(Self::Map(bytes));
        }
        if let Some(message) = formats::foreign(&bytes) {
            return Err(ReadError::file(path, message));
        }
        let text = String::from_utf8(bytes).map_err(|error| {
            let message = formats::not_utf_8(error.as_bytes(), &error.utf8_error());
            ReadError::file(path, message)
        })?;
        // A byte order mark is no content.
        let text = text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text);
        if !text.trim_start().starts_with('<') {
            if formats::is_named_lines(path) {
                return Ok(Self::Lines(Box::new(Cursor::new(text))));
            }
            let message = format!("neither XML nor JSON Lines; {}", formats::READ);
            return Err(ReadError::file(path, message));
        }
        let mut document = Document::of(path, &text)?;
        document.each_child(|_| Ok(()))?;
        match document.root().name() {
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

/// Whether a text that starts so is one of JSON objects; behind a byte order mark or blanks, too.
fn are_lines(head: &[u8]) -> bool {
    let text = head.strip_prefix(b"\xef\xbb\xbf").unwrap_or(head).trim_ascii_start();
    // In UTF-16 and UTF-32 there is a zero behind it.
    text.starts_with(b"{") && text.get(1) != Some(&0)
}
