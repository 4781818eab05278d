//! Comments and code of Rust, with the item at which they stand.

/// Where a line stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place<'a> {
    /// At the top of the file, which it is about.
    Head,
    /// At a function, a type or a constant, or within it.
    Item(&'a str),
}

/// A line: the item that it belongs to, its code and its comment.
pub struct Line<'a> {
    pub at: Place<'a>,
    pub code: &'a str,
    pub comment: &'a str,
}

/// The lines of a file; documentation belongs to the item below it.
pub fn lines(text: &str) -> Vec<Line<'_>> {
    let mut found: Vec<Line> = Vec::new();
    let (mut current, mut waiting) = (Place::Head, 0);
    for line in text.lines().map(str::trim_start) {
        let (code, comment) = line.split_once("//").unwrap_or((line, ""));
        if comment.starts_with('/') {
            waiting += 1;
        } else {
            current = item(code).map_or(current, Place::Item);
            if !code.is_empty() && !code.starts_with("#[") {
                let from = found.len() - waiting;
                found[from..].iter_mut().for_each(|it| it.at = current);
                waiting = 0;
            } else if waiting > 0 {
                waiting += 1;
            }
        }
        let at = if comment.starts_with('!') { Place::Head } else { current };
        found.push(Line { at, code, comment });
    }
    found
}

/// The name of the function, type or constant that begins on a line.
pub fn item(line: &str) -> Option<&str> {
    let words = ["fn ", "struct ", "enum ", "const ", "macro_rules! "];
    let (before, rest) = words.iter().find_map(|word| {
        let at = line.find(word)?;
        Some((&line[..at], &line[at + word.len()..]))
    })?;
    let begins = before.split_whitespace().all(|word| {
        word.starts_with("pub")
            || ["const", "unsafe", "async", "(super)", "(crate)"].contains(&word)
    });
    let name = rest.split(|c: char| !(c.is_alphanumeric() || c == '_')).next()?;
    (begins && !name.is_empty()).then_some(name)
}
