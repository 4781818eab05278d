//! What a campaign does with a program that is wrong nearly everywhere: little, and it says so.

use std::fs;
use std::path::Path;

use mufasa_conform::{NotShrunk, Summary};

use crate::{EACH, MUFASA, SAFE, folder, summary, text, with_vectors};

/// Runs who says always safe, with all kinds of records; its output, the summary, and how often it was started.
fn beginner(test: &str, options: &[&str]) -> Option<(String, Summary, usize)> {
    let folder = folder(test);
    let starts = folder.join("starts");
    let program = format!("echo . >> '{}'; {EACH} {SAFE}; done", starts.display());
    let output = with_vectors(&folder, options, &["sh", "-c", &program]);
    if output.status.code() == Some(2) {
        eprintln!("NOT RUN: {test}: there is no `sh` here");
        return None;
    }
    assert_eq!(output.status.code(), Some(1), "{}", text(&output));
    let starts = fs::read_to_string(starts).expect("starts").lines().count();
    Some((text(&output), summary(&folder), starts))
}

/// Starts are counted, and not time: it was 357 when each class was made small.
#[test]
fn who_is_wrong_nearly_everywhere_is_started_seldom() {
    let Some((told, summary, starts)) = beginner("seldom", &["--cases", "0"]) else { return };
    assert!(summary.classes.len() > 100, "{told}");
    assert!(starts < 100, "{starts} starts: {told}");
    let rules = |wanted: &dyn Fn(&mufasa_conform::Found) -> bool| {
        let classes = summary.classes.iter().filter(|it| wanted(it));
        let mut rules: Vec<_> = classes.map(|it| (it.class.kind, it.class.breach)).collect();
        rules.dedup();
        rules
    };
    // Of each rule one was tried, of the others each says that it was not.
    assert_eq!(rules(&|found| found.is_tried()), rules(&|_| true), "{told}");
    let limit = summary.classes.iter().filter(|it| it.why == Some(NotShrunk::Limit)).count();
    assert!(limit > 90 && summary.classes.iter().all(|it| it.shrunk == it.why.is_none()), "{told}");
    let all = summary.classes.len();
    let why = "of each rule only a few are, those to mend first";
    assert!(told.contains(&format!("\n{limit} of {all} classes not shrunk: {why}\n")), "{told}");
    let junit =
        fs::read_to_string(Path::new(env!("CARGO_TARGET_TMPDIR")).join("conform-seldom/junit.xml"));
    assert!(junit.expect("JUnit XML").matches("not shrunk").count() >= limit, "{told}");
}

/// The vectors show that much is wrong: no case is asked, unless their number is given.
#[test]
fn random_cases_wait_until_the_vectors_are_mended() {
    let Some((told, summary, _)) = beginner("enough", &[]) else { return };
    assert!(summary.enough && summary.is_complete(), "{told}");
    assert_eq!((summary.asked, summary.campaign.cases), (0, 10_000), "{told}");
    let words = "\n0 of 10000 cases asked: the vectors show that much is wrong; mend that first (--cases 10000 asks all the same)\n";
    assert!(told.contains(words), "{told}");
    let Some((told, summary, _)) = beginner("enough-asked", &["--cases", "6"]) else { return };
    assert!(!summary.enough && summary.asked + summary.skipped == 6, "{told}");
}

#[test]
fn without_time_nothing_is_shrunk_and_each_class_says_so() {
    let options = ["--kinds", "cycle", "--cases", "0", "--shrinking", "0"];
    let Some((told, summary, starts)) = beginner("no-time", &options) else { return };
    assert_eq!(starts, 1, "{told}");
    assert!(summary.classes.iter().all(|it| !it.shrunk && !it.is_tried()), "{told}");
    assert!(told.contains("there was no more time for it (--shrinking)"), "{told}");
    assert!(told.contains(" not shrunk; vector "), "{told}");
}

/// A program that is wrong in one rule: its classes are all made small.
#[test]
fn who_is_nearly_right_has_each_class_shrunk() {
    let folder = folder("nearly");
    let program = format!(
        r#""{MUFASA}" oracle | sed -u '/"failed_stage":"iii"/s/"verdict":.*/"verdict":"safe","failed_stage":null}}/'"#
    );
    let options = ["--kinds", "cycle", "--cases", "0", "--profile", "paper"];
    let options = [&options[..], &["--time-limit", "20000"]].concat();
    let output = with_vectors(&folder, &options, &["sh", "-c", &program]);
    if output.status.code() == Some(2) {
        return eprintln!("NOT RUN: nearly: there is no `sh` here");
    }
    let (told, summary) = (text(&output), summary(&folder));
    assert!((2..=6).contains(&summary.classes.len()), "{told}");
    assert!(summary.classes.iter().all(|it| it.shrunk && it.size <= 3), "{told}");
    assert!(!told.contains("not shrunk"), "{told}");
}
