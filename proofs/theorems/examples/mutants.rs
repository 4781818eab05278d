//! For `proofs/mutants/theorems`: lists theorems, bounds and ranges with their mutants, or says what is found of one.

use std::io;

use mufasa_theorems::prove::{Verdict, prove};
use mufasa_theorems::theorem::{self, Mutant};
use mufasa_theorems::{doubles, gappa};

fn main() -> io::Result<()> {
    let Some(name) = std::env::args().nth(1) else {
        theorem::all().for_each(|theorem| list(theorem.id, &theorem.mutant));
        gappa::BOUNDS.iter().for_each(|bound| list(bound.id, &bound.mutant));
        doubles::RANGES.iter().for_each(|range| list(range.id, &range.mutant));
        return Ok(());
    };
    let theorem = theorem::all().find(|theorem| theorem.id == name);
    let bound = gappa::BOUNDS.iter().find(|bound| bound.id == name);
    let range = doubles::RANGES.iter().find(|range| range.id == name);
    let verdict = match (theorem, bound, range) {
        (Some(theorem), ..) => prove(&theorem.claim)?.verdict,
        (None, Some(bound), _) => bound.judge()?.0,
        (None, None, Some(range)) => range.judge()?.claim,
        (None, None, None) => return Err(io::Error::other("nothing has such a name")),
    };
    match verdict {
        Verdict::Proved => println!("proved"),
        Verdict::Refuted(_) => println!("refuted"),
        Verdict::Unknown => println!("unknown"),
    }
    Ok(())
}

fn list(id: &str, Mutant { file, from, to }: &Mutant) {
    print!("{id}\u{1}{file}\u{1}{from}\u{1}{to}\0");
}
