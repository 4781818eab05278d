//! The table within a document, between two markers.

use std::fs;
use std::io;
use std::path::Path;

use super::tables;

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

/// The ids of the lines of the table in the document. Errors: no such file, no markers.
pub fn ids(path: &Path) -> io::Result<Vec<String>> {
    let text = fs::read_to_string(path)?;
    let (_, table, _) = parts(&text)?;
    Ok(tables::ids(table).into_iter().map(str::to_owned).collect())
}

/// Up to the table, the table, from its end on.
fn parts(text: &str) -> io::Result<(&str, &str, &str)> {
    let missing = || io::Error::other(format!("no lines {} and {}", BEGIN.trim(), END.trim()));
    let begin = text.find(BEGIN).ok_or_else(missing)? + BEGIN.len();
    let end = text[begin..].find(END).ok_or_else(missing)? + begin;
    Ok((&text[..begin], &text[begin..end], &text[end..]))
}
