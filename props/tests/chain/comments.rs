//! What comments of Rust name, and at which function.

use super::ids::ids_at;
use super::lines::{Place, lines};

/// A heading of `spec/`, a rule or a requirement that a comment names.
#[derive(Debug, PartialEq)]
pub struct Mention<'a> {
    /// `spec/3-stages.md#distances`, `DIST-02`, `H-04`, `I-02`.
    pub name: String,
    /// At what it stands.
    pub at: Place<'a>,
}

/// All that the comments of a file name.
pub fn mentions(text: &str) -> Vec<Mention<'_>> {
    let head: Vec<&str> = text.lines().filter_map(|line| line.strip_prefix("//!")).collect();
    let head = names(&head.join(" "));
    let head = head.into_iter().map(|name| Mention { name, at: Place::Head });
    let below = lines(text).into_iter().filter(|line| !line.comment.starts_with('!'));
    let below = below.flat_map(|line| {
        names(line.comment).into_iter().map(move |name| Mention { name, at: line.at })
    });
    head.chain(below).collect()
}

/// Names of headings, rules and requirements in a text; behind a heading `#another` is one of the same file.
/// `H-01 to H-14` names the profile and none of its rules.
pub fn names(text: &str) -> Vec<String> {
    let mut found = Vec::new();
    for (at, id) in ids_at(text) {
        let is_range = text[at + id.len()..].starts_with(" to H-") || text[..at].ends_with(" to ");
        found.extend(Some(id.to_owned()).filter(|_| !is_range));
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
                pub(crate) const fn f() {\n    let x = 1; // DIST-03\n}\n";
    let found: Vec<_> = mentions(text).into_iter().map(|it| (it.name, it.at)).collect();
    let heading = "spec/3-stages.md#distances".to_owned();
    let at = Place::Item("f");
    let schedule = "spec/3-stages.md#schedule".to_owned();
    let head = [(heading, Place::Head), (schedule, Place::Head)];
    let expected = [head.to_vec(), vec![("H-04".to_owned(), at), ("DIST-03".to_owned(), at)]];
    assert_eq!(found, expected.concat());
}
