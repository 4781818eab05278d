//! Mistakes on the command line and what is said of them: outputs that nobody reads, inputs named twice, units
//! forgotten, help that was looked for.

use crate::kit::folder;
use serde_json::Value;
use std::fs::{self, File, OpenOptions};
use std::process::{Command, Output, Stdio};
use std::thread;
use std::time::Duration;

const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../drives/data/readers/");

fn mufasa(arguments: &[&str], input: Stdio, output: Stdio) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_mufasa"));
    let command = command.args(arguments).stdin(input).stdout(output).stderr(Stdio::piped());
    command.spawn().expect("the program starts").wait_with_output().expect("it ends")
}

/// What was refused, with standard input as said.
fn refusal(arguments: &[&str], input: Stdio) -> String {
    let output = mufasa(arguments, input, Stdio::null());
    assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    String::from_utf8(output.stderr).expect("UTF-8")
}

#[test]
fn a_full_disk_or_a_closed_pipe_ends_completions_as_other_outputs() {
    for shell in ["bash", "zsh", "fish"] {
        let full = OpenOptions::new().write(true).open("/dev/full").expect("Linux has it");
        let ended = mufasa(&["completions", shell], Stdio::null(), full.into());
        let told = String::from_utf8(ended.stderr).expect("UTF-8");
        assert_eq!(ended.status.code(), Some(2), "{told}");
        assert!(told.starts_with("mufasa: standard input or output: "), "{told}");
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        let ended = mufasa(&["completions", shell], Stdio::null(), writer.into());
        assert_eq!((ended.status.code(), ended.stderr), (Some(141), Vec::new()));
    }
}

#[test]
fn commands_with_results_say_their_exit_codes() {
    for command in ["check", "compose", "conform", "demo", "explore", "oracle", "prove"] {
        let help = mufasa(&[command, "--help"], Stdio::null(), Stdio::piped()).stdout;
        let help = String::from_utf8(help).expect("UTF-8");
        assert!(help.contains("\nExit codes: 0 "), "{command}: {help}");
    }
}

fn scenario() -> Stdio {
    File::open(format!("{DATA}small-2018b.xml")).expect("a scenario").into()
}

/// Two readers of one input would each get a part of it.
#[test]
fn standard_input_is_read_by_one() {
    let second = "`-` stands here a second time, and standard input comes once";
    for files in [["-", "-"], ["-", "/dev/stdin"]] {
        let told = refusal(&["check", "--summary", files[0], files[1]], scenario());
        assert_eq!(told.lines().count(), 1, "{told}");
        assert!(told.contains(second), "{told}");
    }
    let told = refusal(&["check", "--parameters", "-", "-"], scenario());
    assert!(told.starts_with("mufasa: --parameters -: standard input is one of FILES"), "{told}");
}

#[test]
fn parameters_come_from_standard_input_too() {
    let file = folder("parameters-piped").join("p.toml");
    fs::write(&file, "a_b = 6\nthetatr = 1\n").expect("written");
    let given = File::open(&file).expect("written").into();
    let told = refusal(&["check", "x", "--parameters", "-"], given);
    assert_eq!(told, "mufasa: -:2: thetatr: is no parameter; is theta_tr meant?\n");
}

/// A time that no vehicle has, or one that drops what is in time, ends no check; the monitor would refuse it.
#[test]
fn a_time_in_another_unit_is_noted() {
    let folder = folder("units");
    let [scenario, solution] =
        ["small-2018b.xml", "small.KS2.solution.xml"].map(|it| format!("{DATA}{it}"));
    let noted = |line: &str| {
        let file = folder.join("p.toml");
        fs::write(&file, line).expect("written");
        let file = file.to_str().expect("a plain name");
        let arguments = ["check", "--summary", &scenario, &solution, "--parameters", file];
        let ended = mufasa(&arguments, Stdio::null(), Stdio::null());
        assert_ne!(ended.status.code(), Some(2));
        String::from_utf8(ended.stderr).expect("UTF-8")
    };
    for (line, said) in [
        ("t_wait_ns = 10", "t_wait_ns = 10 ns is below 1 s; is it in another unit?"),
        ("l_max_ns = 50", "l_max_ns = 50 ns is below 1 ms"),
        ("max_age_ns = 100", "max_age_ns = 100 ns is below 1 ms"),
        ("max_age_ns = 40_000_000", "max_age_ns = 40000000 is below "),
    ] {
        let told = noted(line);
        assert!(told.contains("p.toml: a vehicle's monitor refuses this: "), "{told}");
        assert!(told.contains(said), "{told}");
    }
    for line in ["t_wait_ns = 1_000_000_000", "t_wait_ns = 0", "dt_max_ns = 1_000_000", "tau = 0"] {
        assert_eq!(noted(line), "", "{line}");
    }
}

/// What the CAV needs to brake is the vehicle's, and follows from the period of its cycles.
#[test]
fn a_tau_that_the_vehicle_raises_is_told() {
    let (folder, scenario) = (folder("tau"), format!("{DATA}small-2018b.xml"));
    let told = |tau: &str, profile: &str| {
        let file = folder.join("p.toml");
        fs::write(&file, format!("tau = {tau}\ndt_max_ns = 150_000_000\n")).expect("written");
        let file = file.to_str().expect("a plain name");
        let arguments = ["vehicle", &scenario, "--parameters", file, "--profile", profile];
        let ended = mufasa(&arguments, Stdio::null(), Stdio::piped());
        let text = String::from_utf8(ended.stdout).expect("UTF-8");
        assert!(text.contains("checked and safe"), "{text}");
        text.lines().find(|line| line.contains("tau")).map(str::to_owned)
    };
    let raised = "tau is 0.25 s, not 0.2 s: at least 2.5 periods, of 100 ms here (A-07 of docs/assumptions.md)";
    assert_eq!(told("0.2", "hardened").as_deref(), Some(raised));
    assert_eq!(told("0.25", "hardened"), None);
    // No rule of the paper has a tau.
    assert_eq!(told("0.2", "paper"), None);
}

