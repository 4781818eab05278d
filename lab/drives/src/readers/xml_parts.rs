//! A large document in parts: the tree of a parser takes about ten times the bytes of the text, so the
//! children of the root are parsed a few at a time.

use std::ops::Range;
use std::path::Path;

use crate::readers::error::ReadError;
use crate::readers::xml::{Element, with_part, with_root};
use crate::readers::xml_limits::exceeded;
use crate::readers::xml_marks::{Kind, Marks};

/// Least bytes of a part but the last.
const PART: usize = 1 << 18;

/// A document, cut between children of its root.
pub(crate) struct Parts<'t> {
    file: &'t Path,
    text: &'t str,
    /// The root's tag, and where its end is.
    open: Range<usize>,
    close: Range<usize>,
    /// The parts of what is between, in their order.
    inner: Vec<Range<usize>>,
}

impl<'t> Parts<'t> {
    /// Cuts a document.
    ///
    /// Errors: a limit is exceeded; it is no XML, where that shows outside of the root's children.
    pub(crate) fn of(file: &'t Path, text: &'t str) -> Result<Self, ReadError> {
        if let Some(limit) = exceeded(text) {
            return Err(ReadError::file(file, limit.to_string()));
        }
        let Some(parts) = Self::cut(file, text) else {
            // No element, or marks that do not match: the parser says what is wrong where; or a root
            // without children.
            with_root(file, text, |_| Ok(()))?;
            let end = text.len();
            return Ok(Self { file, text, open: 0..end, close: end..end, inner: Vec::new() });
        };
        parts.root(|_| Ok(()))?;
        Ok(parts)
    }

    fn cut(file: &'t Path, text: &'t str) -> Option<Self> {
        let mut depth: usize = 0;
        let mut open: Option<Range<usize>> = None;
        let mut inner = Vec::new();
        let mut from = 0;
        for mark in Marks::of(text) {
            match mark.kind {
                Kind::Open { .. } => depth += 1,
                Kind::Close => depth = depth.checked_sub(1)?,
                Kind::Empty { .. } | Kind::Other => {}
                Kind::Broken => return None,
            }
            match (depth, &open) {
                (1, None) => {
                    from = mark.range.end;
                    open = Some(mark.range);
                }
                (1, Some(_)) if mark.range.end - from >= PART => {
                    inner.push(from..mark.range.end);
                    from = mark.range.end;
                }
                (0, Some(open)) if mark.kind == Kind::Close => {
                    inner.push(from..mark.range.start);
                    let (open, close) = (open.clone(), mark.range);
                    return Some(Self { file, text, open, close, inner });
                }
                _ => {}
            }
        }
        None
    }

    /// Gives the root without its children to `read`: its name and attributes.
    pub(crate) fn root<T>(
        &self,
        read: impl FnOnce(Element<'_>) -> Result<T, ReadError>,
    ) -> Result<T, ReadError> {
        let (before, behind) = (&self.text[..self.open.end], &self.text[self.close.start..]);
        with_part(self.file, &format!("{before}{behind}"), 0, read)
    }

    /// Gives the children of the root to `read` in their order.
    pub(crate) fn each_child(
        &self,
        mut read: impl FnMut(Element<'_>) -> Result<(), ReadError>,
    ) -> Result<(), ReadError> {
        let lines = |range: Range<usize>| {
            let count = self.text[range].bytes().filter(|byte| *byte == b'\n').count();
            i64::try_from(count).unwrap_or(i64::MAX)
        };
        let of_tag = lines(self.open.clone());
        let mut before = lines(0..self.open.end) - of_tag;
        for range in &self.inner {
            let [open, inner, close] =
                [&self.open, range, &self.close].map(|range| &self.text[range.clone()]);
            with_part(self.file, &format!("{open}{inner}{close}"), before, |root| {
                root.children().try_for_each(&mut read)
            })?;
            before += lines(range.clone());
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn document(children: usize) -> String {
        let wide = " ".repeat(1000);
        let child =
            |i| format!("<!-- > --><lanelet id='{i}'\n a='/>'>{wide}<x>{i}</x></lanelet>\n<e/>");
        let inner: String = (0..children).map(child).collect();
        format!("<?xml version='1.0'?>\n<r n='<'\n b='1'>{inner}<last/></r>\n<!-- end -->\n")
            .replace("n='<'", "n='&lt;>'")
    }

    /// Names and lines.
    type Children = Vec<(String, Option<u32>)>;

    /// What is read of a document as a whole and in parts: names and the place of each child.
    fn read(text: &str) -> [Result<Children, ReadError>; 2] {
        let file = Path::new("f.xml");
        let place = |child: Element<'_>| (child.name().to_owned(), child.error("", "").line);
        let whole = with_root(file, text, |root| Ok(root.children().map(place).collect()));
        let parts = Parts::of(file, text).and_then(|parts| {
            let mut places = Vec::new();
            parts.each_child(|child| {
                places.push(place(child));
                Ok(())
            })?;
            Ok(places)
        });
        [whole, parts]
    }

    #[test]
    fn parts_hold_what_the_whole_holds_at_the_same_lines() {
        for children in [0, 1, 1_000] {
            let text = document(children);
            let [whole, parts] = read(&text);
            assert_eq!(whole.as_ref().unwrap().len(), 2 * children + 1);
            assert_eq!(whole, parts);
        }
        let text = document(1_000);
        let parts = Parts::of(Path::new("f.xml"), &text).unwrap();
        assert!(parts.inner.len() > 3, "{}", parts.inner.len());
        let attribute = parts.root(|root| root.attribute("b").map(str::to_owned));
        assert_eq!(attribute.unwrap(), "1");
    }

    /// Whatever is broken is refused in both ways, and what is whole is read in both.
    #[test]
    fn a_document_is_refused_in_parts_where_it_is_as_a_whole() {
        let good = document(600);
        let mut refused = 0;
        for (from, to) in [
            ("<x>599</x>", "<x>599</y>"),
            ("<x>10</x>", "<x>10"),
            ("<x>10</x>", "10</x>"),
            ("<last/></r>", "<last/></s>"),
            ("<last/></r>", "<last/>"),
            ("<last/>", "</r><r>"),
            ("<last/>", "<!DOCTYPE r>"),
            ("<last/>", "<![CDATA[</r>]]>"),
            ("<last/>", "&nothing;"),
            ("<last/>", "<n:last/>"),
            ("<!-- end -->", "<end/>"),
            ("<!-- end -->", "<!-- end"),
            ("<r n=", "<r r n="),
            ("id='77'", "id='77' id='77'"),
        ] {
            let [whole, parts] = read(&good.replacen(from, to, 1));
            assert_eq!(whole.is_err(), parts.is_err(), "{to}: {whole:.0?} {parts:.0?}");
            refused += usize::from(parts.is_err());
        }
        assert_eq!(refused, 13);
        for text in ["", " ", "<r/>", "<r></r>", "text", "<r>", "</r>", "<r/><r/>"] {
            let [whole, parts] = read(text);
            assert_eq!(whole.is_err(), parts.is_err(), "{text}: {whole:?} {parts:?}");
        }
    }
}
