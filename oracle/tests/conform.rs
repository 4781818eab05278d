//! `mufasa conform` against programs that are right, and against programs that misbehave in every
//! way that `spec/5-interfaces.md#programs-under-test` names. The latter are shell scripts of a
//! few lines; where there is no `sh` the tests say NOT RUN.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use mufasa_oracle::conform::{Breach, Kind, Scale, Summary};

const MUFASA: &str = env!("CARGO_BIN_EXE_mufasa");

/// Reads a line and takes its id, as every script does.
const EACH: &str = r#"while IFS= read -r line; do id=${line#*'"id": "'}; id=${id%%'"'*}; "#;

/// Answers that the cycle is safe.
const SAFE: &str = r#"printf '{"id": "%s", "verdict": "safe", "failed_stage": null}\n' "$id""#;

/// A folder of its own for a test, empty.
fn folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("conform-{test}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder for the test");
    folder
}

fn conform(folder: &Path, options: &[&str], command: &[&str]) -> Output {
    let mut mufasa = Command::new(MUFASA);
    mufasa.arg("conform").args(options).arg("--out").arg(folder).arg("--").args(command);
    mufasa.output().expect("mufasa runs")
}

fn text(output: &Output) -> String {
    let errors = String::from_utf8_lossy(&output.stderr);
    format!("{}{errors}", String::from_utf8_lossy(&output.stdout))
}

fn summary(folder: &Path) -> Summary {
    Summary::read(&folder.join("summary.json")).unwrap_or_else(|error| panic!("{error}"))
}

/// Runs a script as the program under test; `None` without a shell. The exit code must be 1 and
/// the three files must hold what the summary says.
fn script(test: &str, options: &[&str], script: &str) -> Option<(Summary, String)> {
    if Command::new("sh").args(["-c", "exit 0"]).status().is_err() {
        eprintln!("NOT RUN: {test}: there is no `sh` here");
        return None;
    }
    let folder = folder(test);
    let output = conform(&folder, options, &["sh", "-c", script]);
    let told = text(&output);
    assert_eq!(output.status.code(), Some(1), "{told}");
    let summary = summary(&folder);
    let reproducers = fs::read_to_string(folder.join("reproducers.jsonl")).expect("reproducers");
    assert_eq!(reproducers.lines().count(), summary.classes.len());
    for (line, found) in reproducers.lines().zip(&summary.classes) {
        assert_eq!(line, found.record.get());
        assert!(told.contains(&format!("DISAGREES  {}", found.class)), "{told}");
    }
    let junit = fs::read_to_string(folder.join("junit.xml")).expect("JUnit XML");
    let document = roxmltree::Document::parse(&junit).expect("XML");
    let failures = document.descendants().filter(|node| node.has_tag_name("failure")).count();
    assert_eq!(failures, summary.classes.len());
    Some((summary, told))
}

/// A script of which nothing but this breach is expected, in every class.
fn broken(test: &str, options: &[&str], text: &str, breach: Breach) {
    let Some((summary, told)) = script(test, options, text) else { return };
    assert!(!summary.classes.is_empty());
    for found in &summary.classes {
        assert_eq!(found.class.breach, breach, "{told}");
    }
}

#[test]
fn the_model_conforms_in_both_profiles() {
    for profile in ["paper", "hardened"] {
        let folder = folder(&format!("model-{profile}"));
        let options = ["--profile", profile, "--cases", "1500", "--seed", "7"];
        let output = conform(&folder, &options, &[MUFASA, "oracle"]);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output));
        let summary = summary(&folder);
        assert_eq!((summary.asked, summary.disagreements(), summary.starts), (1500, 0, 1));
        // A campaign of nothing would conform, too.
        for verdict in ["safe", "error", "input", "i", "ii", "iii", "iv", "v"] {
            let reached = summary.groups.iter().any(|group| group.expected == verdict);
            assert!(reached, "{profile}: no case is {verdict}");
        }
        for kind in Kind::ALL {
            assert!(summary.groups.iter().any(|group| group.kind == kind));
        }
    }
}

#[test]
fn the_implementation_conforms_in_both_profiles() {
    for profile in ["paper", "hardened"] {
        let folder = folder(&format!("implementation-{profile}"));
        let options = ["--profile", profile, "--cases", "1500", "--kinds", "cycle,offloading"];
        let output = conform(&folder, &options, &[MUFASA, "oracle", "--implementation"]);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output));
    }
}

#[test]
fn who_always_says_safe_is_unsound() {
    let options = ["--kinds", "cycle", "--cases", "150", "--profile", "paper"];
    let program = format!("{EACH} {SAFE}; done");
    let Some((summary, told)) = script("safe", &options, &program) else { return };
    for found in &summary.classes {
        // Invalid local input has a rule of its own.
        let breaches = [Breach::Soundness, Breach::Input];
        assert!(breaches.contains(&found.class.breach), "{told}");
        assert!(found.shrunk && found.size <= 4, "{told}");
        assert!(found.size <= 3 || found.class.scale == Scale::Threshold, "{told}");
    }
    let collision = |scale| {
        let place = |place: &str| place == "iii collision" || place == "iv collision";
        summary
            .classes
            .iter()
            .find(|found| place(&found.class.place) && found.class.scale == scale)
            .unwrap_or_else(|| panic!("no collision: {told}"))
    };
    let numbers = collision(Scale::Clear).told.numbers.as_ref().expect("numbers");
    let value = |text: &str| text.parse::<f64>().expect("a number");
    assert!(value(&numbers.left) < value(&numbers.right), "{numbers:?}");
    let apart = value(&numbers.right) - value(&numbers.left);
    assert_eq!(value(&numbers.margin).to_bits(), apart.to_bits());
    // Around a threshold lie half of the cases.
    assert!(collision(Scale::Threshold).count > 0);
}

