//! What is claimed: laws, properties of the exploration, theorems, harnesses; and what each is about:
//! what its text names, and what a change that has to refute it is at.

use std::collections::BTreeSet;

use toml::{Table, Value};

use super::comments::{mentions, names};
use super::ids::{prefix, rule};
use super::lines::{Place, item, lines};
use super::rows::{Cell, Link};
use super::symbols::has_word;
use super::tree::{Tree, sections};

/// A claim.
pub struct Claim {
    /// Law, theorem or harness.
    pub cell: Cell,
    /// Where it is stated.
    pub link: Link,
    /// Headings and rules that it is about.
    pub about: BTreeSet<String>,
    /// Its sentence, and what a change that refutes it is at and says: for symbols.
    pub words: String,
}

/// All claims.
pub fn all(tree: &Tree) -> Vec<Claim> {
    let mut claims = laws(tree);
    claims.extend(properties(tree));
    claims.extend(theorems(tree));
    claims.extend(harnesses(tree));
    for mutant in tables(tree, "proofs/mutants.toml", "mutant") {
        let refuted: Vec<&str> = mutant
            .get("refutes")
            .and_then(Value::as_table)
            .into_iter()
            .flat_map(|engines| engines.values())
            .flat_map(|ids| ids.as_array().into_iter().flatten().filter_map(Value::as_str))
            .collect();
        let places = mutant.get("at").and_then(Value::as_array).into_iter().flatten();
        for place in places.filter_map(Value::as_table) {
            let (about, words) = place_of(tree, place);
            for claim in claims.iter_mut().filter(|claim| is_one_of(claim, &refuted)) {
                claim.about.extend(about.iter().cloned());
                claim.words += &words;
            }
        }
    }
    claims
}

/// An id ends in the name of the claim.
fn is_one_of(claim: &Claim, ids: &[&str]) -> bool {
    ids.iter().any(|id| id.rsplit("::").next() == Some(claim.link.name.as_str()))
}

/// What the function of a change is about: what its comments name, else what its file does. A requirement that
/// the implementation cites is kept at some of its lines, and the change may be at others.
fn place_of(tree: &Tree, place: &Table) -> (BTreeSet<String>, String) {
    let text = |key: &str| place.get(key).and_then(Value::as_str).unwrap_or_default();
    let mut path = text("item").split("::");
    let folder = match path.next() {
        Some("mufasa_model") => "model/src/",
        Some("mufasa") => "impl/src/",
        _ => return Default::default(),
    };
    let path: Vec<&str> = path.collect();
    let function = path.last().copied().unwrap_or_default();
    let mut about = BTreeSet::new();
    for (file, source) in tree.ending(".rs").filter(|(file, _)| file.starts_with(folder)) {
        let here = lines(source).iter().any(|line| item(line.code) == Some(function));
        let owner = path.len() < 2 || source.contains(path[0]) || file.contains(path[0]);
        if here && owner {
            let all = mentions(source);
            let counts = |name: &str| folder == "model/src/" || is_whole(name);
            let own = all.iter().filter(|it| it.at == Place::Item(function) && counts(&it.name));
            let head = all.iter().filter(|it| it.at == Place::Head);
            about.extend(own.chain(head).map(|it| it.name.clone()));
        }
    }
    (about, format!(" {function} {} {}", text("from"), text("to")))
}

/// A heading, or a rule as a whole.
fn is_whole(name: &str) -> bool {
    name.starts_with("spec/") || (prefix(name) == "H" && rule(name) == name)
}

/// A claim of a file; the head of the file is about each of its claims. "Stage i" is its heading.
fn claim(tree: &Tree, cell: Cell, [file, name, text]: [&str; 3]) -> Claim {
    let source = tree.0.get(file).map(String::as_str).unwrap_or_default();
    let head: Vec<&str> = source.lines().take_while(|line| line.starts_with("//!")).collect();
    let all = format!("{} {text}", head.join(" "));
    let mut about: BTreeSet<String> = names(&all).into_iter().collect();
    for section in sections(tree.0.get("spec/3-stages.md").map(String::as_str).unwrap_or_default())
    {
        let stage = section.lines[0].trim_start_matches(['#', ' ']).split(':').next();
        let stage = stage.filter(|words| words.starts_with("Stage ")).unwrap_or("no stage");
        if has_word(&all.to_lowercase(), &stage.to_lowercase()) {
            about.insert(format!("spec/3-stages.md#{}", section.anchor));
        }
    }
    let link = Link { file: file.to_owned(), name: name.to_owned() };
    Claim { cell, link, about, words: format!("{name} {text}") }
}

