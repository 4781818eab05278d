//! A safety case in GSN, from the YAML of gsn2x. Its parser is that of gsn2x, so both read the same.

use std::collections::BTreeSet;

use serde_yaml_ng::{Mapping, Value};

use super::super::tree::Tree;

/// Where its modules are.
pub const FOLDER: &str = "docs/safety-case/";

/// What an id begins with: counter-goal, solution, goal, strategy, context, assumption, justification.
const KINDS: [&str; 7] = ["CG", "Sn", "G", "S", "C", "A", "J"];

/// An element.
pub struct Element {
    /// Its id.
    pub id: String,
    /// The name of its file.
    pub module: String,
    /// What is said of it.
    pub keys: Mapping,
}

impl Element {
    /// What its id begins with, up to the first `-`.
    pub fn kind(&self) -> &'static str {
        let start = self.id.split('-').next();
        KINDS.into_iter().find(|kind| start == Some(*kind)).unwrap_or_default()
    }

    /// The text of a key.
    pub fn word(&self, key: &str) -> &str {
        self.keys.get(key).and_then(Value::as_str).unwrap_or_default()
    }

    /// The words of a key, of which there may be one or a list.
    pub fn words(&self, key: &str) -> Vec<&str> {
        let value = self.keys.get(key);
        let all = value.and_then(Value::as_sequence).map_or(&[][..], Vec::as_slice);
        all.iter().chain(value).filter_map(Value::as_str).collect()
    }

    /// Whether it says that nothing supports it.
    pub fn is_undeveloped(&self) -> bool {
        self.keys.get("undeveloped").and_then(Value::as_bool) == Some(true)
    }
}

/// The elements of all modules in their order.
pub struct Case(pub Vec<Element>);

impl Case {
    /// The case of the repository; a file that is no YAML, or names an id twice, is told.
    pub fn of(tree: &Tree) -> Result<Self, (String, String)> {
        let mut elements = Vec::new();
        for (path, text) in tree.ending(".gsn.yaml").filter(|(path, _)| path.starts_with(FOLDER)) {
            let module = path.trim_start_matches(FOLDER).trim_end_matches(".gsn.yaml");
            let all: Mapping = serde_yaml_ng::from_str(text)
                .map_err(|error| (path.to_owned(), error.to_string()))?;
            for (id, keys) in all {
                let id = id.as_str().unwrap_or_default().to_owned();
                if id != "module" {
                    let keys = keys.as_mapping().cloned().unwrap_or_default();
                    elements.push(Element { id, module: module.to_owned(), keys });
                }
            }
        }
        Ok(Self(elements))
    }

    /// The element of an id.
    pub fn get(&self, id: &str) -> Option<&Element> {
        self.0.iter().find(|it| it.id == id)
    }

    /// What stands below an element, each with the key that says so: context, support, what challenges it.
    pub fn below(&self, element: &Element) -> Vec<(&'static str, &Element)> {
        let named = ["inContextOf", "supportedBy"].into_iter().flat_map(|key| {
            element.words(key).into_iter().filter_map(move |id| Some((key, self.get(id)?)))
        });
        let against = self.0.iter().filter(|it| it.words("challenges") == [&element.id]);
        named.chain(against.map(|it| ("challenges", it))).collect()
    }

    /// Elements of a module, or of all, that no other of them has for support or context, except counter-goals.
    pub fn roots(&self, module: Option<&str>) -> Vec<&Element> {
        let here = |it: &&Element| module.is_none_or(|module| it.module == module);
        let named: BTreeSet<&str> = (self.0.iter().filter(here))
            .flat_map(|it| [it.words("inContextOf"), it.words("supportedBy")].concat())
            .collect();
        let is_root = |it: &&Element| it.kind() != "CG" && !named.contains(it.id.as_str());
        self.0.iter().filter(here).filter(is_root).collect()
    }
}
