//! Reading JSON with the original text of its numbers and the path of every error
//! (`spec/5-interfaces.md`: duplicate keys, unknown fields, integers, nearest doubles).

use std::fmt;

use mufasa_model::report::InvalidInput;
use serde::Deserializer;
use serde::de::{IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde_json::value::RawValue;

/// How much of a user's text an error repeats.
const EXCERPT_CHARS: usize = 40;

/// A place in a record, and the JSON text there; `None` when the field is absent.
#[derive(Clone, Copy)]
pub struct Value<'l, 'p> {
    raw: Option<&'l RawValue>,
    at: At<'p>,
}

/// One step of the path per link, so that a path costs nothing until there is an error.
#[derive(Clone, Copy)]
struct At<'p> {
    parent: Option<&'p At<'p>>,
    step: Step,
}

#[derive(Clone, Copy)]
enum Step {
    Record,
    Key(&'static str),
    Index(usize),
}

impl<'l> Value<'l, '_> {
    /// The whole record.
    pub fn record(raw: &'l RawValue) -> Self {
        Self { raw: Some(raw), at: At { parent: None, step: Step::Record } }
    }

    /// The fields `names` of an object, in that order; a key that is not among them, and a key
    /// that is given twice, is an error.
    pub fn object<const N: usize>(
        &self,
        names: [&'static str; N],
    ) -> Result<[Value<'l, '_>; N], InvalidInput> {
        let text = self.expect(Shape::Object)?;
        let mut found = [None; N];
        let mut problem = None;
        let visitor =
            Fields { at: &self.at, names: &names, found: &mut found, problem: &mut problem };
        let read = serde_json::Deserializer::from_str(text).deserialize_map(visitor);
        self.read(read, problem)?;
        let mut fields = names.map(|name| Value { raw: None, at: self.at.then(Step::Key(name)) });
        for (field, raw) in fields.iter_mut().zip(found) {
            field.raw = raw;
        }
        Ok(fields)
    }

    /// One field of an object, whatever the others are; an error when it is given twice.
    pub fn field(&self, name: &'static str) -> Result<Value<'l, '_>, InvalidInput> {
        let text = self.expect(Shape::Object)?;
        let at = self.at.then(Step::Key(name));
        let (mut raw, mut problem) = (None, None);
        let visitor = Field { at: &at, name, found: &mut raw, problem: &mut problem };
        let read = serde_json::Deserializer::from_str(text).deserialize_map(visitor);
        self.read(read, problem)?;
        Ok(Value { raw, at })
    }

    /// The elements of a list, each read by `element`; the first error ends the list.
    pub fn list<T>(
        &self,
        element: impl FnMut(Value<'l, '_>) -> Result<T, InvalidInput>,
    ) -> Result<Vec<T>, InvalidInput> {
        let text = self.expect(Shape::List)?;
        let mut items = Vec::new();
        let mut problem = None;
        let visitor = Elements { at: &self.at, element, items: &mut items, problem: &mut problem };
        let read = serde_json::Deserializer::from_str(text).deserialize_seq(visitor);
        self.read(read, problem)?;
        Ok(items)
    }

    /// The nearest double; `"nan"`, `"inf"` and `"-inf"` stand for those values.
    pub fn float(&self) -> Result<f64, InvalidInput> {
        let text = self.text()?;
        match Shape::of(text) {
            // `str::parse` rounds correctly and gives an infinity beyond the range of doubles.
            Shape::Number => text.parse().map_err(|_| self.problem("must be a number")),
            Shape::String => match self.string()?.as_str() {
                "nan" => Ok(f64::NAN),
                "inf" => Ok(f64::INFINITY),
                "-inf" => Ok(f64::NEG_INFINITY),
                other => Err(self.problem(format_args!(
                    "must be a number, \"nan\", \"inf\" or \"-inf\", not \"{}\"",
                    excerpt(other)
                ))),
            },
            shape => Err(self.problem(format_args!("must be a number, not {shape}"))),
        }
    }

    /// A signed 64-bit integer, written without fraction and exponent.
    pub fn integer(&self) -> Result<i64, InvalidInput> {
        let text = self.expect(Shape::Number)?;
        text.parse().map_err(|_| {
            self.problem(format_args!(
                "must be an integer from -2^63 to 2^63 - 1 without fraction or exponent, not {}",
                excerpt(text)
            ))
        })
    }

    /// `true` or `false`.
    pub fn boolean(&self) -> Result<bool, InvalidInput> {
        Ok(self.expect(Shape::Boolean)? == "true")
    }

    /// A string, unescaped.
    pub fn string(&self) -> Result<String, InvalidInput> {
        let text = self.expect(Shape::String)?;
        serde_json::from_str(text)
            .map_err(|error| self.problem(format_args!("is not a valid string: {error}")))
    }

    /// One of `choices`, by its name.
    pub fn choice<T: Copy>(
        &self,
        choices: &[T],
        name: impl Fn(T) -> &'static str,
    ) -> Result<T, InvalidInput> {
        let word = self.string()?;
        choices.iter().copied().find(|choice| name(*choice) == word).ok_or_else(|| {
            let names: Vec<_> = choices.iter().map(|choice| name(*choice)).collect();
            self.problem(format_args!("must be {}, not {}", names.join(" or "), excerpt(&word)))
        })
    }

    /// `None` when the field is absent.
    pub fn present(&self) -> Option<Self> {
        self.raw.map(|_| *self)
    }

    /// `None` when the field is absent or null.
    pub fn given(&self) -> Option<Self> {
        self.raw.filter(|raw| raw.get() != "null").map(|_| *self)
    }

    /// An error about this value. The message begins with the full path, which has the indices
    /// that `field` and `index` have no room for.
    pub fn problem(&self, message: impl fmt::Display) -> InvalidInput {
        self.at.problem(message)
    }

    fn text(&self) -> Result<&'l str, InvalidInput> {
        self.raw.map(RawValue::get).ok_or_else(|| self.problem("is missing"))
    }

