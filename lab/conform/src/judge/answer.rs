//! What a program under test answers. Only `id`, `verdict` and `failed_stage` of a cycle,
//! `states` of a trace, `compositions` and `none` of a composition are needed
//! (`spec/5-interfaces.md#programs-under-test`); the place of what is invalid is looked at where it
//! is given.

use std::fmt;

use mufasa_model::report::{FailedStage, Stage};
use serde::de::{Deserialize, Deserializer, Error, MapAccess, Visitor};
use serde_json::{Map, Value};

use crate::judge::class::Breach;
use crate::subject::{Broken, excerpt};

/// The answer to a cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Said {
    /// The cycle is safe (`None`), or fails at a stage.
    Verdict(Option<FailedStage>),
    /// The local input is invalid.
    Error,
}

/// The object on an answer's line, for the record with this id. `is_record` is false for a line
/// that is none: its id is null in the answer when it could not be read.
pub fn object(line: &[u8], id: &str, is_record: bool) -> Result<Map<String, Value>, Broken> {
    let nonsense = |words: String| Broken::new(Breach::Nonsense, words);
    let Once(object) = serde_json::from_slice(line).map_err(|error| {
        let what = if error.is_data() { "is no answer" } else { "is not JSON" };
        nonsense(format!("{what} ({error}): {}", excerpt(line)))
    })?;
    match object.get("id") {
        Some(Value::String(given)) if given == id => Ok(object),
        Some(Value::Null) if !is_record => Ok(object),
        Some(Value::String(given)) => {
            Err(Broken::new(Breach::OutOfOrder, format!("answers {given:?}, but {id:?} was asked")))
        }
        Some(_) | None => {
            Err(nonsense(format!("`id` must be the record's, {id:?}: {}", excerpt(line))))
        }
    }
}

/// The verdict in an answer to a cycle.
pub fn said(object: &Map<String, Value>) -> Result<Said, Broken> {
    let nonsense = |words: String| Broken::new(Breach::Nonsense, words);
    let failed = match object.get("failed_stage") {
        Some(Value::Null) => None,
        Some(Value::String(name)) => Some(stage(name).ok_or_else(|| {
            nonsense(format!(
                "`failed_stage` must be null, input, i, ii, iii, iv, v or no_obstacle_check, not \
                 {name:?}"
            ))
        })?),
        Some(other) => {
            return Err(nonsense(format!("`failed_stage` must be a string or null, not {other}")));
        }
        None => {
            return Err(nonsense(String::from("has no `failed_stage` (null where none failed)")));
        }
    };
    match (object.get("verdict").and_then(Value::as_str), failed) {
        (Some("safe"), None) => Ok(Said::Verdict(None)),
        (Some("unsafe"), Some(failed)) => Ok(Said::Verdict(Some(failed))),
        (Some("error"), None) => Ok(Said::Error),
        (Some("unsafe"), None) => Err(nonsense(String::from("is unsafe without a `failed_stage`"))),
        (Some(verdict @ ("safe" | "error")), Some(_)) => {
            Err(nonsense(format!("`failed_stage` must be null when the verdict is {verdict}")))
        }
        (_, _) => Err(nonsense(format!(
            "`verdict` must be safe, unsafe or error, not {}",
            object.get("verdict").unwrap_or(&Value::Null)
        ))),
    }
}

/// A list under a key of an answer.
pub fn list<'a>(object: &'a Map<String, Value>, key: &str) -> Result<&'a [Value], Broken> {
    match object.get(key) {
        Some(Value::Array(items)) => Ok(items),
        Some(_) | None => Err(Broken::new(Breach::Nonsense, format!("has no list `{key}`"))),
    }
}

/// Whether an answer says that the record is invalid.
pub fn is_error(object: &Map<String, Value>) -> bool {
    object.get("verdict").and_then(Value::as_str) == Some("error")
}

/// Whether a place is named in an answer, but not this one.
pub fn names_another(given: Option<&Value>, field: &str, index: Option<usize>) -> bool {
    let named = given.and_then(|given| given.get("field"));
    let at = given.and_then(|given| given.get("index")).unwrap_or(&Value::Null);
    named.is_some_and(|named| *named != field || *at != Value::from(index))
}

