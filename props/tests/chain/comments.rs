//! What comments of Rust name, and at which function.

/// A heading of `spec/` or a rule that a comment names.
#[derive(Debug, PartialEq)]
pub struct Mention {
    /// `spec/3-stages.md#distances`, `H-04`, `I-02`.
    pub name: String,
    /// At what it stands.
    pub at: Place,
}

/// Where a comment stands.
#[derive(Clone, Debug, PartialEq)]
pub enum Place {
    /// At the top of the file, which it is about.
    Head,
    /// At a function, a type or a constant, or within it.
    Item(String),
}

/// All that the comments of a file name.
pub fn mentions(text: &str) -> Vec<Mention> {
    let head: Vec<&str> = text.lines().filter_map(|line| line.strip_prefix("//!")).collect();
    let head = names(&head.join(" "));
    let mut found: Vec<_> =
        head.into_iter().map(|name| Mention { name, at: Place::Head }).collect();
    let mut waiting: Vec<String> = Vec::new();
    let mut current = Place::Head;
    for line in text.lines().map(str::trim_start).filter(|line| !line.starts_with("//!")) {
        if let Some(doc) = line.strip_prefix("///") {
            waiting.extend(names(doc));
        } else {
            if let Some(item) = item(line) {
                current = Place::Item(item.to_owned());
            }
            if !line.is_empty() && !line.starts_with("#[") {
                let waiting = waiting.drain(..).map(|name| Mention { name, at: current.clone() });
                found.extend(waiting);
            }
            let comment = line.split_once("//").map_or("", |(_, comment)| comment);
            found.extend(
                names(comment).into_iter().map(|name| Mention { name, at: current.clone() }),
            );
        }
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

/// Names of headings and rules in a text; behind a heading `#another` is one of the same file.
/// `H-01 to H-14` names the profile and none of its rules.
pub fn names(text: &str) -> Vec<String> {
    let mut found = Vec::new();
    for (at, _) in text.match_indices("H-").chain(text.match_indices("I-")) {
        let Some(name) = text.get(at..at + 4) else { continue };
        let is_range = text[at + 4..].starts_with(" to H-") || text[..at].ends_with(" to ");
        let is_whole = !text[..at].ends_with(|c: char| c.is_alphanumeric() || c == '-');
        if name[2..].parse::<u8>().is_ok() && is_whole && !is_range {
            found.push(name.to_owned());
        }
    }
    let end = |c: char| !(c.is_alphanumeric() || "/.#-_".contains(c));
    for (at, _) in text.match_indices("spec/") {
        let name = text[at..].split(end).next().unwrap_or_default();
        let Some((file, anchor)) = name.split_once(".md#") else { continue };
        let own = text[at + name.len()..].split("spec/").next().unwrap_or_default();
        let others = own.split("`#").skip(1).filter_map(|rest| rest.split('`').next());
        for anchor in [anchor].into_iter().chain(others) {
            found.push(format!("{file}.md#{}", anchor.split('.').next().unwrap_or_default()));
        }
    }
    found
}

#[test]
fn comments_are_about_what_they_stand_at() {
    let text = "//! Top (`spec/3-stages.md#distances`,\n//! `#schedule`).\n\n/// H-04, H-01 to H-14.\n#[must_use]\n\
                pub(crate) const fn f() {\n    let x = 1; // spec/3-stages.md#distances.2\n}\n";
    let found: Vec<_> = mentions(text).into_iter().map(|it| (it.name, it.at)).collect();
    let [heading, f] = ["spec/3-stages.md#distances".to_owned(), "f".to_owned()];
    let at = Place::Item(f);
    let schedule = "spec/3-stages.md#schedule".to_owned();
    let head = [(heading.clone(), Place::Head), (schedule, Place::Head)];
    let expected = [head.to_vec(), vec![("H-04".to_owned(), at.clone()), (heading, at)]];
    assert_eq!(found, expected.concat());
}