    fn expect(&self, wanted: Shape) -> Result<&'l str, InvalidInput> {
        let text = self.text()?;
        let shape = Shape::of(text);
        if shape == wanted {
            Ok(text)
        } else {
            Err(self.problem(format_args!("must be {wanted}, not {shape}")))
        }
    }

    /// A problem found on the way goes first; what remains are strings that do not decode.
    fn read(
        &self,
        read: Result<(), serde_json::Error>,
        problem: Option<InvalidInput>,
    ) -> Result<(), InvalidInput> {
        match (problem, read) {
            (Some(problem), _) => Err(problem),
            (None, Err(error)) => Err(self.problem(format_args!("cannot be read: {error}"))),
            (None, Ok(())) => Ok(()),
        }
    }
}

/// The beginning of a text that may be long, with control characters escaped.
pub fn excerpt(text: &str) -> String {
    let mut chars = text.chars();
    let mut shown: String =
        chars.by_ref().take(EXCERPT_CHARS).flat_map(char::escape_debug).collect();
    if chars.next().is_some() {
        shown.push_str("...");
    }
    shown
}

impl<'p> At<'p> {
    fn then<'q>(&'q self, step: Step) -> At<'q>
    where
        'p: 'q,
    {
        At { parent: Some(self), step }
    }

    fn problem(&self, message: impl fmt::Display) -> InvalidInput {
        self.problem_below(None, message)
    }

    /// `key` is one more step, a key that the schema does not know.
    fn problem_below(&self, key: Option<&str>, message: impl fmt::Display) -> InvalidInput {
        let mut steps = Vec::new();
        let mut here = Some(self);
        while let Some(at) = here {
            steps.push(at.step);
            here = at.parent;
        }
        let (mut field, mut path, mut index) = (String::new(), String::new(), None);
        for step in steps.into_iter().rev() {
            match step {
                Step::Record => {}
                Step::Key(key) => enter(key, &mut field, &mut path),
                Step::Index(i) => {
                    index = Some(i);
                    path.extend(["[", &i.to_string(), "]"]);
                }
            }
        }
        if let Some(key) = key {
            enter(&excerpt(key), &mut field, &mut path);
        }
        if path.is_empty() {
            path.push_str("the record");
        }
        InvalidInput { field, index, message: format!("{path} {message}") }
    }
}

