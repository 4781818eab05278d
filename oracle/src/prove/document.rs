//! The table within a document, between two markers.

use std::fs;
use std::io;
use std::path::Path;

/// The line before the table.
const BEGIN: &str = "<!-- mufasa prove: begin -->\n";
/// The line after it.
const END: &str = "<!-- mufasa prove: end -->\n";

/// Puts the table in the place of the one in the document. Errors: no such file, no markers.
pub fn write(path: &Path, table: &str) -> io::Result<()> {
    let text = fs::read_to_string(path)?;
    let (before, _, after) = parts(&text)?;
    fs::write(path, format!("{before}\n{table}\n{after}"))
}

/// The table in the document. Errors: no such file, no markers.
pub fn read(path: &Path) -> io::Result<String> {
    let text = fs::read_to_string(path)?;
    parts(&text).map(|(_, table, _)| table.to_owned())
}

/// Up to the table, the table, from its end on.
fn parts(text: &str) -> io::Result<(&str, &str, &str)> {
    let missing = || io::Error::other(format!("no lines {} and {}", BEGIN.trim(), END.trim()));
    let begin = text.find(BEGIN).ok_or_else(missing)? + BEGIN.len();
    let end = text[begin..].find(END).ok_or_else(missing)? + begin;
    Ok((&text[..begin], &text[begin..end], &text[end..]))
}
