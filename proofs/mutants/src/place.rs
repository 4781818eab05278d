//! Finds the place of a mutant by the path of its item, in whichever file of the crate that stands.

use std::fs;
use std::io;
use std::ops::Range;
use std::path::{Path, PathBuf};

use syn::spanned::Spanned;
use syn::{ImplItem, Item, TraitItem, Type};

use crate::{Mutant, Place};

/// Crates and their folders.
const CRATES: [(&str, &str); 3] = [
    ("mufasa", "impl/src"),
    ("mufasa_model", "model/src"),
    ("mufasa_theorems", "proofs/theorems/src"),
];

/// The sources of all crates that mutants change.
#[derive(Debug)]
pub struct Sources {
    files: Vec<Source>,
}

#[derive(Debug)]
struct Source {
    path: PathBuf,
    text: String,
    /// Paths, from the crate on, with the bytes that they take.
    items: Vec<(Vec<String>, Range<usize>)>,
}

/// Bytes of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Span<'a> {
    /// The file.
    pub file: &'a Path,
    /// The bytes that `from` takes.
    pub bytes: Range<usize>,
}

impl Span<'_> {
    /// Whether a byte is in both.
    pub fn overlaps(&self, other: &Span<'_>) -> bool {
        let Range { start, end } = &self.bytes;
        self.file == other.file && *start < other.bytes.end && other.bytes.start < *end
    }
}

impl Sources {
    /// Reads a checkout. Errors: a file cannot be read or is no Rust.
    pub fn read(checkout: &Path) -> io::Result<Self> {
        let mut files = Vec::new();
        for (name, folder) in CRATES {
            read_folder(&checkout.join(folder), &[name.to_owned()], &mut files)?;
        }
        Ok(Self { files })
    }

    /// Where `from` stands. Errors say what is missing or ambiguous.
    pub fn find(&self, place: &Place) -> Result<Span<'_>, String> {
        let Place { item, from, .. } = place;
        let wanted: Vec<&str> = item.split("::").collect();
        let items = self.files.iter().flat_map(|file| {
            let those = file.items.iter().filter(|(path, _)| is_named(path, &wanted));
            those.map(move |(_, bytes)| (file, bytes))
        });
        let items: Vec<_> = items.collect();
        let [(file, bytes)] = items.as_slice() else {
            let files: Vec<_> = items.iter().map(|(file, _)| file.path.display()).collect();
            return Err(format!("{} items are called {item}: {files:?}", items.len()));
        };
        let places = occurrences(&file.text[(*bytes).clone()], from);
        let [place] = places.as_slice() else {
            return Err(format!("{item}: {from:?} stands there {} times", places.len()));
        };
        let bytes = bytes.start + place.start..bytes.start + place.end;
        Ok(Span { file: &file.path, bytes })
    }
}

/// Applies a mutant to a checkout. Errors: a file cannot be read or written, or a place is not there.
pub fn apply(mutant: &Mutant, checkout: &Path) -> io::Result<()> {
    for place in &mutant.at {
        let sources = Sources::read(checkout)?;
        let Span { file, bytes } = sources.find(place).map_err(io::Error::other)?;
        let mut text = fs::read_to_string(file)?;
        text.replace_range(bytes, &place.to);
        fs::write(file, text)?;
    }
    Ok(())
}

/// The path begins with the same crate and ends with the other names.
fn is_named(path: &[String], wanted: &[&str]) -> bool {
    let ([crate_name, path @ ..], [wanted_crate, wanted @ ..]) = (path, wanted) else {
        return false;
    };
    let end = path.len().checked_sub(wanted.len()).and_then(|start| path.get(start..));
    crate_name == wanted_crate && end.is_some_and(|end| end == wanted)
}

/// Where the text stands, whatever the white space within it.
fn occurrences(text: &str, wanted: &str) -> Vec<Range<usize>> {
    let (text, wanted) = (dense(text), dense(wanted));
    let window = wanted.len().max(1);
    let hits = text
        .windows(window)
        .filter(|part| part.iter().map(|it| it.1).eq(wanted.iter().map(|it| it.1)));
    hits.map(|part| part[0].0..part[window - 1].0 + part[window - 1].1.len_utf8()).collect()
}

