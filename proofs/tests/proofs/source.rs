//! The harnesses as they stand in the source.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// One harness.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// Its path below `mufasa_proofs::harness`.
    pub id: String,
    /// The first paragraph of its doc.
    pub statement: String,
    /// The sentence `Domain:` of its doc.
    pub domain: String,
    /// The sentence `Not covered:` of its doc.
    pub not_covered: String,
    /// Whether it has `kani::proof`.
    pub kani: bool,
    /// The text of `kani::unwind`.
    pub unwind: Option<String>,
    /// The text of `kani::solver`.
    pub solver: Option<String>,
}

/// All functions of the name `verify_..`, and the names of the covers of each module.
pub fn written() -> (Vec<Written>, BTreeMap<String, BTreeSet<String>>) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/harness");
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .expect("the harnesses are there")
        .map(|entry| entry.expect("readable").path())
        .collect();
    files.sort();
    let (mut harnesses, mut covers) = (Vec::new(), BTreeMap::new());
    for file in files {
        let module = file.file_stem().and_then(|stem| stem.to_str()).expect("a name").to_owned();
        let text = std::fs::read_to_string(&file).expect("readable");
        let head = text.lines().map_while(|line| line.strip_prefix("//!")).map(str::trim);
        let (_, domain) = domain_of(&head.collect::<Vec<_>>());
        harnesses.extend(functions(&module, &text, &domain));
        let names: BTreeSet<String> = text.split("kani::cover!(").skip(1).map(cover).collect();
        if !names.is_empty() {
            covers.insert(module, names);
        }
    }
    (harnesses, covers)
}

/// `of_all`: domain, and what is not covered, of harnesses that say none.
fn functions(module: &str, text: &str, of_all: &[String; 2]) -> Vec<Written> {
    let (mut found, mut doc, mut attributes) = (Vec::new(), Vec::new(), Vec::new());
    for line in text.lines() {
        if let Some(said) = line.strip_prefix("///") {
            doc.push(said.trim());
        } else if let Some(attribute) = line.strip_prefix("#[cfg_attr(kani, kani::") {
            attributes.push(attribute.strip_suffix(")]").unwrap_or(attribute));
        } else if let Some(rest) = line.strip_prefix("pub fn ") {
            let name = rest.split('(').next().unwrap_or_default();
            if name.starts_with("verify_") {
                found.push(harness(format!("{module}::{name}"), &doc, &attributes, of_all));
            }
            doc.clear();
            attributes.clear();
        } else {
            doc.clear();
            attributes.clear();
        }
    }
    found
}

/// The first paragraph; domain and what is not covered.
fn domain_of(doc: &[&str]) -> (String, [String; 2]) {
    let mut paragraphs = doc.split(|line| line.is_empty()).map(|lines| lines.join(" "));
    let statement = paragraphs.next().unwrap_or_default();
    let rest = paragraphs.collect::<Vec<_>>().join(" ");
    let (domain, not_covered) = rest.split_once(" Not covered: ").unwrap_or((&rest, ""));
    let domain = domain.strip_prefix("Domain: ").unwrap_or_default().to_owned();
    (
        statement,
        [domain, not_covered.split_inclusive(". ").next().unwrap_or_default().trim().to_owned()],
    )
}

fn harness(id: String, doc: &[&str], attributes: &[&str], of_all: &[String; 2]) -> Written {
    let (statement, own) = domain_of(doc);
    let [domain, not_covered] = if own[0].is_empty() { of_all.clone() } else { own };
    let argument = |name: &str| {
        let found = attributes.iter().find_map(|attribute| attribute.strip_prefix(name));
        found.and_then(|rest| rest.strip_suffix(')')).map(str::to_owned)
    };
    Written {
        id,
        statement,
        domain,
        not_covered,
        kani: attributes.contains(&"proof"),
        unwind: argument("unwind("),
        solver: argument("solver("),
    }
}

/// The name of a cover: the last string of its arguments.
fn cover(rest: &str) -> String {
    let call = rest.split(");").next().unwrap_or_default();
    call.rsplit('"').nth(1).expect("a cover has a name").to_owned()
}
