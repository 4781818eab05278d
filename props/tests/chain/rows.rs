//! The rows of the chain and what stands in their cells.

use std::collections::{BTreeMap, BTreeSet};

use super::claims::{self, Claim};
use super::comments::{Mention, mentions, names};
use super::ids::{Requirement, prefix, prefixes, requirements, rule};
use super::lines::{Place, item};
use super::symbols;
use super::tree::{Tree, sections};

/// The links of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Cell {
    /// Normative text.
    Spec,
    /// The model.
    Model,
    /// The implementation.
    Impl,
    /// Laws, and properties of the exploration.
    Law,
    /// Theorems over the reals.
    Theorem,
    /// Proof harnesses.
    Harness,
    /// Tests.
    Test,
    /// Vectors.
    Vector,
    /// Benches.
    Bench,
    /// Any of law, theorem and harness: of these one has to be there.
    Proof,
}

/// Tests that read the names of all rows.
pub const BOOKS: [&str; 4] =
    ["props/tests/chain", "props/tests/requirements", "props/tests/tidy", "props/tests/tree"];

/// A place in a file.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Link {
    /// From the root; with an anchor in Markdown.
    pub file: String,
    /// A function or the like; none: the file.
    pub name: String,
}

/// A row.
pub struct Row {
    /// `spec/3-stages.md#distances`, `H-04`, `I-02`, or a symbol.
    pub name: String,
    /// What it is called.
    pub title: String,
    /// Where the paper has it.
    pub paper: String,
    /// Ids of the requirements under a heading or of a rule.
    pub ids: BTreeSet<String>,
    /// Interpretations that the lines of a heading name.
    pub readings: BTreeSet<String>,
    /// What the rows of those headings have.
    pub elsewhere: BTreeSet<Cell>,
    /// What stands where.
    pub cells: BTreeMap<Cell, BTreeSet<Link>>,
}

impl Row {
    /// A row that leads to the spec alone.
    pub fn new(name: &str, title: &str, paper: &str, spec: &str) -> Self {
        let mut row = Self {
            name: name.to_owned(),
            title: title.to_owned(),
            paper: paper.to_owned(),
            ids: BTreeSet::new(),
            readings: BTreeSet::new(),
            elsewhere: BTreeSet::new(),
            cells: BTreeMap::new(),
        };
        row.add(Cell::Spec, spec, "");
        row
    }

    /// Whether a name is the row's, of a heading of its file, or of a requirement of it.
    pub fn is_named(&self, name: &str) -> bool {
        let file = name.split('#').next().unwrap_or_default();
        self.name == name || self.name == file || self.ids.contains(name)
    }

    /// Neither a heading nor a rule.
    pub fn is_symbol(&self) -> bool {
        !self.name.starts_with("spec/") && !is_of_rule(&self.name)
    }

    /// Adds a link.
    pub fn add(&mut self, cell: Cell, file: &str, name: &str) {
        let link = Link { file: file.to_owned(), name: name.to_owned() };
        self.cells.entry(cell).or_default().insert(link);
    }
}

/// All rows: headings in the order of the spec, rules, interpretations, symbols.
pub fn all(tree: &Tree) -> Vec<Row> {
    let claims = claims::all(tree);
    let sources: Vec<Source> = tree
        .ending(".rs")
        .map(|(file, text)| Source { file, text, mentions: mentions(text) })
        .collect();
    let mut rows = headings_and_rules(tree);
    for row in &mut rows {
        add_code(&sources, row);
        add_claims(&claims, row);
        add_tests(&sources, row);
        add_vectors(tree, row);
        add_benches(tree, row);
    }
    as_their_headings(&mut rows);
    let mut symbols = symbols::all(tree, &claims, &rows);
    for row in symbols.iter_mut().filter(|row| !row.ids.is_empty()) {
        add_code(&sources, row);
        add_tests(&sources, row);
        add_benches(tree, row);
    }
    rows.extend(symbols);
    rows
}

