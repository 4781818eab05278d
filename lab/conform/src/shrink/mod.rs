//! The end of a campaign: one record of each class is made small, as far as there is time. First one class of
//! each rule, in the order in which to mend them; then others; then further cases of those that are not small.

mod cycle;
mod passes;
mod program;
mod record;
mod sequence;

use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::time::Instant;

use indicatif::ProgressBar;
use serde_json::Value;
use serde_json::value::RawValue;

use crate::cases::case::Case;
use crate::cases::order::Order;
use crate::error::ConformError;
use crate::judge::class::{AFTERWARDS, Class, Kind};
use crate::judge::examine::Examined;
use crate::judge::explain::{Told, in_words};
use crate::results::advice;
use crate::results::found::{Found, NotShrunk, best};
use crate::settings::Settings;
use crate::subject::Subject;
use program::{Again, Hunt, Limits};

/// So many classes of a rule are shrunk; of a program at its beginning, whose classes are many and alike, one.
const CLASSES_OF_A_RULE: usize = 6;

/// So often the program is started to make records small that take a start each, in all.
const STARTS: usize = 240;

/// One case takes at most one of so many parts of the time and of the starts.
const PARTS: u32 = 4;

/// What was kept in bytes of the lines that were asked before a case.
const KEPT_BYTES: usize = 64 << 20;

/// A disagreement: where it was seen, and what came.
#[derive(Debug)]
pub struct Sighting {
    /// Its position in the order of the campaign.
    pub position: u64,
    /// The position of the first line that the same process was asked.
    pub begin: u64,
    /// What was answered, and what is right.
    pub examined: Examined,
}

/// The disagreements of a class.
#[derive(Debug, Default)]
pub struct Sightings {
    /// How many.
    pub count: u64,
    /// The vectors among them.
    pub vectors: Vec<String>,
    /// Number of the first case among them.
    pub first: Option<u64>,
    /// The first of them, at least one.
    pub earliest: Vec<Sighting>,
}

/// Classes, and the program under test.
#[derive(Debug)]
pub struct Shrinking<'a> {
    /// What was asked.
    pub order: Order<'a>,
    /// The program under test.
    pub subject: &'a mut Subject,
    /// Time and tolerance.
    pub settings: &'a Settings,
    /// What was not asked any more, and from where on.
    pub given_up: &'a [(Kind, u64)],
    /// Where it is said what is done.
    pub bar: &'a ProgressBar,
}

