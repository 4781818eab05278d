//! `mufasa conform` against programs that are right, and against programs that misbehave in every
//! way that `spec/5-interfaces.md#programs-under-test` names: shell scripts of a few lines.
#![cfg(unix)]

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

use mufasa_conform::{Breach, Found, Summary};

const MUFASA: &str = env!("CARGO_BIN_EXE_mufasa");

/// Reads a line and takes its id, as every script does.
const EACH: &str = r#"while IFS= read -r line; do id=${line#*'"id": "'}; id=${id%%'"'*}; "#;

/// Answers that the cycle is safe.
const SAFE: &str = r#"printf '{"id": "%s", "verdict": "safe", "failed_stage": null}\n' "$id""#;

/// A script that says safe to everything.
fn always_safe() -> String {
    format!("{EACH} {SAFE}; done")
}

/// The oracle.
fn right() -> String {
    format!("exec '{MUFASA}' oracle")
}

/// The oracle, with its answers changed on the way.
fn changed(sed: &str) -> String {
    format!("'{MUFASA}' oracle | sed -u '{sed}'")
}

/// What the answer to a line becomes that matches: safe.
fn safe_where(matches: &str) -> String {
    changed(&format!(r#"/{matches}/s/"verdict":.*/"verdict":"safe","failed_stage":null}}/"#))
}

/// Right, except that it says stage iv where stage iii failed, in each line by itself.
fn names_iv_for_iii() -> String {
    changed(
        r#"s/"verdict":"unsafe","failed_stage":"iii".*/"verdict":"unsafe","failed_stage":"iv"}/"#,
    )
}

/// A folder of its own for a test, empty.
fn folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("conform-{test}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder for the test");
    folder
}

fn text(output: &Output) -> String {
    let errors = String::from_utf8_lossy(&output.stderr);
    format!("{}{errors}", String::from_utf8_lossy(&output.stdout))
}

/// What `mufasa` says to these words and paths.
fn mufasa(words: &str, paths: &[PathBuf]) -> (Option<i32>, String) {
    let output = Command::new(MUFASA).args(words.split_whitespace()).args(paths).output();
    let output = output.expect("mufasa runs");
    (output.status.code(), text(&output))
}

/// A campaign that has ended.
struct Run {
    code: Option<i32>,
    told: String,
    folder: PathBuf,
}

impl Run {
    fn file(&self, name: &str) -> String {
        fs::read_to_string(self.folder.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    fn summary(&self) -> Summary {
        summary(&self.folder)
    }
}

fn summary(folder: &Path) -> Summary {
    Summary::read(&folder.join("summary.json")).unwrap_or_else(|error| panic!("{error}"))
}

/// Judges a script, the vectors first, in the folder of a test.
fn with_vectors(test: &str, options: &str, script: &str) -> Run {
    judged(&folder(test), options, script)
}

/// The same in a folder that is there.
fn judged(folder: &Path, options: &str, script: &str) -> Run {
    let mut mufasa = Command::new(MUFASA);
    mufasa.arg("conform").args(options.split_whitespace());
    if !options.contains("--shrinking") {
        // On a busy machine there is time enough.
        mufasa.args(["--shrinking", "600"]);
    }
    mufasa.arg("--out").arg(folder).args(["--", "sh", "-c", script]);
    let output = mufasa.output().expect("mufasa runs");
    Run { code: output.status.code(), told: text(&output), folder: folder.to_owned() }
}

/// Generated cases alone: many tests count them, and shell scripts are slow.
fn cases(test: &str, options: &str, script: &str) -> Run {
    with_vectors(test, &format!("{options} --no-vectors"), script)
}

/// Cases alone for a script that is wrong: the exit code must be 1, and the three files must hold what the summary says.
fn wrong(test: &str, options: &str, script: &str) -> (Summary, String) {
    let run = cases(test, options, script);
    assert_eq!(run.code, Some(1), "{}", run.told);
    let (summary, told) = (run.summary(), &run.told);
    let reproducers = run.file("reproducers.jsonl");
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
    let junit = run.file("junit.xml");
    let document = roxmltree::Document::parse(&junit).expect("XML");
    let failures = document.descendants().filter(|node| node.has_tag_name("failure")).count();
    assert_eq!(failures, summary.classes.len());
    (summary, run.told)
}

fn is_of(found: &Found, breach: Breach, place: &str) -> bool {
    found.class.breach == breach && found.class.place == place
}

/// The class of this breach and place.
fn class<'a>((summary, told): &'a (Summary, String), breach: Breach, place: &str) -> &'a Found {
    let found = summary.classes.iter().find(|found| is_of(found, breach, place));
    found.unwrap_or_else(|| panic!("no {breach:?} {place}: {told}"))
}