/// Records name the parameters of their stages; those of the requester are the file's.
#[test]
fn parameters_that_recorded_cycles_ignore_are_told() {
    let folder = folder("ignored");
    let vectors = include_str!("../../../../vectors/findings/F-30.jsonl");
    let mut vector: Value =
        serde_json::from_str(vectors.lines().next().expect("one")).expect("JSON");
    let cycle = &mut vector["input"];
    let lines = [0, 1, 2].map(|index: i64| {
        cycle["now_ns"] = (1_000_000_000 + index * 100_000_000).into();
        cycle.to_string()
    });
    let [file, of_stages, of_requester] = [
        ("drive.jsonl", lines.join("\n")),
        ("stages.toml", String::from("theta_tr = 0.3\ndt_max_ns = 150_000_000\n")),
        ("requester.toml", String::from("dt_max_ns = 150_000_000\n")),
    ]
    .map(|(name, text)| {
        let file = folder.join(name);
        fs::write(&file, text).expect("written");
        file.to_str().expect("a plain name").to_owned()
    });
    let told = |arguments: &[&str]| {
        let ended =
            mufasa(&[&["vehicle", &file], arguments].concat(), Stdio::null(), Stdio::null());
        assert_ne!(ended.status.code(), Some(2));
        let said = String::from_utf8(ended.stderr).expect("UTF-8");
        said.contains("each cycle has its own profile, configuration and parameters")
    };
    assert!(told(&["--parameters", &of_stages]));
    assert!(told(&["--profile", "paper"]));
    assert!(!told(&["--parameters", &of_requester]));
    assert!(!told(&[]));
}

#[test]
fn what_cannot_be_written_or_read_is_refused_before_the_work() {
    let folder = folder("refused");
    let [place, gone] = ["", "gone"].map(|name| folder.join(name).display().to_string());
    for (arguments, said) in [
        (vec!["vehicle", "--json", &place], "it is a folder; name a file"),
        (vec!["station", "--broker", "amqp://127.0.0.1:1", "--json", &place], "it is a folder"),
        (vec!["prove", "--out", &place, "gappa"], "it is a folder"),
        (vec!["prove", "--cbmc", &gone, "gappa"], "gone: is not there; scripts/prove-wasm writes"),
        (vec!["evaluate", "replay", "--out", &place], "it is a folder"),
    ] {
        let told = refusal(&arguments, Stdio::null());
        assert!(told.contains(said) && told.lines().count() == 1, "{told}");
    }
}

/// As a full disk.
#[cfg(unix)]
#[test]
fn a_limit_of_file_sizes_is_told() {
    let folder = folder("limit");
    let command =
        format!("ulimit -f 8; exec {} vectors --out vectors", env!("CARGO_BIN_EXE_mufasa"));
    let ended = Command::new("sh").args(["-c", &command]).current_dir(&folder).output();
    let ended = ended.expect("a shell is there");
    assert_eq!(ended.status.code(), Some(2), "{ended:?}");
    let told = String::from_utf8(ended.stderr).expect("UTF-8");
    assert!(told.contains("cannot be written") && told.contains("large"), "{told}");
}

#[test]
fn hints_are_about_what_was_asked() {
    let mixed = folder("mixed").join("mixed.jsonl");
    let vector =
        include_str!("../../../../vectors/findings/F-30.jsonl").lines().next().expect("one");
    let vector: Value = serde_json::from_str(vector).expect("JSON");
    fs::write(&mixed, format!("{}\n{{\"kind\": 3}}\n", vector["input"])).expect("written");
    let told = refusal(&["vehicle", mixed.to_str().expect("plain")], Stdio::null());
    assert!(told.contains("mixed.jsonl:2") && told.contains("kind"), "{told}");
    let told = refusal(&["conform", "merge"], Stdio::null());
    assert!(told.contains("required") && !told.contains("behind `--`"), "{told}");
    let told = refusal(&["conform", "./program"], Stdio::null());
    assert!(told.contains("behind `--`"), "{told}");
    let two = concat!(env!("CARGO_MANIFEST_DIR"), "/../../vectors/services/composition.jsonl");
    let told = refusal(&["compose", two], Stdio::null());
    assert!(
        told.contains("one record is composed") && told.contains("more; give a file with one"),
        "{told}"
    );
}

/// A broker that is not there is tried again and again; who never had it did not what was asked.
#[test]
fn a_broker_that_is_never_reached_is_told() {
    let scenario = format!("{DATA}small-2018b.xml");
    let vehicle = ["vehicle", &scenario, "--broker", "amqp://guest:guest@127.0.0.1:1"];
    let station =
        ["station", &scenario, "--broker", "amqp://guest:guest@127.0.0.1:1", "--seconds", "1"];
    for arguments in [&vehicle[..], &station] {
        let ended = mufasa(arguments, Stdio::null(), Stdio::null());
        assert_eq!(ended.status.code(), Some(1));
        let told = String::from_utf8(ended.stderr).expect("UTF-8");
        assert!(
            told.contains("the broker at 127.0.0.1:1 cannot be reached, and is tried again"),
            "{told}"
        );
    }
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
    let summary: Value =
        serde_json::from_str(&fs::read_to_string(&file).expect("written")).expect("JSON");
    assert_eq!(summary["interrupted"], true);
    assert!(summary["cycles"].as_u64().expect("a count") < 188);
}
