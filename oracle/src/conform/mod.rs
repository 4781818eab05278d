//! `mufasa conform`: a program of others, held against the exact model
//! (`spec/5-interfaces.md#programs-under-test`).
//!
//! A campaign asks cases one by one, each from its own number and the seed alone, so that shards
//! are disjoint and any case can be had again. The first disagreement of every class is shrunk
//! while the program is asked about every smaller record.

mod answer;
mod class;
mod drives;
mod error;
mod examine;
mod explain;
mod generate;
mod junit;
mod minimise;
mod question;
mod report;
mod shrink;
mod subject;
mod summary;

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::io::Write;
use std::path::PathBuf;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};
use mufasa_model::cycle::Profile;
use mufasa_props::conformance::name as stage_name;
use serde_json::value::RawValue;

pub use class::{Breach, Class, Kind, Scale};
pub use error::ConformError;
pub use explain::{Numbers, Told};
pub use summary::{Campaign, Found, Group, Summary};

use drives::Pool;
use examine::{Examined, Expected, examine};
use generate::Generator;
use question::Question;
use report::Files;
use shrink::Hunt;
use subject::Subject;

use crate::check::complain;
use crate::drive::Options;
use crate::json::names;

/// Generated cases unless the number is given.
pub const CASES: u64 = 10_000;

/// So often a program may break in one class before its kind of record is given up.
const RESTARTS: u64 = 5;

/// A case is small when it has so many objects; of a class without a small one further cases are
/// shrunk, too.
const SMALL: usize = 3;

/// So many cases of a class are shrunk at most.
const SHRUNK: u64 = 6;

/// No disagreement.
const CONFORMS: u8 = 0;
/// Some disagreement.
const DISAGREES: u8 = 1;
/// Bad input, or nothing was compared.
const BAD_INPUT: u8 = 2;

/// What is to be done.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// The program under test and its arguments.
    pub command: Vec<OsString>,
    /// Profile of generated cases and of recorded drives.
    pub profile: Profile,
    /// Cases of all shards; by default 10,000, or all that the drives give.
    pub cases: Option<u64>,
    /// Seed of the cases.
    pub seed: u64,
    /// How long an answer may take.
    pub time_limit: Duration,
    /// Kinds of generated records.
    pub kinds: Vec<Kind>,
    /// Only the cases whose number leaves the first when divided by the second.
    pub shard: Option<(u64, u64)>,
    /// Files of drives that give the cases instead.
    pub drives: Vec<PathBuf>,
    /// Margin within which a disagreement is none, m.
    pub tolerance: Option<f64>,
    /// Where summary, JUnit and reproducers go.
    pub out: PathBuf,
}

/// Runs a campaign or a shard of it: writes what is found to `out` as it is found, and the files
/// at the end. Returns the exit code: 0 without a disagreement, 1 with one, 2 when some file could
/// not be read or nothing was compared. Errors: bad usage.
pub fn run(
    settings: &Settings,
    out: &mut impl Write,
    err: &mut impl Write,
) -> Result<u8, ConformError> {
    let (source, unreadable) = Source::new(settings, err)?;
    let subject = Subject::start(&settings.command, settings.time_limit)?;
    let files = Files::prepare(&settings.out, settings.shard)?;
    let mut course = Course::new(settings, &source, subject);
    course.run(out)?;
    let summary = course.summary();
    files.write(&summary)?;
    report::end(&summary, out)?;
    writeln!(out, "{}, {}", files.summary.display(), files.junit.display())?;
    if !summary.classes.is_empty() {
        writeln!(out, "{}: the shrunk records", files.reproducers.display())?;
    }
    Ok(match (summary.classes.is_empty(), unreadable || summary.asked == 0) {
        (false, _) => DISAGREES,
        (true, true) => BAD_INPUT,
        (true, false) => CONFORMS,
    })
}

/// Joins the summaries of shards, prints the result, and writes it to a folder if one is given.
/// Returns the exit code: 0 and 1 as above, 2 when shards are missing. Errors: summaries that do
/// not belong together.
pub fn merge(
    inputs: &[PathBuf],
    folder: Option<&PathBuf>,
    out: &mut impl Write,
) -> Result<u8, ConformError> {
    let summary = Summary::merge(inputs)?;
    for found in &summary.classes {
        report::found(found, out)?;
    }
    report::end(&summary, out)?;
    if let Some(folder) = folder {
        Files::prepare(folder, None)?.write(&summary)?;
    }
    let missing: Vec<String> = summary.missing().iter().map(u64::to_string).collect();
    if !missing.is_empty() {
        writeln!(out, "INCOMPLETE: shard {} missing", missing.join(", "))?;
    }
    Ok(match (summary.classes.is_empty(), summary.is_complete() && summary.asked > 0) {
        (false, _) => DISAGREES,
        (true, true) => CONFORMS,
        (true, false) => BAD_INPUT,
    })
}

