//! Campaigns that are ended before their end.
#![cfg(unix)]

use std::fs;
use std::os::unix::process::CommandExt;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use mufasa_conform::NotShrunk;

use crate::{MUFASA, folder, summary, text};

/// A campaign on its way, in a group of its own.
fn started(out: &Path, options: &[&str], command: &[&str]) -> Child {
    let mut mufasa = Command::new(MUFASA);
    mufasa.arg("conform").args(options).arg("--out").arg(out).arg("--").args(command);
    mufasa.stdout(Stdio::piped()).stderr(Stdio::piped()).process_group(0);
    mufasa.spawn().expect("mufasa runs")
}

/// Interrupts the whole group, as a terminal does it, and waits for its end.
fn interrupted(running: Child) -> Output {
    let group = format!("-{}", running.id());
    let killed = Command::new("kill").args(["-INT", "--", &group]).status();
    assert!(killed.expect("kill runs").success());
    let output = running.wait_with_output().expect("it ends");
    assert_eq!(output.status.code(), Some(130), "{}", text(&output));
    output
}

#[test]
fn an_interrupted_campaign_leaves_what_is_known_and_does_not_look_complete() {
    let out = folder("interrupted");
    let options = ["--no-vectors", "--cases", "100000000", "--kinds", "offloading"];
    let running = started(&out, &options, &[MUFASA, "oracle", "--implementation"]);
    thread::sleep(Duration::from_secs(2));
    let told = text(&interrupted(running));
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

/// The vectors have been asked, one of them disagrees, and it is ended among the cases: nothing is made small.
#[test]
fn an_interrupted_campaign_says_what_the_vectors_found() {
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
    let options = ["--cases", "100000000", "--kinds", "cycle", "--profile", "paper"];
    let options = [&options[..], &["--time-limit", "60000"]].concat();
    let mut running = started(&out, &options, &["sh", "-c", &program]);
    let begun = Instant::now();
    while !reached.exists() {
        if running.try_wait().expect("a process").is_some() {
            let output = running.wait_with_output().expect("it ended");
            assert_eq!(output.status.code(), Some(2), "{}", text(&output));
            return eprintln!("NOT RUN: interrupted: there is no `sh` here");
        }
        assert!(begun.elapsed().as_secs() < 300, "the cases are not reached");
        thread::sleep(Duration::from_millis(20));
    }
    let told = text(&interrupted(running));
    let known = summary(&out);
    assert!(known.interrupted && known.asked >= 9, "{told}");
    assert_eq!(known.vectors, known.campaign.vectors, "{told}");
    let wrong = known.wrong_vectors();
    assert!(!wrong.is_empty() && wrong.iter().all(|id| id.starts_with("collision")), "{told}");
    assert!(told.contains("\nmend first:\nDISAGREES  cycle soundness"), "{told}");
    assert!(told.contains(" not shrunk; vector collision"), "{told}");
    let (count, why) = (known.classes.len(), Some(NotShrunk::Interrupted));
    assert!(known.classes.iter().all(|found| found.why == why), "{told}");
    let why = format!("\n{count} of {count} classes not shrunk: it was interrupted\n");
    assert!(told.contains(&why) && !told.contains("--shrinking"), "{told}");
    let mut merge = Command::new(MUFASA);
    let merged = merge.args(["conform", "merge"]).arg(out.join("summary.json")).output();
    let merged = text(&merged.expect("mufasa runs"));
    assert!(merged.contains(&why) && !merged.contains("--shrinking"), "{merged}");
    let words = format!("vectors asked: {} DISAGREE: collision", wrong.len());
    assert!(told.contains(&words), "{told}");
    assert!(told.contains(" cases asked, INTERRUPTED: no disagreement so far"), "{told}");
    let reproducers = fs::read_to_string(out.join("reproducers.jsonl")).expect("reproducers");
    assert_eq!(reproducers.lines().count(), known.classes.len(), "{told}");
    let junit = fs::read_to_string(out.join("junit.xml")).expect("JUnit XML");
    assert!(junit.contains("interrupted after") && junit.contains("<failure"), "{junit}");
}

/// Standard output ends with the first class that is found: what is known is in the files all the same.
#[test]
fn a_campaign_whose_reader_goes_away_leaves_what_is_known() {
    let out = folder("reader-gone");
    let always_safe = r#"while IFS= read -r line; do
        id=${line#*'"id":'}; echo "{\"id\":${id%%,*},\"verdict\":\"safe\",\"failed_stage\":null}"; done"#;
    let mut running = started(&out, &["--kinds", "cycle"], &["sh", "-c", always_safe]);
    drop(running.stdout.take());
    let output = running.wait_with_output().expect("it ends");
    assert_eq!(output.status.code(), Some(141), "{}", text(&output));
    let known = summary(&out);
    assert!(known.interrupted && !known.is_complete() && known.vectors > 0, "{}", text(&output));
}
