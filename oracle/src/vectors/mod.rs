//! Vectors: lines with the answers that they must get, for other implementations
//! (`spec/5-interfaces.md#vectors`).

pub mod base;
pub mod book;
pub mod edge;
pub mod expected;
pub mod flag;
pub mod schema;
pub mod story;

mod hardened;
mod record;
mod stages;

use std::collections::BTreeMap;

use book::{Book, Refused, Vector};

/// All vectors by file, such as `stages/schedule`, or everything that is wrong with them: a vector
/// on which its author and the model differ is refused.
pub fn all() -> Result<BTreeMap<&'static str, Vec<Vector>>, Vec<Refused>> {
    let mut book = Book::default();
    stages::add(&mut book);
    hardened::add(&mut book);
    book.finish()
}

#[cfg(test)]
mod tests {
    #[test]
    fn author_and_model_agree() {
        if let Err(refused) = super::all() {
            for r in &refused {
                println!("{r}");
            }
            panic!("{} refused", refused.len());
        }
    }
}
