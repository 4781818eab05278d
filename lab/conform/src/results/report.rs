//! What is printed, and the files that are kept.

use std::fmt::Write as _;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::error::ConformError;
use crate::judge::class::{Class, Kind};
use crate::results::found::{Found, NotShrunk};
use crate::results::summary::{Campaign, CaseCount, Summary};
use crate::results::{advice, junit, seeded};
use mufasa_records::files;

/// So many vectors that disagree are named; the summary has all.
const NAMED: usize = 5;

/// What is said where only the tolerance makes answers agree.
const TOLERATED: &str = "no disagreement beyond the tolerance (this is not conformance)";

/// Longest record that is printed; the file has all.
const MOST: usize = 4000;

/// So many rules are shown with a record, of a program that is nearly right.
const SHOWN: usize = 3;

/// Prints that a rule broke for the first time; the end shows more.
pub fn noticed(class: &Class, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "found: {class}")
}

/// Prints a class with its smallest case.
fn found(found: &Found, out: &mut impl Write) -> io::Result<()> {
    let Found { class, count, id, name, about, told, why, before, size, unit, record, .. } = found;
    let plural = if *count == 1 { "" } else { "s" };
    writeln!(out, "DISAGREES  {class}, {count} time{plural}")?;
    writeln!(out, "  program  {}", told.answered)?;
    writeln!(out, "  exact    {}", told.expected)?;
    if let Some(numbers) = &told.numbers {
        writeln!(out, "  decides  {}", numbers.what)?;
        write!(out, "           {} against {}", numbers.left, numbers.right)?;
        if !numbers.margin.is_empty() {
            write!(out, ", margin {}", numbers.margin)?;
        }
        writeln!(out)?;
    }
    if let Some(delta) = found.delta() {
        writeln!(out, "  delta    {delta} m, the record's own margin (parameters.delta)")?;
    }
    if let Some(integer) = found.rounded().filter(|_| found.shrunk) {
        writeln!(
            out,
            "  hint     {integer} is beyond 2^53: who reads it as a double has another number"
        )?;
    }
    let how = match (why, before.is_empty()) {
        (None, _) => "shrunk from",
        (Some(_), false) => "does not occur alone;",
        (Some(NotShrunk::NotAlone), true) => "was not shown again;",
        (Some(NotShrunk::Limit | NotShrunk::Time | NotShrunk::Interrupted), true) => "not shrunk;",
    };
    let what = if about.is_empty() { "case" } else { "vector" };
    let plural = if *size == 1 { "" } else { "s" };
    writeln!(out, "  size     {size} {unit}{plural}, {how} {what} {name}")?;
    if found.history() > 0 {
        writeln!(out, "  history  {} earlier detections (detection_history)", found.history())?;
    }
    if !about.is_empty() {
        writeln!(out, "  vector   {about}")?;
    }
    if !before.is_empty() {
        let (count, plural) = (before.len(), if before.len() == 1 { "" } else { "s" });
        writeln!(out, "  after    {count} other line{plural}: sequence.{id}.jsonl")?;
    }
    let text = record.get();
    if text.len() <= MOST {
        writeln!(out, "  record   {text}")
    } else {
        writeln!(out, "  record   {} bytes, see the file", text.len())
    }
}

/// Prints what to mend first, the rules that broke with their counts, what was asked, one sentence,
/// and what a clean run means.
pub fn end(summary: &Summary, out: &mut impl Write) -> io::Result<()> {
    wrong(summary, out)?;
    counts(summary, out)?;
    seeded::words(summary).map_or(Ok(()), |words| writeln!(out, "{words}"))
}

/// The class to mend first, with its record, and of a program that is nearly right one of each of a
/// few rules; then all rules.
fn wrong(summary: &Summary, out: &mut impl Write) -> io::Result<()> {
    advice::begin(summary, out)?;
    let order = advice::order(summary);
    let shown = if advice::is_beginning(summary) { 1 } else { SHOWN };
    for (at, class) in order.iter().take(shown).enumerate() {
        writeln!(out, "{}", if at == 0 { "\nmend first:" } else { "" })?;
        found(class, out)?;
    }
    if !order.is_empty() {
        writeln!(out)?;
    }
    advice::print(summary, out)?;
    not_shrunk(summary, out)
}

/// How many classes were not made small, and why.
fn not_shrunk(summary: &Summary, out: &mut impl Write) -> io::Result<()> {
    let reasons = [
        (NotShrunk::Limit, "of each rule only a few are, those to mend first"),
        (NotShrunk::Time, "there was no more time for it (--shrinking)"),
        (NotShrunk::Interrupted, "it was interrupted"),
    ];
    for (why, words) in reasons {
        let count = summary.classes.iter().filter(|found| found.why == Some(why)).count();
        if count > 0 {
            let all = summary.classes.len();
            writeln!(out, "{count} of {all} classes not shrunk: {words}")?;
        }
    }
    Ok(())
}

