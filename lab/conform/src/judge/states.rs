//! What a trace or a monitor is answered, state by state (`spec/5-interfaces.md#monitor`).

use mufasa_model::report::{InvalidInput, Reading};
use mufasa_records::monitor_answer::{self, MonitorState};
use mufasa_records::offloading_answer::OffloadingAnswer;
use mufasa_records::record::{monitor, offloading};
use mufasa_records::{Sequence, Trace};
use serde_json::Value;

use crate::judge::answer::names_another;

/// What is compared of a state, in this order: why before what came of it.
const FIELDS: [&str; 15] = [
    "dropped",
    "given_back_ns",
    "decision/verdict",
    "decision/failed_stage",
    "decision/input",
    "decision/error",
    "decision/tracks",
    "decision/trajectory",
    "decision/brake_by_ns",
    "decision/brake",
    "decision",
    "mot",
    "plan",
    "hold_until_ns",
    "actions",
];

/// Which requirements of the monitor a difference is about: by the field, the type of the event, and a word of
/// one of the two states. The first that fits is told.
const REQUIREMENTS: [(&str, &str, &str, &str); 17] = [
    ("dropped", "", r#""stale""#, "MON-30"),
    ("dropped", "", r#""starved""#, "MON-31, MON-32, MON-33, MON-69"),
    ("dropped", "", r#""does_not_fit""#, "MON-20"),
    ("dropped", "", "", "MON-08, MON-09"),
    ("hold_until_ns", "tick", "", "MON-34 to MON-38, MON-43, MON-44, MON-58, MON-64"),
    ("hold_until_ns", "", "", "MON-34 to MON-38"),
    ("actions", "", r#""request""#, "MON-28, MON-34, MON-43, MON-61, MON-64"),
    ("given_back_ns", "", "", "MON-54 to MON-59"),
    ("decision/verdict", "", r#""tick""#, "MON-45, MON-46"),
    ("decision/verdict", "", r#""detections"#, "MON-12 to MON-17, MON-19, MON-65"),
    ("decision/verdict", "", "", "MON-06, MON-07, MON-08, MON-12 to MON-17"),
    ("decision/failed_stage", "", "", "MON-06, MON-07, MON-08, MON-12 to MON-17"),
    ("decision/error", "", "", "MON-19, MON-46, MON-65"),
    ("decision/tracks", "", "", "MON-01, MON-02, MON-05"),
    ("decision/trajectory", "", "", "MON-01, MON-04, MON-05, MON-66"),
    ("decision/brake_by_ns", "", "", "MON-40, MON-41"),
    ("decision/brake", "", "", "MON-47 to MON-52"),
];

/// The model's states.
#[derive(Clone, Debug)]
pub struct States {
    /// Each with the type of its event, without witnesses.
    pub list: Vec<(&'static str, Value)>,
    /// So many of them are those of the strict reading, too. What comes behind may differ by a margin.
    sure: usize,
    /// The requirements that a difference is told with.
    requirements: &'static [(&'static str, &'static str, &'static str, &'static str)],
}

/// The first field that differs.
#[derive(Clone, Debug)]
pub struct Difference {
    /// After which event, counted from 0.
    pub at: usize,
    /// Its type.
    pub event: &'static str,
    /// The field of the state.
    pub field: &'static str,
    /// What it must be.
    pub wanted: Value,
    /// What it is; `None` is missing.
    pub found: Option<Value>,
    /// Which requirements say so; empty where none can be told.
    pub requirements: &'static str,
}

impl States {
    /// Of a trace.
    pub fn of_trace(trace: &Trace) -> Self {
        let states = OffloadingAnswer::run(String::new(), trace).states;
        // States are plain data, here and below: they always become JSON.
        let states = states.iter().map(|it| serde_json::to_value(it).unwrap_or_default());
        let types = trace.events.iter().map(offloading::event_type);
        let list: Vec<_> = types.zip(states).collect();
        Self { sure: list.len(), list, requirements: &[] }
    }

    /// Of a sequence. `Err` is a setting that is refused, or `work`.
    pub fn of_sequence(sequence: &Sequence) -> Result<Self, InvalidInput> {
        let exact = decisions(sequence, Reading::Exact)?;
        let strict = decisions(sequence, Reading::Strict).unwrap_or_default();
        let sure = exact.iter().zip(&strict).take_while(|(exact, strict)| exact == strict).count();
        let types = sequence.events.iter().map(monitor::event_type);
        Ok(Self { sure, list: types.zip(exact).collect(), requirements: &REQUIREMENTS })
    }

    /// Where these states differ from them first.
    pub fn first_difference(&self, states: &[Value]) -> Option<Difference> {
        let both = self.list.iter().zip(states).take(self.sure).enumerate();
        both.flat_map(|(at, ((event, wanted), found))| {
            FIELDS.iter().map(move |field| (at, *event, *field, wanted, found))
        })
        .find_map(|(at, event, field, wanted, found)| {
            let pointer = format!("/{field}");
            let (value, other) = (wanted.pointer(&pointer)?, found.pointer(&pointer));
            let text = format!("{wanted} {found}");
            let is_about = |(of, after, word, _): &&(&str, &str, &str, &str)| {
                *of == field && (after.is_empty() || *after == event) && text.contains(word)
            };
            (!is_same(value, other)).then(|| Difference {
                at,
                event,
                field,
                wanted: value.clone(),
                found: other.cloned(),
                requirements: self.requirements.iter().find(is_about).map_or("", |it| it.3),
            })
        })
    }
}

impl Difference {
    /// In words, without the values.
    pub fn place(&self) -> String {
        let told = |it: &str| if it.is_empty() { String::new() } else { format!(" [{it}]") };
        let Self { at, event, field, requirements, .. } = self;
        format!("{} after event {at} ({event}){}", field.replace('/', "."), told(requirements))
    }
}

/// Whether a value is as wanted. Of invalid input the place counts where it is named; what a decision holds is
/// compared by its own fields.
fn is_same(wanted: &Value, found: Option<&Value>) -> bool {
    let is_place = |problem: &Value, given: Option<&Value>| {
        let index = problem["index"].as_u64().and_then(|it| usize::try_from(it).ok());
        !names_another(given, problem["field"].as_str().unwrap_or_default(), index)
    };
    match (wanted.as_object(), found) {
        (Some(fields), _) if fields.contains_key("field") => is_place(wanted, found),
        (_, None) => false,
        (None, Some(found)) => wanted == found,
        (Some(fields), Some(found)) if fields.contains_key("verdict") => found.is_object(),
        (Some(fields), Some(found)) => fields.iter().all(|(key, value)| match found.get(key) {
            Some(place) if key == "input" => place.is_object() && is_place(value, Some(place)),
            given => given == Some(value),
        }),
    }
}

/// What a sequence is answered in a reading, without witnesses; `Err` as of [`States::of_sequence`].
pub fn decisions(sequence: &Sequence, reading: Reading) -> Result<Vec<Value>, InvalidInput> {
    let answers = monitor_answer::answers(sequence, reading)?;
    let plain = |answer| {
        let mut state = serde_json::to_value(MonitorState::new(answer)).unwrap_or_default();
        for place in ["/decision", "/decision/brake"] {
            let object = state.pointer_mut(place).and_then(Value::as_object_mut);
            object.map(|object| object.remove("witness"));
        }
        state
    };
    Ok(answers.into_iter().map(plain).collect())
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use mufasa_model::input::cycle::Profile;
    use serde_json::json;

    use super::*;
    use crate::cases::generate::Generator;
    use crate::cases::question::Question;
    use crate::judge::class::Kind;

    fn sequences(profile: Profile, count: u64) -> impl Iterator<Item = Sequence> {
        let generator = Generator { seed: 0, profile, kinds: vec![Kind::Monitor] };
        (0..count).filter_map(move |case| match generator.question(case) {
            Question::Monitor(sequence) => Some(*sequence),
            _ => None,
        })
    }

    /// Nothing of a generated sequence is left out of the comparison, and its states are not all alike.
    #[test]
    fn no_margin_changes_a_generated_sequence() {
        for profile in [Profile::PAPER, Profile::HARDENED] {
            let (mut dropped, mut stages, mut refused) = (BTreeSet::new(), BTreeSet::new(), 0);
            for sequence in sequences(profile, 60) {
                let Ok(states) = States::of_sequence(&sequence) else {
                    refused += 1;
                    continue;
                };
                assert_eq!(
                    (states.sure, states.list.len()),
                    (states.list.len(), sequence.events.len())
                );
                for (_, state) in &states.list {
                    dropped.insert(state["dropped"].to_string());
                    stages.insert(state["decision"]["failed_stage"].to_string());
                }
            }
            assert_eq!((dropped.len(), refused > 0), (8, true), "{dropped:?} {refused}");
            assert!(stages.len() > 4, "{stages:?}");
        }
    }

    #[test]
    fn a_difference_is_told_with_its_event_its_field_and_its_requirement() {
        let all = sequences(Profile::HARDENED, 60).filter_map(|it| States::of_sequence(&it).ok());
        let (mut told, mut unnamed) = (BTreeSet::new(), 0);
        for states in all {
            let right: Vec<Value> = states.list.iter().map(|it| it.1.clone()).collect();
            assert!(states.first_difference(&right).is_none());
            let changes = [
                ("/dropped", json!("stale"), Value::Null),
                ("/decision/error/field", json!("tick"), json!("tack")),
                ("/decision/brake/input/index", json!(0), json!(1)),
                ("/decision/brake", json!({"missing": "trajectory"}), Value::Null),
            ];
            for (place, from, to) in changes {
                let is_so = |it: &Value| it.pointer(place) == Some(&from);
                let Some(at) = right.iter().position(is_so) else { continue };
                let mut wrong = right.clone();
                *wrong[at].pointer_mut(place).expect("it is there") = to;
                let it = states.first_difference(&wrong).expect("a difference");
                assert_eq!(it.at, at);
                told.insert(it.place().replace(&format!(" {at} "), " N "));
                // A program need not name the place of what is invalid.
                wrong[at]
                    .pointer_mut("/decision")
                    .and_then(Value::as_object_mut)
                    .map(|it| it.remove("error"));
                unnamed += u32::from(states.first_difference(&wrong).is_none());
            }
        }
        let expected = [
            "decision.brake after event N (cycle) [MON-47 to MON-52]",
            "decision.error after event N (cycle) [MON-19, MON-46, MON-65]",
            "dropped after event N (tracks) [MON-30]",
            "dropped after event N (trajectory) [MON-30]",
        ];
        assert_eq!(told.iter().map(String::as_str).collect::<Vec<_>>(), expected);
        assert!(unnamed > 0);
    }

    /// The strict reading rejects where a margin decides; what comes behind it is not compared.
    #[test]
    fn what_a_margin_changes_is_not_compared() {
        let sequence = sequences(Profile::HARDENED, 1).next().expect("a sequence");
        let mut states = States::of_sequence(&sequence).expect("it is not refused");
        let wrong = vec![Value::Null; states.list.len()];
        assert_eq!(states.first_difference(&wrong).map(|it| it.at), Some(0));
        states.sure = 0;
        assert!(states.first_difference(&wrong).is_none());
    }
}