/// A file of Rust and what its comments name.
struct Source<'a> {
    file: &'a str,
    text: &'a str,
    mentions: Vec<Mention<'a>>,
}

impl Source<'_> {
    /// Where it names a row.
    fn places(&self, row: &Row) -> Vec<Place<'_>> {
        let of_row = self.mentions.iter().filter(|it| row.is_named(&it.name));
        of_row.map(|it| it.at).collect()
    }
}

/// A row for each prefix of `spec/README.md`; of rules and interpretations one for each.
fn headings_and_rules(tree: &Tree) -> Vec<Row> {
    let (asked, _) = requirements(tree);
    let mut rows: Vec<Row> = Vec::new();
    for (name, target) in prefixes(tree).into_iter().filter(|(name, _)| !is_of_rule(name)) {
        let (file, anchor) = target.split_once('#').unwrap_or((&target, ""));
        let text = tree.0.get(file).map(String::as_str).unwrap_or_default();
        let here = sections(text).into_iter().filter(|it| anchor.is_empty() || it.anchor == anchor);
        let lines: Vec<&str> = here.flat_map(|it| it.lines).collect();
        let heading = lines.first().unwrap_or(&"").trim_start_matches(['#', ' ']);
        let paper =
            lines.iter().find(|line| line.starts_with("Paper ") || line.starts_with("Not in "));
        let number = file.trim_start_matches("spec/").split('-').next().unwrap_or_default();
        let title =
            if anchor.is_empty() { heading.to_owned() } else { format!("{number} {heading}") };
        let mut row = Row::new(&target, &title, paper.unwrap_or(&""), &target);
        row.ids =
            asked.iter().filter(|it| prefix(&it.id) == name).map(|it| it.id.clone()).collect();
        row.readings.extend(lines.iter().flat_map(|line| names(line)));
        rows.push(row);
    }
    let mut rules: BTreeMap<&str, Row> = BTreeMap::new();
    for Requirement { id, place, text } in asked.iter().filter(|it| is_of_rule(&it.id)) {
        let page = place.split('#').next().unwrap_or_default();
        let (place, words) = match tree.0.get(page).filter(|_| page.starts_with("spec/hardened/")) {
            Some(text) => (page, called(text)),
            None => (place.as_str(), text.split(" | ").next().unwrap_or_default()),
        };
        let words: String = words.chars().take(100).collect();
        let row =
            rules.entry(rule(id)).or_insert_with(|| Row::new(rule(id), rule(id), &words, place));
        row.ids.insert(id.clone());
    }
    rows.extend(rules.into_values());
    rows
}

/// What a rule is called: behind the colon of the heading of its page.
fn called(text: &str) -> &str {
    let title = text.lines().next().unwrap_or_default();
    title.split_once(": ").map_or(title, |(_, words)| words)
}

/// A rule H-nn or an interpretation I-nn has a row of its own.
fn is_of_rule(id: &str) -> bool {
    ["H", "I"].contains(&prefix(id))
}

/// An interpretation says how a requirement is read: for what it has no link of its own it leads to the
/// row of that requirement.
fn as_their_headings(rows: &mut [Row]) {
    let (headings, rules): (Vec<&mut Row>, Vec<_>) =
        rows.iter_mut().partition(|row| row.name.starts_with("spec/"));
    for row in rules.into_iter().filter(|row| row.name.starts_with("I-")) {
        let name = row.name.clone();
        for heading in headings.iter().filter(|heading| heading.readings.contains(&name)) {
            row.add(Cell::Spec, &heading.name, "");
            row.elsewhere.extend(heading.cells.keys().copied());
        }
    }
}

/// Whether a file is a test, or sources that only tests build.
pub fn is_test(file: &str) -> bool {
    file.contains("/tests/") || file.ends_with("/tests.rs")
}

