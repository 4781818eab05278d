//! Vectors are asked first.

use std::fs;
use std::process::Command;

use mufasa_conform::Scale;

use crate::{EACH, MUFASA, SAFE, folder, summary, text, with_vectors};

#[test]
fn without_a_case_the_vectors_find_who_says_always_safe() {
    let program = format!("{EACH} {SAFE}; done");
    let options = ["--kinds", "cycle", "--cases", "0", "--profile", "paper"];
    let folder = folder("vectors");
    let output = with_vectors(&folder, &options, &["sh", "-c", &program]);
    let told = text(&output);
    if output.status.code() == Some(2) {
        eprintln!("NOT RUN: vectors: there is no `sh` here");
        return;
    }
    assert_eq!(output.status.code(), Some(1), "{told}");
    let summary = summary(&folder);
    assert_eq!((summary.asked, summary.vectors), (0, summary.campaign.vectors));
    let wrong = summary.wrong_vectors();
    assert!(wrong.len() > 50 && (wrong.len() as u64) < summary.vectors, "{told}");
    assert_eq!(wrong.len() as u64, summary.disagreements());
    for stage in ["iii", "iv", "v"] {
        let place = |place: &str| place.split(' ').next() == Some(stage);
        assert!(summary.classes.iter().any(|it| place(&it.class.place)), "{stage}: {told}");
    }
    for found in &summary.classes {
        assert!(found.first.is_none() && !found.about.is_empty(), "{told}");
        assert_eq!(found.shrunk, found.is_tried(), "{told}");
        assert!(found.vectors.contains(&found.name), "{told}");
    }
    assert!(told.contains(&format!(
        "{} vectors asked: {} DISAGREE: ",
        summary.vectors,
        wrong.len()
    )));
    assert!(
        told.contains("shrunk from vector ")
            && summary
                .classes
                .iter()
                .any(|it| { told.contains(&format!("\n  vector   {}\n", it.about)) }),
        "{told}"
    );
}

/// What is right in all cases is asked about in the vectors nevertheless.
#[test]
fn a_class_of_vectors_alone_is_a_disagreement() {
    // No generated cycle has this id.
    let program = format!(
        r#""{MUFASA}" oracle | while IFS= read -r line; do
        case $line in *'"id":"collision'*) printf '%s\n' "$line" | sed 's/"verdict":.*/"verdict":"safe","failed_stage":null}}/';;
        *) printf '%s\n' "$line";; esac; done"#
    );
    let run = |name: &str, more: &[&str]| {
        let folder = folder(name);
        let options = [&["--kinds", "cycle", "--cases", "40"], more].concat();
        let output = with_vectors(&folder, &options, &["sh", "-c", &program]);
        (output.status.code(), text(&output), folder)
    };
    let (code, told, out) = run("vectors-alone", &[]);
    if code == Some(2) {
        eprintln!("NOT RUN: vectors alone: there is no `sh` here");
        return;
    }
    assert_eq!(code, Some(1), "{told}");
    assert!(told.contains("40 of 40 cases asked: the program conforms in all of them"), "{told}");
    assert!(summary(&out).wrong_vectors().iter().all(|id| id.starts_with("collision")), "{told}");
    let junit = fs::read_to_string(out.join("junit.xml")).expect("JUnit XML");
    assert!(!junit.contains("name=\"vectors ("), "{junit}");
    let (code, told, _) = run("vectors-none", &["--no-vectors"]);
    assert_eq!(code, Some(0), "{told}");
    assert!(!told.contains("vectors asked"), "{told}");
}

