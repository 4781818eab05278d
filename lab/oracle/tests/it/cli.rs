//! The built program's command line: exit codes and outputs.

use std::fs::{self, File};
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread;
use std::time::Duration;

use crate::kit::{folder, lines, mufasa, said, small, with_input, write};
use mufasa_records::cycle_to_line;
use roxmltree::Document;
use serde_json::Value;

const PROJECT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

#[test]
fn exit_codes_and_sums_of_drives() {
    let folder = folder("codes");
    let [safe, blocked] = [lines(&folder, "a", 6, &[]), lines(&folder, "b", 3, &[2])];
    let ended = mufasa(&["check", &safe]);
    ended.has(0, "6 cycles, AllRemote, hardened: 6 safe, 0 unsafe", "");
    let end = "0 fallbacks, 6 offloaded; model and implementation agree\n";
    assert!(ended.out.ends_with(end) && ended.err.is_empty(), "{}", ended.out);
    mufasa(&["check", &blocked]).has(1, "at 0.2 s: stage iii, point 3 meets track 7", "");
    let mut cycle = crate::common::cycle(0, false);
    cycle.detections.as_mut().expect("some").items[0].x = f64::NAN;
    let invalid = write(&folder, "invalid.jsonl", cycle_to_line("the id", &cycle));
    mufasa(&["check", &invalid]).has(2, "1 error", "cycle the id: detections.items.x[0]: ");
    let sum = mufasa(&["check", "--summary", &safe, &blocked]).out;
    let line = sum.lines().find(|line| line.starts_with("all 2 drives")).expect("a sum");
    let words: Vec<_> = line.split_whitespace().skip(3).collect();
    assert_eq!(words[..8], ["9", "8", "1", "0", "0", "1", "0", "0"], "{sum}");
    assert!(!sum.contains("fallbacks:"), "{sum}");
    let attacked = mufasa(&["check", &safe, "--inject", "ghost-tracks@0.2..0.3"]);
    attacked.has(1, "6 cycles, AllRemote, hardened: 4 safe, 2 unsafe", "");
    cycle = crate::common::cycle(0, false);
    cycle.configuration = mufasa_model::services::configuration::Configuration::PlanRemote;
    let local = write(&folder, "local.jsonl", cycle_to_line("local", &cycle));
    for (file, attack, problem) in [
        (&safe, "ghost-tracks@90..100", "the drive ends at 0.5 s"),
        (&local, "ghost-tracks", "received tracks, which are local in PlanRemote"),
    ] {
        let told = mufasa(&["check", file, "--inject", attack]);
        told.has(2, "", problem);
        assert!(told.err.contains(file.as_str()) && !told.out.contains("1 safe"), "{}", told.out);
    }
}

#[test]
fn json_output_is_one_valid_record_per_cycle_and_drive() {
    let folder = folder("json");
    let files = [lines(&folder, "a", 3, &[1]), lines(&folder, "b", 2, &[])];
    let told = mufasa(&["check", "--json", &files[0], &files[1]]);
    told.has(1, "", "");
    let records = told.out.lines().map(|line| serde_json::from_str(line).expect("JSON"));
    let records: Vec<Value> = records.collect();
    let kinds: Vec<_> = records.iter().map(|it| it["kind"].as_str().expect("a kind")).collect();
    let cycles = |count| vec!["checked_cycle"; count];
    let expected = [cycles(3), vec!["checked_drive"], cycles(2), vec!["checked_drive", "checked"]];
    assert_eq!(kinds, expected.concat());
    for (record, place, value) in [
        (1, "/answer/id", Value::from("a-1")),
        (1, "/answer/verdict", "unsafe".into()),
        (1, "/answer/strict", "unsafe".into()),
        (1, "/answer/stages/iii/witness/track", 7.into()),
        (1, "/implementation/failed_stage", "iii".into()),
        (1, "/disagreement", Value::Null),
        (3, "/model/fallbacks/0/hold", "started".into()),
        (3, "/model/stages/2/failed", 1.into()),
        (6 + 1, "/cycles", 5.into()),
        (6 + 1, "/unsafe", 1.into()),
        (6 + 1, "/disagreements", 0.into()),
    ] {
        assert_eq!(records[record].pointer(place), Some(&value), "{record} {place}");
    }
}