fn counts(summary: &Summary, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "\n{}", coverage(&summary.groups).trim_end())?;
    for kind in &summary.given_up {
        let name = kind.name();
        writeln!(out, "given up: {name} records, after too many restarts of the program")?;
    }
    if summary.late > 0 {
        let limit = summary.campaign.time_limit_ms;
        writeln!(out, "{} answered only when asked again, not within {limit} ms", summary.late)?;
    }
    if summary.campaign.vectors > 0 {
        vectors(summary, out)?;
    }
    cases(summary, out)
}

/// The line of the vectors.
fn vectors(summary: &Summary, out: &mut impl Write) -> io::Result<()> {
    let wrong = summary.wrong_vectors();
    write!(out, "{} of {} vectors asked", summary.vectors, summary.campaign.vectors)?;
    left_out(summary.vectors_skipped, summary.vectors_tolerated, out)?;
    match wrong.split_at_checked(NAMED) {
        _ if summary.vectors == 0 => writeln!(out),
        _ if wrong.is_empty() && summary.vectors_tolerated > 0 => writeln!(out, ": {TOLERATED}"),
        _ if wrong.is_empty() => writeln!(out, ": no disagreement"),
        Some((named, more)) if !more.is_empty() => {
            let named = named.join(", ");
            writeln!(out, ": {} DISAGREE: {named}, {} more", wrong.len(), more.len())
        }
        _ => writeln!(out, ": {} DISAGREE: {}", wrong.len(), wrong.join(", ")),
    }
}

/// The line of the cases.
fn cases(summary: &Summary, out: &mut impl Write) -> io::Result<()> {
    let Campaign { cases, of, .. } = &summary.campaign;
    write!(out, "{} of {cases} cases asked", summary.asked)?;
    if *of > 1 {
        write!(out, " ({} of {of} shards)", summary.shards.len())?;
    }
    left_out(summary.skipped, summary.tolerated, out)?;
    if summary.interrupted {
        write!(out, ", INTERRUPTED")?;
    }
    if summary.enough {
        return writeln!(
            out,
            ": the vectors show that much is wrong; mend that first (--cases {cases} asks all the same)"
        );
    }
    let of_cases = summary.disagreements() - summary.wrong_vectors().len() as u64;
    match (of_cases, summary.asked) {
        (_, 0) if !summary.is_empty() => writeln!(out),
        (_, 0) => writeln!(out, ": nothing was compared"),
        (0, _) if summary.interrupted => writeln!(out, ": no disagreement so far"),
        (0, _) if summary.tolerated > 0 => writeln!(out, ": {TOLERATED}"),
        (0, _) => writeln!(out, ": the program conforms in all of them"),
        (count, _) => {
            let classes = summary.classes.iter().filter(|found| found.first.is_some()).count();
            let plural = if classes == 1 { "" } else { "es" };
            writeln!(out, ": {count} DISAGREE, in {classes} class{plural}")
        }
    }
}

/// How many of those on this line were not asked, and how many were asked in vain.
fn left_out(skipped: u64, tolerated: u64, out: &mut impl Write) -> io::Result<()> {
    if skipped > 0 {
        write!(out, ", {skipped} left out")?;
    }
    if tolerated > 0 {
        write!(out, ", {tolerated} agree within the tolerance only")?;
    }
    Ok(())
}

/// Cases by kind, profile and expected verdict, on one line each.
fn coverage(groups: &[CaseCount]) -> String {
    let mut text = String::new();
    for kind in Kind::ALL {
        let of_kind = groups.iter().filter(|group| group.kind == kind);
        let mut by_verdict: Vec<(&str, u64)> = Vec::new();
        for group in of_kind {
            match by_verdict.iter_mut().find(|(verdict, _)| *verdict == group.expected) {
                Some((_, cases)) => *cases += group.cases,
                None => by_verdict.push((&group.expected, group.cases)),
            }
        }
        let total: u64 = by_verdict.iter().map(|(_, cases)| cases).sum();
        if total == 0 {
            continue;
        }
        // Writing to a string cannot fail.
        let _ = write!(text, "{:<12} {total:>7} cases", kind.name());
        for (verdict, cases) in by_verdict.into_iter().filter(|(verdict, _)| !verdict.is_empty()) {
            let _ = write!(text, ", {cases} {verdict}");
        }
        text.push('\n');
    }
    text
}

/// The files of a campaign or shard in a folder.
#[derive(Clone, Debug)]
pub struct Files {
    /// JSON.
    pub summary: PathBuf,
    /// For build servers.
    pub junit: PathBuf,
    /// The shrunk records, JSON Lines.
    pub reproducers: PathBuf,
    folder: PathBuf,
    /// What a shard puts into the names of its files.
    part: String,
}

