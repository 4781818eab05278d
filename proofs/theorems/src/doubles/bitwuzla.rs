//! bitwuzla as a process: the library of the Python package, which reads SMT-LIB.

use std::io;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use crate::claim::Decision;
use crate::process;

/// Longest time for a question.
const LIMIT: Duration = Duration::from_mins(2);
/// Where `.ci/run` puts the package, from the root of the project.
const PACKAGES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../target/bitwuzla");
const VERSION: &str = "import bitwuzla; print(bitwuzla.version())";
const ASK: &str = "import bitwuzla, sys
options = bitwuzla.Options()
options.set(bitwuzla.Option.PRODUCE_MODELS, True)
bitwuzla.Parser(bitwuzla.TermManager(), options).parse(sys.stdin.read(), parse_file=False)";

/// The version of bitwuzla, or nothing where there is none.
pub fn version() -> Option<String> {
    let output = python(VERSION).stderr(Stdio::null()).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| text.trim().to_owned())
}

/// Proved when there is no counterexample. Errors are those of running it.
pub(super) fn ask(question: &str) -> io::Result<Decision> {
    let Some(output) = process::run(&mut python(ASK), question, LIMIT)? else {
        return Ok(Decision::Unknown);
    };
    let text = String::from_utf8_lossy(&output.stdout);
    let mut lines = text.lines();
    // Without a counterexample it has no values to give, and ends with an error.
    match (lines.next(), output.status.success()) {
        (Some("unsat"), _) => Ok(Decision::Proved),
        (Some("sat"), true) => Ok(Decision::Refuted(lines.filter_map(value).collect())),
        (Some("unknown"), _) => Ok(Decision::Unknown),
        (other, _) => Err(io::Error::other(format!("bitwuzla says: {other:?}"))),
    }
}

fn python(code: &str) -> Command {
    let mut command = Command::new("python3");
    command.args(["-c", code]);
    if Path::new(PACKAGES).exists() {
        command.env("PYTHONPATH", PACKAGES);
    }
    command
}

/// Name and value of `((v_now (fp #b0 #b01111111111 #b00...)))`.
fn value(line: &str) -> Option<(String, f64)> {
    let (name, bits) = line.trim_matches(['(', ')']).split_once(" (fp ")?;
    let bits: String = bits.chars().filter(|digit| ['0', '1'].contains(digit)).collect();
    Some((name.to_owned(), f64::from_bits(u64::from_str_radix(&bits, 2).ok()?)))
}
