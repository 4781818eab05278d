//! Programs that are right.

use mufasa_conform::Kind;

use crate::{MUFASA, cases, changed, right, with_vectors};

/// TOOL-02, TOOL-03, TOOL-05.
#[test]
fn model_and_implementation_conform_in_both_profiles() {
    for profile in ["paper", "hardened"] {
        // The exact model takes a second and more for the largest cycles.
        let options = format!("--profile {profile} --cases 1500 --seed 7 --time-limit 20000");
        let run = with_vectors(&format!("model-{profile}"), &options, &right());
        assert_eq!(run.code, Some(0), "{}", run.told);
        let summary = run.summary();
        assert_eq!((summary.asked, summary.disagreements(), summary.restarts), (1500, 0, 0));
        assert_eq!(summary.vectors, summary.campaign.vectors);
        assert!(summary.vectors > 500, "{}", run.told);
        // A campaign of nothing would conform, too.
        for verdict in ["safe", "error", "input", "i", "ii", "iii", "iv", "v"] {
            let reached = summary.groups.iter().any(|group| group.expected == verdict);
            assert!(reached, "{profile}: no case is {verdict}");
        }
        for kind in Kind::USUAL {
            assert!(summary.groups.iter().any(|group| group.kind == kind));
        }
        // The command of docs/conformance.md; it composes nothing.
        let options = format!("--profile {profile} --cases 1500 --kinds cycle,offloading,line");
        let script = format!("exec '{MUFASA}' oracle --implementation");
        let run = with_vectors(&format!("implementation-{profile}"), &options, &script);
        assert_eq!(run.code, Some(0), "{}", run.told);
    }
}

/// A monitor is asked for when it is named, and never else.
#[test]
fn the_model_conforms_as_a_monitor() {
    for profile in ["paper", "hardened"] {
        let options = format!("--profile {profile} --kinds monitor,line --cases 60");
        let run = with_vectors(&format!("monitor-{profile}"), &options, &right());
        assert_eq!(run.code, Some(0), "{}", run.told);
        let summary = run.summary();
        let of = |kind| summary.groups.iter().filter(move |group| group.kind == kind);
        assert!(of(Kind::Monitor).count() > 1 && of(Kind::Line).count() > 0, "{}", run.told);
        assert!(summary.vectors > 60, "{}", run.told);
    }
}

/// The answers to lines that are no records need no place; nobody has to answer every kind.
#[test]
fn three_keys_are_enough() {
    let script = changed(r#"s/,"\(error\|stages\)":{.*}/}/"#);
    let run = cases("three-keys", "--kinds cycle,line --cases 500", &script);
    assert_eq!(run.code, Some(0), "{}", run.told);
    let lines = run.summary().groups.into_iter().find(|group| group.kind == Kind::Line);
    assert!(lines.is_some_and(|group| group.cases > 20));
}
