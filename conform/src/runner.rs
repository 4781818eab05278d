//! A campaign on its way: case by case, with the classes found so far.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::io::Write;
use std::time::Duration;

use indicatif::ProgressBar;
use mufasa_props::conformance::{is_too_much, name as stage_name};
use serde_json::Value;
use serde_json::value::RawValue;

use crate::cases::case::Case;
use crate::cases::question::Question;
use crate::cases::source::Source;
use crate::cases::vectors::Given;
use crate::error::ConformError;
use crate::judge::class::{Breach, Class, Kind, Scale};
use crate::judge::examine::{Examined, Expected, ask_and_compare, expect};
use crate::judge::explain::in_words;
use crate::reproduce::{Again, Reproduction};
use crate::results::report;
use crate::results::summary::{Campaign, CaseCount, Found, Summary};
use crate::settings::Settings;
use crate::subject::{Broken, Subject};
use mufasa_records::names;

/// So often in a row a program may break before its kind of record is given up, and so often it may
/// hang in all.
const RESTARTS: u64 = 5;

/// So often it may break in all.
const RESTARTS_IN_ALL: u64 = 200;

/// A case is small when it has so many objects; of a class without a small one further cases are
/// shrunk, too.
const SMALL: usize = 3;

/// So many cases of a class are shrunk at most.
const SHRUNK: u64 = 6;

/// A case that is not answered in time is asked once more, with so many times the limit, before a
/// program is said to hang: on a busy machine it may stand still.
const LONGER: u32 = 5;

/// So many late answers are forgiven; a program with more of them does not keep the limit.
const FORGIVEN: u64 = 20;

/// Place of what the program did after its answer.
const AFTERWARDS: &str = "after its answer";

/// Of the vectors, or of the cases: how many were asked, given up, and let pass.
#[derive(Clone, Copy, Debug, Default)]
struct Counts {
    asked: u64,
    skipped: u64,
    tolerated: u64,
}

/// A campaign on its way.
#[derive(Debug)]
pub struct Runner<'a> {
    settings: &'a Settings,
    source: &'a Source,
    vectors: &'a [Given],
    subject: Subject,
    bar: ProgressBar,
    of_vectors: Counts,
    of_cases: Counts,
    late: u64,
    interrupted: bool,
    given_up: Vec<Kind>,
    /// By kind of record: how often the program broke in a row, hung, and broke in all.
    broken: BTreeMap<Kind, [u64; 3]>,
    groups: BTreeMap<(Kind, &'static str, &'static str, &'static str), (u64, u64)>,
    classes: BTreeMap<Class, Found>,
}

impl<'a> Runner<'a> {
    /// A campaign that has not begun.
    pub fn new(
        settings: &'a Settings,
        source: &'a Source,
        vectors: &'a [Given],
        subject: Subject,
    ) -> Self {
        Self {
            settings,
            source,
            vectors,
            subject,
            bar: ProgressBar::hidden(),
            of_vectors: Counts::default(),
            of_cases: Counts::default(),
            late: 0,
            interrupted: false,
            given_up: Vec::new(),
            broken: BTreeMap::new(),
            groups: BTreeMap::new(),
            classes: BTreeMap::new(),
        }
    }

    /// Asks all vectors, then all cases; prints the name of the first class of each rule as it is found.
    /// Errors: the program cannot be started again, `out` cannot be written.
    pub fn run(&mut self, out: &mut impl Write) -> Result<(), ConformError> {
        let (first, step) = self.settings.shard.unwrap_or((0, 1));
        let cases = self.source.cases(self.settings.cases);
        let vectors = self.vectors.len() as u64;
        let mine = |all: u64| all.saturating_sub(first).div_ceil(step);
        self.bar = progress(mine(vectors).saturating_add(mine(cases)));
        let mut last = None;
        // Divided among the shards as the cases are.
        let (mut vector, mut number) = (first, first);
        while vector < vectors || number < cases {
            if self.subject.is_interrupted() {
                self.interrupted = true;
                break;
            }
            let given = usize::try_from(vector).ok().and_then(|at| self.vectors.get(at));
            let kind = given.map_or_else(|| self.source.kind(number), |it| it.question.kind());
            if self.given_up.contains(&kind) {
                self.counts(given.is_none()).skipped += 1;
            } else {
                let case =
                    given.map_or_else(|| Case::of_source(self.source, number), Case::of_vector);
                self.ask(&case, last.as_ref(), out)?;
                last = Some(case);
            }
            self.bar.inc(1);
            let next = if given.is_some() { &mut vector } else { &mut number };
            *next = next.saturating_add(step);
        }
        self.bar.finish_and_clear();
        if self.interrupted {
            return Ok(());
        }
        match (self.subject.finish(), last) {
            (Err(broken), Some(case)) => self.afterwards(broken, &case, out),
            (Ok(()), _) | (_, None) => Ok(()),
        }
    }

