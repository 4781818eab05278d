//! What a campaign does with a program that is wrong nearly everywhere: little, and it says so.

use mufasa_conform::{NotShrunk, Summary};

use crate::{Run, always_safe, folder, safe_where, with_vectors};

/// Runs who says always safe, with all kinds of records; the run, the summary, and how often it was started.
fn beginner(test: &str, options: &str) -> (Run, Summary, usize) {
    let starts = folder(&format!("{test}-starts")).join("starts");
    let script = format!("echo . >> '{}'; {}", starts.display(), always_safe());
    let run = with_vectors(test, options, &script);
    assert_eq!(run.code, Some(1), "{}", run.told);
    let starts = std::fs::read_to_string(starts).expect("starts").lines().count();
    let summary = run.summary();
    (run, summary, starts)
}

/// Starts are counted, and not time: it was 357 when each class was made small.
#[test]
fn who_is_wrong_nearly_everywhere_is_started_seldom() {
    let (run, summary, starts) = beginner("seldom", "--cases 0");
    let told = &run.told;
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
    assert!(run.file("junit.xml").matches("not shrunk").count() >= limit, "{told}");
}

/// The vectors show that much is wrong: no case is asked, unless their number is given.
#[test]
fn random_cases_wait_until_the_vectors_are_mended() {
    let (run, summary, _) = beginner("enough", "");
    let told = &run.told;
    assert!(summary.enough && summary.is_complete(), "{told}");
    assert_eq!((summary.asked, summary.campaign.cases), (0, 10_000), "{told}");
    let words = "\n0 of 10000 cases asked: the vectors show that much is wrong; mend that first (--cases 10000 asks all the same)\n";
    assert!(told.contains(words), "{told}");
    let (run, summary, _) = beginner("enough-asked", "--cases 6");
    assert!(!summary.enough && summary.asked + summary.skipped == 6, "{}", run.told);
}

#[test]
fn without_time_nothing_is_shrunk_and_each_class_says_so() {
    let (run, summary, starts) = beginner("no-time", "--kinds cycle --cases 0 --shrinking 0");
    let told = &run.told;
    assert_eq!(starts, 1, "{told}");
    assert!(summary.classes.iter().all(|it| !it.shrunk && !it.is_tried()), "{told}");
    assert!(told.contains("there was no more time for it (--shrinking)"), "{told}");
    assert!(told.contains(" not shrunk; vector "), "{told}");
}

/// A program that is wrong in one rule: its classes are all made small.
#[test]
fn who_is_nearly_right_has_each_class_shrunk() {
    let options = "--kinds cycle --cases 0 --profile paper --time-limit 20000";
    let run = with_vectors("nearly", options, &safe_where("\"failed_stage\":\"iii\""));
    let (told, summary) = (&run.told, run.summary());
    assert!((2..=6).contains(&summary.classes.len()), "{told}");
    assert!(summary.classes.iter().all(|it| it.shrunk && it.size <= 3), "{told}");
    assert!(!told.contains("not shrunk"), "{told}");
}
