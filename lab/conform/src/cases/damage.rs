//! Lines that are no records: one thing of a record is made wrong
//! (`spec/3-stages.md#invalid-input`, `spec/5-interfaces.md#cycle`).

use std::ops::Range;

/// What is made wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Damage {
    /// A blank line.
    Blank,
    /// The line ends too early.
    Cut,
    /// A key that is in no record.
    UnknownField,
    /// A field that is given twice.
    Twice,
    /// A field that is left out.
    Missing,
    /// `null` for a value.
    Null,
    /// `true` for a value, or a number for `true`.
    Type,
    /// A word that is none of those that may stand there.
    Word,
    /// An integer with a fraction of zero.
    Fraction,
    /// An integer with an exponent of zero.
    Exponent,
    /// An integer beyond 64 bits.
    Range,
}

impl Damage {
    /// All damages.
    pub const ALL: [Self; 11] = [
        Self::Blank,
        Self::Cut,
        Self::UnknownField,
        Self::Twice,
        Self::Missing,
        Self::Null,
        Self::Type,
        Self::Word,
        Self::Fraction,
        Self::Exponent,
        Self::Range,
    ];

    /// In words.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Blank => "blank",
            Self::Cut => "no JSON",
            Self::UnknownField => "unknown field",
            Self::Twice => "field twice",
            Self::Missing => "field missing",
            Self::Null => "null",
            Self::Type => "wrong type",
            Self::Word => "unknown word",
            Self::Fraction => "integer with fraction",
            Self::Exponent => "integer with exponent",
            Self::Range => "integer beyond 64 bits",
        }
    }

    /// The changes of a text that do this damage: what is replaced, and by what.
    pub fn changes(self, text: &str) -> Vec<(Range<usize>, String)> {
        let Parts { objects, members, values } = Parts::of(text);
        let is_integer = |value: &&Range<usize>| text[(*value).clone()].parse::<i64>().is_ok();
        let integers = || values.iter().filter(is_integer);
        let replaced = |by: &str| values.iter().map(|it| (it.clone(), by.to_owned())).collect();
        match self {
            Self::Blank => vec![(0..text.len(), String::new())],
            Self::Cut => {
                let boundaries = (1..text.len()).filter(|at| text.is_char_boundary(*at));
                boundaries.map(|at| (at..text.len(), String::new())).collect()
            }
            Self::UnknownField => {
                let is_empty = |at: usize| text[at..].starts_with('}');
                let field = |at| if is_empty(at) { "\"extra\": 1" } else { "\"extra\": 1, " };
                objects.into_iter().map(|at| (at..at, field(at).to_owned())).collect()
            }
            Self::Twice => {
                let twice = |it: &Range<usize>| format!("{}, ", &text[it.clone()]);
                members.iter().map(|it| (it.start..it.start, twice(it))).collect()
            }
            Self::Missing => {
                members.into_iter().map(|it| (with_comma(text, it), String::new())).collect()
            }
            Self::Null => replaced("null"),
            Self::Type => {
                let other = |it: &Range<usize>| {
                    if text[it.clone()].parse::<bool>().is_ok() { "0" } else { "true" }
                };
                values.iter().map(|it| (it.clone(), other(it).to_owned())).collect()
            }
            Self::Word => {
                let words = values.into_iter().filter(|it| text[it.start..].starts_with('"'));
                words.map(|it| (it, String::from("\"other\""))).collect()
            }
            Self::Fraction => integers().map(|it| (it.end..it.end, String::from(".0"))).collect(),
            Self::Exponent => integers().map(|it| (it.end..it.end, String::from("e0"))).collect(),
            Self::Range => {
                integers().map(|it| (it.clone(), String::from("9223372036854775808"))).collect()
            }
        }
    }
}

/// A member of an object with the comma that must go with it.
fn with_comma(text: &str, member: Range<usize>) -> Range<usize> {
    if text[member.end..].starts_with(", ") {
        member.start..member.end + 2
    } else if text[..member.start].ends_with(", ") {
        member.start - 2..member.end
    } else {
        member
    }
}