    /// What the program did after its answer to a case, which was counted with that answer.
    fn afterwards(
        &mut self,
        broken: Broken,
        case: &Case,
        out: &mut impl Write,
    ) -> Result<(), ConformError> {
        let class = Class {
            kind: case.question.kind(),
            breach: broken.breach,
            place: AFTERWARDS.to_owned(),
            profile: String::new(),
            configuration: String::new(),
            scale: Scale::Clear,
        };
        self.broke(class.kind, class.breach);
        let expected = expect(&case.name, &case.question);
        let answered = Err(broken);
        let examined =
            Examined { expected, answered, class: Some(class.clone()), tolerated: false };
        self.settle(&class, case, &examined, out)
    }

    /// What was found.
    pub fn summary(mut self) -> Summary {
        self.given_up.sort();
        let campaign = self.campaign();
        let group =
            |((kind, profile, configuration, expected), (cases, disagreements))| CaseCount {
                kind,
                profile: str::to_owned(profile),
                configuration: str::to_owned(configuration),
                expected: str::to_owned(expected),
                cases,
                disagreements,
            };
        Summary {
            campaign,
            shards: vec![self.settings.shard.map_or(0, |(at, _)| at)],
            vectors: self.of_vectors.asked,
            asked: self.of_cases.asked,
            vectors_skipped: self.of_vectors.skipped,
            vectors_tolerated: self.of_vectors.tolerated,
            skipped: self.of_cases.skipped,
            tolerated: self.of_cases.tolerated,
            late: self.late,
            starts: self.subject.starts(),
            interrupted: self.interrupted,
            given_up: self.given_up,
            groups: self.groups.into_iter().map(group).collect(),
            classes: self.classes.into_values().collect(),
        }
    }

    fn campaign(&self) -> Campaign {
        let settings = self.settings;
        let text = |word: &OsString| word.to_string_lossy().into_owned();
        Campaign {
            command: settings.command.iter().map(text).collect(),
            profile: names::profile(settings.profile).to_owned(),
            seed: settings.seed,
            vectors: self.vectors.len() as u64,
            cases: self.source.cases(settings.cases),
            kinds: self.source.kinds(),
            drives: settings.drives.iter().map(|path| path.display().to_string()).collect(),
            time_limit_ms: milliseconds(settings.time_limit),
            tolerance: settings.tolerance,
            of: settings.shard.map_or(1, |(_, of)| of),
        }
    }

    /// `last`: the case before.
    fn ask(
        &mut self,
        case: &Case,
        last: Option<&Case>,
        out: &mut impl Write,
    ) -> Result<(), ConformError> {
        let Case { name, question, .. } = case;
        let tolerance = self.settings.tolerance;
        let mut examined = ask_and_compare(&mut self.subject, name, question, tolerance)?;
        let is_known = examined.class.as_ref().is_some_and(|it| self.classes.contains_key(it));
        if examined.hangs() && !is_known && self.late < FORGIVEN {
            let limit = self.settings.time_limit;
            self.subject.set_time_limit(limit.saturating_mul(LONGER));
            examined = ask_and_compare(&mut self.subject, name, question, tolerance)?;
            self.subject.set_time_limit(limit);
            self.late += u64::from(!examined.hangs());
        }
        if self.subject.is_interrupted() {
            // What interrupts the campaign may have ended the program, too.
            return Ok(());
        }
        if let (Some(broken), Some(last)) = (self.subject.take_afterwards(), last) {
            self.afterwards(broken, last, out)?;
        }
        match &examined.class {
            Some(class) if class.breach.is_broken() => self.broke(class.kind, class.breach),
            _ => self.broken.entry(question.kind()).or_default()[0] = 0,
        }
        let counts = self.counts(case.number.is_some());
        counts.tolerated += u64::from(examined.tolerated);
        counts.asked += 1;
        if case.number.is_some() {
            self.count(question, &examined);
        }
        match examined.class.clone() {
            None => Ok(()),
            Some(class) => self.settle(&class, case, &examined, out),
        }
    }

    fn counts(&mut self, of_cases: bool) -> &mut Counts {
        if of_cases { &mut self.of_cases } else { &mut self.of_vectors }
    }

    fn count(&mut self, question: &Question, examined: &Examined) {
        let expected = match &examined.expected {
            Expected::Cycle(answer) if is_too_much(answer) => "work",
            Expected::Cycle(answer) => {
                answer.as_ref().as_ref().map_or("error", |report| stage_name(report.failed_stage))
            }
            Expected::Composition(Err(_)) | Expected::Line(_) => "error",
            Expected::Composition(Ok(answer)) if answer.none.is_some() => "none",
            Expected::Composition(Ok(_)) => "some",
            Expected::Offloading(_) => "",
        };
        let (profile, configuration) = question.setting();
        let group =
            self.groups.entry((question.kind(), profile, configuration, expected)).or_default();
        group.0 += 1;
        group.1 += u64::from(examined.class.is_some());
    }

