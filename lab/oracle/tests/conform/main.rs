//! `mufasa conform` against programs that are right, and against programs that misbehave in every
//! way that `spec/5-interfaces.md#programs-under-test` names. The latter are shell scripts of a
//! few lines; where there is no `sh` the tests say NOT RUN.

mod batch;
mod broken;
mod campaign;
mod interrupted;
mod limits;
mod right;
mod stateful;
mod vectors;
mod wrong;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use mufasa_conform::Summary;

const MUFASA: &str = env!("CARGO_BIN_EXE_mufasa");

/// Reads a line and takes its id, as every script does.
const EACH: &str = r#"while IFS= read -r line; do id=${line#*'"id": "'}; id=${id%%'"'*}; "#;

/// Answers that the cycle is safe.
const SAFE: &str = r#"printf '{"id": "%s", "verdict": "safe", "failed_stage": null}\n' "$id""#;

/// A script that is right but that it says stage iv where stage iii failed, in each line by itself.
fn names_iv_for_iii() -> String {
    format!(
        r#""{MUFASA}" oracle | while IFS= read -r line; do
        case $line in
        *'"failed_stage":"iii"'*) id=${{line#*'"id":"'}}; id=${{id%%'"'*}};
          printf '{{"id": "%s", "verdict": "unsafe", "failed_stage": "iv"}}\n' "$id";;
        *) printf '%s\n' "$line";;
        esac; done"#
    )
}

/// The folder of a test.
fn path(test: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("conform-{test}"))
}

/// A folder of its own for a test, empty.
fn folder(test: &str) -> PathBuf {
    let folder = path(test);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder for the test");
    folder
}

/// Generated cases alone: many tests count them, and shell scripts are slow.
fn conform(folder: &Path, options: &[&str], command: &[&str]) -> Output {
    with_vectors(folder, &[options, &["--no-vectors"]].concat(), command)
}

fn with_vectors(folder: &Path, options: &[&str], command: &[&str]) -> Output {
    let mut mufasa = Command::new(MUFASA);
    mufasa.arg("conform").args(options);
    if !options.contains(&"--shrinking") {
        // On a busy machine there is time enough.
        mufasa.args(["--shrinking", "600"]);
    }
    mufasa.arg("--out").arg(folder).arg("--").args(command);
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
        assert_eq!(line, found.line());
        let rule = format!(" x  {} {}", found.class.kind.name(), found.class.breach.name());
        assert!(told.contains(&rule), "{told}");
    }
    let shown =
        summary.classes.iter().filter(|it| told.contains(&format!("DISAGREES  {},", it.class)));
    assert!((1..=3).contains(&shown.count()), "{told}");
    assert!(told.contains("\nmend first:\nDISAGREES  "), "{told}");
    let junit = fs::read_to_string(folder.join("junit.xml")).expect("JUnit XML");
    let document = roxmltree::Document::parse(&junit).expect("XML");
    let failures = document.descendants().filter(|node| node.has_tag_name("failure")).count();
    assert_eq!(failures, summary.classes.len());
    Some((summary, told))
}
