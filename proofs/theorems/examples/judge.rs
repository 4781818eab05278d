//! Says what is found of a theorem, bound or range; for `scripts/mutants`.

use std::io;

use mufasa_theorems::claim::Decision;
use mufasa_theorems::prove::prove_claim;
use mufasa_theorems::{doubles, gappa, theorem};

fn main() -> io::Result<()> {
    let name = std::env::args().nth(1).unwrap_or_default();
    let theorem = theorem::all().find(|theorem| theorem.id == name);
    let bound = gappa::BOUNDS.iter().find(|bound| bound.id == name);
    let range = doubles::RANGES.iter().find(|range| range.id == name);
    let decision = match (theorem, bound, range) {
        (Some(theorem), ..) => prove_claim(&theorem.claim)?.decision,
        (None, Some(bound), _) => bound.judge()?.0,
        (None, None, Some(range)) => range.judge()?.claim,
        (None, None, None) => return Err(io::Error::other("nothing has such a name")),
    };
    match decision {
        Decision::Proved => println!("proved"),
        Decision::Refuted(_) => println!("refuted"),
        Decision::Unknown => println!("unknown"),
    }
    Ok(())
}
