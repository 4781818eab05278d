//! Tables within a document, each between two marker lines that name the command that writes it.

use std::fs;
use std::io;
use std::path::Path;
use std::process::Command;

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

/// The line above a table that says of which commit it is: asked before the work, which may be changed behind it. Empty
/// without a document, or where that is in no checkout. Errors: in words, such as that this program is of another commit.
pub fn stamp(path: Option<&Path>) -> Result<String, String> {
    let path = path.and_then(|it| it.canonicalize().ok());
    let mut scripts =
        path.iter().flat_map(|it| it.ancestors()).map(|it| it.join("scripts/measured"));
    let Some(script) = scripts.find(|it| it.exists()) else { return Ok(String::new()) };
    let cannot = |why: String| format!("{}: {why}", script.display());
    let done = Command::new(&script).output().map_err(|error| cannot(error.to_string()))?;
    let line = String::from_utf8_lossy(&done.stdout).into_owned();
    let own = env!("MUFASA_VERSION").split_once("(commit ").map(|it| it.1.trim_end_matches(')'));
    if !done.status.success() || !own.is_none_or(|own| line.contains(own)) {
        return Err(cannot(format!("{line}this program is {}", env!("MUFASA_VERSION"))));
    }
    Ok(line + "\n")
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
