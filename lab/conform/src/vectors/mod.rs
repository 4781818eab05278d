//! Vectors: lines with the answers that they must get, for other implementations
//! (`spec/5-interfaces.md#vectors`).

pub mod book;
pub mod flag;

mod authored;
mod expected;
mod random;
mod sequences;

use std::collections::BTreeMap;
use std::io;
use std::path::Path;

use book::{Book, Refused, Vector};

/// What people of other languages read first.
const README: &str = include_str!("readme.md");

/// All vectors by file, such as `stages/schedule`, or everything that is wrong with them: a vector
/// on which its author and the model differ is refused.
pub fn all() -> Result<BTreeMap<&'static str, Vec<Vector>>, Vec<Refused>> {
    let mut book = Book::default();
    authored::add(&mut book);
    random::add(&mut book);
    book.finish()
}

/// Every file with its content: these vectors, schemas, and a README.
pub fn contents(files: &BTreeMap<&'static str, Vec<Vector>>) -> BTreeMap<String, String> {
    let mut contents = BTreeMap::from([(String::from("README.md"), README.to_owned())]);
    for (file, vectors) in files {
        let lines: String = vectors.iter().map(|vector| vector.to_string() + "\n").collect();
        contents.insert(format!("{file}.jsonl"), lines);
    }
    for (name, schema) in mufasa_records::schema::all() {
        contents
            .insert(format!("schemas/{name}.schema.json"), mufasa_records::schema::text(&schema));
    }
    contents
}

/// Writes the files into a folder; other files there stay.
pub fn write(folder: &Path, contents: &BTreeMap<String, String>) -> io::Result<()> {
    for (name, content) in contents {
        let file = folder.join(name);
        if let Some(parent) = file.parent() {
            std::fs::create_dir_all(parent)?;
        }
        mufasa_records::files::write(&file, content)?;
    }
    Ok(())
}
