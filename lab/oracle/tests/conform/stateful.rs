//! Programs whose answer depends on what they were asked before.

use std::io::Write;
use std::process::{Command, Stdio};

use crate::{EACH, MUFASA, SAFE, cases};

/// Right until it was asked about a leading vehicle, then it says safe.
fn after_a_lead() -> String {
    format!(
        r#"seen=; {EACH} if [ -n "$seen" ]; then {SAFE}; else printf '%s\n' "$line" | '{MUFASA}' oracle; fi
        case $line in *'"gap"'*) seen=1;; esac; done"#
    )
}

#[test]
fn what_does_not_occur_alone_is_said_with_the_lines_that_show_it() {
    let program = after_a_lead();
    let options = "--kinds cycle --cases 60 --profile paper --time-limit 20000";
    let run = cases("stateful", options, &program);
    let (summary, told) = (run.summary(), &run.told);
    assert_eq!(run.code, Some(1), "{told}");
    assert!(told.contains("does not occur alone; case c-"), "{told}");
    for found in &summary.classes {
        assert!(!found.shrunk, "{told}");
        if !found.is_tried() {
            continue;
        }
        assert_eq!(found.before.len(), 1, "{told}");
        assert!(found.before[0].contains("\"gap\""), "{told}");
        let sequence = run.file(&format!("sequence.{}.jsonl", found.id));
        assert_eq!(sequence.lines().count(), 2);
        let mut child = Command::new("sh")
            .args(["-c", &program])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("sh runs");
        child.stdin.take().expect("input").write_all(sequence.as_bytes()).expect("asked");
        let answers = child.wait_with_output().expect("answers").stdout;
        let answers = String::from_utf8(answers).expect("text");
        assert!(answers.lines().last().is_some_and(|it| it.contains("\"safe\"")), "{answers}");
    }
}
