//! `spec/requirements.lock`: what each requirement said when what cites it was confirmed. What cites it stands in
//! `docs/requirements.csv`.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use super::citations::Citations;
use super::hash;
use super::ids::{Requirement, prefix, rule};
use super::tree::Tree;

/// The lock.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lock {
    /// The hash of what each requirement said when it was confirmed.
    hashes: BTreeMap<String, String>,
    /// Ids that were of a requirement once and must not be of another.
    pub retired: BTreeSet<String>,
}

const HEAD: &str = "# Written by CONFIRM=ID,... cargo test -p mufasa-props --test requirements.\n\
                    # Each id with the hash of its text when what cites it was confirmed.\n";

impl Lock {
    /// The lock from its text.
    pub fn parse(text: &str) -> Self {
        let mut lock = Self::default();
        for line in text.lines().filter(|line| !line.starts_with('#')) {
            match line.split_once(' ') {
                Some((id, "retired")) => drop(lock.retired.insert(id.to_owned())),
                Some((id, hash)) => drop(lock.hashes.insert(id.to_owned(), hash.to_owned())),
                None => {}
            }
        }
        lock
    }

    /// What has to be read and confirmed, or mended.
    pub fn suspects(&self, requirements: &[Requirement], cited: &Citations) -> Vec<String> {
        let mut wrong = Vec::new();
        for Requirement { id, text, .. } in requirements {
            if self.retired.contains(id) {
                wrong.push(format!("{id} was of a requirement that is gone: take a new id"));
                continue;
            }
            let what = match self.hashes.get(id) {
                None => "is new",
                Some(hash) if *hash != hash::of(text) => "has changed",
                Some(_) => continue,
            };
            // What cites a rule as a whole is about each of its requirements, and these are about its terms.
            let (of, is_chapter) =
                id.split_once(':').map_or((id.as_str(), false), |(of, _)| (of, true));
            let is_about = |it: &str| {
                it == of || it == rule(of) || is_chapter && [rule(it), prefix(it)].contains(&of)
            };
            let by = cited.iter().filter(|(it, _)| is_about(it)).flat_map(|(_, by)| by);
            let by: BTreeSet<&str> = by.map(String::as_str).collect();
            let by = Vec::from_iter(by).join(", ");
            wrong.push(format!("{id} {what}: {text}\n    read and confirm (CONFIRM={id}): {by}"));
        }
        let is_gone = |id: &&String| !requirements.iter().any(|it| it.id == **id);
        let gone = self.hashes.keys().filter(is_gone);
        wrong.extend(gone.map(|id| format!("{id} is gone: CONFIRM={id} retires it")));
        wrong
    }

    /// Takes over what the named ids say; an id that is gone is retired.
    pub fn confirm(&mut self, names: &[&str], requirements: &[Requirement]) {
        for name in names.iter().map(|it| (*it).to_owned()) {
            if let Some(requirement) = requirements.iter().find(|it| it.id == name) {
                self.hashes.insert(name, hash::of(&requirement.text));
            } else {
                let known = self.hashes.remove(&name);
                assert!(known.is_some(), "CONFIRM: {name} is no requirement");
                self.retired.insert(name);
            }
        }
    }
}

/// Chapters that requirements count on without an id of their own: `H-06:Terms` of a rule's page, and those of
/// `spec/4-arithmetic.md` that a requirement names.
pub fn definitions(tree: &Tree) -> Vec<Requirement> {
    let chapter = |text: &str, heading: &str| {
        let rest = text.split_once(&format!("\n## {heading}\n"))?.1;
        let words = rest.split("\n## ").next().unwrap_or_default();
        Some(words.split_whitespace().collect::<Vec<_>>().join(" "))
    };
    let mut found = Vec::new();
    let mut add = |file: &str, of: &str, heading: &str| {
        let text = tree.0.get(file).and_then(|text| chapter(text, heading));
        let place = format!("{file}#{}", heading.to_lowercase());
        let id = format!("{of}:{}", heading.replace(' ', "-"));
        found.extend(text.map(|text| Requirement { id, place, text }));
    };
    for (file, _) in tree.ending(".md").filter(|(path, _)| path.starts_with("spec/hardened/")) {
        let name = file.rsplit('/').next().unwrap_or_default();
        add(file, name.trim_end_matches(".md"), "Terms");
    }
    add("spec/hardened/what-the-cav-saw.md", "SEEN", "Symbols");
    for (of, heading) in
        [("IMPL-10", "Steps"), ("IMPL-14", "Usual settings"), ("IMPL-16", "Advice")]
    {
        add("spec/4-arithmetic.md", of, heading);
    }
    found
}

