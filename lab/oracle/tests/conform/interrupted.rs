//! Campaigns that are ended before their end.

use std::os::unix::process::CommandExt;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use mufasa_conform::NotShrunk;

use crate::{MUFASA, Run, always_safe, folder, mufasa, text};

/// A campaign on its way, in a group of its own.
fn started(out: &Path, options: &str, script: &str) -> Child {
    let mut mufasa = Command::new(MUFASA);
    mufasa.arg("conform").args(options.split_whitespace()).arg("--out").arg(out);
    mufasa.args(["--", "sh", "-c", script]);
    mufasa.stdout(Stdio::piped()).stderr(Stdio::piped()).process_group(0);
    mufasa.spawn().expect("mufasa runs")
}

/// Waits for its end.
fn ended(running: Child, out: &Path) -> Run {
    let output = running.wait_with_output().expect("it ends");
    Run { code: output.status.code(), told: text(&output), folder: out.to_owned() }
}

/// Interrupts the whole group, as a terminal does it.
fn interrupted(running: Child, out: &Path) -> Run {
    let group = format!("-{}", running.id());
    let killed = Command::new("kill").args(["-INT", "--", &group]).status();
    assert!(killed.expect("kill runs").success());
    let run = ended(running, out);
    assert_eq!(run.code, Some(130), "{}", run.told);
    run
}

/// Waits until the program has made a file.
fn reached(file: &Path, running: &mut Child) {
    let begun = Instant::now();
    while !file.exists() {
        assert!(running.try_wait().expect("a process").is_none(), "it ended");
        assert!(begun.elapsed().as_secs() < 300, "the cases are not reached");
        thread::sleep(Duration::from_millis(20));
    }
}

/// The vectors have been asked, one of them disagrees, and it is ended among the cases: nothing is made small.
#[test]
fn an_interrupted_campaign_says_what_the_vectors_found() {
    let out = folder("interrupted-late");
    let among_cases = out.join("reached");
    let script = format!(
        r#"'{MUFASA}' oracle | while IFS= read -r line; do
        case $line in
        *'"id":"collision'*) printf '%s\n' "$line" | sed 's/"verdict":.*/"verdict":"safe","failed_stage":null}}/';;
        *'"id":"c-9"'*) : > '{}'; printf '%s\n' "$line";;
        *) printf '%s\n' "$line";; esac; done"#,
        among_cases.display()
    );
    let options = "--cases 100000000 --kinds cycle --profile paper --time-limit 60000";
    let mut running = started(&out, options, &script);
    reached(&among_cases, &mut running);
    let run = interrupted(running, &out);
    let (told, known) = (&run.told, run.summary());
    assert!(known.interrupted && !known.is_complete() && known.asked >= 9, "{told}");
    assert_eq!(known.vectors, known.campaign.vectors, "{told}");
    let wrong = known.wrong_vectors();
    assert!(!wrong.is_empty() && wrong.iter().all(|id| id.starts_with("collision")), "{told}");
    assert!(told.contains("\nmend first:\nDISAGREES  cycle soundness"), "{told}");
    assert!(told.contains(" not shrunk; vector collision"), "{told}");
    let (count, why) = (known.classes.len(), Some(NotShrunk::Interrupted));
    assert!(known.classes.iter().all(|found| found.why == why), "{told}");
    let why = format!("\n{count} of {count} classes not shrunk: it was interrupted\n");
    let (code, merged) = mufasa("conform merge", &[out.join("summary.json")]);
    let says = merged.contains("INCOMPLETE: a shard was interrupted");
    assert!(code == Some(1) && says, "{merged}");
    for told in [told, &merged] {
        assert!(told.contains(&why) && !told.contains("--shrinking"), "{told}");
    }
    let words = format!("vectors asked: {} DISAGREE: collision", wrong.len());
    assert!(told.contains(&words), "{told}");
    assert!(told.contains(" cases asked, INTERRUPTED: no disagreement so far"), "{told}");
    assert_eq!(run.file("reproducers.jsonl").lines().count(), count, "{told}");
    let junit = run.file("junit.xml");
    assert!(junit.contains("interrupted after") && junit.contains("<failure"), "{junit}");
}

/// Standard output ends with the first class that is found: what is known is in the files all the same.
#[test]
fn a_campaign_whose_reader_goes_away_leaves_what_is_known() {
    let out = folder("reader-gone");
    let mut running = started(&out, "--kinds cycle", &always_safe());
    drop(running.stdout.take());
    let run = ended(running, &out);
    assert_eq!(run.code, Some(141), "{}", run.told);
    let known = run.summary();
    assert!(known.interrupted && !known.is_complete() && known.vectors > 0, "{}", run.told);
}
