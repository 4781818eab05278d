//! `spec/requirements.lock`: what each requirement said when what cites it was confirmed.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use super::citations::Citations;
use super::hash;
use super::ids::{Requirement, rule};

/// Hashes of a requirement and of what its citations were confirmed for.
#[derive(Clone, Debug, Default, PartialEq)]
struct Entry {
    hash: String,
    citations: BTreeMap<String, String>,
}

/// The lock.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lock {
    entries: BTreeMap<String, Entry>,
    /// Ids that were of a requirement once and must not be of another.
    pub retired: BTreeSet<String>,
}

const HEAD: &str = "# Written by CONFIRM=ID,... cargo test -p mufasa-props --test requirements.\n\
                    # Each id with the hash of its text; below it each citation with the hash that it was confirmed for.\n";

impl Lock {
    /// The lock from its text.
    pub fn parse(text: &str) -> Self {
        let mut lock = Self::default();
        let mut current = String::new();
        for line in text.lines().filter(|line| !line.starts_with('#')) {
            let Some((first, second)) = line.trim().split_once(' ') else { continue };
            if line.starts_with(' ') {
                let citations = lock.entries.get_mut(&current).map(|entry| &mut entry.citations);
                citations.map(|all| all.insert(second.to_owned(), first.to_owned()));
            } else if second == "retired" {
                lock.retired.insert(first.to_owned());
            } else {
                first.clone_into(&mut current);
                let entry = Entry { hash: second.to_owned(), ..Entry::default() };
                lock.entries.insert(current.clone(), entry);
            }
        }
        lock
    }

    /// What has to be read and confirmed, or mended.
    pub fn suspects(&self, requirements: &[Requirement], cited: &Citations) -> Vec<String> {
        let mut wrong = Vec::new();
        let none = (BTreeSet::new(), Entry::default());
        for Requirement { id, text, .. } in requirements {
            let entry = self.entries.get(id).unwrap_or(&none.1);
            let by = cited.get(id).unwrap_or(&none.0);
            if self.retired.contains(id) {
                wrong.push(format!("{id} was of a requirement that is gone: take a new id"));
                continue;
            }
            let now = hash::of(text);
            let suspect: Vec<&str> = by
                .iter()
                .filter(|it| entry.citations.get(*it) != Some(&now))
                .map(String::as_str)
                .collect();
            if entry.hash != now || !suspect.is_empty() {
                // What cites a rule as a whole is about each of its requirements.
                let whole = cited.get(rule(id)).filter(|_| entry.hash != now && rule(id) != id);
                let suspect: BTreeSet<&str> = suspect
                    .into_iter()
                    .chain(whole.into_iter().flatten().map(String::as_str))
                    .collect();
                let suspect: Vec<&str> = suspect.into_iter().collect();
                let what = match entry.hash.as_str() {
                    "" => "is new",
                    hash if hash == now => "is cited anew",
                    _ => "has changed",
                };
                wrong.push(format!(
                    "{id} {what}: {text}\n    read and confirm (CONFIRM={id}): {}",
                    suspect.join(", ")
                ));
            }
            for gone in entry.citations.keys().filter(|it| !by.contains(*it)) {
                wrong.push(format!("{id} is no longer cited by {gone} (CONFIRM={id})"));
            }
        }
        for id in self.entries.keys() {
            if !requirements.iter().any(|it| it.id == *id) {
                wrong.push(format!("{id} is gone: CONFIRM={id} retires it"));
            }
        }
        wrong
    }

    /// Takes over what the named ids say and what cites them now; an id that is gone is retired.
    pub fn confirm(&mut self, names: &[&str], requirements: &[Requirement], cited: &Citations) {
        for name in names {
            if let Some(requirement) = requirements.iter().find(|it| it.id == *name) {
                let hash = hash::of(&requirement.text);
                let by = cited.get(*name).into_iter().flatten();
                let citations = by.map(|it| (it.clone(), hash.clone())).collect();
                self.entries.insert((*name).to_owned(), Entry { hash, citations });
            } else {
                let known = self.entries.remove(*name);
                assert!(known.is_some(), "CONFIRM: {name} is no requirement");
                self.retired.insert((*name).to_owned());
            }
        }
    }
}

impl fmt::Display for Lock {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{HEAD}")?;
        for (id, entry) in &self.entries {
            writeln!(out, "{id} {}", entry.hash)?;
            for (by, hash) in &entry.citations {
                writeln!(out, "  {hash} {by}")?;
            }
        }
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
        lock.confirm(&["A-01"], &old, &by);
        assert_eq!(lock.suspects(&old, &by), [""; 0]);
        assert_eq!(Lock::parse(&lock.to_string()), lock);

        let new = [requirement("A-01", "It MUST NOT.")];
        let wrong = lock.suspects(&new, &by).join("");
        assert!(wrong.starts_with("A-01 has changed") && wrong.ends_with("one, two"), "{wrong}");
        lock.confirm(&["A-01"], &new, &by);
        assert_eq!(lock.suspects(&new, &by), [""; 0]);

        let wrong = lock.suspects(&new, &cited(&["one", "three"])).join("\n");
        assert!(wrong.starts_with("A-01 is cited anew") && wrong.contains(": three\n"), "{wrong}");
        assert!(wrong.contains("no longer cited by two"), "{wrong}");
    }

    #[test]
    fn what_cites_a_rule_as_a_whole_is_suspect_with_each_of_its_requirements() {
        let of = |text: &str| [requirement("H-04.1", text)];
        let by = Citations::from([("H-04".to_owned(), BTreeSet::from(["a_test".to_owned()]))]);
        let mut lock = Lock::default();
        lock.confirm(&["H-04.1"], &of("It MUST."), &by);
        assert_eq!(lock.suspects(&of("It MUST."), &by), [""; 0]);
        assert!(lock.suspects(&of("It MUST NOT."), &by)[0].ends_with("(CONFIRM=H-04.1): a_test"));
    }

    #[test]
    fn an_id_that_is_gone_is_retired_and_never_taken_again() {
        let old = [requirement("A-01", "It MUST.")];
        let mut lock = Lock::default();
        lock.confirm(&["A-01"], &old, &cited(&[]));
        assert_eq!(lock.suspects(&[], &cited(&[])), ["A-01 is gone: CONFIRM=A-01 retires it"]);
        lock.confirm(&["A-01"], &[], &cited(&[]));
        assert_eq!(lock.suspects(&[], &cited(&[])), [""; 0]);
        lock = Lock::parse(&lock.to_string());
        let wrong = lock.suspects(&old, &cited(&[]));
        assert_eq!(wrong, ["A-01 was of a requirement that is gone: take a new id"]);
    }

    #[test]
    #[should_panic(expected = "B-01 is no requirement")]
    fn what_is_no_requirement_is_not_confirmed() {
        Lock::default().confirm(&["B-01"], &[], &cited(&[]));
    }
}
