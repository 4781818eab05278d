//! Model and implementation on every published vector (`spec/5-interfaces.md#vectors`): what `vectors/` shows has no
//! second test of its own.

#[path = "tree/numbers.rs"]
mod numbers;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::{env, fs};

use mufasa_model::cycle::check;
use mufasa_model::input::cycle::Cycle;
use mufasa_model::input::profile::{HardenedRule, Profile};
use mufasa_model::report::Reading;
use mufasa_props::bridge;
use mufasa_props::refine::{Monitors, Pair};
use mufasa_records::offloading_answer::OffloadingAnswer;
use mufasa_records::{self as json, Record, Sequence, Trace};
use serde_json::Value;
use serde_json::value::RawValue;

use numbers::numbers;

/// A vector: its keys with their text, since a JSON library may change a last digit.
type Vector = BTreeMap<String, Box<RawValue>>;

/// Calls a job with every published vector and its line.
fn each(mut job: impl FnMut(&Vector, &str)) {
    let mut open = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("../vectors")];
    while let Some(folder) = open.pop() {
        let entries = fs::read_dir(folder).expect("the vectors are published");
        let paths: Vec<PathBuf> = entries.map(|it| it.expect("a directory entry").path()).collect();
        for path in paths {
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|it| it == "jsonl") {
                for line in fs::read_to_string(path).expect("text").lines() {
                    let vector: Vector = serde_json::from_str(line).expect("a vector is JSON");
                    let input = vector["input"].get();
                    job(&vector, &serde_json::from_str(input).unwrap_or_else(|_| input.to_owned()));
                }
            }
        }
    }
}

/// With every outcome and witness, and the verdicts of the strict and the lax reading.
#[test]
fn the_model_gives_every_published_answer() {
    let mut count = 0;
    each(|vector, line| {
        let answer = serde_json::to_value(json::answer(line.as_bytes(), 1)).expect("JSON");
        let expected: Value = serde_json::from_str(vector["expect"].get()).expect("JSON");
        assert_eq!(answer, expected, "{}: {}", vector["id"], vector["note"]);
        count += 1;
    });
    assert!(count > 2_000, "{count}");
}

#[test]
fn the_implementation_conforms_on_every_published_vector() {
    let mut count = BTreeMap::<&str, u32>::new();
    let only = env::var("MUFASA_REQUIREMENT");
    each(|vector, line| {
        if only.as_ref().is_ok_and(|id| !cites(vector, id)) {
            return;
        }
        let kind = match json::parse(line.as_bytes(), 1) {
            Ok(Record::Cycle { cycle, .. }) => {
                let [exact, strict] = [Reading::Exact, Reading::Strict].map(|it| check(&cycle, it));
                let found = bridge::check_impl(&cycle);
                if let Err(disagreement) = bridge::conforms(&exact, &strict, &found) {
                    panic!("{}: {disagreement}", vector["id"]);
                }
                "cycle"
            }
            Ok(Record::Offloading { trace, .. }) => {
                let mut pair = Pair::new(trace.profile, trace.parameters).expect("it starts");
                for event in &trace.events {
                    if let Err(difference) = pair.step(event) {
                        panic!("{}: {difference}", vector["id"]);
                    }
                }
                "offloading"
            }
            Ok(Record::Monitor { sequence, .. }) => {
                if let Err(difference) = played(&sequence) {
                    panic!("{}: {difference}", vector["id"]);
                }
                "monitor"
            }
            // The implementation has no services, and reads no lines.
            Ok(Record::Composition { .. }) | Err(_) => "other",
        };
        *count.entry(kind).or_default() += 1;
    });
    if only.is_ok() {
        return println!("vectors of {only:?} alone: {count:?}");
    }
    assert!(count["cycle"] > 1_300 && count["offloading"] > 100, "{count:?}");
    assert!(count["monitor"] > 150, "{count:?}");
}

/// `scripts/coverage` asks for those of one requirement.
fn cites(vector: &Vector, id: &str) -> bool {
    let is_outside = |it: char| !(it.is_alphanumeric() || it == '-' || it == '.');
    ["requirement", "flag"]
        .iter()
        .any(|key| vector[*key].get().split(is_outside).any(|it| it == id))
}

