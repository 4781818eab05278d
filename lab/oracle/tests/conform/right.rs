//! Programs that are right.

use mufasa_conform::Kind;

use crate::{MUFASA, conform, folder, summary, text, with_vectors};

/// TOOL-02, TOOL-03, TOOL-05.
#[test]
fn the_model_conforms_in_both_profiles() {
    for profile in ["paper", "hardened"] {
        let folder = folder(&format!("model-{profile}"));
        let options = ["--profile", profile, "--cases", "1500", "--seed", "7"];
        let output = with_vectors(&folder, &options, &[MUFASA, "oracle"]);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output));
        let summary = summary(&folder);
        assert_eq!((summary.asked, summary.disagreements(), summary.restarts), (1500, 0, 0));
        assert_eq!(summary.vectors, summary.campaign.vectors);
        assert!(summary.vectors > 500, "{}", text(&output));
        // A campaign of nothing would conform, too.
        for verdict in ["safe", "error", "input", "i", "ii", "iii", "iv", "v"] {
            let reached = summary.groups.iter().any(|group| group.expected == verdict);
            assert!(reached, "{profile}: no case is {verdict}");
        }
        for kind in Kind::ALL {
            assert!(summary.groups.iter().any(|group| group.kind == kind));
        }
    }
}

#[test]
fn the_implementation_conforms_in_both_profiles() {
    for profile in ["paper", "hardened"] {
        let folder = folder(&format!("implementation-{profile}"));
        // The command of docs/conformance.md; it composes nothing.
        let options = ["--profile", profile, "--cases", "1500", "--kinds", "cycle,offloading,line"];
        let command = [MUFASA, "oracle", "--implementation"];
        let output = with_vectors(&folder, &options, &command);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output));
    }
}

/// The answers to lines that are no records need no place; nobody has to answer every kind.
#[test]
fn three_keys_are_enough() {
    let program = format!(r#""{MUFASA}" oracle | sed -u 's/,"\(error\|stages\)":{{.*}}/}}/'"#);
    let folder = folder("three-keys");
    let options = ["--kinds", "cycle,line", "--cases", "500"];
    let output = conform(&folder, &options, &["sh", "-c", &program]);
    if output.status.code() == Some(2) {
        eprintln!("NOT RUN: three keys: there is no `sh` here");
        return;
    }
    assert_eq!(output.status.code(), Some(0), "{}", text(&output));
    let lines = summary(&folder).groups.into_iter().find(|group| group.kind == Kind::Line);
    assert!(lines.is_some_and(|group| group.cases > 20));
}
