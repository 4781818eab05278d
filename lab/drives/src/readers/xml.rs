//! XML with the place of every complaint. A document is read from its start to its end, and of the children of its
//! root one is kept at a time: the whole tree would take many times the bytes of the text.

use std::path::Path;
use std::ptr;

use quick_xml::escape::resolve_predefined_entity;
use quick_xml::events::{BytesRef, BytesStart, Event};
use quick_xml::{Error, Reader, XmlVersion};

use crate::geometry::Point;
use crate::readers::error::{ReadError, quoted};

const CUT_OFF: &str = "cut off: it ends here, within its root element; get the file again";
const NO_TYPE: &str = "a document type (`<!DOCTYPE`) is not read, because its entities can make a small \
                       file endless; no CommonRoad file needs one: remove it";
/// Limits of a document; files of `CommonRoad` nest less than 10 deep and have less than 10 attributes on an
/// element. Each attribute is held against all others, and elements are freed from the outside inwards.
const DEPTH_MAX: usize = 64;
const ATTRIBUTES_MAX: usize = 256;
const LIMIT: &str = "the most that is read; no CommonRoad file needs so many";
/// Positions of `spec/4-arithmetic.md#domain`, m.
const POSITION_MAX: f64 = 16_777_216.0;
/// The domain of speeds (`spec/4-arithmetic.md`), m/s.
const SPEED_MAX: f64 = 1.5e9;

/// An element with all that is in it.
#[derive(Default)]
struct Node {
    name: String,
    attributes: Vec<(String, String)>,
    text: String,
    /// Where it begins, in bytes of the text.
    at: usize,
    children: Vec<Self>,
}

/// A document, read up to its root's tag, or up to behind some child of it.
pub(crate) struct Document<'t> {
    file: &'t Path,
    text: &'t str,
    reader: Reader<&'t [u8]>,
    root: Node,
    /// Whether the end of the root is still to come.
    is_open: bool,
}

impl<'t> Document<'t> {
    /// Reads up to the root.
    ///
    /// Errors: it is no XML up to there.
    pub(crate) fn of(file: &'t Path, text: &'t str) -> Result<Self, ReadError> {
        let (root, is_open) = (Node::default(), false);
        let mut document = Self { file, text, reader: Reader::from_str(text), root, is_open };
        let (root, is_open) = document.first()?;
        Ok(Self { root, is_open, ..document })
    }

    /// Reads a document as a whole.
    pub(crate) fn whole(file: &'t Path, text: &'t str) -> Result<Self, ReadError> {
        let mut document = Self::of(file, text)?;
        while let Some(child) = document.next()? {
            document.root.children.push(child);
        }
        Ok(document)
    }