/// Where cases come from.
enum Source {
    Generated(Generator),
    Drives(Pool),
}

impl Source {
    /// The source, and whether some file could not be read.
    fn new(settings: &Settings, err: &mut impl Write) -> Result<(Self, bool), ConformError> {
        if settings.drives.is_empty() {
            let Settings { seed, profile, .. } = *settings;
            let mut kinds = settings.kinds.clone();
            kinds.sort();
            kinds.dedup();
            return Ok((Self::Generated(Generator { seed, profile, kinds }), false));
        }
        let options = Options { profile: settings.profile, ..Options::default() };
        let (pool, errors) = Pool::read(&settings.drives, &options, settings.seed)?;
        for error in &errors {
            complain(err, &error.to_string());
        }
        Ok((Self::Drives(pool), !errors.is_empty()))
    }

    /// How many cases there are to be.
    fn cases(&self, wanted: Option<u64>) -> u64 {
        match self {
            Self::Generated(_) => wanted.unwrap_or(CASES),
            Self::Drives(pool) => wanted.unwrap_or_else(|| pool.total()),
        }
    }

    fn kinds(&self) -> Vec<Kind> {
        match self {
            Self::Generated(generator) => generator.kinds.clone(),
            Self::Drives(_) => vec![Kind::Cycle],
        }
    }

    fn kind(&self, case: u64) -> Kind {
        match self {
            Self::Generated(generator) => generator.kind(case),
            Self::Drives(_) => Kind::Cycle,
        }
    }

    /// Name and content of a case.
    fn case(&self, case: u64) -> (String, Question) {
        match self {
            Self::Generated(generator) => (format!("c-{case}"), generator.question(case)),
            Self::Drives(pool) => {
                let (name, cycle) = pool.cycle(case);
                (format!("c-{case} {name}"), Question::Cycle(Box::new(cycle)))
            }
        }
    }
}

/// A campaign on its way.
struct Course<'a> {
    settings: &'a Settings,
    source: &'a Source,
    subject: Subject,
    asked: u64,
    skipped: u64,
    tolerated: u64,
    /// Breaks by breach and kind.
    broken: BTreeMap<(Breach, Kind), u64>,
    given_up: Vec<Kind>,
    groups: BTreeMap<(Kind, &'static str, &'static str, &'static str), (u64, u64)>,
    classes: BTreeMap<Class, Found>,
}

impl<'a> Course<'a> {
    fn new(settings: &'a Settings, source: &'a Source, subject: Subject) -> Self {
        Self {
            settings,
            source,
            subject,
            asked: 0,
            skipped: 0,
            tolerated: 0,
            broken: BTreeMap::new(),
            given_up: Vec::new(),
            groups: BTreeMap::new(),
            classes: BTreeMap::new(),
        }
    }

    fn run(&mut self, out: &mut impl Write) -> Result<(), ConformError> {
        let (first, step) = self.settings.shard.unwrap_or((0, 1));
        let cases = self.source.cases(self.settings.cases);
        let here = cases.saturating_sub(first).div_ceil(step);
        let bar = progress(here);
        let mut last = None;
        let mut case = first;
        while case < cases {
            if self.given_up.contains(&self.source.kind(case)) {
                self.skipped += 1;
            } else {
                let (name, question) = self.source.case(case);
                self.ask(case, &name, &question, &bar, out)?;
                last = Some((case, name, question));
            }
            bar.inc(1);
            case = case.saturating_add(step);
        }
        bar.finish_and_clear();
        if let Err(broken) = self.subject.finish()
            && let Some((case, name, question)) = last
        {
            // A line too many behind the last answer.
            let class = Class {
                kind: question.kind(),
                breach: broken.breach,
                place: String::new(),
                profile: String::new(),
                configuration: String::new(),
                scale: Scale::Clear,
            };
            let expected = examine::expect(&name, &question);
            let examined = Examined {
                expected,
                answered: Err(broken),
                class: Some(class.clone()),
                tolerated: false,
            };
            self.count(&question, &examined);
            self.settle(&class, case, &name, &question, &examined, &bar, out)?;
        }
        Ok(())
    }

    fn ask(
        &mut self,
        case: u64,
        name: &str,
        question: &Question,
        bar: &ProgressBar,
        out: &mut impl Write,
    ) -> Result<(), ConformError> {
        let examined = examine(&mut self.subject, name, question, self.settings.tolerance)?;
        self.asked += 1;
        self.tolerated += u64::from(examined.tolerated);
        self.count(question, &examined);
        match examined.class.clone() {
            None => Ok(()),
            Some(class) => self.settle(&class, case, name, question, &examined, bar, out),
        }
    }

