//! XML with the place of every complaint.

use std::path::Path;

use roxmltree::{Document, Error, Node};

use crate::geometry::Point;
use crate::readers::error::{ReadError, quoted};
use crate::readers::xml_limits::exceeded;
use crate::readers::xml_marks::{Kind, Marks};

const CUT_OFF: &str = "cut off: it ends here, within its root element; get the file again";
const NO_TYPE: &str = "a document type (`<!DOCTYPE`) is not read, because its entities can make a small \
                       file endless; no CommonRoad file needs one: remove it";
/// Positions of `spec/4-arithmetic.md#domain`, m.
const POSITION_MAX: f64 = 16_777_216.0;

/// Parses a document and gives its root element to `read`.
pub(crate) fn with_root<T>(
    file: &Path,
    text: &str,
    read: impl FnOnce(Element<'_>) -> Result<T, ReadError>,
) -> Result<T, ReadError> {
    if let Some(limit) = exceeded(text) {
        return Err(ReadError::file(file, limit.to_string()));
    }
    with_part(file, text, 0, read)
}

/// Parses a part of a file that is a document of its own and gives its root element to `read`; `before`:
/// lines of the file that are before it.
pub(crate) fn with_part<T>(
    file: &Path,
    text: &str,
    before: i64,
    read: impl FnOnce(Element<'_>) -> Result<T, ReadError>,
) -> Result<T, ReadError> {
    let document = Document::parse(text).map_err(|e| {
        let (row, message) = match e {
            Error::UnclosedRootNode => (text.lines().count(), String::from(CUT_OFF)),
            Error::DtdDetected => (row_of_type(text), String::from(NO_TYPE)),
            _ => (e.pos().row as usize, format!("not well-formed XML: {e}")),
        };
        let row = u32::try_from(row).unwrap_or(u32::MAX);
        ReadError::file(file, message).line(line(before, row))
    })?;
    read(Element { file, before, node: document.root_element() })
}

/// The row of a document type, from 1: it is the first mark that is none.
fn row_of_type(text: &str) -> usize {
    let broken = Marks::of(text).find(|mark| mark.kind == Kind::Broken);
    let start = broken.map_or(0, |mark| mark.range.start);
    1 + text[..start].matches('\n').count()
}

/// The line of a file of a row of a part.
fn line(before: i64, row: u32) -> u32 {
    u32::try_from(before + i64::from(row)).unwrap_or(u32::MAX)
}

/// An element of a document.
#[derive(Clone, Copy)]
pub(crate) struct Element<'a> {
    file: &'a Path,
    before: i64,
    node: Node<'a, 'a>,
}

impl<'a> Element<'a> {
    pub(crate) fn name(self) -> &'a str {
        self.node.tag_name().name()
    }

    /// An error at this element.
    pub(crate) fn error(self, field: &str, message: impl Into<String>) -> ReadError {
        let position = self.node.document().text_pos_at(self.node.range().start);
        let row = line(self.before, position.row);
        ReadError::file(self.file, message).line(row).at(self.path(), field)
    }

    fn path(self) -> String {
        let mut names: Vec<String> = self
            .node
            .ancestors()
            .filter(Node::is_element)
            .map(|n| match n.attribute("id") {
                Some(id) => format!("{}[{id}]", n.tag_name().name()),
                None => n.tag_name().name().to_owned(),
            })
            .collect();
        names.reverse();
        names.join("/")
    }

    pub(crate) fn children(self) -> impl Iterator<Item = Element<'a>> {
        let nodes = self.node.children().filter(Node::is_element);
        nodes.map(move |node| Element { node, ..self })
    }

    pub(crate) fn all(self, name: &'static str) -> impl Iterator<Item = Element<'a>> {
        self.children().filter(move |e| e.name() == name)
    }

    pub(crate) fn find(self, name: &'static str) -> Option<Element<'a>> {
        self.all(name).next()
    }

    pub(crate) fn get(self, name: &'static str) -> Result<Element<'a>, ReadError> {
        self.find(name).ok_or_else(|| self.error(name, "this element is missing"))
    }

    pub(crate) fn text(self) -> &'a str {
        self.node.text().unwrap_or("").trim()
    }

    pub(crate) fn attribute(self, name: &str) -> Result<&'a str, ReadError> {
        let value = self.node.attribute(name);
        value.ok_or_else(|| self.error(name, "this attribute is missing"))
    }

    /// An attribute that is an integer, such as `id` or `ref`.
    pub(crate) fn integer_attribute(self, name: &str) -> Result<i64, ReadError> {
        let value = self.attribute(name)?;
        value
            .trim()
            .parse()
            .map_err(|_| self.error(name, format!("{} is no integer", quoted(value))))
    }

    /// The text as a finite number.
    pub(crate) fn number(self) -> Result<f64, ReadError> {
        let number: f64 = self.text().parse().map_err(|_| self.not_a_number())?;
        if number.is_finite() { Ok(number) } else { Err(self.not_a_number()) }
    }

    /// The text as an integer not below zero, such as a time step.
    pub(crate) fn step(self) -> Result<i64, ReadError> {
        let step: i64 = self.text().parse().map_err(|_| self.not_a_number())?;
        if (0..=1_000_000).contains(&step) {
            Ok(step)
        } else {
            Err(self.error("", format!("time step {step} is not within 0 and 1000000")))
        }
    }

    fn not_a_number(self) -> ReadError {
        self.error("", format!("{} is no number that can stand here", quoted(self.text())))
    }

    /// A number within bounds, in the child `name`.
    pub(crate) fn number_in(
        self,
        name: &'static str,
        low: f64,
        high: f64,
    ) -> Result<f64, ReadError> {
        let child = self.get(name)?;
        let number = child.number()?;
        if (low..=high).contains(&number) {
            Ok(number)
        } else {
            Err(child.error("", format!("{number} is not within {low} and {high}")))
        }
    }

    /// The children x and y as a position.
    pub(crate) fn point(self) -> Result<Point, ReadError> {
        Ok([
            self.number_in("x", -POSITION_MAX, POSITION_MAX)?,
            self.number_in("y", -POSITION_MAX, POSITION_MAX)?,
        ])
    }

    /// The children named `point`, each a position.
    pub(crate) fn points(self) -> Result<Vec<Point>, ReadError> {
        // Counted first, so that there is room for no more.
        let mut points = Vec::with_capacity(self.all("point").count());
        for (i, point) in self.all("point").enumerate() {
            points.push(point.point().map_err(|e| e.index(i))?);
        }
        Ok(points)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_names_line_element_and_value() {
        let text = "<r>\n <lanelet id=\"7\">\n  <x>1e999</x></lanelet></r>";
        let error = with_root(Path::new("f.xml"), text, |root| {
            root.get("lanelet")?.number_in("x", 0.0, 1.0).map(drop)
        });
        let error = error.unwrap_err();
        assert_eq!((error.line, error.element.as_str()), (Some(3), "r/lanelet[7]/x"));
        assert!(error.message.contains("1e999"), "{error}");
    }
}
