//! Campaigns: usage, files, shards, drives.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use crate::{MUFASA, cases, folder, judged, mufasa, names_iv_for_iii, right};

#[test]
fn bad_usage_and_a_program_that_is_not_there_end_with_2() {
    let out = folder("none").display().to_string();
    for (words, said) in [
        (format!("conform --out {out} -- ./no-such-program"), "no-such-program: cannot be started"),
        (format!("conform --out {out} --shard 3/3 -- {MUFASA} oracle"), "3/3"),
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
    fs::create_dir(folder.join("junit.xml")).expect("a folder in the way");
    let run = judged(&folder, "--cases 5 --no-vectors", &right());
    assert_eq!(run.code, Some(2), "{}", run.told);
    assert!(!folder.join("summary.json").exists());
}

/// The summaries of shards, joined into a folder.
fn merged(words: &str, parts: &Path, shards: &[u32], out: &Path) -> (Option<i32>, String) {
    let files = shards.iter().map(|it| parts.join(format!("summary.{it}-of-3.json")));
    let files: Vec<PathBuf> = files.chain(["--out".into(), out.to_owned()]).collect();
    mufasa(words, &files)
}

#[test]
fn what_is_no_whole_campaign_is_refused_or_said() {
    let parts = folder("parts");
    for shard in 0..3 {
        let options = format!("--kinds cycle --cases 6 --no-vectors --shard {shard}/3");
        judged(&parts, &options, &right());
    }
    let out = folder("merged");
    let merge = |shards: &[u32]| merged("conform merge", &parts, shards, &out);
    let (code, told) = merge(&[0, 0, 1]);
    assert!(code == Some(2) && told.contains("shard 0 is given twice"), "{told}");
    let (code, told) = merge(&[0, 2]);
    assert!(code == Some(2) && told.contains("INCOMPLETE: shard 1 missing"), "{told}");
    // What another version asked, and took for right, is no part of it.
    let file = parts.join("summary.1-of-3.json");
    let other = fs::read_to_string(&file).expect("it is there");
    let other = other.replacen("\"version\": \"", "\"version\": \"0.", 1);
    fs::write(&file, other).expect("it can be written");
    let (_, told) = merge(&[0, 1, 2]);
    assert!(told.contains("summary.1-of-3.json") && told.contains("version of mufasa"), "{told}");
}

/// The files of a right program, and of one that is wrong in few classes and answers each line the same whatever
/// came before, are those of one run; `mufasa merge` and `mufasa conform merge` write the same.
#[test]
fn the_merged_files_are_byte_for_byte_those_of_one_run() {
    let options = "--kinds cycle --cases 90 --profile paper --seed 5 --time-limit 20000";
    for (name, script, code) in
        [("equal-right", right(), 0), ("equal-wrong", names_iv_for_iii(), 1)]
    {
        let whole = folder(&format!("{name}-whole"));
        let run = judged(&whole, options, &script);
        assert_eq!(run.code, Some(code), "{}", run.told);
        let parts = folder(&format!("{name}-parts"));
        for shard in [2, 0, 1] {
            judged(&parts, &format!("{options} --shard {shard}/3"), &script);
        }
        for words in ["merge", "conform merge"] {
            let out = folder(&format!("{name}-merged"));
            let (found, told) = merged(words, &parts, &[1, 2, 0], &out);
            assert_eq!(found, Some(code), "{told}");
            assert_eq!(names(&out), names(&whole));
            for name in names(&whole) {
                let [one, other] = [&whole, &out].map(|it| fs::read_to_string(it.join(&name)));
                assert_eq!(one.expect("a file"), other.expect("a file"), "{name:?}");
            }
        }
    }
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
