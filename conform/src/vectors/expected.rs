//! What the author of a vector expects from the text of `spec/`, before the model is asked.

use serde_json::Value;

/// An expectation about an answer. What is not said is not checked.
#[derive(Clone, Debug, Default)]
pub struct Expected {
    facts: Vec<Fact>,
}

#[derive(Clone, Debug)]
enum Fact {
    /// The answer has this value at the pointer; null stands for an absent one, too.
    Value(String, Value),
    /// The list at the pointer is so long.
    Length(String, usize),
}

/// A safe cycle.
pub fn safe() -> Expected {
    Expected::default().that("/verdict", "safe").that("/failed_stage", Value::Null)
}

/// A cycle that fails in this stage.
pub fn fails(stage: &str) -> Expected {
    Expected::default().that("/verdict", "unsafe").that("/failed_stage", stage)
}

/// A cycle that stage `stage` fails by this rule.
pub fn fails_by(stage: &str, rule: &str) -> Expected {
    fails(stage).that(&format!("/stages/{stage}/witness/rule"), rule)
}

/// A cycle with invalid remote data.
pub fn invalid_remote(field: &str, index: Option<usize>) -> Expected {
    fails("input").that("/input/field", field).that("/input/index", index)
}

/// A record that is refused.
pub fn refused(field: &str, index: Option<usize>) -> Expected {
    Expected::default()
        .that("/verdict", "error")
        .that("/failed_stage", Value::Null)
        .that("/error/field", field)
        .that("/error/index", index)
}

/// So many compositions, none or some of them.
pub fn compositions(count: usize) -> Expected {
    Expected { facts: vec![Fact::Length(String::from("/compositions"), count)] }
}

/// What the requester is and does after the last of `events` events. `actions` are words such as
/// `release mot 1#2` (station 1, session 2), `activate plan`, `drop mot`.
pub fn after(
    events: usize,
    [mot, plan]: [&str; 2],
    hold: Option<i64>,
    actions: &[&str],
) -> Expected {
    let last = format!("/states/{}", events.saturating_sub(1));
    let actions: Vec<Value> = actions.iter().map(|words| action(words)).collect();
    Expected::default()
        .that(&format!("{last}/mot"), mot)
        .that(&format!("{last}/plan"), plan)
        .that(&format!("{last}/hold_until_ns"), hold)
        .that(&format!("{last}/actions"), actions)
}

impl Expected {
    /// The answer has this value at the pointer (RFC 6901); null stands for an absent one, too.
    pub fn that(mut self, pointer: &str, value: impl Into<Value>) -> Self {
        self.facts.push(Fact::Value(pointer.to_owned(), value.into()));
        self
    }

    /// The witness of `stage` has this value.
    pub fn witness(self, stage: &str, key: &str, value: impl Into<Value>) -> Self {
        self.that(&format!("/stages/{stage}/witness/{key}"), value)
    }

    /// The outcomes of the five stages in letters: P passed, F failed, - not scheduled; skipped:
    /// a after failure, o other stage ran, j t d g no current trajectory, tracks, detections, grid;
    /// the same as capitals: not applicable because of it.
    pub fn stages(mut self, letters: &str) -> Self {
        for (stage, letter) in ["i", "ii", "iii", "iv", "v"].into_iter().zip(letters.chars()) {
            let (outcome, key, why) = outcome(letter);
            self = self.that(&format!("/stages/{stage}/outcome"), outcome);
            if let Some(key) = key {
                self = self.that(&format!("/stages/{stage}/{key}"), why);
            }
        }
        self
    }

    /// What of the expectation the answer breaks, in words.
    pub fn broken_by(&self, answer: &Value) -> Option<String> {
        self.facts.iter().find_map(|fact| fact.broken_by(answer))
    }
}

impl Fact {
    fn broken_by(&self, answer: &Value) -> Option<String> {
        let at = |pointer: &str| answer.pointer(pointer).unwrap_or(&Value::Null);
        match self {
            Self::Value(pointer, expected) => (at(pointer) != expected)
                .then(|| format!("{pointer} should be {expected}, is {}", at(pointer))),
            Self::Length(pointer, expected) => {
                let found = at(pointer).as_array().map(Vec::len);
                (found != Some(*expected)).then(|| {
                    format!("{pointer} should be of length {expected}, is {}", at(pointer))
                })
            }
        }
    }
}

fn outcome(letter: char) -> (&'static str, Option<&'static str>, &'static str) {
    const SKIPPED: (&str, Option<&str>) = ("skipped", Some("reason"));
    const NOT_APPLICABLE: (&str, Option<&str>) = ("not_applicable", Some("missing"));
    let ((outcome, key), why) = match letter {
        'P' => (("passed", None), ""),
        'F' => (("failed", None), ""),
        '-' => (("not_scheduled", None), ""),
        'a' => (SKIPPED, "after_failure"),
        'o' => (SKIPPED, "other_stage_ran"),
        'j' => (SKIPPED, "no_current_trajectory"),
        't' => (SKIPPED, "no_current_tracks"),
        'd' => (SKIPPED, "no_current_detections"),
        'g' => (SKIPPED, "no_current_grid"),
        'J' => (NOT_APPLICABLE, "trajectory"),
        'T' => (NOT_APPLICABLE, "tracks"),
        'D' => (NOT_APPLICABLE, "detections"),
        'G' => (NOT_APPLICABLE, "grid"),
        // No answer has such an outcome: the vector is refused.
        _ => (("no such letter", None), ""),
    };
    (outcome, key, why)
}

fn action(words: &str) -> Value {
    match *words.split(' ').collect::<Vec<_>>() {
        [send, group, partner] => {
            let (station, session) = partner.split_once('#').unwrap_or((partner, ""));
            let number = |text: &str| text.parse::<i64>().ok();
            serde_json::json!({
                "send": send, "station": number(station), "group": group,
                "session": number(session),
            })
        }
        [verb, group] => serde_json::json!({ verb: group }),
        _ => Value::Null,
    }
}