    /// Counts a disagreement; shrinks and prints the first of its class.
    fn settle(
        &mut self,
        class: &Class,
        case: &Case,
        examined: &Examined,
        out: &mut impl Write,
    ) -> Result<(), ConformError> {
        let known = self.classes.get(class);
        let known = known.map(|found| (found.count, found.rank(), found.shrunk));
        let enough = known.is_some_and(|(count, (_, _, size), shrunk)| {
            (shrunk && size <= SMALL) || count >= SHRUNK || class.breach.is_broken()
        });
        if !enough {
            self.bar.set_message(format!("shrinking: {class}"));
            let found = self.shrunk(class, case, examined)?;
            if known.is_none_or(|(_, rank, _)| found.rank() < rank) {
                let of_class = self.classes.get(class);
                let (count, first) = of_class.map_or((0, None), |it| (it.count, it.first));
                let vectors = of_class.map_or_else(Vec::new, |it| it.vectors.clone());
                let is_new = !self.classes.keys().any(|it| it.is_of_rule(class));
                if is_new {
                    self.bar.suspend(|| report::noticed(&found, out).and_then(|()| out.flush()))?;
                }
                self.classes.insert(class.clone(), Found { count, vectors, first, ..found });
            }
            self.bar.set_message("");
        }
        if let Some(found) = self.classes.get_mut(class) {
            found.count += 1;
            match case.number {
                Some(_) => found.first = found.first.or(case.number),
                None => found.vectors.push(case.name.clone()),
            }
        }
        Ok(())
    }

    /// The program gave no answer that could be compared. A kind of record for which it does so
    /// again and again is given up.
    fn broke(&mut self, kind: Kind, breach: Breach) {
        let [in_a_row, hung, in_all] = self.broken.entry(kind).or_default();
        *in_a_row += 1;
        *hung += u64::from(breach == Breach::Hangs);
        *in_all += 1;
        let hopeless = *in_a_row >= RESTARTS || *hung >= RESTARTS || *in_all >= RESTARTS_IN_ALL;
        if hopeless && !self.given_up.contains(&kind) {
            self.given_up.push(kind);
        }
    }

    fn shrunk(
        &mut self,
        class: &Class,
        case: &Case,
        examined: &Examined,
    ) -> Result<Found, ConformError> {
        let Case { number, name, about, question } = case;
        let is_first = !self.classes.contains_key(class);
        let mut reproduction = Reproduction {
            subject: &mut self.subject,
            class,
            name,
            question,
            tolerance: self.settings.tolerance,
        };
        let again = match (self.source, *number) {
            // That comes after an answer, and cannot be asked.
            _ if class.place == AFTERWARDS => Again::Never,
            (Source::Generated(generator), Some(number)) => {
                let kind = question.kind();
                let read = |tape: &[u32]| generator.read(kind, tape);
                reproduction.run(Some(&(generator.tape(number), &read)), is_first)?
            }
            (Source::Generated(_) | Source::Drives(_), _) => reproduction.run(None, is_first)?,
        };
        // What the program did after an answer while a case was made smaller is no case of its own.
        let _ = self.subject.take_afterwards();
        let (told, shown, shrunk, before) = match &again {
            Again::Alone(alone) => (in_words(&alone.0, &alone.1), &alone.0, true, Vec::new()),
            Again::After(before) => (in_words(question, examined), question, false, before.clone()),
            Again::Never => (in_words(question, examined), question, false, Vec::new()),
        };
        let id = class.slug();
        Ok(Found {
            class: class.clone(),
            count: 1,
            vectors: Vec::new(),
            first: *number,
            name: name.clone(),
            about: about.clone(),
            told,
            shrunk,
            before,
            size: shown.objects(),
            unit: shown.unit().to_owned(),
            record: record(&shown.line(&id))?,
            id,
        })
    }
}

/// A record as it is; a line that is none, as a string.
fn record(line: &str) -> Result<Box<RawValue>, ConformError> {
    let text = line.to_owned();
    RawValue::from_string(text)
        .or_else(|_| RawValue::from_string(Value::from(line).to_string()))
        .map_err(|error| ConformError::Output(error.into()))
}

fn milliseconds(time: Duration) -> u64 {
    u64::try_from(time.as_millis()).unwrap_or(u64::MAX)
}

fn progress(cases: u64) -> ProgressBar {
    mufasa_drives::progress::bar(cases, "{bar:30} {pos}/{len} cases, {per_sec}, {left} left {msg}")
}