#[test]
fn pictures_of_unsafe_cycles_show_the_witness_and_do_not_overwrite_each_other() {
    let folder = folder("pictures");
    let file = lines(&folder, "p", 4, &[1, 3]);
    let pictures = folder.join("new/folder");
    let place = pictures.to_str().expect("a plain name");
    mufasa(&["check", &file, &file, "--svg", place]).has(1, "4 pictures", "");
    let entries =
        fs::read_dir(&pictures).expect("a folder").map(|entry| entry.expect("one").path());
    let mut names: Vec<_> = entries.map(|it| it.display().to_string()).collect();
    names.sort();
    assert_eq!(names.len(), 4);
    for index in [1, 3] {
        let end = format!("-000{index}-iii.svg");
        assert_eq!(names.iter().filter(|name| name.ends_with(&end)).count(), 2, "{names:?}");
    }
    for name in &names {
        let text = fs::read_to_string(name).expect("a picture");
        let document = Document::parse(&text).expect("XML");
        let witness = document.descendants().find(|node| node.attribute("id") == Some("witness"));
        assert_eq!(witness.expect("one").attribute("data-stage"), Some("iii"));
    }
    // A folder that cannot be written is refused before the work.
    let below_a_file = format!("{file}/pictures");
    let told = mufasa(&["check", &file, "--svg", &below_a_file]);
    told.has(2, "", &below_a_file);
    assert!(told.out.is_empty());
}

/// The look at what a file is once took the first bytes of a pipe away; two readers of one input would each get a part.
#[test]
fn standard_input_is_read_from_its_first_byte_and_by_one() {
    let file = lines(&folder("standard_input"), "a", 3, &[0]);
    for stdin in ["/dev/stdin", "-"] {
        let mut cat = Command::new("cat").arg(&file).stdout(Stdio::piped()).spawn().expect("cat");
        let told = with_input(&["check", "--summary", stdin], cat.stdout.take().expect("a pipe"));
        assert!(cat.wait().expect("it ends").success());
        told.has(1, "3 cycles: 2 safe, 1 unsafe", "");
    }
    let scenario = || File::open(&small()[0]).expect("a scenario");
    let second = "`-` stands here a second time, and standard input comes once";
    for files in [["-", "-"], ["-", "/dev/stdin"]] {
        let told = with_input(&["check", "--summary", files[0], files[1]], scenario());
        told.has(2, "", second);
        assert_eq!(told.err.lines().count(), 1, "{}", told.err);
    }
    let told = with_input(&["check", "--parameters", "-", "-"], scenario());
    told.has(2, "", "mufasa: --parameters -: standard input is one of FILES");
}

/// TOOL-01
#[test]
fn the_oracle_answers_standard_input() {
    let file = lines(&folder("oracle"), "a", 2, &[1]);
    let told = with_input(&["oracle"], File::open(file).expect("written"));
    let answers = told.out.lines().map(|line| serde_json::from_str::<Value>(line).expect("JSON"));
    let verdicts: Vec<_> = answers.map(|it| it["verdict"].clone()).collect();
    assert_eq!((told.code, verdicts), (Some(0), vec!["safe".into(), "unsafe".into()]));
}

#[test]
fn compositions_are_found_and_drawn() {
    let folder = folder("compose");
    let services = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/fig2.json");
    said(&folder, &["compose", services]).has(0, "8 compositions", "");
    let example = write(&folder, "example.json", mufasa(&["compose", "--example"]).out);
    said(&folder, &["compose", &example]).has(0, "8 compositions", "");
    assert!(mufasa(&["compose", services, "--dot"]).out.starts_with("digraph"));
}

/// In a checkout with git the commit, elsewhere the version alone.
#[test]
fn the_version_says_the_commit_of_a_checkout() {
    let told = mufasa(&["--version"]).out;
    let version = concat!("mufasa ", env!("CARGO_PKG_VERSION"));
    let is_here = |commit: &str| {
        let object = format!("{commit}^{{commit}}");
        let done = Command::new("git").args(["-C", PROJECT, "cat-file", "-e", &object]).status();
        done.is_ok_and(|status| status.success())
    };
    if Path::new(PROJECT).join(".git").exists() && is_here("HEAD") {
        let commit = told.strip_prefix(&format!("{version} (commit ")).expect("a commit");
        let commit = commit.strip_suffix(")\n").expect("nothing else");
        assert!(commit.len() >= 10 && is_here(commit), "{told}");
    } else {
        assert_eq!(told, format!("{version}\n"));
    }
}

