//! Parts of records from their text; errors with the path of the field.

use mufasa_model::report::InvalidInput;
use serde::de::DeserializeOwned;
use serde_path_to_error::Segment;

use crate::error::text;
use crate::order::{Cut, Step, ordered, place};

/// How much of a user's text an error repeats.
const EXCERPT_CHARS: usize = 40;

/// Reads a part of a record. Errors name the field below `json`, of several in one object the first
/// in the order of `spec/5-interfaces.md`.
pub fn from_json<T: DeserializeOwned>(json: &str) -> Result<T, InvalidInput> {
    serde_json::from_str(json).map_err(|error| match first_error::<T>(json) {
        Some((path, message)) => problem(&path, &message),
        // What stands behind the record is wrong.
        None => InvalidInput { field: String::new(), index: None, message: text(&error) },
    })
}

/// Where and why a part of a record cannot be read. It is found only when there is an error, because
/// it costs time.
fn first_error<T: DeserializeOwned>(json: &str) -> Option<(Vec<Step>, String)> {
    let (path, message) = error::<T>(&ordered(json, None))?;
    let missing = |depth: usize| {
        let (path, Step::Key(key)) = (&path[..depth], &path[depth]) else { return None };
        let found = error::<T>(&ordered(json, Some(Cut { path, key })))?;
        let is_before = missing_key(&found.1).is_some_and(|it| place(it) < place(key));
        (found.0 == path && is_before).then_some(found)
    };
    (0..path.len()).find_map(missing).or(Some((path, message)))
}

/// The first error of serde, as it reads.
fn error<T: DeserializeOwned>(json: &str) -> Option<(Vec<Step>, String)> {
    let mut reader = serde_json::Deserializer::from_str(json);
    let error = serde_path_to_error::deserialize::<_, T>(&mut reader).err()?;
    let step = |segment: &Segment| match segment {
        Segment::Seq { index } => Some(Step::Index(*index)),
        Segment::Map { key } => Some(Step::Key(key.clone())),
        Segment::Enum { .. } | Segment::Unknown => None,
    };
    Some((error.path().iter().filter_map(step).collect(), text(error.inner())))
}

/// The key that an error says is missing.
fn missing_key(error: &str) -> Option<&str> {
    error.strip_prefix("missing field `")?.split('`').next()
}

/// A place in a record, with and without indices.
#[derive(Default)]
struct Place {
    field: String,
    path: String,
    index: Option<usize>,
}

impl Place {
    fn enter(&mut self, key: &str) {
        let key = excerpt(key);
        for text in [&mut self.field, &mut self.path] {
            text.push_str(if text.is_empty() { "" } else { "." });
            text.push_str(&key);
        }
    }
}

/// The error of serde in our words. It begins with the full path, which has the indices that
/// `field` and `index` have no room for.
fn problem(path: &[Step], error: &str) -> InvalidInput {
    let mut place = Place::default();
    for step in path {
        match step {
            Step::Index(index) => {
                place.index = Some(*index);
                place.path.extend(["[", &index.to_string(), "]"]);
            }
            Step::Key(key) => place.enter(key),
        }
    }
    // Three kinds are errors of the object; which key is wrong stands in their text alone. A key
    // that no struct has ends the path already, one that another type of event has does not.
    let key_after = |start: &str| error.strip_prefix(start)?.split('`').next();
    let is_at_key = matches!(path.last(), Some(Step::Key(_)));
    let what = if let Some(key) = missing_key(error) {
        place.enter(key);
        String::from("is missing")
    } else if let Some(key) = key_after("duplicate field `") {
        place.enter(key);
        String::from("is given twice: remove one")
    } else if let Some(key) = key_after("unknown field `") {
        if !is_at_key {
            place.enter(key);
        }
        String::from("is no field of the schema: remove it")
    } else if let Some((found, wanted)) = error
        .strip_prefix("invalid type: ")
        .or_else(|| error.strip_prefix("invalid value: "))
        .and_then(|error| error.rsplit_once(", expected "))
    {
        format!("must be {}, not {}", plain(wanted), plain(&beginning(found, EXCERPT_CHARS + 20)))
    } else if error.starts_with("must ") {
        error.to_owned()
    } else {
        format!("cannot be read: {}", beginning(error, 4 * EXCERPT_CHARS))
    };
    let Place { field, path, index } = place;
    let path = if path.is_empty() { "the record" } else { &path };
    InvalidInput { field, index, message: format!("{path} {what}") }
}

/// The beginning of a text that may be long, with control characters escaped.
pub fn excerpt(text: &str) -> String {
    let shown: String = text.chars().take(EXCERPT_CHARS).flat_map(char::escape_debug).collect();
    if text.chars().nth(EXCERPT_CHARS).is_some() { shown + "..." } else { shown }
}

/// The words of serde in those of JSON.
fn plain(words: &str) -> &str {
    match words {
        "sequence" | "a sequence" => "a list",
        "map" => "an object",
        "a boolean" => "true or false",
        words => words,
    }
}

fn beginning(text: &str, chars: usize) -> String {
    match text.char_indices().nth(chars) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_owned(),
    }
}
