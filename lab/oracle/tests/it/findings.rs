//! Every finding has its file, and each file names what exists: vectors, theorems,
//! laws. The witnesses that a solver finds are accepted in the paper profile and in no hardened one.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use mufasa_model::cycle::check;
use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_model::report::{FailedStage, Reading, Stage};
use mufasa_props::bridge;
use mufasa_records::{self as json, Record};
use mufasa_theorems::claim::Decision;
use mufasa_theorems::numbers::real::formula::Formula;
use mufasa_theorems::prove::prove_claim;
use mufasa_theorems::report::Reading as SymbolicReading;
use mufasa_theorems::{cycle as symbolic_cycle, theorem, witness};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn read(file: impl AsRef<Path>) -> String {
    let file = root().join(file);
    fs::read_to_string(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display()))
}

/// The vectors of a folder, which a test of `lab/conform` compares with those made anew.
fn vectors(folder: &Path) -> Vec<serde_json::Value> {
    let files =
        fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let files = files.map(|file| file.expect("a file").path());
    let text: String =
        files.filter(|file| file.extension() == Some("jsonl".as_ref())).map(read).collect();
    text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect()
}

/// The rows of the table, cell by cell.
fn table() -> Vec<Vec<String>> {
    let page = read("findings/README.md");
    let rows = page.lines().filter(|line| line.starts_with("| [F-"));
    rows.map(|row| row.trim_matches('|').split(" | ").map(|it| it.trim().to_owned()).collect())
        .collect()
}

/// Findings with their claims.
fn claims() -> Vec<(String, String)> {
    let finding = |row: Vec<String>| {
        let id = row[0].split(['[', ']']).nth(1).unwrap_or_default().to_owned();
        (id, row[1].clone())
    };
    table().into_iter().map(finding).collect()
}

/// The names of one kind that a file lists as "* kind `name`".
fn named<'a>(text: &'a str, kind: &str) -> Vec<&'a str> {
    let start = format!("* {kind} `");
    text.lines().filter_map(|line| line.strip_prefix(&start)?.strip_suffix('`')).collect()
}

#[test]
fn every_finding_has_a_file_with_its_claim() {
    let claims = claims();
    assert!(claims.len() >= 23);
    for (finding, claim) in &claims {
        let file = read(format!("findings/{finding}.md"));
        let quoted: Vec<&str> = file.lines().filter_map(|line| line.strip_prefix("> ")).collect();
        assert_eq!(quoted.join(" "), *claim, "{finding}");
        for heading in ["## Witness", "## Hardened", "## Open"] {
            assert!(file.contains(heading), "{finding}: {heading}");
        }
    }
    let files = fs::read_dir(root().join("findings")).expect("findings/").count();
    assert_eq!(files, claims.len() + 1, "a README and a file for each finding, nothing else");
}

/// Each row says what an attacker gets out of it.
#[test]
fn the_table_has_a_consequence_for_every_finding() {
    for (number, row) in (1..).zip(table()) {
        assert_eq!(row[0], format!("[F-{number:02}](F-{number:02}.md)"));
        assert_eq!(row.len(), 7, "{row:?}");
        assert!(row.iter().all(|cell| cell.len() > 2), "{row:?}");
    }
}

#[test]
fn every_file_names_what_exists() {
    let folders = fs::read_dir(root().join("vectors")).expect("vectors/");
    let folders = folders.map(|folder| folder.expect("a folder").path()).filter(|it| it.is_dir());
    let vectors: BTreeSet<String> = folders
        .flat_map(|folder| vectors(&folder))
        .map(|vector| vector["id"].as_str().expect("an id").to_owned())
        .collect();
    let theorems: BTreeSet<&str> = theorem::all().map(|theorem| theorem.id).collect();
    let laws = ["requester", "schedule"].map(|law| read(format!("proofs/src/law/{law}.rs")));
    let laws = [laws.join("\n"), read("proofs/exploration/src/properties.rs")].join("\n");
    let mut lists = [0, 0, 0];
    for (finding, _) in claims() {
        let file = read(format!("findings/{finding}.md"));
        for vector in named(&file, "vector") {
            assert!(vectors.contains(vector), "{finding}: no vector {vector}");
            lists[0] += 1;
        }
        for theorem in named(&file, "theorem") {
            assert!(theorems.contains(theorem), "{finding}: no theorem {theorem}");
            lists[1] += 1;
        }
        for law in named(&file, "law") {
            let is_there =
                laws.contains(&format!("fn {law}(")) || laws.contains(&format!("\"{law}\""));
            assert!(is_there, "{finding}: no law {law}");
            lists[2] += 1;
        }
    }
    assert!(lists[0] > 40 && lists[1] > 15 && lists[2] > 2, "{lists:?}");
}

#[test]
fn a_witness_that_z3_finds_is_accepted_by_the_paper_profile_alone() {
    if !mufasa_theorems::solver::is_new_enough() {
        println!("NOT RUN: no z3 4.8 here");
        return;
    }
    for search in &witness::searches::SEARCHES {
        let paper = witness::find(search).expect("z3 answers").expect(search.finding);
        assert!(is_safe(&paper), "{}: {paper:?}", search.finding);
        let hardened = Cycle { profile: Profile::HARDENED, ..paper };
        assert!(!is_safe(&hardened), "{}: {hardened:?}", search.finding);
        let implementation = bridge::check_impl(&hardened).expect("the local input is valid");
        assert!(implementation.failed_stage.is_some(), "{}", search.finding);
    }
}

