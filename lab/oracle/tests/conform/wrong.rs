//! Programs that answer wrongly.

use mufasa_conform::{Breach, Found, Scale};

use crate::{EACH, MUFASA, SAFE, names_iv_for_iii, script};

/// TOOL-04.
#[test]
fn who_always_says_safe_is_unsound() {
    let options = ["--kinds", "cycle", "--cases", "150", "--profile", "paper"];
    let program = format!("{EACH} {SAFE}; done");
    let Some((summary, told)) = script("safe", &options, &program) else { return };
    // What is unsafe by a stage comes before invalid input, though that is wrong in as many answers.
    let (_, first) =
        told.split_once("\nmend first:\nDISAGREES  cycle soundness ").expect("unsound");
    assert!(
        ["i", "ii", "iii", "iv", "v"].iter().any(|stage| first.starts_with(&format!("{stage} "))),
        "{told}"
    );
    for found in &summary.classes {
        // Invalid local input has a rule of its own.
        let breaches = [Breach::Soundness, Breach::Input];
        assert!(breaches.contains(&found.class.breach), "{told}");
        assert!(!found.is_tried() || found.shrunk && found.size <= 3, "{told}");
    }
    let collision = |scale| {
        let place = |place: &str| place == "iii collision" || place == "iv collision";
        summary
            .classes
            .iter()
            .find(|found| place(&found.class.place) && found.class.scale == scale)
            .unwrap_or_else(|| panic!("no collision: {told}"))
    };
    let numbers = collision(Scale::Clear).told.numbers.as_ref().expect("numbers");
    let value = |text: &str| text.parse::<f64>().expect("a number");
    assert!(value(&numbers.left) < value(&numbers.right), "{numbers:?}");
    let apart = value(&numbers.right) - value(&numbers.left);
    assert_eq!(value(&numbers.margin).to_bits(), apart.to_bits());
    // Around a threshold lie half of the cases.
    assert!(collision(Scale::Threshold).count > 0);
}

#[test]
fn who_always_says_unsafe_is_incomplete_or_names_the_wrong_stage() {
    let program = format!(
        r#"{EACH} printf '{{"id": "%s", "verdict": "unsafe", "failed_stage": "ii"}}\n' "$id"; done"#
    );
    let options = ["--kinds", "cycle", "--cases", "100"];
    let Some((summary, told)) = script("unsafe", &options, &program) else { return };
    let has = |breach, place: &str| {
        let same = |it: &&_| matches_class(it, breach, place);
        assert!(summary.classes.iter().any(|found| same(&found)), "{breach:?} {place}: {told}");
    };
    has(Breach::Completeness, "ii");
    has(Breach::Stage, "ii instead of i");
    assert!(summary.classes.iter().all(|found| found.class.breach != Breach::Soundness), "{told}");
}

fn matches_class(found: &Found, breach: Breach, place: &str) -> bool {
    found.class.breach == breach && found.class.place == place
}

#[test]
fn who_names_another_stage_is_told_which() {
    let options = ["--kinds", "cycle", "--cases", "200", "--profile", "paper"];
    let Some((summary, told)) = script("stage", &options, &names_iv_for_iii()) else { return };
    for found in &summary.classes {
        assert!(matches_class(found, Breach::Stage, "iv instead of iii"), "{told}");
        assert!(found.size <= 3, "{told}");
        assert!(found.told.expected.contains("stage iv skipped (after_failure)"), "{told}");
    }
}

#[test]
fn who_forgets_the_hold_is_found_in_few_events() {
    let program = format!(
        r#""{MUFASA}" oracle | sed -u 's/"hold_until_ns":-*[0-9][0-9]*/"hold_until_ns":null/g'"#
    );
    let options = ["--kinds", "offloading", "--cases", "20"];
    let Some((summary, told)) = script("hold", &options, &program) else { return };
    let verdict = "hold_until_ns after verdict";
    let found = summary.classes.iter().find(|it| matches_class(it, Breach::States, verdict));
    assert_eq!(found.unwrap_or_else(|| panic!("{told}")).size, 1, "{told}");
}