/// The characters that count, with their places.
fn dense(text: &str) -> Vec<(usize, char)> {
    let mut dense: Vec<(usize, char)> = Vec::new();
    for (place, character) in text.char_indices().filter(|it| !it.1.is_whitespace()) {
        if matches!(character, ')' | ']' | '}') && dense.last().is_some_and(|it| it.1 == ',') {
            dense.pop();
        }
        dense.push((place, character));
    }
    dense
}

/// Everything in a folder: files and folders are modules.
fn read_folder(folder: &Path, path: &[String], files: &mut Vec<Source>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let file = entry?.path();
        let stem = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let below = match stem.as_str() {
            "lib" | "main" | "mod" => path.to_vec(),
            _ => [path, &[stem]].concat(),
        };
        if file.is_dir() {
            read_folder(&file, &below, files)?;
        } else if file.extension().is_some_and(|ending| ending == "rs") {
            let text = fs::read_to_string(&file)?;
            let parsed = syn::parse_file(&text)
                .map_err(|error| io::Error::other(format!("{}: {error}", file.display())))?;
            let mut items = Vec::new();
            collect(&parsed.items, &below, &mut items);
            files.push(Source { path: file, text, items });
        }
    }
    Ok(())
}

fn collect(list: &[Item], path: &[String], items: &mut Vec<(Vec<String>, Range<usize>)>) {
    let below = |names: &[&str]| -> Vec<String> {
        path.iter().cloned().chain(names.iter().map(|&name| name.to_owned())).collect()
    };
    for item in list {
        let named = match item {
            Item::Fn(it) => Some(&it.sig.ident),
            Item::Const(it) => Some(&it.ident),
            Item::Static(it) => Some(&it.ident),
            Item::Struct(it) => Some(&it.ident),
            Item::Enum(it) => Some(&it.ident),
            Item::Macro(it) => it.ident.as_ref(),
            _ => None,
        };
        items.extend(named.map(|name| (below(&[&name.to_string()]), item.span().byte_range())));
        match item {
            Item::Mod(it) => {
                if let Some((_, list)) = it.content.as_ref().filter(|_| it.ident != "tests") {
                    collect(list, &below(&[&it.ident.to_string()]), items);
                }
            }
            Item::Trait(it) => {
                let functions = it.items.iter().filter_map(|item| match item {
                    TraitItem::Fn(function) => Some((&function.sig.ident, function.span())),
                    _ => None,
                });
                for (name, span) in functions {
                    let path = below(&[&it.ident.to_string(), &name.to_string()]);
                    items.push((path, span.byte_range()));
                }
            }
            Item::Impl(it) => {
                let of = match &*it.self_ty {
                    Type::Reference(reference) => &reference.elem,
                    of => of,
                };
                let Type::Path(of) = of else { continue };
                let Some(of) = of.path.segments.last() else { continue };
                for item in &it.items {
                    let (name, span) = match item {
                        ImplItem::Fn(function) => (&function.sig.ident, function.span()),
                        ImplItem::Const(constant) => (&constant.ident, constant.span()),
                        _ => continue,
                    };
                    let path = below(&[&of.ident.to_string(), &name.to_string()]);
                    items.push((path, span.byte_range()));
                }
            }
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_space_and_trailing_commas_do_not_count() {
        let text = "call(\n    a,\n    b + c,\n);\ncall(a, b)";
        assert_eq!(occurrences(text, "call(a, b + c)").first(), Some(&(0..25)));
        assert_eq!(occurrences(text, "call(").len(), 2);
        assert_eq!(occurrences(text, "call(a, b)").len(), 1);
        assert!(occurrences(text, "call(b").is_empty());
    }

    #[test]
    fn an_item_is_named_by_crate_and_end_of_its_path() {
        let path = ["mufasa", "stages", "distances", "s_b"].map(str::to_owned);
        assert!(is_named(&path, &["mufasa", "s_b"]));
        assert!(is_named(&path, &["mufasa", "stages", "distances", "s_b"]));
        assert!(!is_named(&path, &["mufasa", "stages", "s_b"]));
        assert!(!is_named(&path, &["mufasa_model", "s_b"]));
    }
}