/// The arc length of a trajectory with more points is a sum of more roots, at which z3 does not end within minutes.
const MOST_POINTS: usize = 40;

/// The model's source decides with symbolic numbers as it does with exact ones.
#[test]
fn symbolic_numbers_decide_every_finding_as_exact_ones_do() {
    if !mufasa_theorems::solver::is_new_enough() {
        println!("NOT RUN: no z3 4.8 here");
        return;
    }
    let mut verdicts = [0, 0];
    for vector in vectors(&root().join("vectors/findings")) {
        let id = vector["id"].as_str().expect("an id");
        let input = vector["input"].to_string();
        let Ok(Record::Cycle { cycle, .. }) = json::parse(input.as_bytes(), 1) else {
            continue;
        };
        let exact = check(&cycle, Reading::Exact).expect("the local input is valid");
        // The places of H-14 take z3 minutes for each cycle; its theorems run the same source with symbols.
        let is_before_h14 = exact.failed_stage == Some(FailedStage::Stage(Stage::I));
        let points = cycle.trajectory.as_ref().map_or(0, |it| it.points.len());
        if cycle.profile == Profile::HARDENED && !is_before_h14 || points > MOST_POINTS {
            continue;
        }
        let expected = format!("{:?}", exact.failed_stage);
        let proof = prove_claim(&|| {
            let symbolic = symbolic_cycle::check(&cycle, SymbolicReading::Exact);
            let failed = symbolic.map(|report| report.failed_stage);
            Formula::from(failed.is_ok_and(|failed| format!("{failed:?}") == expected))
        });
        let proof = proof.expect("z3 answers");
        assert_eq!(proof.decision, Decision::Proved, "{id}");
        verdicts[usize::from(is_safe(&cycle))] += 1;
    }
    println!("{} unsafe, {} safe", verdicts[0], verdicts[1]);
    assert!(verdicts[0] > 5 && verdicts[1] > 15, "{verdicts:?}");
}

fn is_safe(cycle: &Cycle) -> bool {
    let report = check(cycle, Reading::Exact).expect("the local input is valid");
    report.failed_stage.is_none()
}

/// F-46, F-54, F-55: a car crosses straight on. With the second decelerations of CAV and car (-4: it speeds up) they meet, first at that time
/// and speed of the CAV, and not with the first ones, of which none is above the vector's `a_b`. The CAV brakes from `begins`
/// on, in s.
#[test]
fn a_vehicle_that_brakes_harder_meets_who_one_that_brakes_with_a_b_lets_pass() {
    let lines =
        ["F-46", "F-54", "F-55"].map(|id| read(format!("vectors/findings/{id}.jsonl"))).concat();
    for (id, begins, soft, hard, after_ms, at) in [
        ("F-54-harder", 0.0, [8.0, 0.0], [11.0, 0.0], 800, 6.2),
        ("F-54-smaller", 0.0, [4.0, 0.0], [8.0, 0.0], 900, 7.8),
        ("F-54-object", 0.1, [8.0, 8.0], [8.0, 11.0], 931, 8.4),
        ("F-46-speeds-up", 0.0, [8.0, 0.0], [8.0, -4.0], 652, 9.8),
        ("F-55-crosses-true", 0.1, [8.0, 0.0], [8.0, 8.0], 931, 8.4),
    ] {
        let line = lines.lines().find(|it| it.contains(&format!("\"id\": \"{id}\"")));
        let vector: serde_json::Value = serde_json::from_str(line.expect(id)).expect("JSON");
        let number = |path: &str| {
            vector["input"].pointer(path).and_then(serde_json::Value::as_f64).expect(path)
        };
        let (v, w) = (number("/ego/speed"), number("/tracks/items/0/vy"));
        let meets = |[cav, car]: [f64; 2], ms: u32| {
            let t = f64::from(ms) / 1000.0;
            let braking = (t - begins).max(0.0);
            let along = v * (t - braking) + braked(v, cav, braking) + number("/ego/center_offset")
                - number("/detections/items/0/x");
            let aside = number("/detections/items/0/y") + braked(w, car, t);
            let [long, wide] = ["length", "width"].map(|it| number(&format!("/ego/{it}")));
            let [car_long, car_wide] =
                ["length", "width"].map(|it| number(&format!("/detections/items/0/{it}")));
            along.abs() <= f64::midpoint(long, car_wide)
                && aside.abs() <= f64::midpoint(wide, car_long)
        };
        let first = (0..5000).find(|ms| meets(hard, *ms)).expect("they meet");
        assert!(first.abs_diff(after_ms) <= 1, "{id}: {first} ms");
        let left = v - hard[0] * (f64::from(first) / 1000.0 - begins);
        assert!((left - at).abs() < 0.1, "{id}: {left} m/s");
        assert!((0..5000).all(|ms| !meets(soft, ms)), "{id}: they meet, too");
    }
}

/// The way of braking with b for t, m.
fn braked(v: f64, b: f64, t: f64) -> f64 {
    let t = if b > 0.0 { t.min(v / b) } else { t };
    v * t - b * t * t / 2.0
}
