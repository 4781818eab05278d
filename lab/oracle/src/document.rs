//! Tables within a document, each between two marker lines that name the command that writes it.

use std::fs;
use std::io;
use std::path::Path;

/// The table of this name in the document. Errors: no such file, no markers.
pub fn read(path: &Path, name: &str) -> io::Result<String> {
    let text = fs::read_to_string(path)?;
    parts(&text, name).map(|(_, table, _)| table.to_owned())
}

/// Whether a table of this name has its place in the document, if there is one: asked before the work, not behind it.
/// Errors: in words, with the file.
pub fn has_place(path: Option<&Path>, name: &str) -> Result<(), String> {
    let Some(path) = path else { return Ok(()) };
    let said = |error| format!("{}: no table can be put there: {error}", path.display());
    read(path, name).map(drop).map_err(said)
}

/// Puts a table in the place of the one of this name. Errors: no such file, no markers.
pub fn write(path: &Path, name: &str, table: &str) -> io::Result<()> {
    let text = fs::read_to_string(path)?;
    let (before, _, after) = parts(&text, name)?;
    fs::write(path, format!("{before}\n{}\n\n{after}", table.trim()))
}

/// Up to the table, the table, from its end on.
fn parts<'a>(text: &'a str, name: &str) -> io::Result<(&'a str, &'a str, &'a str)> {
    let [begin, end] = ["begin", "end"].map(|what| format!("<!-- {name}: {what} -->\n"));
    let missing = || io::Error::other(format!("no lines {} and {}", begin.trim(), end.trim()));
    let from = text.find(&begin).ok_or_else(missing)? + begin.len();
    let to = text[from..].find(&end).ok_or_else(missing)? + from;
    Ok((&text[..from], &text[from..to], &text[to..]))
}
