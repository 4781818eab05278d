//! Instructions of cycles, counted by valgrind: one process for many cycles.

use std::env;
use std::fs;
use std::hint::black_box;
use std::path::Path;
use std::process::{Command, Stdio};

use mufasa::report::Stage;
use mufasa_benches::contestant::Contestant;
use mufasa_model::input::domain::first_problem;
use mufasa_props::bridge;
use mufasa_records::{Record, files};

use crate::ended::{Stopped, cannot, said};

/// What is counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum What {
    /// A cycle as a vehicle asks for it, with what is kept between cycles.
    Cycle,
    /// One stage alone.
    Stage(Stage),
}

impl What {
    pub const ALL: [Self; 6] = [
        Self::Stage(Stage::I),
        Self::Stage(Stage::Ii),
        Self::Stage(Stage::Iii),
        Self::Stage(Stage::Iv),
        Self::Stage(Stage::V),
        Self::Cycle,
    ];

    pub fn name(self) -> &'static str {
        match self {
            Self::Cycle => "cycle",
            Self::Stage(stage) => ["i", "ii", "iii", "iv", "v"][stage as usize],
        }
    }
}

/// Of each record, in their order; few for invalid input. Errors: valgrind is missing or fails.
pub fn instructions(records: &[String], what: What, folder: &Path) -> Result<Vec<u64>, Stopped> {
    let (input, counts) = (folder.join("round.jsonl"), folder.join("counts"));
    files::write(&input, &records.join("\n")).map_err(cannot(&input, "written"))?;
    let program = env::current_exe().map_err(said)?;
    // The count of each call is a file of its own, `counts.1` and so on.
    let done = Command::new("valgrind")
        .arg("--tool=callgrind")
        .args(["toggle-collect", "dump-after"].map(|option| format!("--{option}={MEASURED}")))
        .arg(format!("--callgrind-out-file={}", counts.display()))
        .arg(program)
        .args(["slow", "--of", what.name(), "--measure"])
        .arg(&input)
        .stdout(Stdio::null())
        .output()
        .map_err(|error| format!("valgrind is needed (package valgrind): {error}"))?;
    if !done.status.success() {
        return Err(Stopped::Refused(String::from_utf8_lossy(&done.stderr).into_owned()));
    }
    (1..=records.len()).map(|call| read(&counts.with_extension(call.to_string()))).collect()
}

fn read(file: &Path) -> Result<u64, Stopped> {
    let text = fs::read_to_string(file).map_err(cannot(file, "read"))?;
    let total = text.lines().find_map(|line| line.strip_prefix("totals: ")?.trim().parse().ok());
    fs::remove_file(file).map_err(cannot(file, "removed"))?;
    total.ok_or_else(|| Stopped::Refused(format!("{}: has no line `totals`", file.display())))
}

/// Runs each cycle of a file once, in [`measured`].
pub fn run_each(file: &Path, what: What) -> Result<(), Stopped> {
    let text = fs::read_to_string(file).map_err(cannot(file, "read"))?;
    for (line, number) in text.lines().zip(1..) {
        let record = mufasa_records::parse(line.as_bytes(), number).map_err(said)?;
        let Record::Cycle { cycle, .. } = record else {
            return Err(Stopped::Refused(format!("{}:{number}: is no cycle", file.display())));
        };
        if first_problem(&cycle).is_some() {
            measured(&mut || false);
            continue;
        }
        let owned = bridge::to_impl(&cycle);
        let history = owned.history();
        let borrowed = owned.borrow(&history);
        let mut it = Contestant::new(&borrowed);
        match what {
            What::Cycle => measured(&mut || it.check().failed_stage.is_none()),
            What::Stage(stage) => measured(&mut || it.stage(stage)),
        };
    }
    Ok(())
}

/// The name of the function below.
const MEASURED: &str = concat!(module_path!(), "::measured");

/// What is counted.
#[inline(never)]
fn measured(run: &mut dyn FnMut() -> bool) -> bool {
    black_box(run())
}
