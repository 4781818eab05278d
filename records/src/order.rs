//! Of several problems in one object the first in the order of the keys of `spec/5-interfaces.md` is
//! named, however the line orders them: the text is put into that order before its error is looked
//! for, and a key that is missing counts at its place.

use std::fmt::{self, Formatter};

use serde::de::{Deserialize, Deserializer, MapAccess, Visitor};
use serde_json::value::RawValue;
use serde_json::{from_str, to_string};

/// The keys of records but for parameters of the stages, so that those of each object stand in its order.
#[rustfmt::skip]
const KEYS: [&str; 68] = [
    "kind", "id", "profile", "parameters", "t_wait_ns", "request_timeout_ns",
    "l_max_ns", "dt_max_ns", "qos_hold", "period_ns", "last_session", "supervise_local",
    "stall", "way", "time_ns", "memory", "t_ns", "type",
    "requires", "guarantees", "station", "group", "session", "generated_ns",
    "verdict", "groups", "sessions", "now_ns", "configuration", "ego",
    "trajectory", "tracks", "detections", "cross_sections", "lead", "route",
    "grid", "detection_history", "measured", "events", "services", "goal",
    "same_station", "local_only", "closed", "stations", "stamp_ns", "points",
    "items", "gap", "mot", "plan", "x", "y",
    "cos", "sin", "vx", "vy", "speed", "left",
    "right", "resolution", "length", "width", "height", "center_offset",
    "occupied", "unknown",
];

/// Records are not deeper; what is, is left as it is.
const DEPTH: usize = 8;

macro_rules! names {
    ($($(#[$doc:meta])* $name:ident: $number:ident = $default:literal in $domain:expr;)*) => {
        /// The parameters of the stages.
        const PARAMETERS: &[&str] = &[$(stringify!($name)),*];
    };
}

mufasa_model::parameters!(names);

/// Where a key stands among those of its object; unknown ones stand last.
pub fn place(key: &str) -> usize {
    let keys = KEYS.iter().chain(PARAMETERS);
    keys.into_iter().position(|known| *known == key).unwrap_or(usize::MAX)
}

/// A step into a record.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Step {
    /// To the value of a key.
    Key(String),
    /// To an item of a list.
    Index(usize),
}

/// Of the object at `path` only the keys that stand before `key` are kept.
#[derive(Clone, Copy)]
pub struct Cut<'a> {
    pub path: &'a [Step],
    pub key: &'a str,
}

/// The JSON text with the keys of its objects in order; equal ones stay as they were.
pub fn ordered(json: &str, cut: Option<Cut<'_>>) -> String {
    let mut text = String::with_capacity(json.len());
    write(json, cut, DEPTH, &mut text);
    text
}

fn write(json: &str, cut: Option<Cut<'_>>, depth: usize, text: &mut String) {
    let Some(depth) = depth.checked_sub(1) else {
        text.push_str(json);
        return;
    };
    if let Ok(Entries(mut entries)) = from_str(json) {
        entries.sort_by_key(|(key, _)| place(key));
        if let Some(Cut { path: [], key }) = cut {
            entries.retain(|(it, _)| place(it) < place(key));
        }
        text.push('{');
        for (i, (key, value)) in entries.iter().enumerate() {
            text.push_str(if i > 0 { ", " } else { "" });
            text.push_str(&to_string(key).unwrap_or_default());
            text.push_str(": ");
            write(value.get(), behind(cut, &Step::Key(key.clone())), depth, text);
        }
        text.push('}');
    } else if let Ok(items) = from_str::<Vec<&RawValue>>(json) {
        text.push('[');
        for (i, item) in items.iter().enumerate() {
            text.push_str(if i > 0 { ", " } else { "" });
            write(item.get(), behind(cut, &Step::Index(i)), depth, text);
        }
        text.push(']');
    } else {
        text.push_str(json);
    }
}

/// The cut as seen behind a step, if the step leads to it.
fn behind<'a>(cut: Option<Cut<'a>>, step: &Step) -> Option<Cut<'a>> {
    let Cut { path, key } = cut?;
    let (first, path) = path.split_first()?;
    (first == step).then_some(Cut { path, key })
}

/// The keys and values of an object as they stand, twice given ones twice.
struct Entries<'a>(Vec<(String, &'a RawValue)>);

impl<'de> Deserialize<'de> for Entries<'de> {
    fn deserialize<D: Deserializer<'de>>(json: D) -> Result<Self, D::Error> {
        struct Object;

        impl<'de> Visitor<'de> for Object {
            type Value = Entries<'de>;

            fn expecting(&self, out: &mut Formatter<'_>) -> fmt::Result {
                out.write_str("an object")
            }

            fn visit_map<M: MapAccess<'de>>(self, mut map: M) -> Result<Entries<'de>, M::Error> {
                let mut entries = Vec::new();
                while let Some(entry) = map.next_entry()? {
                    entries.push(entry);
                }
                Ok(Entries(entries))
            }
        }

        json.deserialize_map(Object)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The records that `spec/5-interfaces.md` shows.
    fn shown() -> Vec<String> {
        let spec = include_str!("../../spec/5-interfaces.md");
        let lines = spec.lines().filter_map(|line| line.strip_prefix("    "));
        let text = lines.collect::<Vec<_>>().join("\n");
        let records = text.split("{\"kind\"").skip(1).map(|rest| format!("{{\"kind\"{rest}"));
        let whole = |text: String| {
            let mut values = serde_json::Deserializer::from_str(&text).into_iter::<&RawValue>();
            values.next().and_then(Result::ok).map(|it| it.get().to_owned())
        };
        records.filter_map(whole).collect()
    }

    fn assert_ordered(json: &str) -> usize {
        if let Ok(Entries(entries)) = from_str(json) {
            let places: Vec<_> = entries.iter().map(|(key, _)| place(key)).collect();
            assert!(places.is_sorted() && !places.contains(&usize::MAX), "{json}");
            return 1 + entries.iter().map(|(_, value)| assert_ordered(value.get())).sum::<usize>();
        }
        let items: Vec<&RawValue> = from_str(json).unwrap_or_default();
        items.iter().map(|item| assert_ordered(item.get())).sum()
    }

    #[test]
    fn the_keys_stand_as_the_spec_shows_them() {
        let records = shown();
        assert_eq!(records.len(), 3);
        assert!(records.iter().map(|record| assert_ordered(record)).sum::<usize>() > 15);
    }

    #[test]
    fn objects_are_put_in_order_and_cut() {
        let json = r#"{"lead": 1, "ego": {"y": [2], "x": "a"}, "z": 3, "ego": null}"#;
        let all = r#"{"ego": {"x": "a", "y": [2]}, "ego": null, "lead": 1, "z": 3}"#;
        assert_eq!(ordered(json, None), all);
        let path = [Step::Key(String::from("ego"))];
        let cut = ordered(json, Some(Cut { path: &path, key: "y" }));
        assert_eq!(cut, r#"{"ego": {"x": "a"}, "ego": null, "lead": 1, "z": 3}"#);
        let cut = ordered(json, Some(Cut { path: &[], key: "lead" }));
        assert_eq!(cut, r#"{"ego": {"x": "a", "y": [2]}, "ego": null}"#);
    }
}
