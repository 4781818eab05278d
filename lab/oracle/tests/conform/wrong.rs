//! Programs that answer wrongly.

use mufasa_conform::{Breach, Scale};

use crate::{EACH, always_safe, changed, class, is_of, names_iv_for_iii, with_vectors, wrong};

/// TOOL-04.
#[test]
fn who_always_says_safe_is_unsound() {
    let options = "--kinds cycle --cases 150 --profile paper";
    let (summary, told) = wrong("safe", options, &always_safe());
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

    let (clear, told) = wrong("tolerance", &format!("{options} --tolerance 1e-6"), &always_safe());
    let of = |scale| summary.classes.iter().filter(move |found| found.class.scale == scale);
    let threshold: u64 = of(Scale::Threshold).map(|found| found.count).sum();
    assert_eq!(clear.tolerated, threshold, "{told}");
    assert_eq!(clear.classes.len(), of(Scale::Clear).count(), "{told}");
}

#[test]
fn who_always_says_unsafe_is_incomplete_or_names_the_wrong_stage() {
    let script = format!(
        r#"{EACH} printf '{{"id": "%s", "verdict": "unsafe", "failed_stage": "ii"}}\n' "$id"; done"#
    );
    let found = wrong("unsafe", "--kinds cycle --cases 100", &script);
    class(&found, Breach::Completeness, "ii");
    class(&found, Breach::Stage, "ii instead of i");
    let (summary, told) = found;
    assert!(summary.classes.iter().all(|found| found.class.breach != Breach::Soundness), "{told}");
}

#[test]
fn who_names_another_stage_is_told_which() {
    let options = "--kinds cycle --cases 200 --profile paper";
    let (summary, told) = wrong("stage", options, &names_iv_for_iii());
    for found in &summary.classes {
        assert!(is_of(found, Breach::Stage, "iv instead of iii"), "{told}");
        assert!(found.size <= 3, "{told}");
        assert!(found.told.expected.contains("stage iv skipped (after_failure)"), "{told}");
    }
}

#[test]
fn who_forgets_a_hold_or_a_composition_is_found_in_one_object() {
    let forgets = changed(r#"s/"hold_until_ns":-*[0-9][0-9]*/"hold_until_ns":null/g"#);
    let found = wrong("hold", "--kinds offloading --cases 20", &forgets);
    assert_eq!(class(&found, Breach::States, "hold_until_ns after verdict").size, 1, "{}", found.1);
    let misses = format!(
        r#"{EACH} printf '{{"id": "%s", "compositions": [], "none": {{"rule": "acyclic"}}}}\n' "$id"; done"#
    );
    let found = wrong("composition", "--kinds composition --cases 40", &misses);
    assert_eq!(class(&found, Breach::Compositions, "one is missing").size, 1, "{}", found.1);
}

/// A difference of a monitor is told with its event, its field and the requirement, of a sequence made small.
#[test]
fn who_forgets_a_rule_of_the_monitor_is_told_which() {
    let forgets = changed(r#"s/"dropped":"stale"/"dropped":null/g"#);
    let found = wrong("monitor", "--kinds monitor --cases 20", &forgets);
    let stale = class(&found, Breach::States, "dropped after trajectory");
    let expected = &stale.told.expected;
    assert!(expected.starts_with("dropped after event "), "{expected}");
    assert!(expected.ends_with("(trajectory) [MON-30] must be \"stale\", is null"), "{expected}");
    // A cycle whose detections are kept, an offer, a tick that asks, the confirmation, and the trajectory.
    assert_eq!(stale.size, 5, "{}", found.1);
    let lenient = changed(r#"s/"verdict":"error".*/"states":[]}/"#);
    let (summary, told) = wrong("monitor-settings", "--kinds monitor --cases 60", &lenient);
    for found in &summary.classes {
        assert!(found.class.place.ends_with("is not refused"), "{told}");
    }
}

/// What only the tolerance lets pass is no conformance, of vectors and of cases. TOOL-05, TOOL-06.
#[test]
fn what_only_a_tolerance_lets_pass_is_said_not_to_conform() {
    // It accepts what the lax model accepts: with margins of at most 1e-2 m.
    let script = changed(
        r#"/"lax":"safe"/s/"verdict":"unsafe","failed_stage":"[a-z_]*"/"verdict":"safe","failed_stage":null/"#,
    );
    let options = "--kinds cycle --cases 150 --profile paper --tolerance 1e-2";
    let run = with_vectors("tolerated", options, &script);
    let (summary, told) = (run.summary(), &run.told);
    assert_eq!(run.code, Some(0), "{told}");
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
    let script = changed(r#"s/"verdict":"error"/"verdict":"safe"/"#);
    let all = wrong("lenient", "--kinds cycle,line --cases 500", &script);
    let told = &all.1;
    for wrong in ["blank", "no JSON", "unknown field", "field twice", "integer with fraction"] {
        let found = class(&all, Breach::Schema, wrong);
        assert!(!found.is_tried() || found.shrunk && found.size <= 3, "{told}");
        assert!(found.told.expected.starts_with("error: field"), "{told}");
    }
    // Invalid values are another matter than lines that cannot be read.
    assert!(all.0.classes.iter().any(|it| it.class.breach == Breach::Input), "{told}");
}

/// CYCLE-03, INPUT-06
#[test]
fn who_names_another_place_is_found() {
    let script = changed(r#"s/"index":0/"index":null/"#);
    let (summary, told) = wrong("another-place", "--kinds line --cases 300", &script);
    for found in &summary.classes {
        assert_eq!(found.class.breach, Breach::Schema, "{told}");
        assert!(found.class.place.ends_with("at another place"), "{told}");
        assert!(found.told.expected.contains("index 0"), "{told}");
    }
    let script = changed(r#"s/"field":"[a-z]*/"field":"elsewhere/"#);
    let all = wrong("elsewhere", "--kinds cycle,composition --cases 1500", &script);
    for found in &all.0.classes {
        let breaches = [Breach::Input, Breach::Compositions];
        assert!(breaches.contains(&found.class.breach), "{}", all.1);
        assert!(found.class.place.ends_with("at another place"), "{}", all.1);
        assert!(!found.is_tried() || found.size <= 3, "{}", all.1);
    }
    class(&all, Breach::Input, "ego at another place");
    class(&all, Breach::Input, "tracks at another place");
}

/// A first program is wrong nearly everywhere: it fits on a screen what to mend first, with its record,
/// which rules broke, and where to begin; with all kinds and the vectors it is not longer.
#[test]
fn who_begins_is_told_what_to_mend_first() {
    let options = "--kinds cycle,composition --cases 60";
    let (summary, told) = wrong("beginner", options, &always_safe());
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

    let run = with_vectors("wall", "--cases 40", &always_safe());
    let told = &run.told;
    assert!(run.summary().classes.len() > 60, "{told}");
    assert!(told.lines().count() < 40, "{} lines: {told}", told.lines().count());
    let schema = told.lines().find(|line| line.contains(" x  line schema: ")).expect("schema");
    assert!(schema.matches(" (1)").count() <= 2 && schema.ends_with(" more"), "{schema}");
}
