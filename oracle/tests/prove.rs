//! `mufasa prove`: what is not here is not run, what is refuted is no success.

use std::path::Path;
use std::process::{Command, Output};

fn prove(arguments: &[&str], path: Option<&str>, folder: &Path) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_mufasa"));
    command.arg("prove").args(arguments).arg("--out").arg(folder.join("prove.json"));
    if let Some(path) = path {
        command.env("PATH", path);
    }
    command.output().expect("the program runs")
}

fn folder(name: &str) -> std::path::PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::create_dir_all(&folder).expect("a folder for the test");
    folder
}

#[test]
fn without_solvers_nothing_is_proved() {
    let folder = folder("prove-without");
    let output = prove(&["z3", "gappa"], Some(""), &folder);
    assert_eq!(output.status.code(), Some(0));
    let text = String::from_utf8(output.stdout).expect("text");
    assert!(text.contains("0 proved, 0 refuted, 0 unknown, 36 not run"), "{text}");
    let lines = std::fs::read_to_string(folder.join("prove.json")).expect("the lines");
    assert_eq!(lines.matches("\"verdict\":\"not run\"").count(), 36);
}

#[test]
fn a_refuted_harness_is_no_success() {
    let folder = folder("prove-refuted");
    let cbmc = folder.join("cbmc.json");
    let line = |verdict: &str| {
        format!(
            r#"{{"id": "qos::verify_latency_is_exact", "statement": "s", "engine": "cbmc-wasm",
             "domain": "d", "verdict": "{verdict}", "seconds": 1.5}}"#
        )
        .replace('\n', " ")
    };
    for (verdict, code) in [("proved", 0), ("refuted", 1), ("unknown", 1), ("perhaps", 2)] {
        std::fs::write(&cbmc, line(verdict)).expect("the file");
        let file = cbmc.to_str().expect("a plain path");
        let output = prove(&["latency", "--cbmc", file], None, &folder);
        assert_eq!(output.status.code(), Some(code), "{verdict}: {output:?}");
    }
}

#[test]
fn a_name_of_nothing_is_bad_input() {
    assert_eq!(prove(&["no such name"], None, &folder("prove-none")).status.code(), Some(2));
}
