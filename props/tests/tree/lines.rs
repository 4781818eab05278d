//! Comments and code of Rust, with the item at which they stand.

/// Where a line stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place<'a> {
    /// At the top of the file, which it is about.
    Head,
    /// At a function, a type, a constant or an entry of a table of claims, or within it.
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
            current = item(code).or_else(|| claim(code)).map_or(current, Place::Item);
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

/// The name of the claim that begins on a line of a table: `id: "it_holds",` of a theorem, `Member = "it_holds",` of a
/// property or a law of the exploration.
fn claim(line: &str) -> Option<&str> {
    let (before, rest) = line.split_once('"')?;
    let is_member = |it: &str| it.chars().all(char::is_alphanumeric) && !it.is_empty();
    let begins = before == "id: " || before.strip_suffix(" = ").is_some_and(is_member);
    rest.trim_end().strip_suffix("\",").filter(|name| begins && !name.contains('"'))
}

#[test]
fn entries_of_a_table_of_claims_are_items() {
    let text = "named! {\n    Law {\n        /// A-01\n        Holds = \"it holds\",\n        /// A-02\n        Ends = \"it_ends\",\n    }\n}\n\
                const ALL: &[Theorem] = &[\n    Theorem {\n        id: \"it_is\",\n        // A-03\n    },\n];\n/// A-04\nfn f() {}\n";
    let cited = lines(text).into_iter().filter(|line| line.comment.contains("A-0"));
    let expected = ["it holds", "it_ends", "it_is", "f"].map(Place::Item);
    assert_eq!(cited.map(|line| line.at).collect::<Vec<_>>(), expected);
}
