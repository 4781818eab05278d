//! Campaigns: usage, files, shards, drives.

use std::fs;
use std::path::Path;
use std::process::Command;

use mufasa_conform::Summary;

use crate::{EACH, MUFASA, SAFE, conform, folder, summary, text};

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
    let part = merge(&["0", "1"], &folder("part"));
    assert!(text(&part).contains("INCOMPLETE: shard 2 missing"), "{}", text(&part));
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

#[cfg(unix)]
#[test]
fn an_interrupted_campaign_leaves_what_is_known_and_does_not_look_complete() {
    use std::os::unix::process::CommandExt;
    use std::process::Stdio;
    use std::{thread, time::Duration};

    let out = folder("interrupted");
    let running = Command::new(MUFASA)
        .args(["conform", "--no-vectors", "--cases", "100000000", "--kinds", "offloading", "--out"])
        .arg(&out)
        .args(["--", MUFASA, "oracle", "--implementation"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .process_group(0)
        .spawn()
        .expect("mufasa runs");
    thread::sleep(Duration::from_secs(2));
    // To the whole group, as a terminal does it.
    let group = format!("-{}", running.id());
    let killed = Command::new("kill").args(["-INT", "--", &group]).status();
    assert!(killed.expect("kill runs").success());
    let output = running.wait_with_output().expect("it ends");
    let told = text(&output);
    assert_eq!(output.status.code(), Some(130), "{told}");
    assert!(told.contains("INTERRUPTED: no disagreement so far"), "{told}");
    let known = summary(&out);
    assert!(known.interrupted && !known.is_complete() && known.asked > 0, "{told}");
    assert_eq!(known.disagreements(), 0, "{told}");
    let junit = fs::read_to_string(out.join("junit.xml")).expect("JUnit XML");
    assert!(junit.contains("errors=\"1\"") && junit.contains("interrupted after"), "{junit}");

    let mut merge = Command::new(MUFASA);
    let merged = merge.args(["conform", "merge"]).arg(out.join("summary.json")).output();
    let merged = merged.expect("mufasa runs");
    assert_eq!(merged.status.code(), Some(2), "{}", text(&merged));
}

/// The vectors have been asked, one of them disagrees, and it is ended among the cases.
#[cfg(unix)]
#[test]
fn an_interrupted_campaign_says_what_the_vectors_found() {
    use std::os::unix::process::CommandExt;
    use std::process::Stdio;
    use std::time::{Duration, Instant};

    let out = folder("interrupted-late");
    let reached = out.join("reached");
    let program = format!(
        r#""{MUFASA}" oracle | while IFS= read -r line; do
        case $line in
        *'"id":"collision'*) printf '%s\n' "$line" | sed 's/"verdict":.*/"verdict":"safe","failed_stage":null}}/';;
        *'"id":"c-9"'*) : > "{}"; printf '%s\n' "$line";;
        *) printf '%s\n' "$line";; esac; done"#,
        reached.display()
    );
    let mut running = Command::new(MUFASA)
        .args(["conform", "--cases", "100000000", "--kinds", "cycle", "--profile", "paper"])
        .args(["--time-limit", "60000", "--out"])
        .arg(&out)
        .args(["--", "sh", "-c", &program])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .process_group(0)
        .spawn()
        .expect("mufasa runs");
    let begun = Instant::now();
    while !reached.exists() {
        if running.try_wait().expect("a process").is_some() {
            let output = running.wait_with_output().expect("it ended");
            assert_eq!(output.status.code(), Some(2), "{}", text(&output));
            return eprintln!("NOT RUN: interrupted: there is no `sh` here");
        }
        assert!(begun.elapsed().as_secs() < 300, "the cases are not reached");
        std::thread::sleep(Duration::from_millis(20));
    }
    let group = format!("-{}", running.id());
    let killed = Command::new("kill").args(["-INT", "--", &group]).status();
    assert!(killed.expect("kill runs").success());
    let output = running.wait_with_output().expect("it ends");
    let told = text(&output);
    assert_eq!(output.status.code(), Some(130), "{told}");
    let known = summary(&out);
    assert!(known.interrupted && known.asked >= 9, "{told}");
    assert_eq!(known.vectors, known.campaign.vectors, "{told}");
    let wrong = known.wrong_vectors();
    assert!(!wrong.is_empty() && wrong.iter().all(|id| id.starts_with("collision")), "{told}");
    assert!(told.contains("\nmend first:\nDISAGREES  cycle soundness"), "{told}");
    assert!(
        told.contains(&format!("vectors asked: {} DISAGREE: collision", wrong.len())),
        "{told}"
    );
    assert!(told.contains(" cases asked, INTERRUPTED: no disagreement so far"), "{told}");
    let reproducers = fs::read_to_string(out.join("reproducers.jsonl")).expect("reproducers");
    assert_eq!(reproducers.lines().count(), known.classes.len(), "{told}");
    let junit = fs::read_to_string(out.join("junit.xml")).expect("JUnit XML");
    assert!(junit.contains("interrupted after") && junit.contains("<failure"), "{junit}");
}
