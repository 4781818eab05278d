//! Proves the theorems named on the command line, or all, and refutes their wrong variants.

use std::process::ExitCode;

use mufasa_theorems::prove::{Verdict, prove};
use mufasa_theorems::theorem;

fn main() -> ExitCode {
    let names: Vec<String> = std::env::args().skip(1).collect();
    let mut fails = false;
    for theorem in theorem::all() {
        if !names.is_empty() && !names.iter().any(|name| theorem.id.contains(name.as_str())) {
            continue;
        }
        for (what, claim) in [("", theorem.claim), ("wrong: ", theorem.wrong.claim)] {
            match prove(&claim) {
                Ok(proof) => {
                    let expected = matches!(
                        (what, &proof.verdict),
                        ("", Verdict::Proved) | ("wrong: ", Verdict::Refuted(_))
                    );
                    fails |= !expected;
                    println!(
                        "{} {what}{} {:?} {} paths {} questions {:.2?}",
                        if expected { "ok " } else { "BAD" },
                        theorem.id,
                        proof.verdict,
                        proof.paths,
                        proof.questions,
                        proof.time
                    );
                }
                Err(error) => {
                    println!("{}: {error}", theorem.id);
                    return ExitCode::from(2);
                }
            }
        }
    }
    ExitCode::from(u8::from(fails))
}
