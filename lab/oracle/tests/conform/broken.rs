//! Programs that do not answer (TOOL-07).

use std::time::Instant;

use mufasa_conform::{Breach, Kind};

use crate::{EACH, MUFASA, SAFE, conform, folder, script, summary, text};

/// A script of which nothing but this breach is expected, in every class.
fn broken(test: &str, options: &[&str], text: &str, breach: Breach) {
    let Some((summary, told)) = script(test, options, text) else { return };
    assert!(!summary.classes.is_empty());
    for found in &summary.classes {
        assert_eq!(found.class.breach, breach, "{told}");
    }
}

#[test]
fn who_dies_is_started_again_until_it_is_given_up() {
    let program = "read -r line; echo 'out of luck' >&2; exit 7";
    let options = ["--cases", "100", "--kinds", "cycle,offloading,composition"];
    let Some((summary, told)) = script("dies", &options, program) else { return };
    assert_eq!(summary.classes.len(), 3, "{told}");
    for found in &summary.classes {
        assert_eq!((found.class.breach, found.count), (Breach::Dies, 5), "{told}");
        assert!(found.told.answered.contains("exit status: 7"), "{told}");
        assert!(found.told.answered.contains("out of luck"), "{told}");
    }
    assert_eq!(summary.given_up, Kind::RECORDS);
    assert_eq!(summary.asked + summary.skipped, 100);
}

#[test]
fn who_dies_at_one_record_is_shrunk_and_the_run_goes_on() {
    let program = format!(r#"{EACH} case $line in *'"gap"'*) exit 1;; esac; {SAFE}; done"#);
    let options = ["--kinds", "cycle", "--cases", "60", "--profile", "paper", "--seed", "3"];
    let Some((summary, told)) = script("dies-at-lead", &options, &program) else { return };
    let dies = summary.classes.iter().find(|found| found.class.breach == Breach::Dies);
    let dies = dies.unwrap_or_else(|| panic!("{told}"));
    assert!(dies.shrunk && dies.size == 1, "{told}");
    assert!(dies.record.get().contains("\"gap\""), "{told}");
    assert!(dies.record.get().contains("\"tracks\": null"), "{told}");
    // The case is valid, and so is what it is shrunk to: a program may die of what is invalid, too.
    let record: serde_json::Value = serde_json::from_str(dies.record.get()).expect("JSON");
    let stations = record["route"]["stations"].as_array().expect("a route");
    assert!(stations.len() >= 2 && record["ego"]["length"].as_f64() > Some(0.0), "{told}");
}

/// It dies at a tenth of the records, seldom often in a row: the others are asked.
#[test]
fn who_dies_now_and_then_is_asked_to_the_end() {
    let program = format!(r#"{EACH} case $line in *'"gap"'*) exit 1;; esac; {SAFE}; done"#);
    let options = ["--kinds", "cycle", "--cases", "60", "--profile", "paper", "--seed", "3"];
    let Some((summary, told)) = script("dies-seldom", &options, &program) else { return };
    assert_eq!((summary.asked, summary.skipped), (60, 0), "{told}");
}

/// The answer to the first record counts; what is done after it is not blamed on the second.
#[test]
fn who_dies_after_an_answer_is_said_to() {
    // Right, so that nothing is asked in between.
    let program = format!(r#"{EACH} printf '%s\n' "$line" | '{MUFASA}' oracle; exit 3; done"#);
    let options = ["--kinds", "cycle", "--cases", "2", "--time-limit", "20000"];
    let Some((summary, told)) = script("dies-after", &options, &program) else { return };
    assert_eq!((summary.asked, summary.skipped), (2, 0), "{told}");
    // On a busy machine the second line may be sent between its answer and its end.
    assert_eq!(summary.classes.len(), 1, "{told}");
    assert_eq!(summary.classes[0].class.breach, Breach::Dies, "{told}");
    assert!(summary.classes[0].told.answered.contains("exit status: 3"), "{told}");
}

#[test]
fn who_dies_or_hangs_at_the_end_of_the_input_is_found() {
    for (name, end, breach) in
        [("killed", "kill -9 $$", Breach::Dies), ("stays", "exec sleep 100", Breach::Hangs)]
    {
        let program = format!("{EACH} {SAFE}; done; {end}");
        let options = ["--kinds", "cycle", "--cases", "4", "--time-limit", "2000"];
        let Some((summary, told)) = script(name, &options, &program) else { return };
        assert!(summary.classes.iter().any(|found| found.class.breach == breach), "{told}");
        assert_eq!(summary.asked, 4, "{told}");
    }
}

#[test]
fn who_hangs_is_ended_soon() {
    let options = ["--kinds", "cycle", "--cases", "100000", "--time-limit", "40"];
    let begun = Instant::now();
    broken("hangs", &options, "exec sleep 100", Breach::Hangs);
    assert!(begun.elapsed().as_secs() < 30, "took {:?}", begun.elapsed());
}

#[test]
fn who_does_not_read_hangs_too_and_long_lines_block_nobody() {
    // A line of a million cells does not fit into a pipe.
    let options = ["--kinds", "cycle", "--cases", "3", "--time-limit", "40"];
    broken("hangs-unread", &options, "exec sleep 100 <&-", Breach::Hangs);
}

#[test]
fn nonsense_is_found() {
    let program = format!("{EACH} echo perhaps; done");
    broken("nonsense", &["--kinds", "cycle", "--cases", "20"], &program, Breach::Nonsense);
}

#[test]
fn answers_out_of_order_are_found() {
    let program = format!(
        r#"{EACH} printf '{{"id": "%s", "verdict": "safe", "failed_stage": null}}\n' "${{last-c-x}}"
        last=$id; done"#
    );
    broken("order", &["--kinds", "cycle", "--cases", "20"], &program, Breach::OutOfOrder);
}

#[test]
fn floods_are_found() {
    let options = ["--kinds", "cycle", "--cases", "8", "--time-limit", "20000"];
    broken("flood-lines", &options, "exec yes", Breach::Floods);
    broken("flood-line", &options, "exec cat /dev/zero", Breach::Floods);
    let program = format!("{EACH} echo '{{}}'; echo '{{}}'; done");
    broken("flood-twice", &options, &program, Breach::Floods);
}

#[test]
fn a_line_too_many_behind_the_last_answer_is_found() {
    let program = format!(r#""{MUFASA}" oracle; echo done"#);
    let options = ["--kinds", "cycle", "--cases", "3"];
    broken("flood-last", &options, &program, Breach::Floods);
}

#[test]
fn who_stood_still_once_is_asked_again_and_not_called_hanging() {
    let folder = folder("late");
    let once = folder.join("once");
    let program = format!(
        r#"mkdir "{}" 2>/dev/null && exec sleep 100; exec "{MUFASA}" oracle"#,
        once.display()
    );
    let options = ["--kinds", "cycle", "--cases", "30", "--time-limit", "500"];
    let output = conform(&folder, &options, &["sh", "-c", &program]);
    if output.status.code() == Some(2) {
        eprintln!("NOT RUN: late: there is no `sh` here");
        return;
    }
    assert_eq!(output.status.code(), Some(0), "{}", text(&output));
    let late = summary(&folder).late;
    // On a busy machine there may be more.
    assert!(late >= 1, "{}", text(&output));
    let words = format!("{late} answered only when asked again, not within 500 ms");
    assert!(text(&output).contains(&words), "{}", text(&output));
}
