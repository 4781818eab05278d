//! Applies a mutant to a checkout: `mutants CHECKOUT CHANGE`; for `scripts/mutants`.

use std::error::Error;
use std::path::Path;

use mufasa_mutants::place;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [checkout, change] = arguments.as_slice() else {
        return Err("usage: mutants CHECKOUT CHANGE".into());
    };
    let mutants = mufasa_mutants::all()?;
    let mutant = mutants.iter().find(|mutant| mutant.change == *change);
    place::apply(mutant.ok_or("no mutant has this change")?, Path::new(checkout))?;
    Ok(())
}
