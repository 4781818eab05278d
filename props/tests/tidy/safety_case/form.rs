//! The form of a safety case: what an element may say, and which elements it may name.

use std::collections::BTreeSet;

use super::super::hash;
use super::super::links::leads;
use super::super::tree::Tree;
use super::COMMAND;
use super::gsn::{Case, Element, FOLDER};

/// Keys that name elements: who may have them, and whom they may name.
const KEYS: [(&str, &[&str], &[&str]); 3] = [
    ("supportedBy", &["G", "S", "CG"], &["G", "S", "Sn"]),
    ("inContextOf", &["G", "S"], &["C", "A", "J"]),
    ("challenges", &["CG"], &["G", "S", "Sn"]),
];

const OTHERS: [&str; 5] = ["text", "undeveloped", "url", "artefact", "hash"];

/// How a solution shows what it shows.
const HOW: [&str; 4] = ["Proved: ", "Tested: ", "Measured: ", "Argued: "];

/// What is wrong with an element.
pub fn wrong(it: &Element, case: &Case, tree: &Tree) -> Vec<String> {
    let mut wrong = Vec::new();
    let mut ask = |is_right: bool, what: &str| {
        if !is_right {
            wrong.push(what.to_owned());
        }
    };
    let kind = it.kind();
    ask(!kind.is_empty() && !it.word("text").is_empty(), "has no kind or no text");
    ask(case.0.iter().filter(|other| other.id == it.id).count() == 1, "is there twice");
    for key in it.keys.keys().filter_map(|key| key.as_str()) {
        let of_keys = KEYS.iter().find(|(name, _, _)| *name == key);
        ask(of_keys.is_some() || OTHERS.contains(&key), &format!("{key} is no key"));
        let Some((_, from, to)) = of_keys else { continue };
        let ids = it.words(key);
        let may = |id: &&str| case.get(id).is_some_and(|other| to.contains(&other.kind()));
        ask(from.contains(&kind) && ids.iter().all(may), &format!("{key} names what it may not"));
        ask(ids.iter().collect::<BTreeSet<_>>().len() == ids.len(), &format!("{key}: twice"));
    }
    let is_developed = !it.words("supportedBy").is_empty();
    if ["G", "S"].contains(&kind) {
        ask(is_developed != it.is_undeveloped(), "is to be supported or undeveloped");
    } else {
        ask(!it.is_undeveloped(), "cannot be undeveloped");
    }
    let url = it.word("url");
    ask(url.is_empty() || leads(tree, &format!("{FOLDER}a"), url), "url leads nowhere");
    if kind == "CG" {
        let page = format!("../../findings/{}.md", it.id.trim_start_matches("CG-"));
        ask(
            it.words("challenges").len() == 1 && url == page,
            "challenges one, with the page of the finding",
        );
    }
    if kind == "Sn" {
        ask(HOW.iter().any(|how| it.word("text").starts_with(how)), "says how it shows this");
        let now = hash_of(tree, it.word("artefact"));
        let what = format!(
            "{} changed or is gone; who has looked whether it holds: {COMMAND}",
            it.word("artefact")
        );
        ask(now.is_some_and(|now| now == it.word("hash")), &what);
    } else {
        ask(it.word("artefact").is_empty(), "is no solution");
    }
    wrong
}

/// Elements that stay when those are taken away again and again below which nothing is left.
pub fn circle(case: &Case) -> BTreeSet<String> {
    let mut left: BTreeSet<&str> = case.0.iter().map(|it| it.id.as_str()).collect();
    loop {
        let is_free = |it: &&Element| !it.words("supportedBy").iter().any(|id| left.contains(id));
        let free: BTreeSet<&str> = case.0.iter().filter(is_free).map(|it| it.id.as_str()).collect();
        let rest: BTreeSet<&str> = left.difference(&free).copied().collect();
        if rest.len() == left.len() {
            return rest.into_iter().map(str::to_owned).collect();
        }
        left = rest;
    }
}

/// Of a file or of all files of a folder with their names; of none where one cannot be read as text.
pub fn hash_of(tree: &Tree, path: &str) -> Option<String> {
    let below = format!("{path}/");
    let files = || tree.0.iter().filter(|(it, _)| *it == path || it.starts_with(&below));
    let all: String = files().flat_map(|(path, text)| [path, "\n", text.as_str(), "\n"]).collect();
    (!all.is_empty() && files().all(|(_, text)| !text.is_empty())).then(|| hash::of(&all))
}
