//! Parts of records from their text; errors with the path of the field.

use mufasa_model::report::InvalidInput;
use serde::de::DeserializeOwned;
use serde_path_to_error::{Path, Segment};

use crate::error::text;

/// How much of a user's text an error repeats.
const EXCERPT_CHARS: usize = 40;

/// Reads a part of a record. Errors name the field below `json`.
pub fn from_json<T: DeserializeOwned>(json: &str) -> Result<T, InvalidInput> {
    serde_json::from_str(json).map_err(|error| {
        // The path costs time and is only needed when there is an error.
        let mut reader = serde_json::Deserializer::from_str(json);
        match serde_path_to_error::deserialize::<_, T>(&mut reader) {
            Err(error) => problem(error.path(), &text(error.inner())),
            // What stands behind the record is wrong.
            Ok(_) => InvalidInput { field: String::new(), index: None, message: text(&error) },
        }
    })
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
fn problem(path: &Path, error: &str) -> InvalidInput {
    let mut place = Place::default();
    for segment in path {
        match segment {
            Segment::Seq { index } => {
                place.index = Some(*index);
                place.path.extend(["[", &index.to_string(), "]"]);
            }
            Segment::Map { key } => place.enter(key),
            Segment::Enum { .. } | Segment::Unknown => {}
        }
    }
    // These three are errors of the object; which key is wrong stands in their text alone. A key
    // that no struct has ends the path already, one that another type of event has does not.
    let key_after = |start: &str| error.strip_prefix(start)?.split('`').next();
    let is_at_key = matches!(path.iter().next_back(), Some(Segment::Map { .. }));
    let what = if let Some(key) = key_after("missing field `") {
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
