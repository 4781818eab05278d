//! `mufasa explore`, and what is kept of F-12: the vectors.

use std::fs;
use std::path::Path;

use mufasa_exploration::bounds::Bounds;
use mufasa_exploration::properties::Property;
use mufasa_exploration::run::{self, WorldOutcome};
use mufasa_model::input::cycle::Profile;
use mufasa_oracle::document;
use mufasa_oracle::explore;
use mufasa_oracle::explore::report::ExplorationReport;
use mufasa_records::{self as json, Record};
use serde_json::Value;

use crate::kit::{folder, said};
use crate::schemas::{assert_valid, validators};

fn kept(name: &str) -> String {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../vectors/offloading").join(name);
    fs::read_to_string(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display()))
}

/// The world without an attacker, which is small, in the paper profile.
fn honest() -> Vec<WorldOutcome> {
    let world = Bounds::Small.worlds().iter().find(|world| world.name == "honest").unwrap();
    vec![run::explore(world, Profile::PAPER, |_| {}).unwrap()]
}

/// The page has a row for every world and property in both profiles; that of the smallest world is
/// what is explored today.
#[test]
fn the_tables_of_the_page_are_those_of_a_run() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/exploration.md");
    let tables = document::read(&page, &explore::table_name(Bounds::Small)).unwrap();
    let rows = |text: &str, name: &str| -> Vec<String> {
        let start = format!("| {name} | ");
        text.lines().filter(|line| line.starts_with(&start)).map(str::to_owned).collect()
    };
    let worlds = Bounds::Small.worlds().iter().map(|world| world.name.to_owned());
    let laws = Property::ALL.iter().map(|law| law.name().replace('_', " "));
    for name in worlds.chain(laws) {
        assert_eq!(
            rows(&tables, &name).len(),
            2,
            "{name}: mufasa explore --into docs/exploration.md"
        );
    }
    let today =
        ExplorationReport::new(Profile::PAPER, Bounds::Small, &honest(), Vec::new()).markdown();
    // Up to the depth; what follows depends on the machine.
    let sizes = |text: &str| -> Vec<String> {
        rows(text, "honest")[0].split(" | ").take(6).map(str::to_owned).collect()
    };
    assert_eq!(sizes(&tables), sizes(&today));
    let stamp = document::stamp(Some(&page)).unwrap();
    assert!(stamp.starts_with("Measured with: commit ") && stamp.ends_with(".\n\n"), "{stamp}");
    assert_eq!(
        [None, Some(Path::new("/"))].map(document::stamp),
        [(); 2].map(|()| Ok(String::new()))
    );
}

/// H-08 and F-12: after the same events the local services stand still in the paper profile and
/// compute in the hardened one; the oracle answers as the vectors expect.
#[test]
fn the_oracle_answers_the_vectors_of_f_12() {
    let text = kept("explored-F-12.jsonl");
    let mut stopped = Vec::new();
    for line in text.lines() {
        let vector: Value = serde_json::from_str(line).unwrap();
        let input = vector["input"].to_string();
        let record = json::parse(input.as_bytes(), 1).unwrap();
        assert!(matches!(&record, Record::Offloading { id, .. } if *id == vector["id"]));
        let answer = serde_json::to_value(json::decide(record).unwrap()).unwrap();
        assert_eq!(answer, vector["expect"], "{}", vector["id"]);
        assert_eq!(vector["requirement"], "F-12");
        let last = vector["expect"]["states"].as_array().unwrap().last().unwrap();
        assert_eq!(last["mot"], "remote:1");
        let profile = vector["input"]["profile"].as_str().unwrap().to_owned();
        assert_eq!(vector["flag"], format!("{profile}-only"));
        stopped.push((profile, last["actions"].to_string().contains("deactivate")));
    }
    assert_eq!(stopped, [("paper".to_owned(), true), ("hardened".to_owned(), false)]);
}

/// F-12 is what the exploration finds today, neither longer nor shorter.
#[test]
fn the_program_shows_verdicts_and_writes_what_it_found() {
    let folder = folder("honest");
    let found = said(&folder, &["explore", "--world", "honest", "--out", "."]);
    found.has(0, "fails after 4 moves (F-12)", "");
    // Both profiles.
    assert_eq!(found.out.matches("5,073").count(), 2, "{}", found.out);
    let name = "explored-F-12.jsonl";
    let text = fs::read_to_string(folder.join(name)).expect("it was written");
    assert_eq!(text, kept(name), "mufasa explore --out writes it");
}

/// And what is written is what its schema says.
#[test]
fn nothing_is_found_in_the_hardened_profile() {
    let folder = folder("hardened");
    let options = ["--profile", "hardened", "--world", "honest", "--out", "."];
    let found = said(&folder, &[&["explore"], &options[..]].concat());
    assert_eq!((found.code, found.out.contains("fails")), (Some(0), false), "{}", found.out);
    let files = fs::read_dir(&folder).unwrap().map(|file| file.unwrap().file_name());
    let mut files: Vec<_> = files.collect();
    files.sort();
    assert_eq!(files, ["exploration.json", "exploration.md"], "no counterexample");
    let json = fs::read_to_string(folder.join("exploration.json")).unwrap();
    let reports: Value = serde_json::from_str(&json).unwrap();
    assert_valid(&validators()["exploration"], &reports);
    assert_eq!(reports[0]["profile"], "hardened");
    assert_eq!(reports[0]["worlds"][0]["states"], 5073);
    for property in reports[0]["properties"].as_array().unwrap() {
        assert_eq!(property["fails_in"], 0, "{property}");
    }
}

#[test]
fn bad_arguments_are_refused() {
    for arguments in [["--world", "nowhere"], ["--bounds", "huge"]] {
        let told = said(&folder("bad"), &[&["explore", "--out", "."], &arguments[..]].concat());
        assert!(told.code == Some(2) && !told.err.is_empty(), "{arguments:?}");
    }
}
