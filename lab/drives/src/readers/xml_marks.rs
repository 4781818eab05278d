//! The marks of XML (tags, comments, instructions), by one pass over the bytes: enough to count and to cut,
//! not to check. What is cut is given to a parser.

use std::ops::Range;

/// What stands between `<` and `>`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// `<a ...>`, with so many values in quotes.
    Open { attributes: usize },
    /// `<a ... />`.
    Empty { attributes: usize },
    /// `</a>`.
    Close,
    /// A comment, CDATA or an instruction.
    Other,
    /// A mark without end, or a document type; the last one.
    Broken,
}

/// A mark and its place in the text; the place of a broken one goes on to the end.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Mark {
    pub kind: Kind,
    pub range: Range<usize>,
}

/// The marks of a text in their order.
pub(crate) struct Marks<'t> {
    text: &'t str,
    at: usize,
}

impl<'t> Marks<'t> {
    pub(crate) fn of(text: &'t str) -> Self {
        Self { text, at: 0 }
    }
}

impl Iterator for Marks<'_> {
    type Item = Mark;

    fn next(&mut self) -> Option<Mark> {
        let start = self.at + self.text[self.at..].find('<')?;
        let rest = &self.text[start..];
        let (kind, length) = if rest.starts_with("<!--") {
            (Kind::Other, after(rest, 4, "-->"))
        } else if rest.starts_with("<![CDATA[") {
            (Kind::Other, after(rest, 9, "]]>"))
        } else if rest.starts_with("<?") {
            (Kind::Other, after(rest, 2, "?>"))
        } else if rest.starts_with("<!") {
            (Kind::Broken, None)
        } else if rest.starts_with("</") {
            (Kind::Close, after(rest, 2, ">"))
        } else {
            tag(rest)
        };
        let end = length.map_or(self.text.len(), |length| start + length);
        self.at = end;
        // The attributes of a tag without end count, too.
        let kind = match kind {
            Kind::Open { .. } | Kind::Empty { .. } => kind,
            _ if length.is_none() => Kind::Broken,
            _ => kind,
        };
        Some(Mark { kind, range: start..end })
    }
}

/// Where `text` goes on after the first `mark` from byte `from`.
fn after(text: &str, from: usize, mark: &str) -> Option<usize> {
    text[from..].find(mark).map(|i| from + i + mark.len())
}

/// The tag that a text starts with, and its length if it ends; `>` may stand in quotes.
fn tag(text: &str) -> (Kind, Option<usize>) {
    let mut quote = None;
    let mut attributes = 0;
    for (i, byte) in text.bytes().enumerate() {
        match (quote, byte) {
            (None, b'"' | b'\'') => {
                quote = Some(byte);
                attributes += 1;
            }
            (None, b'>') => {
                let is_empty = text[..=i].ends_with("/>");
                let kind =
                    if is_empty { Kind::Empty { attributes } } else { Kind::Open { attributes } };
                return (kind, Some(i + 1));
            }
            (Some(q), b) if q == b => quote = None,
            _ => {}
        }
    }
    (Kind::Empty { attributes }, None)
}