/// Places in the text of a record, as this program writes it.
#[derive(Default)]
struct Parts {
    /// Behind the brace that opens an object.
    objects: Vec<usize>,
    /// Keys with their values.
    members: Vec<Range<usize>>,
    /// Values of members and elements of lists.
    values: Vec<Range<usize>>,
}

impl Parts {
    fn of(text: &str) -> Self {
        let mut parts = Self::default();
        parts.value(text.as_bytes(), 0);
        parts
    }

    /// Reads the value at `at`; gives its end.
    fn value(&mut self, text: &[u8], at: usize) -> usize {
        match text.get(at) {
            Some(b'{') => {
                self.objects.push(at + 1);
                self.items(text, at + 1, |parts, key| {
                    let end = parts.element(text, past(text, string(text, key), b": "));
                    parts.members.push(key..end);
                    end
                })
            }
            Some(b'[') => self.items(text, at + 1, |parts, item| parts.element(text, item)),
            Some(b'"') => string(text, at),
            _ => until(text, at, b",]}"),
        }
    }

    fn element(&mut self, text: &[u8], at: usize) -> usize {
        let end = self.value(text, at);
        self.values.push(at..end);
        end
    }

    /// Reads items up to the closing bracket; gives what is behind it.
    fn items(
        &mut self,
        text: &[u8],
        mut at: usize,
        item: impl Fn(&mut Self, usize) -> usize,
    ) -> usize {
        loop {
            at = past(text, at, b", ");
            match text.get(at) {
                Some(b'}' | b']') => return at + 1,
                Some(_) => at = item(self, at),
                None => return at,
            }
        }
    }
}

/// Behind the string that begins at `at`.
fn string(text: &[u8], at: usize) -> usize {
    let mut at = at + 1;
    while let Some(byte) = text.get(at) {
        match byte {
            b'\\' => at += 2,
            b'"' => return at + 1,
            _ => at += 1,
        }
    }
    text.len()
}

fn past(text: &[u8], at: usize, bytes: &[u8]) -> usize {
    at + text[at..].iter().take_while(|byte| bytes.contains(byte)).count()
}

fn until(text: &[u8], at: usize, bytes: &[u8]) -> usize {
    at + text[at..].iter().take_while(|byte| !bytes.contains(byte)).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_place_that_is_wrong_is_the_one_that_is_changed() {
        let text = r#"{"a": 1, "b": [{"c": "x"}, 2], "d": {}, "e": true}"#;
        let all = |damage: Damage| -> Vec<String> {
            let changed = |(place, by): (Range<usize>, String)| {
                let mut text = text.to_owned();
                text.replace_range(place, &by);
                text
            };
            damage.changes(text).into_iter().map(changed).collect()
        };
        assert_eq!(all(Damage::Missing)[0], r#"{"b": [{"c": "x"}, 2], "d": {}, "e": true}"#);
        assert_eq!(all(Damage::Missing)[1], r#"{"a": 1, "b": [{}, 2], "d": {}, "e": true}"#);
        assert_eq!(all(Damage::Missing)[4], r#"{"a": 1, "b": [{"c": "x"}, 2], "d": {}}"#);
        let field = r#"{"a": 1, "b": [{"c": "x"}, 2], "d": {"extra": 1}, "e": true}"#;
        assert!(all(Damage::UnknownField).contains(&field.to_owned()));
        let twice = r#"{"a": 1, "b": [{"c": "x", "c": "x"}, 2], "d": {}, "e": true}"#;
        assert!(all(Damage::Twice).contains(&twice.to_owned()));
        let fraction = r#"{"a": 1, "b": [{"c": "x"}, 2.0], "d": {}, "e": true}"#;
        assert_eq!(all(Damage::Fraction).last().map(String::as_str), Some(fraction));
        assert_eq!(
            all(Damage::Word),
            [r#"{"a": 1, "b": [{"c": "other"}, 2], "d": {}, "e": true}"#]
        );
        assert!(all(Damage::Type).contains(&text.replace("true", "0")));
        assert_eq!(all(Damage::Blank), [""]);
    }
}