impl Files {
    /// Prepares the folder and removes what an earlier run left under the same names, so that
    /// nothing there looks like a result of this one before it is.
    /// Errors: the folder cannot be written to.
    pub fn prepare(folder: &Path, shard: Option<(u64, u64)>) -> Result<Self, ConformError> {
        let denied = |error| ConformError::file(folder, format!("cannot be written to: {error}"));
        files::prepare(folder).map_err(denied)?;
        let part = shard.map_or(String::new(), |(at, of)| format!(".{at}-of-{of}"));
        let these = Self {
            summary: folder.join(format!("summary{part}.json")),
            junit: folder.join(format!("junit{part}.xml")),
            reproducers: folder.join(format!("reproducers{part}.jsonl")),
            folder: folder.to_owned(),
            part,
        };
        let sequences = these.sequences().map_err(denied)?;
        let single = [&these.summary, &these.junit, &these.reproducers];
        for file in single.into_iter().chain(&sequences) {
            match fs::remove_file(file) {
                Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(denied(error)),
                Ok(()) | Err(_) => {}
            }
        }
        Ok(these)
    }

    /// The sequences in the folder: `sequence.ID.jsonl`, of a shard `sequence.0-of-8.ID.jsonl`.
    fn sequences(&self) -> io::Result<Vec<PathBuf>> {
        let prefix = format!("sequence{}.", self.part);
        let is_one = |path: &PathBuf| {
            let name = path.file_name().and_then(|name| name.to_str());
            let id = name.and_then(|name| name.strip_prefix(&prefix)?.strip_suffix(".jsonl"));
            id.is_some_and(|id| !id.contains('.'))
        };
        let entries: io::Result<Vec<_>> = fs::read_dir(&self.folder)?.collect();
        Ok(entries?.into_iter().map(|entry| entry.path()).filter(is_one).collect())
    }

    /// Writes the files, the summary last. Errors: one cannot be written.
    pub fn write(&self, summary: &Summary) -> Result<(), ConformError> {
        let lines: String = summary.classes.iter().map(|found| found.line() + "\n").collect();
        let json = serde_json::to_string_pretty(summary)
            .map_err(|error| ConformError::file(&self.summary, error))?;
        let sequences = summary.classes.iter().filter_map(|found| {
            let name = format!("sequence{}.{}.jsonl", self.part, found.id);
            Some((self.folder.join(name), found.sequence()?))
        });
        let rest = [
            (self.reproducers.clone(), lines),
            (self.junit.clone(), junit::xml(summary)),
            (self.summary.clone(), json + "\n"),
        ];
        for (path, content) in sequences.chain(rest) {
            files::write(&path, &content).map_err(|error| {
                ConformError::file(&path, format!("cannot be written: {error}"))
            })?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use serde_json::value::RawValue;

    use super::*;
    use crate::judge::class::{Breach, Class, Scale};
    use crate::judge::explain::Told;

    fn printed(record: &str) -> String {
        let class = Class {
            kind: Kind::Cycle,
            breach: Breach::Completeness,
            place: String::from("i"),
            profile: String::new(),
            configuration: String::new(),
            scale: Scale::Clear,
        };
        let told = Told { answered: String::new(), expected: String::new(), numbers: None };
        let found = Found {
            id: class.slug(),
            class,
            count: 1,
            vectors: Vec::new(),
            first: Some(0),
            at: 0,
            name: String::from("c-0"),
            about: String::new(),
            told,
            shrunk: true,
            why: None,
            tried: Vec::new(),
            before: Vec::new(),
            size: 1,
            unit: String::from("object"),
            record: RawValue::from_string(record.to_owned()).expect("JSON"),
        };
        let mut out = Vec::new();
        super::found(&found, &mut out).expect("written");
        String::from_utf8(out).expect("text")
    }

    #[test]
    fn earlier_detections_of_the_record_are_counted_under_their_name() {
        let with = |items| printed(&format!(r#"{{"detection_history": [{{"items": {items}}}]}}"#));
        let two = with("[{}, {}]");
        assert!(two.contains("\n  history  2 earlier detections (detection_history)\n"), "{two}");
        assert!(!with("[]").contains("history  "));
    }

    #[test]
    fn a_margin_of_the_record_itself_is_said_and_no_other() {
        let own = printed(r#"{"parameters": {"delta": 1e-8}}"#);
        assert!(
            own.contains("\n  delta    1e-8 m, the record's own margin (parameters.delta)\n"),
            "{own}"
        );
        assert!(!printed(r#"{"parameters": {"theta_tr": 0.1}}"#).contains("delta"));
        assert!(!printed(r#""no record""#).contains("delta"));
    }

    #[test]
    fn an_integer_that_no_double_is_has_one_hint() {
        let far = printed(r#"{"now_ns": 9223371966854775807, "stamps": [9223371966854775805]}"#);
        let hint = "\n  hint     9223371966854775807 is beyond 2^53: ";
        assert!(far.contains(hint) && far.matches("2^53").count() == 1, "{far}");
        assert!(
            printed(r#"{"items": [{"id": -9007199254740993}]}"#).contains(" -9007199254740993 is")
        );
        let same = printed(r#"{"now_ns": 9007199254740992, "x": 1e300, "id": "9007199254740993"}"#);
        assert!(!same.contains("2^53"), "{same}");
    }
}
