//! What the program writes as JSON is what its schemas say.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use crate::kit::{folder, said};
use jsonschema::Validator;
use mufasa_oracle::schemas;
use serde_json::Value;

/// The validators by name.
pub fn validators() -> BTreeMap<&'static str, Validator> {
    let build = |schema| jsonschema::validator_for(&schema).expect("a valid schema");
    schemas::all().into_iter().map(|(name, schema)| (name, build(schema))).collect()
}

/// What the program wrote, whatever its exit code.
fn run(folder: &Path, arguments: &[&str]) -> String {
    said(folder, arguments).out
}

pub fn assert_valid(validator: &Validator, value: &Value) {
    let problems: Vec<_> = validator.iter_errors(value).map(|it| it.to_string()).collect();
    assert!(problems.is_empty(), "{problems:?}\n{value}");
    // And a field more is none.
    let mut more = value.clone();
    if let Some(fields) = more.as_object_mut() {
        fields.insert(String::from("surplus"), Value::Null);
        assert!(!validator.is_valid(&more), "{more}");
    }
}

fn parsed(text: &str) -> Value {
    serde_json::from_str(text).expect("JSON")
}

/// The first cycles of a vector's file, as drives of records.
fn some_cycles(folder: &Path) {
    let vectors = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../vectors/findings/F-30.jsonl");
    let text = fs::read_to_string(vectors).expect("the vectors are there");
    let inputs = text.lines().map(|line| parsed(line)["input"].to_string());
    let mut lines: Vec<_> = inputs.collect();
    let mut invalid = parsed(&lines[0]);
    invalid["id"] = "invalid".into();
    invalid["ego"]["x"] = "nan".into();
    lines.push(invalid.to_string());
    fs::write(folder.join("cycles.jsonl"), lines.join("\n")).expect("it can be written");
}

#[test]
fn the_answers_that_the_text_shows_are_what_their_schemas_say() {
    let text = include_str!("../../../../spec/5-interfaces.md");
    let (_, behind) = text.split_once("Answer:\n\n").expect("an answer to a cycle");
    let (example, _) = behind.split_once("\n\n").expect("an end");
    assert_valid(&validators()["cycle-answer"], &parsed(example));
}

#[test]
fn lines_of_check_are_what_their_schemas_say() {
    let (validators, folder) = (validators(), folder("check"));
    some_cycles(&folder);
    let text = run(&folder, &["check", "--json", "cycles.jsonl"]);
    let mut counts = BTreeMap::new();
    for line in text.lines() {
        let value = parsed(line);
        let kind = value["kind"].as_str().expect("a kind").replace('_', "-");
        let verdict = value["answer"]["verdict"].as_str().unwrap_or("").to_owned();
        assert_valid(&validators[kind.as_str()], &value);
        *counts.entry((kind, verdict)).or_insert(0) += 1;
    }
    let seen: Vec<_> = counts.keys().map(|(kind, verdict)| format!("{kind} {verdict}")).collect();
    let expected = ["checked ", "checked-cycle error", "checked-cycle unsafe", "checked-drive "];
    for expected in expected {
        assert!(seen.iter().any(|it| it == expected), "{expected}: {seen:?}");
    }
}

#[test]
fn the_summary_of_conform_is_what_its_schema_says() {
    let (validators, folder) = (validators(), folder("conform"));
    // Finds everything safe, so that there are classes.
    let program = r#"while read -r l; do i=${l#*'"id": "'}; echo "{\"id\": \"${i%%'"'*}\", \"verdict\": \"safe\", \"failed_stage\": null}"; done"#;
    let count = ["conform", "--cases", "60", "--kinds", "cycle", "--", "sh", "-c", program];
    run(&folder, &count);
    let text = fs::read_to_string(folder.join("mufasa-conform/summary.json"));
    let summary = parsed(&text.expect("there is a summary"));
    assert!(summary["classes"].as_array().is_some_and(|it| !it.is_empty()), "{summary}");
    assert_valid(&validators["conform-summary"], &summary);
}

#[test]
fn claims_are_what_their_schema_says() {
    let (validators, folder) = (validators(), folder("prove"));
    run(&folder, &["prove", "law", "--out", "prove.json"]);
    run(&folder, &["prove", "s_b_grows_with_v", "--out", "z3.json"]);
    let mut lines = 0;
    for file in ["prove.json", "z3.json"] {
        for line in fs::read_to_string(folder.join(file)).unwrap_or_default().lines() {
            assert_valid(&validators["claim"], &parsed(line));
            lines += 1;
        }
    }
    assert!(lines > 0);
}

