//! For the workflow `kani.yml`: which harnesses a shard runs, and whether what Kani exported is what
//! `expected.toml` asks for.
//!
//! `check-kani shard N` prints arguments for `cargo kani`; `check-kani judge EXPORT.json...` prints
//! what is wrong and ends with 1 if anything is.

use std::process::ExitCode;

#[path = "../tests/proofs/expected.rs"]
mod expected;
#[path = "../tests/proofs/export.rs"]
mod export;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
        ["shard", number] => shard(number),
        ["judge", files @ ..] if !files.is_empty() => judge(files),
        _ => {
            eprintln!("usage: check-kani shard N | check-kani judge EXPORT.json...");
            ExitCode::from(2)
        }
    }
}

fn shard(number: &str) -> ExitCode {
    let chosen = expected::expected()
        .into_iter()
        .filter(|one| one.shard.is_some_and(|shard| shard.to_string() == number));
    let arguments: Vec<String> = chosen.map(|one| format!("--harness {}", one.id)).collect();
    if arguments.is_empty() {
        eprintln!("no harness is in shard {number}");
        return ExitCode::from(2);
    }
    println!("{}", arguments.join(" "));
    ExitCode::SUCCESS
}

fn judge(files: &[&str]) -> ExitCode {
    let mut exports = Vec::new();
    for file in files {
        let read = std::fs::read_to_string(file).map_err(|error| error.to_string());
        match read.and_then(|text| serde_json::from_str(&text).map_err(|error| error.to_string())) {
            Ok(export) => exports.push(export),
            Err(error) => {
                eprintln!("{file}: {error}");
                return ExitCode::from(2);
            }
        }
    }
    let expected = expected::expected().into_iter().filter(|one| one.shard.is_some());
    let expected: Vec<_> = expected.collect();
    let problems = export::problems(&expected, &exports);
    for problem in &problems {
        println!("{problem}");
    }
    println!("{} harnesses, {} problems", expected.len(), problems.len());
    if problems.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