/// Of the monitor: no record shows them, and which test does.
const NO_RECORD: [(&str, &str); 5] = [
    // What came out can be read by nobody later: a matter of borrows, not of an answer.
    ("MON-03", "sources/does_not_compile.rs"),
    // What control does with a decision: the record ends at the decision.
    ("MON-42", "monitor/brake_by.rs"),
    ("MON-67", "../../lab/oracle/tests/it/integrate.rs"),
    ("MON-68", "../../lab/oracle/tests/it/integrate.rs"),
    ("MON-53", "monitor/own_plan.rs"),
];

#[test]
fn each_requirement_of_the_monitor_has_a_vector_or_says_why_not() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let page = fs::read_to_string(root.join("../spec/monitor.md")).expect("the page");
    let ids = page.split("**[").skip(1).filter_map(|it| it.split_once("]**").map(|it| it.0));
    let mut shown = BTreeSet::new();
    each(|vector, _| {
        shown.insert(vector["requirement"].get().trim_matches('"').to_owned());
    });
    let without: Vec<&str> = ids.filter(|id| !shown.contains(*id)).collect();
    assert_eq!(without, NO_RECORD.map(|(id, _)| id));
    for (id, test) in NO_RECORD {
        let test = fs::read_to_string(root.join("tests").join(test)).expect("a test");
        assert!(test.contains(id), "{id}");
    }
}

/// Both monitors live through it.
fn played(sequence: &Sequence) -> Result<(), String> {
    let settings = sequence.settings();
    let mut lent = bridge::lent(&settings);
    let Some(mut pair) = Monitors::new(&settings, sequence.route.clone(), &mut lent)? else {
        return Ok(());
    };
    sequence.events.iter().try_for_each(|event| pair.step(event).map(drop))
}

/// What a record is answered in a profile: of a cycle whether it is safe, of a trace its states.
fn decided(record: &Record, profile: Profile) -> Option<String> {
    match record {
        Record::Cycle { cycle, .. } => {
            let report = check(&Cycle { profile, ..cycle.as_ref().clone() }, Reading::Exact);
            report.ok().map(|it| it.failed_stage.is_none().to_string())
        }
        Record::Offloading { trace, .. } => {
            let trace = Trace { profile, ..trace.clone() };
            let states = OffloadingAnswer::run(String::new(), &trace).states;
            serde_json::to_string(&states).ok()
        }
        _ => None,
    }
}

/// A finding is in the row of a rule only when one of its vectors, about which the profiles differ, is decided as
/// `hardened` does by the rule beside the paper alone, or as `paper` does without it.
#[test]
fn each_rule_closes_the_findings_of_its_row() {
    let alone = |rule: HardenedRule| {
        let others = HardenedRule::ALL.into_iter().filter(|it| *it != rule);
        others.fold(Profile::HARDENED, Profile::without)
    };
    let mut shown = BTreeMap::<&str, BTreeSet<String>>::new();
    each(|vector, line| {
        let id: String = serde_json::from_str(vector["id"].get()).expect("a string");
        let Ok(record) = json::parse(line.as_bytes(), 1) else { return };
        let paper = decided(&record, Profile::PAPER);
        let hardened = decided(&record, Profile::HARDENED);
        if !id.starts_with("F-") || paper == hardened {
            return;
        }
        for rule in HardenedRule::ALL {
            let without = decided(&record, Profile::HARDENED.without(rule));
            if without == paper || decided(&record, alone(rule)) == hardened {
                shown.entry(rule.id()).or_default().insert(id[2..4].to_owned());
            }
        }
    });
    let spec = Path::new(env!("CARGO_MANIFEST_DIR")).join("../spec/hardened/README.md");
    let text = fs::read_to_string(spec).expect("the table of rules");
    let rows = text.lines().filter_map(|line| line.strip_prefix("| [")?.split_once(']'));
    let mut count = 0;
    for (rule, row) in rows {
        let closed = row.rsplit(" | ").next().unwrap_or_default();
        for finding in numbers("F-", closed) {
            assert!(
                shown[rule].contains(&finding),
                "{rule}: no vector shows F-{finding}: {shown:?}"
            );
            count += 1;
        }
    }
    assert!(count > 40, "{count}");
    // No vector of F-05 or F-15 needs these rules.
    assert!(!shown["H-04"].contains("05") && !shown["H-10"].contains("15"));
}
