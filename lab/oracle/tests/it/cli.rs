//! The built program: exit codes, bad input, outputs.

use std::ffi::OsStr;
use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use crate::kit::folder;
use mufasa_records::cycle_to_line;
use roxmltree::Document;
use serde_json::Value;

fn mufasa(arguments: impl IntoIterator<Item = impl AsRef<OsStr>>) -> Output {
    Command::new(env!("CARGO_BIN_EXE_mufasa"))
        .args(arguments)
        .stdin(Stdio::null())
        .output()
        .expect("the program starts")
}

fn code(output: &Output) -> i32 {
    output.status.code().expect("the program ends by itself")
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn stderr(output: &Output) -> String {
    let text = String::from_utf8(output.stderr.clone()).unwrap();
    assert!(!text.contains("panicked"), "{text}");
    text
}

/// A drive of `count` cycles as JSON Lines; those in `blocked` are unsafe.
fn lines(folder: &Path, name: &str, count: u32, blocked: &[u32]) -> String {
    let line = |index| {
        cycle_to_line(
            &format!("{name}-{index}"),
            &crate::common::cycle(index, blocked.contains(&index)),
        )
    };
    let text: Vec<_> = (0..count).map(line).collect();
    write(folder, &format!("{name}.jsonl"), text.join("\n"))
}

fn write(folder: &Path, name: &str, content: impl AsRef<[u8]>) -> String {
    let file = folder.join(name);
    fs::write(&file, content).unwrap();
    file.to_str().unwrap().to_owned()
}

#[test]
fn exit_code_0_when_every_cycle_is_safe() {
    let folder = folder("safe");
    let output = mufasa(["check", &lines(&folder, "safe", 5, &[])]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let text = stdout(&output);
    assert!(text.contains("5 cycles, AllRemote, hardened: 5 safe, 0 unsafe"), "{text}");
    assert!(text.ends_with("0 fallbacks, 5 offloaded; model and implementation agree\n"), "{text}");
    assert_eq!(stderr(&output), "");
}

#[test]
fn exit_code_1_when_a_cycle_is_unsafe() {
    let folder = folder("unsafe");
    let output = mufasa(["check", &lines(&folder, "unsafe", 5, &[2])]);
    assert_eq!(code(&output), 1);
    assert!(stdout(&output).contains("at 0.2 s: stage iii, point 3 meets track 7"));
}

#[test]
fn exit_code_2_for_every_kind_of_bad_file_and_the_others_are_still_checked() {
    let folder = folder("bad");
    let good = lines(&folder, "good", 2, &[1]);
    let bad = [
        folder.join("missing.xml").to_str().unwrap().to_owned(),
        folder.to_str().unwrap().to_owned(),
        write(&folder, "empty", ""),
        write(&folder, "binary", [0_u8, 255, 254, 0, 7]),
        write(&folder, "text", "hello"),
        write(&folder, "cut.xml", "<commonRoad><lanelet"),
        write(&folder, "other.xml", "<html/>"),
        write(&folder, "cut.jsonl", "{\"kind\": \"cycle\""),
        write(&folder, "other.jsonl", "{\"kind\": \"cycle\", \"id\": \"x\", \"speed\": 1}"),
        write(&folder, "cut.npy", b"\x93NUMPY\x01\x00"),
    ];
    for file in &bad {
        let output = mufasa(["check", file, &good]);
        let message = stderr(&output);
        assert_eq!(code(&output), 2, "{file}: {message}");
        assert!(message.contains(file), "{file}: {message}");
        assert!(stdout(&output).contains("2 cycles, AllRemote, hardened: 1 safe"), "{file}");
    }
    let all: Vec<_> = ["check", "--summary"].into_iter().chain(bad.iter().map(|s| &**s)).collect();
    let output = mufasa(all);
    assert_eq!((code(&output), stderr(&output).lines().count()), (2, bad.len()));
}

#[test]
fn invalid_local_input_is_an_error_with_cycle_field_and_index() {
    let folder = folder("invalid");
    let mut cycle = crate::common::cycle(0, false);
    cycle.detections.as_mut().unwrap().items[0].x = f64::NAN;
    let file = write(&folder, "invalid.jsonl", cycle_to_line("the id", &cycle));
    let output = mufasa(["check", &file]);
    let message = stderr(&output);
    assert_eq!(code(&output), 2);
    assert!(message.contains("cycle the id: detections.items.x[0]: "), "{message}");
    assert!(stdout(&output).contains("1 error"));
}

#[test]
fn arguments_that_make_no_sense_are_refused() {
    let folder = folder("arguments");
    let good = lines(&folder, "good", 1, &[]);
    for arguments in [
        &["check"][..],
        &["nonsense"],
        &["check", &good, "--profile", "soft"],
        &["check", &good, "--configuration", "Remote"],
        &["check", &good, "--sensor-range", "nan"],
        &["check", &good, "--sensor-probability", "1.5"],
        &["check", &good, "--horizon", "1e9"],
        &["check", &good, "--grid-width", "0"],
        &["check", &good, "--grid-width", "-1"],
        &["check", &good, "--ego", "99999999999999999999"],
        &["check", &good, "--seed", "x"],
        &["check", &good, "--inject", "nothing"],
        &["check", &good, "--inject", "wrong-map@x..2"],
        &["check", &good, "--inject", "wrong-map@3..2"],
        &["check", &good, "--inject", "wrong-map@2..2"],
        &["check", &good, "--json", "--summary"],
        &["compose"],
    ] {
        let output = mufasa(arguments);
        assert_eq!(code(&output), 2, "{arguments:?}");
        assert!(!stderr(&output).is_empty(), "{arguments:?}");
        assert!(output.stdout.is_empty(), "{arguments:?}");
    }
}

#[test]
fn parameters_files_are_read_and_their_errors_name_the_line() {
    let folder = folder("parameters");
    let good = lines(&folder, "good", 3, &[1]);
    let parameters = write(&folder, "good.toml", "t_wait_ns = 100_000_000\n");
    let output = mufasa(["check", &good, "--parameters", &parameters]);
    assert_eq!(code(&output), 1);
    assert!(stdout(&output).contains("wait until 0.2 s"), "{}", stdout(&output));
    for (text, problem) in [
        ("\nspeed = 3", ":2: speed: is no parameter; "),
        ("theta_tr = -1.0", ":1: theta_tr: "),
        ("t_wait_ns = 1.5", ":1: t_wait_ns: must be an integer"),
        ("= 3", ":1: is not TOML"),
    ] {
        let file = write(&folder, "bad.toml", text);
        let output = mufasa(["check", &good, "--parameters", &file]);
        let message = stderr(&output);
        assert_eq!(code(&output), 2);
        assert!(message.contains(&format!("{file}{problem}")), "{message}");
    }
    let output = mufasa(["check", &good, "--parameters", "missing.toml"]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("missing.toml: cannot be read"));
}

#[test]
fn json_output_is_one_valid_record_per_cycle_and_drive() {
    let folder = folder("json");
    let files = [lines(&folder, "a", 3, &[1]), lines(&folder, "b", 2, &[])];
    let output = mufasa(["check", "--json", &files[0], &files[1]]);
    assert_eq!(code(&output), 1);
    let records: Vec<Value> =
        stdout(&output).lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let kinds: Vec<_> = records.iter().map(|record| record["kind"].as_str().unwrap()).collect();
    let cycles = |count| vec!["checked_cycle"; count];
    let expected = [cycles(3), vec!["checked_drive"], cycles(2), vec!["checked_drive", "checked"]];
    assert_eq!(kinds, expected.concat());
    let failed = &records[1];
    assert_eq!(failed["answer"]["id"], "a-1");
    assert_eq!(failed["answer"]["verdict"], "unsafe");
    assert_eq!(failed["answer"]["strict"], "unsafe");
    assert_eq!(failed["answer"]["stages"]["iii"]["witness"]["track"], 7);
    assert_eq!(failed["implementation"]["failed_stage"], "iii");
    assert!(failed["disagreement"].is_null());
    assert_eq!(records[3]["model"]["fallbacks"][0]["hold"], "started");
    assert_eq!(records[3]["model"]["stages"][2]["failed"], 1);
    assert_eq!(records[7 - 1]["kind"], "checked_drive");
    let last = records.last().unwrap();
    assert_eq!(
        (&last["cycles"], &last["unsafe"], &last["disagreements"]),
        (&5.into(), &1.into(), &0.into())
    );
}

#[test]
fn pictures_of_unsafe_cycles_are_complete_and_show_the_witness() {
    let folder = folder("pictures");
    let file = lines(&folder, "p", 4, &[1, 3]);
    let pictures = folder.join("new/folder");
    let output = mufasa(["check", &file, "--svg", pictures.to_str().unwrap()]);
    assert_eq!(code(&output), 1);
    assert!(stdout(&output).contains("2 pictures"));
    let mut names: Vec<_> = fs::read_dir(&pictures)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert_eq!(names.len(), 2);
    for (name, index) in names.iter().zip([1, 3]) {
        assert!(name.ends_with(&format!("-000{index}-iii.svg")), "{name}");
        let text = fs::read_to_string(pictures.join(name)).unwrap();
        let document = Document::parse(&text).unwrap();
        let witness = document.descendants().find(|node| node.attribute("id") == Some("witness"));
        assert_eq!(witness.unwrap().attribute("data-stage"), Some("iii"));
    }
}

#[test]
fn a_folder_that_cannot_be_written_is_refused_before_the_work() {
    let folder = folder("unwritable");
    let file = lines(&folder, "p", 2, &[1]);
    let below_a_file = format!("{file}/pictures");
    let output = mufasa(["check", &file, "--svg", &below_a_file]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains(&below_a_file));
    assert!(output.stdout.is_empty());
}

#[test]
fn the_table_over_all_drives_sums_them() {
    let folder = folder("summary");
    let files = [lines(&folder, "a", 3, &[1]), lines(&folder, "b", 2, &[])];
    let output = mufasa(["check", "--summary", &files[0], &files[1]]);
    let text = stdout(&output);
    let sum = text.lines().find(|line| line.starts_with("all 2 drives")).unwrap();
    let words: Vec<_> = sum.split_whitespace().skip(3).collect();
    assert_eq!(words[..8], ["5", "4", "1", "0", "0", "1", "0", "0"], "{text}");
    assert!(!text.contains("fallbacks:"), "{text}");
}

#[test]
fn pictures_of_drives_with_the_same_name_do_not_overwrite_each_other() {
    let folder = folder("same");
    let file = lines(&folder, "a", 2, &[1]);
    let pictures = folder.join("pictures");
    let output = mufasa(["check", &file, &file, "--svg", pictures.to_str().unwrap()]);
    assert_eq!(code(&output), 1);
    assert_eq!(fs::read_dir(&pictures).unwrap().count(), 2);
}

#[test]
fn an_attack_is_injected_and_caught() {
    let folder = folder("inject");
    let file = lines(&folder, "a", 6, &[]);
    let output = mufasa(["check", &file, "--inject", "ghost-tracks@0.2..0.3"]);
    let text = stdout(&output);
    assert_eq!(code(&output), 1, "{text}");
    assert!(text.contains("6 cycles, AllRemote, hardened: 4 safe, 2 unsafe"), "{text}");
    assert!(text.contains("at 0.2 s: stage i"), "{text}");
}

#[test]
fn an_attack_that_changes_nothing_is_bad_input() {
    let folder = folder("inject_nothing");
    let file = lines(&folder, "a", 6, &[]);
    let mut local = crate::common::cycle(0, false);
    local.configuration = mufasa_model::services::configuration::Configuration::PlanRemote;
    let local = write(&folder, "local.jsonl", cycle_to_line("local", &local));
    for (file, attack, problem) in [
        (&file, "ghost-tracks@90..100", "the drive ends at 0.5 s"),
        (&local, "ghost-tracks", "received tracks, which are local in PlanRemote"),
    ] {
        let output = mufasa(["check", file, "--inject", attack]);
        let message = stderr(&output);
        assert_eq!(code(&output), 2, "{message}");
        assert!(message.contains(file.as_str()) && message.contains(problem), "{message}");
        assert!(!stdout(&output).contains("1 safe"), "{}", stdout(&output));
    }
}

#[test]
fn files_are_counted_and_not_their_lines() {
    let folder = folder("wrong_lines");
    let file = write(&folder, "wrong.jsonl", "{}\n".repeat(30));
    let output = mufasa(["check", &file]);
    let message = stderr(&output);
    assert_eq!((code(&output), message.lines().count()), (2, 11), "{message}");
    assert!(message.trim_end().ends_with("and 20 more lines"), "{message}");
    assert!(
        stdout(&output).contains("1 file with something that could not be read"),
        "{}",
        stdout(&output)
    );
}

#[test]
fn a_reader_that_goes_away_ends_the_program_quietly() {
    let folder = folder("pipe");
    let file = lines(&folder, "a", 300, &[]);
    let mut child = Command::new(env!("CARGO_BIN_EXE_mufasa"))
        .args(["check", "--json", &file])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(stderr(&output), "");
    assert_eq!(code(&output), 141);
}

/// The look at what a file is once took the first bytes of a pipe away.
#[test]
fn standard_input_is_checked_from_its_first_byte() {
    let folder = folder("standard_input");
    let file = lines(&folder, "a", 3, &[0]);
    for stdin in ["/dev/stdin", "-"] {
        let mut cat = Command::new("cat").arg(&file).stdout(Stdio::piped()).spawn().unwrap();
        let output = Command::new(env!("CARGO_BIN_EXE_mufasa"))
            .args(["check", "--summary", stdin])
            .stdin(cat.stdout.take().unwrap())
            .output()
            .unwrap();
        assert!(cat.wait().unwrap().success());
        assert_eq!(code(&output), 1, "{}", stderr(&output));
        assert!(stdout(&output).contains("3 cycles: 2 safe, 1 unsafe"), "{}", stdout(&output));
    }
}

/// TOOL-01
#[test]
fn the_oracle_answers_standard_input() {
    let folder = folder("oracle");
    let file = lines(&folder, "a", 2, &[1]);
    let output = Command::new(env!("CARGO_BIN_EXE_mufasa"))
        .arg("oracle")
        .stdin(fs::File::open(file).unwrap())
        .output()
        .unwrap();
    assert_eq!(code(&output), 0);
    let verdicts: Vec<Value> =
        stdout(&output).lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(verdicts.len(), 2);
    assert_eq!(
        (&verdicts[0]["verdict"], &verdicts[1]["verdict"]),
        (&"safe".into(), &"unsafe".into())
    );
}

#[test]
fn compositions_are_found_drawn_and_refused() {
    let folder = folder("compose");
    let services = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/fig2.json");
    let output = mufasa(["compose", services]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(!output.stdout.is_empty());
    let output = mufasa(["compose", services, "--dot"]);
    assert!(stdout(&output).starts_with("digraph"));
    let picture = folder.join("fig2.svg");
    let output = mufasa(["compose", services, "--svg", picture.to_str().unwrap()]);
    assert_eq!(code(&output), 0);
    assert!(Document::parse(&fs::read_to_string(&picture).unwrap()).is_ok());
    for bad in [write(&folder, "bad.json", "{"), folder.join("missing").to_str().unwrap().into()] {
        let output = mufasa(["compose", &bad]);
        assert_eq!(code(&output), 2);
        assert!(stderr(&output).contains(&bad));
    }
}

#[test]
fn help_is_no_error() {
    for arguments in [&["--help"][..], &["check", "--help"], &["--version"]] {
        let output = mufasa(arguments);
        assert_eq!(code(&output), 0);
        assert!(!output.stdout.is_empty());
    }
}
