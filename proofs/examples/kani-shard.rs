//! For the workflow `kani.yml`: `kani-shard N` prints the arguments for `cargo kani` of a shard of `expected.toml`.

use std::process::ExitCode;

#[path = "../tests/proofs/expected.rs"]
mod expected;

fn main() -> ExitCode {
    let number = std::env::args().nth(1).unwrap_or_default();
    let chosen = expected::expected()
        .into_iter()
        .filter(|one| one.shard.is_some_and(|shard| shard.to_string() == number));
    let arguments: Vec<String> = chosen.map(|one| format!("--harness {}", one.id)).collect();
    if arguments.is_empty() {
        eprintln!("no harness is in shard {number:?}");
        return ExitCode::from(2);
    }
    println!("{}", arguments.join(" "));
    ExitCode::SUCCESS
}
