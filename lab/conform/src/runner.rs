//! A campaign on its way: case by case, with the classes found so far.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::io::Write;
use std::time::Duration;

use indicatif::ProgressBar;
use mufasa_props::conformance::{is_too_much, name as stage_name};

use crate::cases::case::Case;
use crate::cases::order::Order;
use crate::cases::question::Question;
use crate::cases::source::Source;
use crate::cases::vectors::Given;
use crate::error::ConformError;
use crate::judge::class::{AFTERWARDS, Breach, Class, Kind, Scale};
use crate::judge::examine::{Examined, Expected, ask_and_compare, expect};
use crate::results::found::CASES_OF_A_CLASS;
use crate::results::summary::{Campaign, CaseCount, Summary};
use crate::results::{advice, report};
use crate::settings::Settings;
use crate::shrink::{Shrinking, Sighting, Sightings};
use crate::subject::{Broken, Subject};
use mufasa_records::names;

/// So often in a row a program may break before its kind of record is given up, and so often it may
/// hang in all.
const RESTARTS: u64 = 5;

/// So often it may break in all.
const RESTARTS_IN_ALL: u64 = 200;

/// A case that is not answered in time is asked once more, with so many times the limit, before a
/// program is said to hang: on a busy machine it may stand still.
const LONGER: u32 = 5;

/// So many late answers are forgiven; a program with more of them does not keep the limit.
const FORGIVEN: u64 = 20;

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
    order: Order<'a>,
    subject: Subject,
    bar: ProgressBar,
    of_vectors: Counts,
    of_cases: Counts,
    late: u64,
    interrupted: bool,
    enough: bool,
    /// Kinds of records, and the position from which on they were not asked any more.
    given_up: Vec<(Kind, u64)>,
    /// By kind of record: how often the program broke in a row, hung, and broke in all.
    broken: BTreeMap<Kind, [u64; 3]>,
    groups: BTreeMap<(Kind, &'static str, &'static str, &'static str), (u64, u64)>,
    classes: BTreeMap<Class, Sightings>,
    /// How often the program was started up to now, and the position of the first line that it was asked since.
    starts: u64,
    begin: u64,
}

impl<'a> Runner<'a> {
    /// A campaign that has not begun.
    pub fn new(
        settings: &'a Settings,
        source: &'a Source,
        vectors: &'a [Given],
        subject: Subject,
    ) -> Self {
        let (first, step) = settings.shard.unwrap_or((0, 1));
        let cases = source.cases(settings.cases);
        Self {
            settings,
            order: Order { source, vectors, cases, first, step },
            starts: subject.starts(),
            subject,
            bar: ProgressBar::hidden(),
            of_vectors: Counts::default(),
            of_cases: Counts::default(),
            late: 0,
            interrupted: false,
            enough: false,
            given_up: Vec::new(),
            broken: BTreeMap::new(),
            groups: BTreeMap::new(),
            classes: BTreeMap::new(),
            begin: 0,
        }
    }

    /// Asks all vectors, then all cases, unless the vectors show that much is wrong; prints the name of the
    /// first class of each rule as it is found.
    /// Errors: the program cannot be started again, `out` cannot be written.
    pub fn run(&mut self, out: &mut impl Write) -> Result<(), ConformError> {
        let order = self.order;
        self.bar = progress(order.len());
        let mut last = None;
        for position in 0..order.len() {
            if self.subject.is_interrupted() {
                self.interrupted = true;
                break;
            }
            if position == order.vectors_here() && self.has_enough() {
                self.enough = true;
                break;
            }
            let kind = order.kind(position);
            if self.given_up.iter().any(|(given_up, _)| *given_up == kind) {
                self.counts(!order.is_vector(position)).skipped += 1;
            } else {
                let case = order.case(position);
                self.ask(&case, position, last.as_ref(), out)?;
                last = Some(case);
            }
            self.bar.inc(1);
        }
        if self.interrupted {
            self.bar.finish_and_clear();
            return Ok(());
        }
        match (self.subject.finish(), last) {
            (Err(broken), Some(case)) => {
                self.afterwards(broken, &case, order.len().saturating_sub(1), out)
            }
            (Ok(()), _) | (_, None) => Ok(()),
        }
    }

    /// Ends the campaign before its end.
    pub fn interrupt(&mut self) {
        self.bar.finish_and_clear();
        self.interrupted = true;
    }

    /// Whether the vectors show that so much is wrong that random cases would say no more; never where their
    /// number was given, and not in a shard, which sees some of the vectors.
    fn has_enough(&self) -> bool {
        let Settings { cases, shard, drives, .. } = self.settings;
        let wrong = self.classes.values().map(|it| it.count).sum();
        let is_asked_for = cases.is_some() || shard.is_some() || !drives.is_empty();
        !is_asked_for && advice::is_much(wrong, self.of_vectors.asked)
    }

    /// What the program did after its answer to a case, which was counted with that answer.
    fn afterwards(
        &mut self,
        broken: Broken,
        case: &Case,
        position: u64,
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
        self.broke(&class, position);
        let expected = expect(&case.name, &case.question);
        let answered = Err(broken);
        let examined =
            Examined { expected, answered, class: Some(class.clone()), tolerated: false };
        self.note(class, case, position, examined, out)
    }