#[test]
fn what_is_written_without_a_named_folder_is_said_first() {
    let folder = folder("unnamed");
    let first = |arguments: &[&str], code, usual: &str| {
        let told = said(&folder, arguments);
        told.has(code, "", "");
        let words = format!("mufasa: writes into {usual}/; --out names another folder");
        assert_eq!(told.err.lines().next(), Some(words.as_str()));
    };
    first(&["explore", "--world", "nope"], 2, "exploration");
    first(&["conform", "--", "./not-there"], 2, "mufasa-conform");
    // Neither has begun, and nothing is left that looks like a result.
    assert_eq!(fs::read_dir(&folder).expect("a folder").count(), 0);
    for command in ["vectors", "man", "schemas"] {
        first(&[command], 0, command);
        assert!(folder.join(command).is_dir());
    }
    assert_eq!(said(&folder, &["man", "--out", "there"]).err, "");
}

#[test]
fn shells_complete_and_every_command_has_help_and_a_page() {
    for (shell, word) in [
        ("bash", "complete -F _mufasa"),
        ("zsh", "#compdef mufasa"),
        ("fish", "complete -c mufasa"),
    ] {
        mufasa(&["completions", shell]).has(0, word, "");
    }
    let help = mufasa(&["--help"]).out;
    let list = help.split_once("Commands:\n").expect("a list of commands").1;
    let list = list.split_once("\n\n").expect("options behind it").0;
    let names = list.lines().filter_map(|line| line.split_ascii_whitespace().next());
    let commands: Vec<_> = names.filter(|it| *it != "help").collect();
    assert!(commands.contains(&"vehicle") && commands.contains(&"station"), "{commands:?}");
    let completions = mufasa(&["completions", "bash"]).out;
    let folder = folder("man");
    said(&folder, &["man", "--out", "."]).has(0, "", "");
    assert!(folder.join("mufasa.1").exists());
    for command in commands {
        let page = fs::read_to_string(folder.join(format!("mufasa-{command}.1")));
        assert!(page.expect("there is a page").contains(".SH DESCRIPTION"), "{command}");
        assert!(completions.contains(&format!("mufasa__subcmd__{command}")), "{command}");
        // What writes once for other programs has no results.
        let has_codes = mufasa(&[command, "--help"]).out.contains("\nExit codes: ");
        assert_eq!(has_codes, command != "completions", "{command}");
    }
    let help = mufasa(&["conform", "--help"]).out;
    for part in
        ["one JSON record per line", "one answer", "spec/5-interfaces.md", "-- node program.mjs"]
    {
        assert!(help.contains(part), "{part}: {help}");
    }
}

/// What is said of progress where standard error is no terminal.
#[test]
fn verbose_shows_progress_as_lines_and_quiet_shows_none() {
    let [scenario, solution] = small();
    let told = |option: &[&str]| {
        mufasa(&[&["check", "--summary", &scenario, &solution], option].concat()).err
    };
    assert_eq!((told(&["-q"]), told(&[])), (String::new(), String::new()));
    let lines = told(&["-v"]);
    assert!(lines.lines().count() > 0, "no line");
    let is_progress = |line: &str| line.contains(" cycles, ") && line.ends_with(" left");
    assert!(lines.lines().all(is_progress), "{lines}");
}

/// What was counted until then is written, and says so.
#[cfg(unix)]
#[test]
fn a_vehicle_that_is_interrupted_says_so() {
    let file = folder("interrupted").join("vehicle.json");
    let mut command = Command::new(env!("CARGO_BIN_EXE_mufasa"));
    let command = command.args(["vehicle", "--quiet", "--json"]).arg(&file);
    let mut vehicle = command.stdout(Stdio::null()).spawn().expect("the program starts");
    thread::sleep(Duration::from_secs(1));
    let killed = Command::new("kill").args(["-INT", &vehicle.id().to_string()]).status();
    assert!(killed.expect("kill is there").success());
    assert_eq!(vehicle.wait().expect("it ends").code(), Some(130));
    let summary = fs::read_to_string(&file).expect("written");
    let summary: Value = serde_json::from_str(&summary).expect("JSON");
    assert_eq!(summary["interrupted"], true);
    assert!(summary["cycles"].as_u64().expect("a count") < 188);
}