/// Public functions of `proofs/src/law`, with their comments.
fn laws(tree: &Tree) -> Vec<Claim> {
    let mut found = Vec::new();
    for (file, text) in tree.ending(".rs").filter(|(file, _)| file.starts_with("proofs/src/law/")) {
        let mut doc = String::new();
        for line in text.lines() {
            if let Some(line) = line.strip_prefix("///") {
                doc += line;
            } else if line.starts_with("pub fn ") && line.contains("bool") {
                let name = item(line).unwrap_or_default();
                found.push(claim(tree, Cell::Law, [file, name, &doc]));
            } else if !line.starts_with('#') {
                doc.clear();
            }
        }
    }
    found
}

/// The properties of the exploration, by the names in their list; their requirements stand in a function there.
fn properties(tree: &Tree) -> Vec<Claim> {
    let file = "proofs/exploration/src/properties.rs";
    let Some(text) = tree.0.get(file) else { return Vec::new() };
    let arms = |function: &str| -> Vec<(Vec<&str>, &str)> {
        let Some((_, body)) = text.split_once(&format!("fn {function}(self)")) else {
            return Vec::new();
        };
        let body = body.split("\n    }\n").next().unwrap_or_default();
        let arm = |(at, _): (usize, &str)| {
            let left = body[..at].rsplit(['{', '}', ',']).next()?;
            let right = body[at..].split('"').nth(1)?;
            Some((left.split('|').map(str::trim).collect(), right))
        };
        body.match_indices("=>").filter_map(arm).collect()
    };
    let requirements = arms("requirement");
    let list = text.split_once("    Property {\n").map_or("", |(_, rest)| rest);
    let list = list.split("\n    }\n").next().unwrap_or_default();
    let mut found = Vec::new();
    for (variant, name) in list.lines().filter_map(|line| line.trim().split_once(" = \"")) {
        let name = name.trim_end_matches("\",");
        let of = |of: &&(Vec<&str>, &str)| of.0.contains(&variant) || of.0.contains(&"_");
        if let Some((_, requirement)) = requirements.iter().find(of) {
            found.push(claim(tree, Cell::Law, [file, name, requirement]));
        }
    }
    found
}

/// Theorems: what stands between one `id` and the next; of a closure what is said, without its cycle.
fn theorems(tree: &Tree) -> Vec<Claim> {
    let folder = "proofs/theorems/src/";
    let mut found = Vec::new();
    for (file, text) in tree.ending(".rs").filter(|(file, _)| file.starts_with(folder)) {
        for part in text.split("id: \"").skip(1) {
            let name = part.split('"').next().unwrap_or_default();
            found.push(claim(tree, Cell::Theorem, [file, name, part]));
        }
        for part in text.split("closure!(").skip(1) {
            if let Some(finding) = part.split('"').nth(1).filter(|it| it.starts_with("F-")) {
                let name = format!("the_hardened_profile_rejects_the_family_of_{finding}");
                let said = part.split("|cycle|").next().unwrap_or_default();
                found.push(claim(tree, Cell::Theorem, [file, &name, said]));
            }
        }
    }
    found
}

/// The harnesses that are expected, each a function of its module.
fn harnesses(tree: &Tree) -> Vec<Claim> {
    let mut found = Vec::new();
    for harness in tables(tree, "proofs/expected.toml", "harness") {
        let text = |key: &str| harness.get(key).and_then(Value::as_str).unwrap_or_default();
        let Some((module, name)) = text("id").split_once("::") else { continue };
        let file = format!("proofs/src/harness/{module}.rs");
        found.push(claim(tree, Cell::Harness, [&file, name, text("statement")]));
    }
    found
}

/// The tables of an array in a file.
fn tables(tree: &Tree, file: &str, name: &str) -> Vec<Table> {
    let parsed: Option<Table> = tree.0.get(file).map(|text| text.parse().expect("it is TOML"));
    let array = parsed.as_ref().and_then(|all| all.get(name)).and_then(Value::as_array);
    array.into_iter().flatten().filter_map(Value::as_table).cloned().collect()
}