    /// The root, with no other child than the last one where it was not read as a whole.
    pub(crate) fn root(&self) -> Element<'_> {
        Element { file: self.file, text: self.text, above: &self.root, node: &self.root }
    }

    /// Gives the children of the root to `read` in their order.
    pub(crate) fn each_child(
        &mut self,
        mut read: impl FnMut(Element<'_>) -> Result<(), ReadError>,
    ) -> Result<(), ReadError> {
        while let Some(child) = self.next()? {
            // A path goes from the root down to one child.
            self.root.children = vec![child];
            read(Element { node: &self.root.children[0], ..self.root() })?;
        }
        Ok(())
    }

    /// The root's tag, and whether it is not its end, too.
    fn first(&mut self) -> Result<(Node, bool), ReadError> {
        loop {
            let at = self.position();
            match self.event()? {
                Event::Start(tag) => return Ok((self.node(&tag, at)?, true)),
                Event::Empty(tag) => return Ok((self.node(&tag, at)?, false)),
                event => self.outside(&event, at)?,
            }
        }
    }

    /// The next child of the root; none behind the last one, where the document has to end.
    fn next(&mut self) -> Result<Option<Node>, ReadError> {
        let mut open: Vec<Node> = Vec::new();
        loop {
            let at = self.position();
            let event = self.event()?;
            let whole = match event {
                Event::Eof if !self.is_open => return Ok(None),
                event if !self.is_open => {
                    self.outside(&event, at)?;
                    continue;
                }
                Event::Eof => return Err(self.cut_off()),
                Event::Start(tag) => {
                    let node = self.node(&tag, at)?;
                    open.push(node);
                    // With the root.
                    if open.len() >= DEPTH_MAX {
                        let message = format!("elements nest deeper than {DEPTH_MAX}, {LIMIT}");
                        return Err(self.wrong(at, message));
                    }
                    continue;
                }
                Event::Empty(tag) => Some(self.node(&tag, at)?),
                Event::End(_) => {
                    let whole = open.pop();
                    self.is_open = whole.is_some();
                    whole
                }
                event => {
                    let words = self.words(&event, at)?;
                    if let Some(node) = open.last_mut()
                        && !(node.text.is_empty() && words.trim().is_empty())
                    {
                        node.text.push_str(&words);
                    }
                    continue;
                }
            };
            match (whole, open.last_mut()) {
                (Some(node), Some(parent)) => parent.children.push(node),
                (Some(node), None) => return Ok(Some(node)),
                (None, _) => {}
            }
        }
    }

    fn event(&mut self) -> Result<Event<'t>, ReadError> {
        self.reader.read_event().map_err(|error| match error {
            // Whatever has no end.
            Error::Syntax(_) => self.cut_off(),
            error => {
                let at = usize::try_from(self.reader.error_position()).unwrap_or(usize::MAX);
                self.broken(at, &error.to_string())
            }
        })
    }

    /// What an event is outside of the root: nothing, or an error.
    fn outside(&self, event: &Event<'_>, at: usize) -> Result<(), ReadError> {
        match event {
            Event::Eof => Err(self.broken(at, "there is no element")),
            Event::Start(_) | Event::Empty(_) | Event::End(_) => {
                Err(self.broken(at, "there is a second root element"))
            }
            event if !self.words(event, at)?.trim().is_empty() => {
                Err(self.broken(at, "there is text outside of the root element"))
            }
            _ => Ok(()),
        }
    }

    /// The text of an event that is no tag.
    fn words(&self, event: &Event<'_>, at: usize) -> Result<String, ReadError> {
        let words = match event {
            Event::Text(text) => text.decode().map(String::from),
            Event::CData(text) => text.decode().map(String::from),
            Event::GeneralRef(reference) => return self.character(reference, at),
            Event::DocType(_) => return Err(self.wrong(at, NO_TYPE.to_owned())),
            _ => Ok(String::new()),
        };
        words.map_err(|error| self.broken(at, &error.to_string()))
    }

    fn character(&self, reference: &BytesRef<'_>, at: usize) -> Result<String, ReadError> {
        let failed = |error: String| self.broken(at, &error);
        let number = reference.resolve_char_ref().map_err(|error| failed(error.to_string()))?;
        let name = reference.decode().map_err(|error| failed(error.to_string()))?;
        let known = || resolve_predefined_entity(&name).map(str::to_owned);
        let unknown = || failed(format!("there is no entity {}", quoted(&name)));
        number.map(String::from).or_else(known).ok_or_else(unknown)
    }

    fn node(&self, tag: &BytesStart<'_>, at: usize) -> Result<Node, ReadError> {
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        let mut attributes = Vec::new();
        for attribute in tag.attributes() {
            if attributes.len() == ATTRIBUTES_MAX {
                let message =
                    format!("an element has more than {ATTRIBUTES_MAX} attributes, {LIMIT}");
                return Err(self.wrong(at, message));
            }
            let attribute = attribute.map_err(|error| self.broken(at, &error.to_string()))?;
            let value = attribute.normalized_value(XmlVersion::Implicit1_0);
            let value = value.map_err(|error| self.broken(at, &error.to_string()))?;
            attributes.push((text(attribute.key.as_ref()), value.into_owned()));
        }
        let name = text(tag.name().as_ref());
        Ok(Node { name, attributes, at, ..Node::default() })
    }

    fn position(&self) -> usize {
        usize::try_from(self.reader.buffer_position()).unwrap_or(usize::MAX)
    }

    fn cut_off(&self) -> ReadError {
        let rows = u32::try_from(self.text.lines().count()).unwrap_or(u32::MAX);
        ReadError::file(self.file, CUT_OFF).line(rows)
    }

    fn broken(&self, at: usize, why: &str) -> ReadError {
        self.wrong(at, format!("not well-formed XML: {why}"))
    }

    fn wrong(&self, at: usize, message: String) -> ReadError {
        ReadError::file(self.file, message).line(row(self.text, at))
    }
}

/// The row of a byte, from 1.
fn row(text: &str, at: usize) -> u32 {
    let before = text.bytes().take(at).filter(|byte| *byte == b'\n').count();
    u32::try_from(before).unwrap_or(u32::MAX).saturating_add(1)
}

/// An element of a document.
#[derive(Clone, Copy)]
pub(crate) struct Element<'a> {
    file: &'a Path,
    text: &'a str,
    /// The root.
    above: &'a Node,
    node: &'a Node,
}

impl<'a> Element<'a> {
    pub(crate) fn name(self) -> &'a str {
        &self.node.name
    }

    /// An error at this element.
    pub(crate) fn error(self, field: &str, message: impl Into<String>) -> ReadError {
        let row = row(self.text, self.node.at);
        ReadError::file(self.file, message).line(row).at(self.path(), field)
    }

    fn path(self) -> String {
        let mut names = Vec::new();
        trail(self.above, self.node, &mut names);
        names.join("/")
    }

    pub(crate) fn children(self) -> impl Iterator<Item = Element<'a>> {
        self.node.children.iter().map(move |node| Element { node, ..self })
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
        self.node.text.trim()
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

    /// The velocity of this element, if it is in the domain.
    pub(crate) fn velocity(self, speed: f64) -> Result<f64, ReadError> {
        let message = || format!("{speed} m/s is not within +-{SPEED_MAX} m/s");
        (speed.abs() <= SPEED_MAX).then_some(speed).ok_or_else(|| self.error("velocity", message()))
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

impl Node {
    fn attribute(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(own, _)| own == name).map(|(_, value)| value.as_str())
    }
}

/// The names from one element down to another, with ids; whether it is there.
fn trail(from: &Node, to: &Node, names: &mut Vec<String>) -> bool {
    names.push(match from.attribute("id") {
        Some(id) => format!("{}[{id}]", from.name),
        None => from.name.clone(),
    });
    let is_there = ptr::eq(from, to) || from.children.iter().any(|child| trail(child, to, names));
    if !is_there {
        names.pop();
    }
    is_there
}

#[cfg(test)]
mod tests;