#[test]
fn who_always_says_unsafe_is_incomplete_or_names_the_wrong_stage() {
    let program = format!(
        r#"{EACH} printf '{{"id": "%s", "verdict": "unsafe", "failed_stage": "ii"}}\n' "$id"; done"#
    );
    let options = ["--kinds", "cycle", "--cases", "100"];
    let Some((summary, told)) = script("unsafe", &options, &program) else { return };
    let has = |breach, place: &str| {
        let same = |it: &&_| matches_class(it, breach, place);
        assert!(summary.classes.iter().any(|found| same(&found)), "{breach:?} {place}: {told}");
    };
    has(Breach::Completeness, "ii");
    has(Breach::Stage, "ii instead of i");
    assert!(summary.classes.iter().all(|found| found.class.breach != Breach::Soundness), "{told}");
}

fn matches_class(found: &mufasa_oracle::conform::Found, breach: Breach, place: &str) -> bool {
    found.class.breach == breach && found.class.place == place
}

#[test]
fn who_names_another_stage_is_told_which() {
    let program = format!(
        r#""{MUFASA}" oracle | while IFS= read -r line; do
        case $line in
        *'"failed_stage":"iii"'*) id=${{line#*'"id":"'}}; id=${{id%%'"'*}};
          printf '{{"id": "%s", "verdict": "unsafe", "failed_stage": "iv"}}\n' "$id";;
        *) printf '%s\n' "$line";;
        esac; done"#
    );
    let options = ["--kinds", "cycle", "--cases", "200", "--profile", "paper"];
    let Some((summary, told)) = script("stage", &options, &program) else { return };
    for found in &summary.classes {
        assert!(matches_class(found, Breach::Stage, "iv instead of iii"), "{told}");
        assert!(found.size <= 3, "{told}");
        assert!(found.told.expected.contains("stage iv skipped (after_failure)"), "{told}");
    }
}

#[test]
fn who_forgets_the_hold_is_found_in_few_events() {
    let program = format!(
        r#""{MUFASA}" oracle | while IFS= read -r line; do
        printf '%s\n' "$line" | sed 's/"hold_until_ns":-*[0-9][0-9]*/"hold_until_ns":null/g'; done"#
    );
    let options = ["--kinds", "offloading", "--cases", "20"];
    let Some((summary, told)) = script("hold", &options, &program) else { return };
    let verdict = "hold_until_ns after verdict";
    let found = summary.classes.iter().find(|it| matches_class(it, Breach::States, verdict));
    assert_eq!(found.unwrap_or_else(|| panic!("{told}")).size, 1, "{told}");
}

#[test]
fn who_misses_a_composition_is_found() {
    let program = format!(
        r#"{EACH} printf '{{"id": "%s", "compositions": [], "none": {{"rule": "acyclic"}}}}\n' "$id"; done"#
    );
    let options = ["--kinds", "composition", "--cases", "40"];
    let Some((summary, told)) = script("composition", &options, &program) else { return };
    let missing = "one is missing";
    let found = summary.classes.iter().find(|it| matches_class(it, Breach::Compositions, missing));
    assert_eq!(found.unwrap_or_else(|| panic!("{told}")).size, 1, "{told}");
}

#[test]
fn who_dies_is_started_again_until_it_is_given_up() {
    let program = "read -r line; echo 'out of luck' >&2; exit 7";
    let options = ["--cases", "100"];
    let Some((summary, told)) = script("dies", &options, program) else { return };
    assert_eq!(summary.classes.len(), 3, "{told}");
    for found in &summary.classes {
        assert_eq!((found.class.breach, found.count), (Breach::Dies, 5), "{told}");
        assert!(found.told.answered.contains("exit status: 7"), "{told}");
        assert!(found.told.answered.contains("out of luck"), "{told}");
    }
    assert_eq!(summary.given_up, Kind::ALL);
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
}

#[test]
fn who_hangs_is_ended_soon() {
    let options = ["--kinds", "cycle", "--cases", "100000", "--time-limit", "40"];
    let begun = std::time::Instant::now();
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
fn a_tolerance_lets_only_what_it_explains_pass() {
    let options = ["--kinds", "cycle", "--cases", "120", "--profile", "paper"];
    let tolerant = [&options[..], &["--tolerance", "1e-6"]].concat();
    let program = format!("{EACH} {SAFE}; done");
    let Some((all, _)) = script("no-tolerance", &options, &program) else { return };
    let Some((clear, told)) = script("tolerance", &tolerant, &program) else { return };
    let of = |scale| all.classes.iter().filter(move |found| found.class.scale == scale);
    let threshold: u64 = of(Scale::Threshold).map(|found| found.count).sum();
    assert!(threshold > 0);
    assert_eq!(clear.tolerated, threshold, "{told}");
    assert_eq!(clear.classes.len(), of(Scale::Clear).count(), "{told}");
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
