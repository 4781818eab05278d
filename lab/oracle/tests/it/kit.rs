//! The program, and a place for what a test writes.

use std::fs;
use std::panic::Location;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use mufasa_records::cycle_to_line;
use serde_json::Value;

/// A folder of its own for a test of the calling file, empty.
#[track_caller]
pub fn folder(test: &str) -> PathBuf {
    let file = Path::new(Location::caller().file()).file_stem().expect("a name");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(file).join(test);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("the folder can be written");
    folder
}

/// Runs `mufasa` there.
pub fn run(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_mufasa"));
    let command = command.args(arguments).current_dir(folder).stdin(Stdio::null());
    command.output().expect("the program starts")
}

/// How `mufasa` ended, and what it wrote.
pub struct Said {
    pub code: Option<i32>,
    pub out: String,
    pub err: String,
}

/// Runs `mufasa` there; it does not panic.
pub fn said(folder: &Path, arguments: &[&str]) -> Said {
    Said::of(run(folder, arguments))
}

impl Said {
    pub fn of(output: Output) -> Self {
        let [out, err] =
            [output.stdout, output.stderr].map(|it| String::from_utf8(it).expect("UTF-8"));
        assert!(!err.contains("panicked"), "{err}");
        Self { code: output.status.code(), out, err }
    }

    /// The code, and words that each of the outputs has.
    #[track_caller]
    pub fn has(&self, code: i32, out: &str, err: &str) {
        let Self { out: told, err: wrong, .. } = self;
        assert_eq!(self.code, Some(code), "{told}{wrong}");
        assert!(told.contains(out), "{out}: {told}");
        assert!(wrong.contains(err), "{err}: {wrong}");
    }
}

const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../drives/data/readers/");

/// The small drive of the readers' tests.
pub fn small() -> [String; 2] {
    ["small-2018b.xml", "small.KS2.solution.xml"].map(|name| format!("{DATA}{name}"))
}

/// What it says to these arguments.
pub fn mufasa(arguments: &[&str]) -> Said {
    said(Path::new(env!("CARGO_TARGET_TMPDIR")), arguments)
}

/// The same with something on standard input.
pub fn with_input(arguments: &[&str], input: impl Into<Stdio>) -> Said {
    let mut command = Command::new(env!("CARGO_BIN_EXE_mufasa"));
    Said::of(command.args(arguments).stdin(input).output().expect("the program starts"))
}

/// Writes a file; its path.
pub fn write(folder: &Path, name: &str, content: impl AsRef<[u8]>) -> String {
    let file = folder.join(name);
    fs::write(&file, content).expect("it can be written");
    file.to_str().expect("a plain name").to_owned()
}

/// A drive of `count` cycles as JSON Lines; those in `blocked` are unsafe.
pub fn lines(folder: &Path, name: &str, count: u32, blocked: &[u32]) -> String {
    let cycle = |index| crate::common::cycle(index, blocked.contains(&index));
    let line = |index| cycle_to_line(&format!("{name}-{index}"), &cycle(index));
    let text: Vec<_> = (0..count).map(line).collect();
    write(folder, &format!("{name}.jsonl"), text.join("\n"))
}

/// A record that `check` reads.
pub fn first_record() -> Value {
    let vectors = include_str!("../../../../vectors/findings/F-06.jsonl");
    let vector: Value = serde_json::from_str(vectors.lines().next().expect("one")).expect("JSON");
    vector["input"].clone()
}
