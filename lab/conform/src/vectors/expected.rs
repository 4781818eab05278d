//! What the author of a vector expects from the text of `spec/`, before the model is asked.

use std::collections::BTreeMap;

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

impl Expected {
    /// Reads an expectation; a trace has `events` events. Its keys are
    /// * `is`: `safe`, `fails STAGE RULE`, `invalid FIELD INDEX` (remote data), `refused FIELD
    ///   INDEX`; rule, field and index may be missing;
    /// * `stages`: the outcomes of the five stages in letters: P passed, F failed, - not scheduled;
    ///   skipped: a after failure, o other stage ran, j t d g no current trajectory, tracks,
    ///   detections, grid; the same as capitals: not applicable because of it;
    /// * `last`: what the requester is and does after the last event: states of MOT and PLAN, hold,
    ///   actions in words such as `release mot 1#2` (station 1, session 2) or `activate plan`;
    /// * `compositions`: how many there are;
    /// * `last/` or a number and `/`: a pointer from the state after the last event, or after this one;
    /// * a pointer (RFC 6901): the answer has this value there; null stands for an absent one, too.
    pub fn read(facts: &BTreeMap<String, Value>, events: usize) -> Result<Self, String> {
        let mut expected = Self::default();
        for (key, value) in facts {
            let words: Vec<&str> = value.as_str().unwrap_or_default().split(' ').collect();
            match key.as_str() {
                "is" => expected.verdict(&words)?,
                "stages" => {
                    let letters = words.concat();
                    for (stage, letter) in
                        ["i", "ii", "iii", "iv", "v"].into_iter().zip(letters.chars())
                    {
                        let (outcome, key, why) = outcome(letter);
                        expected.that(&format!("/stages/{stage}/outcome"), outcome);
                        if let Some(key) = key {
                            expected.that(&format!("/stages/{stage}/{key}"), why);
                        }
                    }
                }
                "last" => {
                    let last = format!("/states/{}", events.saturating_sub(1));
                    for (index, key) in ["mot", "plan", "hold_until_ns"].into_iter().enumerate() {
                        expected.that(&format!("{last}/{key}"), value[index].clone());
                    }
                    let actions = value[3].as_array().into_iter().flatten();
                    let actions: Vec<Value> = actions.map(action).collect();
                    expected.that(&format!("{last}/actions"), actions);
                }
                "compositions" => {
                    let count = value.as_u64().and_then(|it| it.try_into().ok());
                    let count = count.ok_or("compositions is a count")?;
                    expected.facts.push(Fact::Length(String::from("/compositions"), count));
                }
                pointer if pointer.starts_with('/') => expected.that(pointer, value.clone()),
                below => {
                    let (place, pointer) = below.split_once('/').ok_or_else(|| unknown(below))?;
                    let last = (place == "last").then_some(events.saturating_sub(1));
                    let index =
                        last.or_else(|| place.parse().ok()).ok_or_else(|| unknown(below))?;
                    expected.that(&format!("/states/{index}/{pointer}"), value.clone());
                }
            }
        }
        Ok(expected)
    }

    fn verdict(&mut self, words: &[&str]) -> Result<(), String> {
        let index = |word: Option<&&str>| word.and_then(|it| it.parse::<usize>().ok());
        let field = words.get(1).copied().unwrap_or_default();
        match words[0] {
            "safe" => {
                self.that("/verdict", "safe");
                self.that("/failed_stage", Value::Null);
            }
            "fails" => {
                self.that("/verdict", "unsafe");
                self.that("/failed_stage", field);
                if let Some(rule) = words.get(2) {
                    self.that(&format!("/stages/{field}/witness/rule"), *rule);
                }
            }
            "invalid" => {
                self.that("/verdict", "unsafe");
                self.that("/failed_stage", "input");
                self.that("/input/field", field);
                self.that("/input/index", index(words.get(2)));
            }
            "refused" => {
                self.that("/verdict", "error");
                self.that("/failed_stage", Value::Null);
                self.that("/error/field", field);
                self.that("/error/index", index(words.get(2)));
            }
            other => return Err(format!("no answer is {other}")),
        }
        Ok(())
    }

    fn that(&mut self, pointer: &str, value: impl Into<Value>) {
        self.facts.push(Fact::Value(pointer.to_owned(), value.into()));
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

fn unknown(key: &str) -> String {
    format!("{key} cannot be expected")
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

fn action(words: &Value) -> Value {
    match *words.as_str().unwrap_or_default().split(' ').collect::<Vec<_>>() {
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