/// Each vector is asked in one shard; the merged summary says what disagreed.
#[test]
fn shards_divide_the_vectors() {
    let program = format!("{EACH} {SAFE}; done");
    let options = ["--kinds", "cycle", "--cases", "0", "--profile", "paper"];
    let whole = folder("vectors-whole");
    with_vectors(&whole, &options, &[MUFASA, "oracle"]);
    let whole = summary(&whole);
    let parts = folder("vectors-parts");
    for shard in ["0/3", "1/3", "2/3"] {
        let options = [&options[..], &["--shard", shard]].concat();
        with_vectors(&parts, &options, &["sh", "-c", &program]);
    }
    let files = (0..3).map(|it| parts.join(format!("summary.{it}-of-3.json")));
    let mut merge = Command::new(MUFASA);
    let output = merge.args(["conform", "merge"]).args(files).arg("--out").arg(&parts).output();
    let output = output.expect("mufasa runs");
    if !parts.join("summary.0-of-3.json").exists() {
        eprintln!("NOT RUN: shards of vectors: there is no `sh` here");
        return;
    }
    let merged = summary(&parts);
    assert!(whole.vectors > 400, "{}", whole.vectors);
    assert_eq!(merged.vectors, whole.vectors, "{}", text(&output));
    assert!(merged.wrong_vectors().len() > 40, "{}", text(&output));
    let mut once = merged.wrong_vectors();
    once.sort_unstable();
    once.dedup();
    assert_eq!(once.len(), merged.wrong_vectors().len());
}

/// Vectors and cases that are not asked are counted apart.
#[test]
fn what_is_left_out_is_counted_on_the_line_of_its_own() {
    let folder = folder("vectors-left-out");
    let options = ["--kinds", "cycle", "--cases", "20", "--profile", "paper"];
    let output = with_vectors(&folder, &options, &["sh", "-c", "exit 7"]);
    let told = text(&output);
    if output.status.code() == Some(2) {
        eprintln!("NOT RUN: left out: there is no `sh` here");
        return;
    }
    let summary = summary(&folder);
    assert_eq!(summary.vectors + summary.vectors_skipped, summary.campaign.vectors, "{told}");
    assert_eq!((summary.asked, summary.skipped), (0, 20), "{told}");
    let said = format!(
        "of {} vectors asked, {} left out: ",
        summary.campaign.vectors, summary.vectors_skipped
    );
    assert!(
        told.contains(&said) && told.contains("\n0 of 20 cases asked, 20 left out\n"),
        "{told}"
    );
}

/// The program in Python, with the norm of directions in doubles in place of fractions.
const IN_DOUBLES: &str = "import sys, runpy; sys.path.insert(0, sys.argv[1]); import record; \
                          record.Fraction = float; \
                          runpy.run_path(sys.argv[1] + '/mufasa_py.py', run_name='__main__')";

/// The vectors at the bound find what is decided in doubles, and nothing else; `--tolerance` hides
/// it, and the report says that it does.
#[test]
fn a_norm_in_doubles_is_found_by_the_vectors_and_hidden_by_a_tolerance() {
    let programs = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/conformance");
    let run = |name: &str, more: &[&str]| {
        let folder = folder(name);
        let least = ["--kinds", "cycle", "--cases", "0", "--profile", "paper"];
        let options = [&least[..], &["--time-limit", "60000"], more].concat();
        let output = with_vectors(&folder, &options, &["python3", "-c", IN_DOUBLES, programs]);
        (output.status.code(), text(&output), folder)
    };
    let (code, told, out) = run("norm", &[]);
    if code == Some(2) {
        eprintln!("NOT RUN: norm in doubles: there is no `python3` here");
        return;
    }
    assert_eq!(code, Some(1), "{told}");
    let found = summary(&out);
    let wrong = found.wrong_vectors();
    assert_eq!(wrong.len(), 16, "{told}");
    assert!(wrong.iter().all(|id| id.starts_with("input-norm-")), "{told}");
    assert!(found.classes.iter().all(|it| it.class.scale == Scale::Threshold), "{told}");
    let (code, told, out) = run("norm-tolerated", &["--tolerance", "1e-6"]);
    assert_eq!(code, Some(0), "{told}");
    let found = summary(&out);
    assert_eq!((found.vectors_tolerated, found.disagreements()), (16, 0), "{told}");
    let said = "16 agree within the tolerance only: no disagreement beyond the tolerance (this is not conformance)";
    assert!(told.contains(&format!("{} vectors asked, {said}", found.vectors)), "{told}");
}