#[test]
fn who_misses_a_composition_is_found() {
    let program = format!(
        r#"{EACH} printf '{{"id": "%s", "compositions": [], "none": {{"rule": "acyclic"}}}}\n' "$id"; done"#
    );
    let options = ["--kinds", "composition", "--cases", "40"];
    let Some((summary, told)) = script("composition", &options, &program) else { return };
    let missing = "one is missing";
    let found = summary.classes.iter().find(|it| matches_class(it, Breach::Compositions, missing));
    assert_eq!(found.unwrap_or_else(|| panic!("{told}")).size, 1, "{told}");
}

#[test]
fn a_tolerance_lets_only_what_it_explains_pass() {
    let options = ["--kinds", "cycle", "--cases", "120", "--profile", "paper"];
    let tolerant = [&options[..], &["--tolerance", "1e-6"]].concat();
    let program = format!("{EACH} {SAFE}; done");
    let Some((all, _)) = script("no-tolerance", &options, &program) else { return };
    let Some((clear, told)) = script("tolerance", &tolerant, &program) else { return };
    let of = |scale| all.classes.iter().filter(move |found| found.class.scale == scale);
    let threshold: u64 = of(Scale::Threshold).map(|found| found.count).sum();
    assert!(threshold > 0);
    assert_eq!(clear.tolerated, threshold, "{told}");
    assert_eq!(clear.classes.len(), of(Scale::Clear).count(), "{told}");
}

/// What only the tolerance lets pass is no conformance, of vectors and of cases. TOOL-05, TOOL-06.
#[test]
fn what_only_a_tolerance_lets_pass_is_said_not_to_conform() {
    // It accepts what the lax model accepts: with margins of at most 1e-2 m.
    let program = format!(
        r#""{MUFASA}" oracle | while IFS= read -r line; do printf '%s\n' "$line" |
        sed '/"lax":"safe"/s/"verdict":"unsafe","failed_stage":"[a-z_]*"/"verdict":"safe","failed_stage":null/'; done"#
    );
    let folder = crate::folder("tolerated");
    let options =
        ["--kinds", "cycle", "--cases", "150", "--profile", "paper", "--tolerance", "1e-2"];
    let output = crate::with_vectors(&folder, &options, &["sh", "-c", &program]);
    let told = crate::text(&output);
    if output.status.code() == Some(2) {
        eprintln!("NOT RUN: tolerated: there is no `sh` here");
        return;
    }
    assert_eq!(output.status.code(), Some(0), "{told}");
    let summary = crate::summary(&folder);
    let (vectors, cases) = (summary.vectors_tolerated, summary.tolerated);
    assert!(vectors > 0 && cases > 0, "{told}");
    let says = "agree within the tolerance only: no disagreement beyond the tolerance (this is not conformance)";
    for (what, count) in [("vectors", vectors), ("cases", cases)] {
        assert!(told.contains(&format!("{what} asked, {count} {says}")), "{told}");
    }
    assert!(!told.contains("conforms"), "{told}");
}