    /// What was found, with records as small as there is time for.
    /// Errors: the program cannot be started again.
    pub fn summary(mut self) -> Result<Summary, ConformError> {
        let campaign = self.campaign();
        let wrong = self.classes.values().map(|it| it.count).sum();
        let much = advice::is_much(wrong, self.of_vectors.asked + self.of_cases.asked);
        let restarts = self.subject.starts().saturating_sub(1);
        let classes = Shrinking {
            order: self.order,
            subject: &mut self.subject,
            settings: self.settings,
            given_up: &self.given_up,
            bar: &self.bar,
        }
        .run(&self.classes, much)?;
        self.bar.finish_and_clear();
        let group =
            |((kind, profile, configuration, expected), (cases, disagreements))| CaseCount {
                kind,
                profile: str::to_owned(profile),
                configuration: str::to_owned(configuration),
                expected: str::to_owned(expected),
                cases,
                disagreements,
            };
        let mut given_up: Vec<Kind> = self.given_up.iter().map(|(kind, _)| *kind).collect();
        given_up.sort();
        Ok(Summary {
            campaign,
            shards: vec![self.settings.shard.map_or(0, |(at, _)| at)],
            vectors: self.of_vectors.asked,
            asked: self.of_cases.asked,
            vectors_skipped: self.of_vectors.skipped,
            vectors_tolerated: self.of_vectors.tolerated,
            skipped: self.of_cases.skipped,
            tolerated: self.of_cases.tolerated,
            late: self.late,
            restarts,
            interrupted: self.interrupted || self.subject.is_interrupted(),
            enough: self.enough,
            given_up,
            groups: self.groups.into_iter().map(group).collect(),
            classes,
        })
    }

    fn campaign(&self) -> Campaign {
        let settings = self.settings;
        let text = |word: &OsString| word.to_string_lossy().into_owned();
        Campaign {
            version: settings.version.clone(),
            command: settings.command.iter().map(text).collect(),
            profile: names::profile(settings.profile).to_owned(),
            seed: settings.seed,
            vectors: self.order.vectors.len() as u64,
            cases: self.order.cases,
            kinds: self.order.source.kinds(),
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
        position: u64,
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
            self.afterwards(broken, last, position.saturating_sub(1), out)?;
        }
        if self.subject.starts() != self.starts {
            // For this line: who breaks at it is started again for the next.
            (self.starts, self.begin) = (self.subject.starts(), position);
        }
        match &examined.class {
            Some(class) if class.breach.is_broken() => self.broke(class, position),
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
            Some(class) => self.note(class, case, position, examined, out),
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
            Expected::States(Err(_)) | Expected::Composition(Err(_)) | Expected::Line(_) => "error",
            Expected::Composition(Ok(answer)) if answer.none.is_some() => "none",
            Expected::Composition(Ok(_)) => "some",
            Expected::States(Ok(_)) => "",
        };
        let (profile, configuration) = question.setting();
        let group =
            self.groups.entry((question.kind(), profile, configuration, expected)).or_default();
        group.0 += 1;
        group.1 += u64::from(examined.class.is_some());
    }

    /// Counts a disagreement, and keeps where it was seen.
    fn note(
        &mut self,
        class: Class,
        case: &Case,
        position: u64,
        examined: Examined,
        out: &mut impl Write,
    ) -> Result<(), ConformError> {
        if !self.classes.keys().any(|it| it.is_of_rule(&class)) {
            self.bar.suspend(|| report::noticed(&class, out).and_then(|()| out.flush()))?;
        }
        let sightings = self.classes.entry(class).or_default();
        sightings.count += 1;
        match case.number {
            Some(_) => sightings.first = sightings.first.or(case.number),
            None => sightings.vectors.push(case.name.clone()),
        }
        if sightings.earliest.len() < CASES_OF_A_CLASS {
            sightings.earliest.push(Sighting { position, begin: self.begin, examined });
        }
        Ok(())
    }

    /// The program gave no answer that could be compared. A kind of record for which it does so
    /// again and again is given up.
    fn broke(&mut self, class: &Class, position: u64) {
        let kind = class.kind;
        let [in_a_row, hung, in_all] = self.broken.entry(kind).or_default();
        *in_a_row += 1;
        *hung += u64::from(class.breach == Breach::Hangs);
        *in_all += 1;
        let hopeless = *in_a_row >= RESTARTS || *hung >= RESTARTS || *in_all >= RESTARTS_IN_ALL;
        if hopeless && !self.given_up.iter().any(|(given_up, _)| *given_up == kind) {
            self.given_up.push((kind, position));
        }
    }
}

fn milliseconds(time: Duration) -> u64 {
    u64::try_from(time.as_millis()).unwrap_or(u64::MAX)
}

fn progress(cases: u64) -> ProgressBar {
    mufasa_drives::progress::bar(cases, "{bar:30} {pos}/{len} cases, {per_sec}, {left} left {msg}")
}
