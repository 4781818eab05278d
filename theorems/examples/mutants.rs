//! For `theorems/mutants`: lists the theorems with their mutants, or says what is found of one.

use std::io;

use mufasa_theorems::prove::{Verdict, prove};
use mufasa_theorems::theorem;

fn main() -> io::Result<()> {
    let name = std::env::args().nth(1);
    for theorem in theorem::all() {
        let mutant = &theorem.mutant;
        match &name {
            None => {
                print!(
                    "{}\u{1}{}\u{1}{}\u{1}{}\0",
                    theorem.id, mutant.file, mutant.from, mutant.to
                );
            }
            Some(name) if name == theorem.id => match prove(&theorem.claim)?.verdict {
                Verdict::Proved => println!("proved"),
                Verdict::Refuted(_) => println!("refuted"),
                Verdict::Unknown => println!("unknown"),
            },
            Some(_) => {}
        }
    }
    Ok(())
}