    fn count(&mut self, question: &Question, examined: &Examined) {
        let expected = match &examined.expected {
            Expected::Cycle(answer) => {
                answer.as_ref().as_ref().map_or("error", |report| stage_name(report.failed_stage))
            }
            Expected::Composition(Err(_)) => "error",
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
    #[expect(clippy::too_many_arguments, reason = "one case with its answer, and where it is told")]
    fn settle(
        &mut self,
        class: &Class,
        case: u64,
        name: &str,
        question: &Question,
        examined: &Examined,
        bar: &ProgressBar,
        out: &mut impl Write,
    ) -> Result<(), ConformError> {
        let known = self.classes.get(class);
        let known = known.map(|found| (found.count, found.size, found.shrunk, found.first));
        let enough = known.is_some_and(|(count, size, shrunk, _)| {
            (shrunk && size <= SMALL) || count >= SHRUNK || class.breach.is_broken()
        });
        if !enough {
            bar.set_message(format!("shrinking: {class}"));
            let found = self.shrunk(class, case, name, question, examined)?;
            let (count, size, shrunk, first) = known.unwrap_or((0, usize::MAX, false, case));
            if (found.shrunk, size) > (shrunk, found.size) {
                bar.suspend(|| report::found(&found, out).and_then(|()| out.flush()))?;
                self.classes.insert(class.clone(), Found { count, first, ..found });
            }
            bar.set_message("");
        }
        if let Some(found) = self.classes.get_mut(class) {
            found.count += 1;
        }
        if class.breach.is_broken() {
            let times = self.broken.entry((class.breach, class.kind)).or_default();
            *times += 1;
            if *times >= RESTARTS && !self.given_up.contains(&class.kind) {
                self.given_up.push(class.kind);
            }
        }
        Ok(())
    }

    fn shrunk(
        &mut self,
        class: &Class,
        case: u64,
        name: &str,
        question: &Question,
        examined: &Examined,
    ) -> Result<Found, ConformError> {
        let tolerance = self.settings.tolerance;
        let hunt = Hunt::new(&mut self.subject, class, name, tolerance);
        let smallest = match self.source {
            Source::Generated(generator) => {
                let kind = question.kind();
                let read = |tape: &[u32]| generator.read(kind, tape);
                hunt.run(question, Some((generator.tape(case), &read)))?
            }
            Source::Drives(_) => hunt.run(question, None)?,
        };
        let id = class.slug();
        let (told, shown, shrunk) = match smallest {
            None => (explain::explain(question, examined), question, false),
            Some(ref smallest) => {
                let again = examine(&mut self.subject, &id, smallest, tolerance)?;
                (explain::explain(smallest, &again), smallest, true)
            }
        };
        let record = RawValue::from_string(shown.line(&id))
            .map_err(|error| ConformError::Output(error.into()))?;
        Ok(Found {
            class: class.clone(),
            id,
            count: 1,
            first: case,
            name: name.to_owned(),
            told,
            shrunk,
            size: shown.objects(),
            unit: shown.unit().to_owned(),
            record,
        })
    }

    fn summary(mut self) -> Summary {
        self.given_up.sort();
        let Settings { command, profile, seed, time_limit, shard, drives, tolerance, .. } =
            self.settings;
        let (at, of) = shard.unwrap_or((0, 1));
        let text = |word: &OsString| word.to_string_lossy().into_owned();
        let group = |((kind, profile, configuration, expected), (cases, disagreements))| Group {
            kind,
            profile: str::to_owned(profile),
            configuration: str::to_owned(configuration),
            expected: str::to_owned(expected),
            cases,
            disagreements,
        };
        Summary {
            campaign: Campaign {
                command: command.iter().map(text).collect(),
                profile: names::profile(*profile).to_owned(),
                seed: *seed,
                cases: self.source.cases(self.settings.cases),
                kinds: self.source.kinds(),
                drives: drives.iter().map(|path| path.display().to_string()).collect(),
                time_limit_ms: u64::try_from(time_limit.as_millis()).unwrap_or(u64::MAX),
                tolerance: *tolerance,
                of,
            },
            shards: vec![at],
            asked: self.asked,
            skipped: self.skipped,
            tolerated: self.tolerated,
            starts: self.subject.starts(),
            given_up: self.given_up,
            groups: self.groups.into_iter().map(group).collect(),
            classes: self.classes.into_values().collect(),
        }
    }
}

/// A bar on a terminal, nothing elsewhere.
fn progress(cases: u64) -> ProgressBar {
    let bar = ProgressBar::new(cases);
    let style = "{bar:30} {pos}/{len} cases, {per_sec}, {eta} left {msg}";
    if let Ok(style) = ProgressStyle::with_template(style) {
        bar.set_style(style);
    }
    bar
}