/// An answer in short: what it says, then how it begins.
pub fn in_short(line: &[u8]) -> String {
    let object = serde_json::from_slice::<Map<String, Value>>(line).unwrap_or_default();
    let said = ["verdict", "failed_stage"].map(|key| object.get(key).map(Value::to_string));
    match said {
        [Some(verdict), Some(failed)] => {
            format!("verdict {verdict}, failed_stage {failed}: {}", excerpt(line))
        }
        _ => excerpt(line),
    }
}

/// An object in which no key stands twice: of two, one reader would take the first and another
/// the last.
struct Once(Map<String, Value>);

impl<'de> Deserialize<'de> for Once {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Keys;
        impl<'de> Visitor<'de> for Keys {
            type Value = Once;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a JSON object")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut pairs: A) -> Result<Once, A::Error> {
                let mut object = Map::new();
                while let Some((key, value)) = pairs.next_entry::<String, Value>()? {
                    if object.contains_key(&key) {
                        return Err(A::Error::custom(format_args!("the key {key:?} stands twice")));
                    }
                    object.insert(key, value);
                }
                Ok(Once(object))
            }
        }
        deserializer.deserialize_map(Keys)
    }
}

fn stage(name: &str) -> Option<FailedStage> {
    Some(match name {
        "input" => FailedStage::Input,
        "i" => FailedStage::Stage(Stage::I),
        "ii" => FailedStage::Stage(Stage::Ii),
        "iii" => FailedStage::Stage(Stage::Iii),
        "iv" => FailedStage::Stage(Stage::Iv),
        "v" => FailedStage::Stage(Stage::V),
        "no_obstacle_check" => FailedStage::NoObstacleCheck,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(line: &str) -> Result<Said, Breach> {
        object(line.as_bytes(), "c-1", true)
            .and_then(|it| said(&it))
            .map_err(|broken| broken.breach)
    }

    #[test]
    fn three_keys_are_enough_and_others_are_passed_over() {
        let iii = Said::Verdict(Some(FailedStage::Stage(Stage::Iii)));
        for (line, expected) in [
            (r#"{"id": "c-1", "verdict": "safe", "failed_stage": null}"#, Said::Verdict(None)),
            (r#"{"failed_stage": "iii", "verdict": "unsafe", "id": "c-1", "x": [1]}"#, iii),
            (r#"{"id": "c-1", "verdict": "error", "failed_stage": null}"#, Said::Error),
        ] {
            assert_eq!(read(line), Ok(expected), "{line}");
        }
    }

    #[test]
    fn what_contradicts_itself_or_is_unknown_is_nonsense() {
        for line in [
            "",
            "safe",
            "[]",
            "{}",
            r#"{"id": 1, "verdict": "safe", "failed_stage": null}"#,
            r#"{"id": null, "verdict": "error", "failed_stage": null}"#,
            r#"{"id": "c-1", "verdict": "safe"}"#,
            r#"{"id": "c-1", "verdict": "safe", "failed_stage": "i"}"#,
            r#"{"id": "c-1", "verdict": "unsafe", "failed_stage": null}"#,
            r#"{"id": "c-1", "verdict": "unsafe", "failed_stage": "vi"}"#,
            r#"{"id": "c-1", "verdict": "unsafe", "failed_stage": 3}"#,
            r#"{"id": "c-1", "verdict": "perhaps", "failed_stage": null}"#,
            r#"{"verdict": "unsafe", "id": "c-1", "verdict": "safe", "failed_stage": null}"#,
            "{\"id\": \"c-1\", \"verdict\": \"safe\", \"failed_stage\": null} x",
        ] {
            assert_eq!(read(line), Err(Breach::Nonsense), "{line}");
        }
        let other = r#"{"id": "c-2", "verdict": "safe", "failed_stage": null}"#;
        assert_eq!(read(other), Err(Breach::OutOfOrder));
    }
}
