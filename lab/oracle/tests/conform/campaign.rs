//! Campaigns: usage, files, drives.

use std::ffi::OsString;
use std::fs;
use std::path::Path;

use crate::{MUFASA, cases, folder, judged, mufasa, right};

#[test]
fn bad_usage_and_a_program_that_is_not_there_end_with_2() {
    let out = folder("none").display().to_string();
    for (words, said) in [
        (format!("conform --out {out} -- ./no-such-program"), "no-such-program: cannot be started"),
        (format!("conform --out {out} --drives no-such-file -- {MUFASA} oracle"), "no-such-file"),
        (String::from("conform"), ""),
    ] {
        let (code, told) = mufasa(&words, &[]);
        assert!(code == Some(2) && told.contains(said), "{words}: {told}");
    }
}

#[test]
fn what_an_earlier_run_left_does_not_look_like_a_result() {
    let folder = folder("stale");
    fs::write(folder.join("summary.json"), "old").expect("a file");
    fs::create_dir(folder.join("reproducers.jsonl")).expect("a folder in the way");
    let run = judged(&folder, "--cases 5 --no-vectors", &right());
    assert_eq!(run.code, Some(2), "{}", run.told);
    assert!(!folder.join("summary.json").exists());
}

/// The names of the files in a folder.
fn names(folder: &Path) -> Vec<OsString> {
    let entries = fs::read_dir(folder).expect("a folder");
    let mut names: Vec<_> = entries.map(|it| it.expect("an entry").file_name()).collect();
    names.sort();
    names
}

#[test]
fn recorded_cycles_are_asked_clean_attacked_and_in_other_configurations() {
    // The demo writes a drive; the empty track list goes through in the paper profile (F-14).
    let demo = folder("demo");
    let (code, told) = mufasa("demo --out", std::slice::from_ref(&demo));
    assert_eq!(code, Some(0), "{told}");
    let is_drive = |name: &OsString| {
        Path::new(name).extension().is_some_and(|it| it == "xml" || it == "jsonl")
    };
    let files = names(&demo).into_iter().filter(is_drive);
    let files: Vec<String> = files.map(|it| demo.join(it).display().to_string()).collect();
    assert!(!files.is_empty());
    let options = format!("--cases 120 --drives {}", files.join(" "));
    let script = format!("exec '{MUFASA}' oracle --implementation");
    let run = cases("drives", &options, &script);
    let (summary, told) = (run.summary(), &run.told);
    assert_eq!((run.code, summary.asked), (Some(0), 120), "{told}");
    for configuration in ["AllRemote", "MotRemote", "PlanRemote"] {
        let seen = summary.groups.iter().any(|group| group.configuration == configuration);
        assert!(seen, "{configuration}: {told}");
    }
    for verdict in ["safe", "i", "ii"] {
        assert!(summary.groups.iter().any(|group| group.expected == verdict), "no {verdict}");
    }
}