impl Shrinking<'_> {
    /// What was found; `much`: the program is at its beginning. Errors: the program cannot be started again.
    pub fn run(
        mut self,
        classes: &BTreeMap<Class, Sightings>,
        much: bool,
    ) -> Result<Vec<Found>, ConformError> {
        let until = Instant::now() + self.settings.shrinking;
        let mut limits = Limits { until, restarts: STARTS };
        let chosen = chosen(classes, if much { 1 } else { CLASSES_OF_A_RULE });
        let mut tried: BTreeMap<&Class, Vec<Found>> = BTreeMap::new();
        for class in &chosen {
            if let Some(first) = classes[*class].earliest.first() {
                let found = self.made_small(class, first, true, &mut limits)?;
                tried.entry(class).or_default().push(found);
            }
        }
        for class in chosen {
            for further in classes[class].earliest.iter().skip(1) {
                let known = tried.entry(class).or_default();
                if class.breach.is_broken() || known.iter().any(Found::is_small) || limits.is_over()
                {
                    break;
                }
                known.push(self.made_small(class, further, false, &mut limits)?);
            }
        }
        let found = classes.iter().filter_map(|(class, sightings)| {
            let tries = match tried.remove(class) {
                Some(tries) => tries,
                None => vec![self.as_seen(class, sightings.earliest.first()?, NotShrunk::Limit)],
            };
            let Sightings { count, first, .. } = *sightings;
            let mut vectors = sightings.vectors.clone();
            vectors.sort_unstable();
            let shown = best(&tries)?.clone();
            let tried = if self.settings.shard.is_some() { tries } else { Vec::new() };
            Some(Found { count, vectors, first, tried, ..shown })
        });
        Ok(found.collect())
    }

    /// What comes of making a case small.
    fn made_small(
        &mut self,
        class: &Class,
        sighting: &Sighting,
        is_first: bool,
        limits: &mut Limits,
    ) -> Result<Found, ConformError> {
        self.bar.set_message(format!("shrinking: {class}"));
        if class.place == AFTERWARDS {
            return Ok(self.as_seen(class, sighting, NotShrunk::NotAlone));
        }
        let case = self.order.case(sighting.position);
        let (order, given_up) = (self.order, self.given_up);
        let before = || if is_first { before(order, given_up, sighting) } else { Vec::new() };
        let own = limits.part(PARTS);
        let mut hunt = Hunt::new(self.subject, class, self.settings.tolerance, own);
        let again = hunt.run(&case.question, before)?;
        let taken = own.restarts - hunt.limits.restarts;
        limits.restarts = limits.restarts.saturating_sub(taken);
        // What the program did after an answer while a case was made smaller is no case of its own.
        let _ = self.subject.take_afterwards();
        Ok(match again {
            Again::Alone(alone) => {
                let (question, examined) = *alone;
                let told = in_words(&question, &examined);
                found(class, Case { question, ..case }, told, None)
            }
            Again::After(before) => {
                Found { before, ..self.as_seen(class, sighting, NotShrunk::NotAlone) }
            }
            Again::Not(why) => self.as_seen(class, sighting, why),
        })
    }

    /// A case as it was seen.
    fn as_seen(&self, class: &Class, sighting: &Sighting, why: NotShrunk) -> Found {
        let case = self.order.case(sighting.position);
        let told = in_words(&case.question, &sighting.examined);
        found(class, case, told, Some(why))
    }
}

/// The lines that the same process was asked before a case; of too many the last.
fn before(order: Order<'_>, given_up: &[(Kind, u64)], sighting: &Sighting) -> Vec<String> {
    let (mut lines, mut bytes) = (Vec::new(), 0);
    for position in (sighting.begin..sighting.position).rev() {
        let kind = order.kind(position);
        if given_up.iter().any(|(given_up, from)| *given_up == kind && position > *from) {
            continue;
        }
        let Case { name, question, .. } = order.case(position);
        let line = question.line(&name);
        bytes += line.len();
        if bytes > KEPT_BYTES {
            break;
        }
        lines.push(line);
    }
    lines.reverse();
    lines
}

/// The classes that are made small, in this order: so many of each rule, the first of each rule first.
fn chosen(classes: &BTreeMap<Class, Sightings>, of_a_rule: usize) -> Vec<&Class> {
    let mut all: Vec<&Class> = classes.keys().collect();
    all.sort_by_key(|class| (advice::urgency(class), Reverse(classes[*class].count)));
    let mut chosen: Vec<(usize, &Class)> = Vec::new();
    for class in all {
        let before = chosen.iter().filter(|(_, it)| it.is_of_rule(class)).count();
        if before < of_a_rule {
            chosen.push((before, class));
        }
    }
    // The order stays among those that are equal.
    chosen.sort_by_key(|(before, _)| *before);
    chosen.into_iter().map(|(_, class)| class).collect()
}

fn found(class: &Class, case: Case, told: Told, why: Option<NotShrunk>) -> Found {
    let Case { at, number, name, about, question } = case;
    let id = class.slug();
    Found {
        class: class.clone(),
        count: 1,
        vectors: Vec::new(),
        first: number,
        at,
        name,
        about,
        told,
        shrunk: why.is_none(),
        why,
        before: Vec::new(),
        size: question.objects(),
        unit: question.unit().to_owned(),
        record: record(&question.line(&id)),
        tried: Vec::new(),
        id,
    }
}

/// A record as it is; a line that is none, as a string.
fn record(line: &str) -> Box<RawValue> {
    let text = line.to_owned();
    RawValue::from_string(text)
        .or_else(|_| RawValue::from_string(Value::from(line).to_string()))
        .unwrap_or_default()
}