impl fmt::Display for Lock {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{HEAD}")?;
        self.hashes.iter().try_for_each(|(id, hash)| writeln!(out, "{id} {hash}"))?;
        self.retired.iter().try_for_each(|id| writeln!(out, "{id} retired"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn requirement(id: &str, text: &str) -> Requirement {
        let [id, place, text] = [id, "spec/6-link.md#limits", text].map(str::to_owned);
        Requirement { id, place, text }
    }

    fn cited(by: &[&str]) -> Citations {
        [("A-01".to_owned(), by.iter().map(|it| (*it).to_owned()).collect())].into()
    }

    #[test]
    fn a_change_makes_what_cites_it_suspect_until_it_is_confirmed() {
        let old = [requirement("A-01", "It MUST.")];
        let by = cited(&["one", "two"]);
        let mut lock = Lock::default();
        assert!(lock.suspects(&old, &by)[0].starts_with("A-01 is new"));
        lock.confirm(&["A-01"], &old);
        assert_eq!(lock.suspects(&old, &by), [""; 0]);
        assert_eq!(Lock::parse(&lock.to_string()), lock);

        let new = [requirement("A-01", "It MUST NOT.")];
        let wrong = lock.suspects(&new, &by).join("");
        assert!(wrong.starts_with("A-01 has changed") && wrong.ends_with("one, two"), "{wrong}");
        lock.confirm(&["A-01"], &new);
        assert_eq!(lock.suspects(&new, &by), [""; 0]);
    }

    #[test]
    fn what_cites_a_rule_as_a_whole_is_suspect_with_each_of_its_requirements() {
        let of = |text: &str| [requirement("H-04.1", text)];
        let by = Citations::from([("H-04".to_owned(), BTreeSet::from(["a_test".to_owned()]))]);
        let mut lock = Lock::default();
        lock.confirm(&["H-04.1"], &of("It MUST."));
        assert_eq!(lock.suspects(&of("It MUST."), &by), [""; 0]);
        assert!(lock.suspects(&of("It MUST NOT."), &by)[0].ends_with("(CONFIRM=H-04.1): a_test"));
    }

    #[test]
    fn what_cites_a_requirement_is_suspect_with_the_terms_of_its_rule() {
        let terms = [requirement("H-04:Terms", "s: a way.")];
        let by =
            |id: &str| Citations::from([(id.to_owned(), BTreeSet::from(["a_test".to_owned()]))]);
        let ends = |id| {
            Lock::default().suspects(&terms, &by(id))[0].ends_with("(CONFIRM=H-04:Terms): a_test")
        };
        assert!(ends("H-04.1") && ends("H-04") && !ends("H-05.1"));
    }

    #[test]
    fn an_id_that_is_gone_is_retired_and_never_taken_again() {
        let old = [requirement("A-01", "It MUST.")];
        let mut lock = Lock::default();
        lock.confirm(&["A-01"], &old);
        assert_eq!(lock.suspects(&[], &cited(&[])), ["A-01 is gone: CONFIRM=A-01 retires it"]);
        lock.confirm(&["A-01"], &[]);
        assert_eq!(lock.suspects(&[], &cited(&[])), [""; 0]);
        lock = Lock::parse(&lock.to_string());
        let wrong = lock.suspects(&old, &cited(&[]));
        assert_eq!(wrong, ["A-01 was of a requirement that is gone: take a new id"]);
    }

    #[test]
    #[should_panic(expected = "B-01 is no requirement")]
    fn what_is_no_requirement_is_not_confirmed() {
        Lock::default().confirm(&["B-01"], &[]);
    }
}
