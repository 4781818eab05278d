//! Says what is found of a theorem; for `scripts/mutants`.

use std::io;

use mufasa_theorems::claim::Decision;
use mufasa_theorems::prove::prove_claim;
use mufasa_theorems::theorem;

fn main() -> io::Result<()> {
    let name = std::env::args().nth(1).unwrap_or_default();
    let theorem = theorem::all().find(|theorem| theorem.id == name);
    let theorem = theorem.ok_or_else(|| io::Error::other("nothing has such a name"))?;
    let decision = prove_claim(&theorem.claim)?.decision;
    match decision {
        Decision::Proved => println!("proved"),
        Decision::Refuted(_) => println!("refuted"),
        Decision::Unknown => println!("unknown"),
    }
    Ok(())
}
