//! Campaigns: usage, files, shards, drives.

use std::fs;
use std::path::Path;
use std::process::Command;

use mufasa_conform::Summary;

use crate::{EACH, MUFASA, SAFE, conform, folder, names_iv_for_iii, summary, text, with_vectors};

#[test]
fn a_program_that_is_not_there_is_bad_usage() {
    let output = conform(&folder("none"), &[], &["./no-such-program"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output).contains("no-such-program: cannot be started"), "{}", text(&output));
    let output = conform(&folder("shard"), &["--shard", "3/3"], &[MUFASA, "oracle"]);
    assert_eq!(output.status.code(), Some(2), "{}", text(&output));
    let output = Command::new(MUFASA).arg("conform").output().expect("mufasa runs");
    assert_eq!(output.status.code(), Some(2), "{}", text(&output));
}

#[test]
fn what_an_earlier_run_left_does_not_look_like_a_result() {
    let folder = folder("stale");
    fs::write(folder.join("summary.json"), "old").expect("a file");
    fs::create_dir(folder.join("junit.xml")).expect("a folder in the way");
    let output = conform(&folder, &["--cases", "5"], &[MUFASA, "oracle"]);
    assert_eq!(output.status.code(), Some(2), "{}", text(&output));
    assert!(!folder.join("summary.json").exists());
}

#[test]
fn shards_are_disjoint_and_merge_to_the_whole() {
    let program = format!("{EACH} {SAFE}; done");
    let command = ["sh", "-c", program.as_str()];
    let whole = folder("whole");
    let options = ["--kinds", "cycle", "--cases", "60", "--profile", "paper", "--seed", "11"];
    let output = conform(&whole, &options, &command);
    if output.status.code() == Some(2) {
        eprintln!("NOT RUN: shards: there is no `sh` here");
        return;
    }
    let parts = folder("parts");
    for shard in ["0/3", "1/3", "2/3"] {
        conform(&parts, &[&options[..], &["--shard", shard]].concat(), &command);
    }
    let merge = |names: &[&str], out: &Path| {
        let files = names.iter().map(|name| parts.join(format!("summary.{name}-of-3.json")));
        let mut mufasa = Command::new(MUFASA);
        mufasa.args(["conform", "merge"]).args(files).arg("--out").arg(out);
        mufasa.output().expect("mufasa runs")
    };
    let merged = folder("merged");
    let output = merge(&["2", "0", "1"], &merged);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output));
    let (merged, whole) = (summary(&merged), summary(&whole));
    assert_eq!((&merged.campaign, &merged.shards), (&whole.campaign, &whole.shards));
    assert_eq!((merged.asked, &merged.groups), (whole.asked, &whole.groups));
    let counts = |summary: &Summary| {
        let classes = summary.classes.iter();
        classes.map(|found| (found.class.clone(), found.count)).collect::<Vec<_>>()
    };
    assert_eq!(counts(&merged), counts(&whole));
    assert!(merged.is_complete());

    let twice = merge(&["0", "0", "1"], &folder("twice"));
    assert_eq!(twice.status.code(), Some(2), "{}", text(&twice));
    assert!(text(&twice).contains("shard 0 is given twice"), "{}", text(&twice));
    // What another version asked, and took for right, is no part of it.
    let file = parts.join("summary.1-of-3.json");
    let other = fs::read_to_string(&file).expect("it is there").replacen(
        "\"version\": \"",
        "\"version\": \"0.",
        1,
    );
    fs::write(&file, other).expect("it can be written");
    let mixed = text(&merge(&["0", "1", "2"], &folder("mixed")));
    assert!(
        mixed.contains("summary.1-of-3.json") && mixed.contains("version of mufasa"),
        "{mixed}"
    );
    let part = merge(&["0", "2"], &folder("part"));
    assert!(text(&part).contains("INCOMPLETE: shard 1 missing"), "{}", text(&part));
}

/// The files of a right program, and of one that is wrong in few classes and answers each line the same whatever
/// came before, are those of one run; `mufasa merge` and `mufasa conform merge` write the same.
#[test]
fn the_merged_files_are_byte_for_byte_those_of_one_run() {
    let right = format!("exec '{MUFASA}' oracle");
    let options = ["--kinds", "cycle", "--cases", "90", "--profile", "paper", "--seed", "5"];
    let options = [&options[..], &["--time-limit", "20000"]].concat();
    for (name, program, code) in [("equal-right", right, 0), ("equal-wrong", names_iv_for_iii(), 1)]
    {
        let command = ["sh", "-c", program.as_str()];
        let whole = folder(&format!("{name}-whole"));
        let output = with_vectors(&whole, &options, &command);
        if output.status.code() == Some(2) {
            return eprintln!("NOT RUN: equal files: there is no `sh` here");
        }
        assert_eq!(output.status.code(), Some(code), "{}", text(&output));
        let parts = folder(&format!("{name}-parts"));
        for shard in ["2/3", "0/3", "1/3"] {
            with_vectors(&parts, &[&options[..], &["--shard", shard]].concat(), &command);
        }
        for merge in [&["merge"][..], &["conform", "merge"]] {
            let merged = folder(&format!("{name}-merged"));
            let files = [1, 2, 0].map(|it| parts.join(format!("summary.{it}-of-3.json")));
            let mut mufasa = Command::new(MUFASA);
            mufasa.args(merge).args(files).arg("--out").arg(&merged);
            let output = mufasa.output().expect("mufasa runs");
            assert_eq!(output.status.code(), Some(code), "{}", text(&output));
            let names = |folder: &Path| -> Vec<_> {
                let entries = fs::read_dir(folder).expect("a folder");
                let mut names: Vec<_> =
                    entries.map(|it| it.expect("an entry").file_name()).collect();
                names.sort();
                names
            };
            assert_eq!(names(&merged), names(&whole));
            for name in names(&whole) {
                let [one, other] = [&whole, &merged].map(|it| fs::read_to_string(it.join(&name)));
                assert_eq!(one.expect("a file"), other.expect("a file"), "{name:?}");
            }
        }
    }
}

#[test]
fn recorded_cycles_are_asked_clean_attacked_and_in_other_configurations() {
    let folder = folder("drives");
    // The demo writes a drive; the empty track list goes through in the paper profile (F-14).
    let demo = folder.join("demo");
    let output = Command::new(MUFASA).arg("demo").arg("--out").arg(&demo).output();
    assert!(output.expect("mufasa runs").status.success());
    let scenario = fs::read_dir(&demo)
        .expect("the folder of the demo")
        .filter_map(|entry| entry.ok().map(|entry| entry.path()))
        .filter(|path| path.extension().is_some_and(|it| it == "xml" || it == "jsonl"))
        .map(|path| path.display().to_string());
    let files: Vec<String> = scenario.collect();
    assert!(!files.is_empty());
    let mut options = vec!["--cases", "120", "--drives"];
    options.extend(files.iter().map(String::as_str));
    let output = conform(&folder, &options, &[MUFASA, "oracle", "--implementation"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output));
    let summary = summary(&folder);
    assert_eq!(summary.asked, 120);
    for configuration in ["AllRemote", "MotRemote", "PlanRemote"] {
        let seen = summary.groups.iter().any(|group| group.configuration == configuration);
        assert!(seen, "{configuration}: {}", text(&output));
    }
    for verdict in ["safe", "i", "ii"] {
        assert!(summary.groups.iter().any(|group| group.expected == verdict), "no {verdict}");
    }
    let nothing = conform(&folder, &["--drives", "no-such-file"], &[MUFASA, "oracle"]);
    assert_eq!(nothing.status.code(), Some(2), "{}", text(&nothing));
}