/// Goes on to a key below both paths.
fn enter(key: &str, field: &mut String, path: &mut String) {
    for text in [field, path] {
        if !text.is_empty() {
            text.push('.');
        }
        text.push_str(key);
    }
}

/// What kind of JSON value a text is; its first byte tells, because the line was scanned before.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Shape {
    Object,
    List,
    String,
    Boolean,
    Null,
    Number,
}

impl Shape {
    fn of(text: &str) -> Self {
        match text.as_bytes().first() {
            Some(b'{') => Self::Object,
            Some(b'[') => Self::List,
            Some(b'"') => Self::String,
            Some(b't' | b'f') => Self::Boolean,
            Some(b'n') => Self::Null,
            Some(_) | None => Self::Number,
        }
    }
}

impl fmt::Display for Shape {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            Self::Object => "an object",
            Self::List => "a list",
            Self::String => "a string",
            Self::Boolean => "true or false",
            Self::Null => "null",
            Self::Number => "a number",
        })
    }
}

/// Collects the values of known keys; stops at the first key that is unknown or repeated, so that
/// a hostile object costs no memory.
struct Fields<'l, 'v> {
    at: &'v At<'v>,
    names: &'v [&'static str],
    found: &'v mut [Option<&'l RawValue>],
    problem: &'v mut Option<InvalidInput>,
}

impl<'l> Visitor<'l> for Fields<'l, '_> {
    type Value = ();

    fn expecting(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str("an object")
    }

    fn visit_map<M: MapAccess<'l>>(self, mut map: M) -> Result<(), M::Error> {
        while let Some(key) = map.next_key::<String>()? {
            let wrong = match self.names.iter().position(|name| *name == key) {
                Some(i) if self.found[i].is_none() => {
                    self.found[i] = Some(map.next_value()?);
                    continue;
                }
                Some(_) => "is given twice: remove one",
                None => "is no field of the schema: remove it",
            };
            *self.problem = Some(self.at.problem_below(Some(&key), wrong));
            return Err(serde::de::Error::custom(wrong));
        }
        Ok(())
    }
}

/// Finds one field and reads over all others.
struct Field<'l, 'v> {
    at: &'v At<'v>,
    name: &'static str,
    found: &'v mut Option<&'l RawValue>,
    problem: &'v mut Option<InvalidInput>,
}

impl<'l> Visitor<'l> for Field<'l, '_> {
    type Value = ();

    fn expecting(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str("an object")
    }

    fn visit_map<M: MapAccess<'l>>(self, mut map: M) -> Result<(), M::Error> {
        while let Some(key) = map.next_key::<String>()? {
            if key == self.name {
                if self.found.replace(map.next_value()?).is_some() {
                    *self.problem = Some(self.at.problem("is given twice: remove one"));
                }
            } else {
                map.next_value::<IgnoredAny>()?;
            }
        }
        Ok(())
    }
}

/// Reads the elements of a list one after the other.
struct Elements<'v, T, F> {
    at: &'v At<'v>,
    element: F,
    items: &'v mut Vec<T>,
    problem: &'v mut Option<InvalidInput>,
}

impl<'l, T, F> Visitor<'l> for Elements<'_, T, F>
where
    F: FnMut(Value<'l, '_>) -> Result<T, InvalidInput>,
{
    type Value = ();

    fn expecting(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str("a list")
    }

    fn visit_seq<S: SeqAccess<'l>>(mut self, mut seq: S) -> Result<(), S::Error> {
        while let Some(raw) = seq.next_element::<&RawValue>()? {
            let at = self.at.then(Step::Index(self.items.len()));
            match (self.element)(Value { raw: Some(raw), at }) {
                Ok(item) => self.items.push(item),
                Err(found) => {
                    *self.problem = Some(found);
                    return Err(serde::de::Error::custom("an element is wrong"));
                }
            }
        }
        Ok(())
    }
}