/// Files of model and implementation that name the row in a comment or, of a rule, in their own name.
fn add_code(sources: &[Source], row: &mut Row) {
    let short = row.name.to_lowercase().replace('-', "");
    for (cell, folder) in [(Cell::Model, "model/src/"), (Cell::Impl, "impl/src/")] {
        let files = sources.iter().filter(|it| it.file.starts_with(folder) && !is_test(it.file));
        for source in files {
            let places = source.places(row);
            let is_of_rule = row.name.len() == 4 && source.file.contains(&short);
            if is_of_rule || places.contains(&Place::Head) {
                let visible =
                    |line: &&str| line.trim_start().starts_with("pub") && line.contains("fn ");
                let mut functions = source
                    .text
                    .lines()
                    .filter(visible)
                    .map(str::trim_start)
                    .filter_map(item)
                    .peekable();
                if functions.peek().is_none() {
                    row.add(cell, source.file, "");
                }
                functions.for_each(|function| row.add(cell, source.file, function));
            }
            for place in places {
                if let Place::Item(name) = place
                    && !is_test_function(source.text, name)
                {
                    row.add(cell, source.file, name);
                }
            }
        }
    }
}

fn add_claims(claims: &[Claim], row: &mut Row) {
    for claim in claims {
        if claim.about.iter().any(|it| row.is_named(it)) {
            row.cells.entry(claim.cell).or_default().insert(claim.link.clone());
        }
    }
}

/// Tests that name the row, and files of tests that do.
fn add_tests(sources: &[Source], row: &mut Row) {
    for source in sources {
        let has_tests = source.text.contains("#[test]") || source.text.contains("proptest!");
        let is_own = BOOKS.iter().any(|it| source.file.starts_with(it));
        for place in source.places(row).into_iter().filter(|_| has_tests && !is_own) {
            match place {
                Place::Item(name) if is_test_function(source.text, name) => {
                    row.add(Cell::Test, source.file, name);
                }
                _ if is_test(source.file) => row.add(Cell::Test, source.file, ""),
                _ => {}
            }
        }
    }
}

fn is_test_function(text: &str, name: &str) -> bool {
    let signature = format!("fn {name}(");
    let at = text.find(&signature).map(|at| &text[..at]);
    at.is_some_and(|before| {
        let attributes = before.lines().rev().skip(1).take_while(|line| {
            let line = line.trim_start();
            line.starts_with("#[") || line.starts_with("//")
        });
        attributes.into_iter().any(|line| line.contains("#[test]")) || text.contains("proptest!")
    })
}

/// Vectors of the requirement, and those that depend on the interpretation.
fn add_vectors(tree: &Tree, row: &mut Row) {
    for (file, text) in tree.ending(".jsonl").filter(|(file, _)| file.starts_with("vectors/")) {
        let flag = format!("\"flag\": \"interpretation {}\"", row.name);
        let is_it = |line: &str| {
            let of =
                line.split_once("\"requirement\": \"").and_then(|(_, it)| it.split('"').next());
            of.is_some_and(|of| row.is_named(of)) || line.contains(&flag)
        };
        if text.lines().any(is_it) {
            row.add(Cell::Vector, file, "");
        }
    }
}

/// The benches of the folders in which the row's implementation is.
pub fn add_benches(tree: &Tree, row: &mut Row) {
    let file = "benches/benches/stages.rs";
    if !tree.0.contains_key(file) {
        return;
    }
    let links = row.cells.get(&Cell::Impl).into_iter().flatten();
    let groups: BTreeSet<String> = links.filter_map(|link| bench(&link.file)).collect();
    groups.iter().for_each(|group| row.add(Cell::Bench, file, group));
}

/// That of a stage for its own folder, of the requester for its; else the whole cycle.
fn bench(file: &str) -> Option<String> {
    let mut parts = file.strip_prefix("impl/src/")?.split('/');
    let (folder, module) = (parts.next()?, parts.next().unwrap_or_default());
    let number = module.split('_').next().unwrap_or_default();
    Some(match folder {
        "stages" if ["i", "ii", "iii", "iv", "v"].contains(&number) => format!("stage {number}"),
        "offloading" => "requester step".to_owned(),
        _ => "whole cycle".to_owned(),
    })
}
