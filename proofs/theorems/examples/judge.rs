//! Says what is found of a theorem, bound or range; for `scripts/mutants`.

use std::io;

use mufasa_theorems::prove::{Verdict, prove};
use mufasa_theorems::theorem;
use mufasa_theorems::{doubles, gappa};

fn main() -> io::Result<()> {
    let name = std::env::args().nth(1).unwrap_or_default();
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
