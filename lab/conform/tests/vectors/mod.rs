//! The vectors of `vectors/`: `spec/5-interfaces.md#vectors`.

mod norm;
mod published;
mod schemas;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use mufasa_conform::vectors::book::Vector;
use mufasa_records::{self as json, Answer, Record};

/// The folder that is published.
fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../vectors")
}

/// All vectors by file, made anew.
static FILES: LazyLock<BTreeMap<&str, Vec<Vector>>> =
    LazyLock::new(|| mufasa_conform::vectors::all().expect("author and model agree"));

/// All of them.
fn all() -> impl Iterator<Item = &'static Vector> {
    FILES.values().flatten()
}

/// The record of a vector; `None` when its line is to be refused by the reader.
fn record(vector: &Vector) -> Option<Record> {
    let record = json::parse(vector.input.text().as_bytes(), 1).ok();
    let is_refused = matches!(vector.expect, Answer::Error(_));
    assert!(record.is_some() || is_refused, "{} cannot be read", vector.id);
    record
}

/// The files of the published folder with an ending, with their names relative to it.
fn published(ending: &str) -> Vec<(String, String)> {
    let mut found = Vec::new();
    let mut open = vec![folder()];
    while let Some(at) = open.pop() {
        for entry in fs::read_dir(at).expect("the folder is published") {
            let path = entry.expect("a directory entry").path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|it| it == ending) {
                let name = path.strip_prefix(folder()).expect("below the folder");
                let name = name.to_string_lossy().replace('\\', "/");
                found.push((name, fs::read_to_string(&path).expect("text")));
            }
        }
    }
    found.sort();
    found
}