#[test]
fn the_summary_of_a_vehicle_is_what_its_schema_says() {
    let (validators, folder) = (validators(), folder("vehicle"));
    some_cycles(&folder);
    let text = fs::read_to_string(folder.join("cycles.jsonl")).expect("it was written");
    let mut cycle = parsed(text.lines().next().expect("a cycle"));
    let at = |index: i64| {
        cycle["now_ns"] = (1_000_000_000 + index * 100_000_000).into();
        cycle.to_string()
    };
    let lines: Vec<_> = (0..4).map(at).collect();
    fs::write(folder.join("drive.jsonl"), lines.join("\n")).expect("it can be written");
    let out = ["--json", "vehicle.json", "--log", "log.jsonl"];
    let text = run(&folder, &[&["vehicle", "drive.jsonl"], &out[..]].concat());
    assert!(text.contains("station"), "both are in one process: {text}");
    let text = fs::read_to_string(folder.join("vehicle.json")).expect("it was written");
    assert_eq!(parsed(&text)["cycles"], 4);
    assert_valid(&validators["vehicle-summary"], &parsed(&text));
    let log = fs::read_to_string(folder.join("log.jsonl")).expect("it was written");
    let entries: Vec<_> = log.lines().map(parsed).collect();
    for what in ["decided", "control", "link"] {
        assert!(entries.iter().any(|it| it["what"] == what), "{what}: {log}");
    }
    for entry in entries {
        assert_valid(&validators["vehicle-log"], &entry);
    }
}

#[test]
fn evaluations_are_what_their_schemas_say_and_csv_has_as_many_runs() {
    let (validators, folder) = (validators(), folder("evaluate"));
    for (name, only) in [
        ("failures", "failures/hardened/wrong-map/0"),
        ("readings", "readings/paper/both+farthest+none/0"),
        ("left-out", "left-out/hardened/blind+grid+none+mot/0"),
        ("stages", "stages/paper/random/1"),
        ("attacks", "attacks/hardened/made-up-lead/mot/0"),
        ("availability", "availability/paper/t-wait-s=60/0"),
        ("combinations", "combinations/hardened/both/1"),
    ] {
        let size = ["--only", only, "--scenarios", "2", "--vehicles", "3", "--out", "files"];
        run(&folder, &[&["evaluate", name], &size[..]].concat());
        let text = |kind: &str| fs::read_to_string(folder.join(format!("files/{name}{kind}")));
        let value = parsed(&text(".json").expect("it was written"));
        assert_valid(&validators[format!("evaluation-{name}").as_str()], &value);
        let runs = value["runs"].as_array().expect("runs").len();
        assert!(runs > 0, "{name}");
        let lines = |kind| {
            let text = text(kind).expect("it was written");
            let mut reader = csv::Reader::from_reader(text.as_bytes());
            reader.records().filter(|line| line.as_ref().is_ok_and(|line| !line.is_empty())).count()
        };
        let rows = value["rows"].as_array().expect("rows").len();
        assert_eq!((lines("-runs.csv"), lines(".csv")), (runs, rows), "{name}");
    }
}

#[test]
fn scenes_and_their_collisions_are_what_their_schemas_say() {
    let (validators, folder) = (validators(), folder("scenes"));
    let size = ["--profile", "paper", "--scenes", "40", "--out", "files"];
    run(&folder, &[&["evaluate", "scenes"], &size[..]].concat());
    let text = fs::read_to_string(folder.join("files/scenes.json")).expect("it was written");
    assert_valid(&validators["evaluation-scenes"], &parsed(&text));
    let mut files = fs::read_dir(folder.join("files/collisions")).expect("a folder");
    let file = files.next().expect("a collision").expect("an entry").path();
    let text = fs::read_to_string(&file).expect("it was written");
    text.lines().for_each(|line| assert_valid(&validators["cycle"], &parsed(line)));
    let said = run(&folder, &["check", file.to_str().expect("a name")]);
    assert!(said.contains("model and implementation agree"), "{said}");
}

#[test]
fn a_collision_that_was_found_is_what_its_schema_says_and_is_made_again() {
    let (validators, folder) = (validators(), folder("falsify"));
    let arguments = ["evaluate", "falsify", "--profile", "paper", "--attack", "empty-tracks"];
    let size = ["--runs", "56", "--seed", "1", "--out", "files"];
    run(&folder, &[&arguments[..], &size[..]].concat());
    let text = fs::read_to_string(folder.join("files/falsify.json")).expect("it was written");
    let value = parsed(&text);
    assert_valid(&validators["evaluation-falsify"], &value);
    let files = fs::read_dir(folder.join("files/found")).expect("a folder");
    // Its page is beside it.
    let mut files = files.map(|file| file.expect("an entry").path());
    let file = files.find(|it| it.extension().is_some_and(|it| it == "json"));
    let file = file.expect("a collision");
    let text = fs::read_to_string(&file).expect("it was written");
    assert_valid(&validators["evaluation-found"], &parsed(&text));
    let name = file.to_str().expect("a name");
    let said = run(&folder, &["evaluate", "replay", name, "--out", "page.html"]);
    assert!(said.contains("Collided"), "{said}");
    let page = fs::read_to_string(folder.join("page.html")).expect("it was written");
    assert!(page.contains("Collided with") && page.contains("paper-"));
}

#[test]
fn every_schema_gets_a_file() {
    let folder = folder("files");
    run(&folder, &["schemas", "--out", "all"]);
    for (name, _) in schemas::all() {
        let text = fs::read_to_string(folder.join("all").join(format!("{name}.schema.json")));
        assert!(parsed(&text.expect("a file")).get("$schema").is_some(), "{name}");
    }
}
