//! Vectors are asked first.

use mufasa_conform::Scale;

use crate::{always_safe, safe_where, with_vectors};

const LEAST: &str = "--kinds cycle --cases 0 --profile paper";

#[test]
fn without_a_case_the_vectors_find_who_says_always_safe() {
    let run = with_vectors("vectors", LEAST, &always_safe());
    let (summary, told) = (run.summary(), &run.told);
    assert_eq!(run.code, Some(1), "{told}");
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
    let (asked, wrong) = (summary.vectors, wrong.len());
    assert!(told.contains(&format!("{asked} vectors asked: {wrong} DISAGREE: ")), "{told}");
    let mut abouts = summary.classes.iter().map(|it| format!("\n  vector   {}\n", it.about));
    assert!(abouts.any(|about| told.contains(&about)), "{told}");
    assert!(told.contains("shrunk from vector "), "{told}");
}

/// What is right in all cases is asked about in the vectors nevertheless.
#[test]
fn a_class_of_vectors_alone_is_a_disagreement() {
    // No generated cycle has this id.
    let script = safe_where("\"id\":\"collision");
    let run = with_vectors("vectors-alone", "--kinds cycle --cases 40", &script);
    let told = &run.told;
    assert_eq!(run.code, Some(1), "{told}");
    assert!(told.contains("40 of 40 cases asked: the program conforms in all of them"), "{told}");
    let summary = run.summary();
    assert!(summary.wrong_vectors().iter().all(|id| id.starts_with("collision")), "{told}");
    assert!(!run.file("junit.xml").contains("name=\"vectors ("));
    let run = with_vectors("vectors-none", "--kinds cycle --cases 40 --no-vectors", &script);
    assert_eq!(run.code, Some(0), "{}", run.told);
    assert!(!run.told.contains("vectors asked"), "{}", run.told);
}

/// Vectors and cases that are not asked are counted apart.
#[test]
fn what_is_left_out_is_counted_on_the_line_of_its_own() {
    let options = "--kinds cycle --cases 20 --profile paper";
    let run = with_vectors("vectors-left-out", options, "exit 7");
    let (summary, told) = (run.summary(), &run.told);
    let (all, skipped) = (summary.campaign.vectors, summary.vectors_skipped);
    assert_eq!(summary.vectors + skipped, all, "{told}");
    assert_eq!((summary.asked, summary.skipped), (0, 20), "{told}");
    assert!(told.contains(&format!("of {all} vectors asked, {skipped} left out: ")), "{told}");
    assert!(told.contains("\n0 of 20 cases asked, 20 left out\n"), "{told}");
}

/// The vectors at the bound find what is decided in doubles, and nothing else; `--tolerance` hides
/// it, and the report says that it does.
#[test]
fn a_norm_in_doubles_is_found_by_the_vectors_and_hidden_by_a_tolerance() {
    if std::process::Command::new("python3").arg("--version").output().is_err() {
        return eprintln!("NOT RUN: norm in doubles: there is no `python3` here");
    }
    // The program in Python, with the norm of directions in doubles in place of fractions.
    let programs = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/conformance");
    let script = format!(
        r#"exec python3 -c 'import sys, runpy; sys.path.insert(0, sys.argv[1]); import record; record.Fraction = float
runpy.run_path(sys.argv[1] + "/mufasa_py.py", run_name="__main__")' '{programs}'"#
    );
    let options = format!("{LEAST} --time-limit 60000");
    let run = with_vectors("norm", &options, &script);
    let (found, told) = (run.summary(), &run.told);
    assert_eq!(run.code, Some(1), "{told}");
    let wrong = found.wrong_vectors();
    assert_eq!(wrong.len(), 16, "{told}");
    assert!(wrong.iter().all(|id| id.starts_with("input-norm-")), "{told}");
    assert!(found.classes.iter().all(|it| it.class.scale == Scale::Threshold), "{told}");
    let run = with_vectors("norm-tolerated", &format!("{options} --tolerance 1e-6"), &script);
    let (found, told) = (run.summary(), &run.told);
    assert_eq!(run.code, Some(0), "{told}");
    assert_eq!((found.vectors_tolerated, found.disagreements()), (16, 0), "{told}");
    let said = "16 agree within the tolerance only: no disagreement beyond the tolerance (this is not conformance)";
    assert!(told.contains(&format!("{} vectors asked, {said}", found.vectors)), "{told}");
}
