//! The vectors that a campaign asks first (`spec/5-interfaces.md#vectors`): the written ones. The
//! random ones come from the generators that the cases behind them come from, too.

use std::collections::BTreeSet;

use mufasa_model::input::cycle::Profile;
use serde::Deserialize;
use serde_json::Value;
use serde_json::value::RawValue;

use crate::cases::question::{Question, Text};
use crate::error::ConformError;
use crate::judge::class::Kind;
use crate::settings::Settings;

/// What is published of the files of written vectors: the model need not answer them anew.
const PUBLISHED: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/published.rs"));

/// A line of these files.
#[derive(Deserialize)]
struct Vector<'a> {
    id: &'a str,
    requirement: &'a str,
    flag: &'a str,
    note: String,
    #[serde(borrow)]
    input: &'a RawValue,
}

/// A vector that binds the program under test.
#[derive(Clone, Debug)]
pub struct Given {
    /// Its id.
    pub id: String,
    /// Its requirement, the interpretation that it depends on, and its note.
    pub about: String,
    /// What is asked; the answer is compared with what the model says now, not with the vector's.
    pub question: Question,
}

/// The vectors of these settings, those of one profile and the wanted kinds; none with drives.
/// Errors: one cannot be read.
pub fn fitting(settings: &Settings) -> Result<Vec<Given>, ConformError> {
    if !settings.vectors || !settings.drives.is_empty() {
        return Ok(Vec::new());
    }
    let (mut known, mut fitting) = (BTreeSet::new(), Vec::new());
    for (file, line) in
        PUBLISHED.iter().flat_map(|(file, text)| text.lines().map(move |it| (file, it)))
    {
        let wrong = |error| ConformError::Vectors(format!("{file}: {error}"));
        let vector: Vector<'_> = serde_json::from_str(line).map_err(wrong)?;
        let Some(question) = vector.question(settings.profile).map_err(wrong)? else { continue };
        if is_wanted(&question, &settings.kinds) && known.insert(question.line("")) {
            fitting.push(Given { id: vector.id.to_owned(), about: vector.about(), question });
        }
    }
    Ok(fitting)
}

impl Vector<'_> {
    /// What it asks of a program of this profile. What binds both profiles is asked in this one.
    fn question(&self, profile: Profile) -> serde_json::Result<Option<Question>> {
        let text = self.input.get();
        let mut question = if text.starts_with('"') {
            // As it stands: another text would be another question.
            let line: String = serde_json::from_str(text)?;
            Question::Text(Text::new(self.id, &line))
        } else {
            Question::of_line(text).unwrap_or_else(|| Question::Text(Text::new(self.id, text)))
        };
        let its_profile = match &mut question {
            Question::Cycle(cycle) => &mut cycle.profile,
            Question::Offloading(trace) => &mut trace.profile,
            Question::Monitor(sequence) => &mut sequence.profile,
            Question::Composition(_) | Question::Line(_) | Question::Text(_) => {
                return Ok(Some(question));
            }
        };
        if self.flag == "must" {
            *its_profile = profile;
        }
        Ok((*its_profile == profile).then_some(question))
    }

    /// What it is about.
    fn about(&self) -> String {
        let reading = self.flag.strip_prefix("interpretation ");
        let reading = reading.map_or(String::new(), |name| format!(", if {name} is read so"));
        format!("{}{reading}: {}", self.requirement, self.note)
    }
}

/// Whether the kind is asked about; a line also has to be of a record that is, where it shows one.
fn is_wanted(question: &Question, kinds: &[Kind]) -> bool {
    let Question::Text(text) = question else { return kinds.contains(&question.kind()) };
    let shown: Option<Value> = serde_json::from_str(&text.line).ok();
    let shown = shown.as_ref().and_then(|it| it.get("kind")?.as_str());
    let of = Kind::RECORDS.into_iter().find(|kind| Some(kind.name()) == shown);
    let is_asked =
        |kind| kinds.contains(&kind) || !Kind::RECORDS.iter().any(|it| kinds.contains(it));
    kinds.contains(&Kind::Line) && of.is_none_or(is_asked)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asked(profile: Profile, kinds: &[Kind]) -> Vec<Given> {
        fitting(&Settings::of(profile, kinds)).unwrap_or_else(|error| panic!("{error}"))
    }

    #[test]
    fn of_each_kind_and_profile_those_are_asked_that_bind() {
        let paper = (Profile::PAPER, "hardened", "F-14");
        for (profile, other, only) in [paper, (Profile::HARDENED, "paper", "H-10")] {
            let of = |kind: Kind| asked(profile, &[kind]);
            for (kind, least) in
                [(Kind::Cycle, 300), (Kind::Offloading, 30), (Kind::Composition, 20)]
            {
                let given = of(kind);
                assert!(given.len() > least, "{}: {}", kind.name(), given.len());
                assert!(given.iter().all(|it| it.question.kind() == kind));
                assert!(given.iter().all(|it| it.question.setting().0 != other));
            }
            assert!(of(Kind::Cycle).iter().any(|it| it.id.starts_with(only)), "{only}");
            let all = asked(profile, &Kind::ALL);
            let sum: usize = Kind::RECORDS.into_iter().map(|kind| of(kind).len()).sum();
            assert_eq!(all.len(), sum + of(Kind::Line).len());
        }
    }

    #[test]
    fn a_line_is_asked_as_it_stands_if_its_record_is_asked_about() {
        let lines = |kinds: &[Kind]| {
            let mut given = asked(Profile::PAPER, kinds);
            given.retain(|it| it.question.kind() == Kind::Line);
            given
        };
        let (all, cycles) = (lines(&[Kind::Line]), lines(&[Kind::Cycle, Kind::Line]));
        assert!(cycles.len() > 40 && cycles.len() < all.len(), "{} {}", cycles.len(), all.len());
        assert!(cycles.iter().all(|it| !it.id.starts_with("composition-lines-id-null")));
        let of = |text: &str| all.iter().any(|it| it.question.line("x").contains(text));
        assert!(of("1e400") && of("{") && of(""), "a line was written anew");
        assert!(lines(&[Kind::Cycle]).is_empty());
    }
}