/// INPUT-01, CYCLE-08
#[test]
fn who_takes_a_line_that_is_no_record_for_one_is_found() {
    let program = format!(r#""{MUFASA}" oracle | sed -u 's/"verdict":"error"/"verdict":"safe"/'"#);
    let options = ["--kinds", "cycle,line", "--cases", "500"];
    let Some((summary, told)) = script("lenient", &options, &program) else { return };
    for wrong in ["blank", "no JSON", "unknown field", "field twice", "integer with fraction"] {
        let found = summary.classes.iter().find(|it| matches_class(it, Breach::Schema, wrong));
        let found = found.unwrap_or_else(|| panic!("{wrong}: {told}"));
        assert!(!found.is_tried() || found.shrunk && found.size <= 3, "{told}");
        assert!(found.told.expected.starts_with("error: field"), "{told}");
    }
    // Invalid values are another matter than lines that cannot be read.
    assert!(summary.classes.iter().any(|it| it.class.breach == Breach::Input), "{told}");
}

/// CYCLE-03
#[test]
fn who_names_another_place_in_a_line_is_found() {
    let program = format!(r#""{MUFASA}" oracle | sed -u 's/"index":0/"index":null/'"#);
    let options = ["--kinds", "line", "--cases", "300"];
    let Some((summary, told)) = script("another-place", &options, &program) else { return };
    for found in &summary.classes {
        assert_eq!(found.class.breach, Breach::Schema, "{told}");
        assert!(found.class.place.ends_with("at another place"), "{told}");
        assert!(found.told.expected.contains("index 0"), "{told}");
    }
}

/// INPUT-06
#[test]
fn who_names_another_place_of_invalid_input_is_found() {
    let program = format!(r#""{MUFASA}" oracle | sed -u 's/"field":"[a-z]*/"field":"elsewhere/'"#);
    let options = ["--kinds", "cycle,composition", "--cases", "1500"];
    let Some((summary, told)) = script("elsewhere", &options, &program) else { return };
    for found in &summary.classes {
        assert!([Breach::Input, Breach::Compositions].contains(&found.class.breach), "{told}");
        assert!(found.class.place.ends_with("at another place"), "{told}");
        assert!(!found.is_tried() || found.size <= 3, "{told}");
    }
    for place in ["ego at another place", "tracks at another place"] {
        let found = summary.classes.iter().any(|it| matches_class(it, Breach::Input, place));
        assert!(found, "{place}: {told}");
    }
}

/// A first program is wrong nearly everywhere: it fits on a screen what to mend first, with its record,
/// which rules broke, and where to begin.
#[test]
fn who_begins_is_told_what_to_mend_first() {
    let program = format!("{EACH} {SAFE}; done");
    let options = ["--kinds", "cycle,composition", "--cases", "60"];
    let Some((summary, told)) = script("beginner", &options, &program) else { return };
    assert!(summary.classes.len() > 8, "{told}");
    assert_eq!(told.matches("\n  record  ").count(), 1, "{told}");
    let (found, report) = told.split_once("\nmend first:\n").expect("what to mend first");
    assert!(report.starts_with("DISAGREES  composition nonsense, "), "{told}");
    let hint = "much disagrees; begin with fewer: --profile paper --kinds cycle";
    let is_head = |line: &str| line.starts_with("found: ") || line.is_empty() || line == hint;
    assert!(found.lines().all(is_head) && found.ends_with(&format!("\n{hint}\n")), "{told}");
    assert!(told.contains(" x  cycle soundness ("), "{told}");
    assert!(told.lines().count() < 40, "{} lines: {told}", told.lines().count());
    assert!(told.lines().all(|line| !line.contains(" x  ") || line.len() < 240), "{told}");
}

/// With all kinds and the vectors it is not longer.
#[test]
fn who_begins_with_everything_is_not_shown_a_wall() {
    let program = format!("{EACH} {SAFE}; done");
    let folder = crate::folder("wall");
    let output = crate::with_vectors(&folder, &["--cases", "40"], &["sh", "-c", &program]);
    let told = crate::text(&output);
    if output.status.code() == Some(2) {
        eprintln!("NOT RUN: wall: there is no `sh` here");
        return;
    }
    let summary = crate::summary(&folder);
    assert!(summary.classes.len() > 60, "{told}");
    assert!(told.lines().count() < 40, "{} lines: {told}", told.lines().count());
    let schema = told.lines().find(|line| line.contains(" x  line schema: ")).expect("schema");
    assert!(schema.matches(" (1)").count() <= 2 && schema.ends_with(" more"), "{schema}");
}
