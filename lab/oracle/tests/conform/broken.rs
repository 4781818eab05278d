//! Programs that do not answer (TOOL-07).

use std::time::Instant;

use mufasa_conform::{Breach, Kind};

use crate::{EACH, MUFASA, SAFE, cases, folder, right, wrong};

/// Of each script nothing but its breach is found, in every class.
#[test]
fn who_gives_no_answer_or_another_is_found() {
    let out_of_order = format!(
        r#"{EACH} printf '{{"id": "%s", "verdict": "safe", "failed_stage": null}}\n' "${{last-c-x}}"
        last=$id; done"#
    );
    let patient = "--cases 8 --time-limit 20000";
    for (name, options, script, breach) in [
        // A line of a million cells does not fit into a pipe that nobody reads.
        ("unread", "--cases 3 --time-limit 40", "exec sleep 100 <&-", Breach::Hangs),
        ("nonsense", "--cases 20", &format!("{EACH} echo perhaps; done"), Breach::Nonsense),
        ("order", "--cases 20", &out_of_order, Breach::OutOfOrder),
        ("flood-lines", patient, "exec yes", Breach::Floods),
        ("flood-line", patient, "exec cat /dev/zero", Breach::Floods),
        ("flood-twice", patient, &format!("{EACH} echo '{{}}'; echo '{{}}'; done"), Breach::Floods),
        ("flood-last", "--cases 3", &format!("'{MUFASA}' oracle; echo done"), Breach::Floods),
    ] {
        let (summary, told) = wrong(name, &format!("--kinds cycle {options}"), script);
        assert!(summary.classes.iter().all(|found| found.class.breach == breach), "{name}: {told}");
    }
    let begun = Instant::now();
    let options = "--kinds cycle --cases 100000 --time-limit 40";
    let (summary, told) = wrong("hangs", options, "exec sleep 100");
    assert!(summary.classes.iter().all(|found| found.class.breach == Breach::Hangs), "{told}");
    assert!(begun.elapsed().as_secs() < 30, "took {:?}", begun.elapsed());
}

#[test]
fn who_dies_is_started_again_until_it_is_given_up() {
    let script = "read -r line; echo 'out of luck' >&2; exit 7";
    let options = "--cases 100 --kinds cycle,offloading,composition,monitor";
    let (summary, told) = wrong("dies", options, script);
    assert_eq!(summary.classes.len(), 4, "{told}");
    for found in &summary.classes {
        assert_eq!((found.class.breach, found.count), (Breach::Dies, 5), "{told}");
        assert!(found.told.answered.contains("exit status: 7"), "{told}");
        assert!(found.told.answered.contains("out of luck"), "{told}");
    }
    assert_eq!(summary.given_up, Kind::RECORDS);
    assert_eq!(summary.asked + summary.skipped, 100);
}

/// It dies at a tenth of the records, seldom often in a row: the others are asked, and the record is made small.
#[test]
fn who_dies_now_and_then_is_asked_to_the_end() {
    let script = format!(r#"{EACH} case $line in *'"gap"'*) exit 1;; esac; {SAFE}; done"#);
    let options = "--kinds cycle --cases 60 --profile paper --seed 1";
    let (summary, told) = wrong("dies-seldom", options, &script);
    assert_eq!((summary.asked, summary.skipped), (60, 0), "{told}");
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

/// The answer to the first record counts; what is done after it is not blamed on the second.
#[test]
fn who_dies_after_an_answer_is_said_to() {
    // Right, so that nothing is asked in between.
    let script = format!(r#"{EACH} printf '%s\n' "$line" | '{MUFASA}' oracle; exit 3; done"#);
    let (summary, told) =
        wrong("dies-after", "--kinds cycle --cases 2 --time-limit 20000", &script);
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
        let script = format!("{EACH} {SAFE}; done; {end}");
        let (summary, told) = wrong(name, "--kinds cycle --cases 4 --time-limit 2000", &script);
        assert!(summary.classes.iter().any(|found| found.class.breach == breach), "{told}");
        assert_eq!(summary.asked, 4, "{told}");
    }
}

#[test]
fn who_stood_still_once_is_asked_again_and_not_called_hanging() {
    let once = folder("late-once").join("once");
    let script = format!("mkdir '{}' 2>/dev/null && exec sleep 100; {}", once.display(), right());
    let run = cases("late", "--kinds cycle --cases 30 --time-limit 500", &script);
    assert_eq!(run.code, Some(0), "{}", run.told);
    let late = run.summary().late;
    // On a busy machine there may be more.
    assert!(late >= 1, "{}", run.told);
    let words = format!("{late} answered only when asked again, not within 500 ms");
    assert!(run.told.contains(&words), "{}", run.told);
}
