//! The claims that a release needs (`mufasa prove --require`).

use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::Path;

use super::End;
use super::claim::{Claim, Status};
use super::tables;

/// What a release needs proved, which is what docs/proofs.md and the README say.
const RELEASE: &str = include_str!("../../../../proofs/required.txt");

/// How many of these claims were asked here, and the number of each verdict.
pub(super) fn promised(lines: &[Claim]) -> String {
    let all = ids(RELEASE);
    let asked = lines.iter().filter(|line| all.contains(&line.id));
    let (count, each) = (asked.clone().count(), tables::counts(asked));
    format!("asked {count} of {} claims that a release proves: {each}", all.len())
}

/// The ids in a list, one a line; what stands behind `#` is said to people.
///
/// Errors, in words: the file cannot be read, lists nothing, or something that is no claim.
pub(super) fn read(path: &Path) -> Result<BTreeSet<String>, String> {
    let text = std::fs::read_to_string(path)
        .map_err(|error| format!("{}: cannot be read: {error}", path.display()))?;
    let ids = ids(&text);
    if ids.is_empty() {
        return Err(format!("{}: requires nothing", path.display()));
    }
    let all: BTreeSet<String> = super::claims()
        .map_err(|error| error.to_string())?
        .into_iter()
        .map(|claim| claim.id)
        .collect();
    match ids.iter().find(|id| !all.contains(*id)) {
        None => Ok(ids),
        Some(id) => Err(format!("{}: {id}: there is no such claim", path.display())),
    }
}

/// The ids in the text of a list.
pub fn ids(text: &str) -> BTreeSet<String> {
    let line = |line: &str| line.split('#').next().unwrap_or_default().trim().to_owned();
    text.lines().map(line).filter(|id| !id.is_empty()).collect()
}

/// How many of the required claims are proved, and each other one with what is said of it; how that ends.
pub(super) fn summary(path: &Path, ids: &BTreeSet<String>, lines: &[Claim]) -> (String, End) {
    let (mut proved, mut others, mut end) = (0, String::new(), End::Proved);
    for id in ids {
        let line = lines.iter().find(|line| line.id == *id);
        let (found, said) = line.map_or((End::LeftOut, String::from("not run")), of);
        end = end.max(found);
        if found == End::Proved {
            proved += 1;
        } else {
            // Writing to a string cannot fail.
            let _ = writeln!(others, "  {id}: {said}");
        }
    }
    let path = path.display();
    (format!("required by {path}: {proved} of {} are proved\n{others}", ids.len()), end)
}

/// What an engine that was not run might say is not known, but a refutation stands whatever it says.
fn of(line: &Claim) -> (End, String) {
    let answer = &line.answer;
    let said = format!("{}, {}", answer.engine, answer.status.name());
    let not_run = [answer].into_iter().chain(&line.others).find(|it| it.status == Status::NotRun);
    match (answer.status, not_run) {
        (Status::Proved, _) => (End::Proved, said),
        (Status::NotRun | Status::Tested, Some(engine)) => {
            (End::LeftOut, format!("{} is missing", engine.engine))
        }
        (Status::NotRun | Status::Tested | Status::Refuted | Status::Unknown, _) => {
            (End::NotProved, said)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::prove::claim::EngineAnswer;

    #[test]
    fn a_missing_engine_is_told_from_a_claim_that_is_not_proved() {
        use Status::{NotRun, Proved, Refuted, Tested, Unknown};
        let ends = |answers: &[Status]| {
            let given = answers.iter().map(|&status| EngineAnswer::given("z3", status, 0.0));
            let line = Claim::new(["an id", "", ""], EngineAnswer::not_run("z3", ""));
            let lines = [line.answered(given.collect())];
            summary(Path::new("list"), &ids("an id # of z3\n\n# nothing\n"), &lines)
        };
        for (answers, end) in [
            (&[Proved][..], End::Proved),
            (&[Proved, NotRun], End::Proved),
            (&[Tested], End::NotProved),
            (&[Unknown], End::NotProved),
            (&[Unknown, NotRun], End::NotProved),
            (&[Refuted, NotRun], End::NotProved),
            (&[Refuted, Proved], End::NotProved),
            (&[NotRun], End::LeftOut),
            (&[Tested, NotRun], End::LeftOut),
        ] {
            let (text, found) = ends(answers);
            assert_eq!(found, end, "{answers:?}");
            let first =
                format!("required by list: {} of 1 are proved\n", u8::from(end == End::Proved));
            assert!(text.starts_with(&first), "{text}");
            assert_eq!(text.contains("an id"), end != End::Proved, "{text}");
        }
        let nothing = summary(Path::new("list"), &ids("an id"), &[]);
        assert_eq!(nothing.1, End::LeftOut, "a claim that was not asked");
        assert!(End::Proved < End::LeftOut && End::LeftOut < End::NotProved);
        assert_eq!(
            [End::Proved, End::NotProved, End::BadInput, End::LeftOut].map(End::code),
            [0, 1, 2, 4]
        );
    }
}
