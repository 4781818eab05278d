//! The safety case (`docs/safety-case`): its form, its evidence, and the findings that stand against it.

mod drawing;
mod form;
mod gsn;

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use super::tree::{Tree, sections};
use form::hash_of;
use gsn::{Case, Element, FOLDER};

const COMMAND: &str = "UPDATE_SAFETY_CASE=1 cargo test -p mufasa-props --test tidy";

/// What is not well-formed, evidence that changed, hazards without a goal and findings without a counter-goal, or
/// the other way round.
pub fn wrong(tree: &Tree) -> Vec<(String, String)> {
    let case = match Case::of(tree) {
        Ok(case) => case,
        Err(wrong) => return vec![wrong],
    };
    let of_each = |it: &Element| {
        form::wrong(it, &case, tree)
            .into_iter()
            .map(|what| (it.id.clone(), what))
            .collect::<Vec<_>>()
    };
    let mut wrong: Vec<_> = case.0.iter().flat_map(of_each).collect();
    let roots: Vec<&str> = case.roots(None).iter().map(|it| it.id.as_str()).collect();
    if roots.len() != 1 || !roots[0].starts_with("G-") {
        wrong.push((FOLDER.to_owned(), format!("one goal is the root, not {roots:?}")));
    }
    wrong.extend(
        form::circle(&case).into_iter().map(|id| (id, "stands in or above a circle".to_owned())),
    );
    let asked = asked_for(tree);
    let is_answer = |id: &&String| id.starts_with("CG-") || id.starts_with("G-HZ-");
    let there: BTreeSet<String> =
        case.0.iter().map(|it| &it.id).filter(is_answer).cloned().collect();
    wrong.extend(asked.difference(&there).map(|id| (id.clone(), "is not there".to_owned())));
    wrong.extend(
        there.difference(&asked).map(|id| (id.clone(), "is no hazard and not open".to_owned())),
    );
    wrong
}

/// Goals and counter-goals that the hazards, the conditions that trigger them and the known problems ask for.
fn asked_for(tree: &Tree) -> BTreeSet<String> {
    let page = |name: &str| tree.0.get(name).map_or("", String::as_str);
    let known = page("docs/known-problems.md").lines().filter(|line| line.starts_with("| [F-"));
    let mut findings: Vec<&str> = known.filter_map(|line| line.split(']').next()).collect();
    let mut goals = BTreeSet::new();
    for section in sections(page("docs/hazards.md")) {
        if section.anchor == "assumed-hazards" || section.anchor == "triggering-conditions" {
            goals.extend(section.lines.iter().flat_map(|line| numbered(line, "HZ-", "G-")));
            findings.extend(section.lines);
        }
    }
    goals.extend(findings.iter().flat_map(|line| numbered(line, "F-", "CG-")));
    goals
}

/// Ids of a line, each with something before it.
fn numbered(line: &str, start: &str, before: &str) -> Vec<String> {
    let after = line.split(start).skip(1);
    let digits = after.map(|it| it.split(|c: char| !c.is_ascii_digit()).next().unwrap_or_default());
    digits.filter(|it| !it.is_empty()).map(|it| format!("{before}{start}{it}")).collect()
}

/// Pictures that are not drawn from the case as it is.
pub fn old_pictures(tree: &Tree) -> Vec<(String, String)> {
    let is_old = |(path, picture): &(String, String)| tree.0.get(path) != Some(picture);
    pictures(tree).into_iter().filter(is_old).map(|(path, _)| (path, COMMAND.to_owned())).collect()
}

fn pictures(tree: &Tree) -> Vec<(String, String)> {
    let Ok(case) = Case::of(tree) else { return Vec::new() };
    let modules: BTreeSet<&str> = case.0.iter().map(|it| it.module.as_str()).collect();
    modules
        .iter()
        .map(|module| (format!("{FOLDER}{module}.svg"), drawing::svg(&case, module)))
        .collect()
}

/// Writes the hash of what each solution names behind it, and the pictures.
pub fn update(tree: &Tree) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    for (path, text) in tree.ending(".gsn.yaml") {
        let mut now = String::new();
        let lines = text.lines().map(|line| {
            if let Some(artefact) = line.trim().strip_prefix("artefact: ") {
                now = hash_of(tree, artefact).unwrap_or_default();
            }
            let is_hash = line.starts_with("  hash:");
            if is_hash { format!("  hash: \"{now}\"\n") } else { format!("{line}\n") }
        });
        fs::write(root.join(path), lines.collect::<String>()).expect("a module can be written");
    }
    for (path, picture) in pictures(tree) {
        fs::write(root.join(path), picture).expect("a picture can be written");
    }
}

#[test]
fn what_breaks_a_safety_case_is_seen() {
    let with = |old: &str, new: &str| {
        let case = "G-HZ-1: {text: a, supportedBy: [Sn-a], inContextOf: C-a}\nC-a: {text: b}\n\
                    Sn-a: {text: 'Tested: c', artefact: a, hash: 'HASH'}\n\
                    CG-F-01: {text: d, challenges: G-HZ-1, url: ../../findings/F-01.md}\n";
        let files = [
            ("a/b.rs", "c"),
            ("docs/hazards.md", "## Assumed hazards\n| HZ-1 | F-01 |\n## Others\n| HZ-2 | F-02 |"),
            ("docs/known-problems.md", "F-03\n| [F-01](../findings/F-01.md) | F-04"),
            ("findings/F-01.md", ""),
        ];
        let mut tree = Tree(files.map(|(path, text)| (path.to_owned(), text.to_owned())).into());
        let case = case.replace("HASH", &hash_of(&tree, "a").expect("a hash"));
        assert!(case.contains(old), "{old}");
        tree.0.insert(format!("{FOLDER}a.gsn.yaml"), case.replacen(old, new, 1));
        wrong(&tree)
    };
    assert_eq!(with("", ""), []);
    for (old, new) in [
        ("[Sn-a]", "[Sn-a, Sn-b]"),
        ("[Sn-a]", "[Sn-a, Sn-a]"),
        ("[Sn-a]", "[Sn-a, G-HZ-1]"),
        ("[Sn-a]", "[Sn-a, C-a]"),
        ("[Sn-a]", "[Sn-a], undeveloped: true"),
        ("supportedBy", "supportedby"),
        ("C-a: {text: b}", "C-a: {text: ''}"),
        ("C-a: {text: b}", "C-a: {text: b}\nC-a: {text: b}"),
        ("C-a: {text: b}", "C-a: {text: b}\nG-b: {text: c, undeveloped: true}"),
        ("C-a: {text: b}", "C-a: {text: b, undeveloped: true}"),
        ("C-a: {text: b}", "C-a: {text: b, url: c.md}"),
        ("Tested: c", "Verified: c"),
        ("artefact: a", "artefact: b"),
        ("hash: '", "hash: '0"),
        ("challenges: G-HZ-1, ", ""),
        ("challenges: G-HZ-1", "challenges: CG-F-01"),
        ("F-01.md", "F-02.md"),
        ("CG-F-01", "CG-F-02"),
    ] {
        assert_ne!(with(old, new), [], "{old} -> {new}");
    }
}
