//! Where the cases of a campaign come from.

use std::io::Write;

use crate::cases::drives::Pool;
use crate::cases::generate::Generator;
use crate::cases::question::Question;
use crate::error::ConformError;
use crate::judge::class::Kind;
use crate::settings::Settings;
use mufasa_drives::Options;
use mufasa_drives::check::complain;

/// Generated cases unless the number is given.
pub const CASES: u64 = 10_000;

/// Cases by their number.
#[derive(Debug)]
pub enum Source {
    /// Drawn.
    Generated(Generator),
    /// Of drives.
    Drives(Pool),
}

impl Source {
    /// The source, and whether some file could not be read, which is complained of on `err`.
    /// Errors: there is no cycle in the files.
    pub fn new(settings: &Settings, err: &mut impl Write) -> Result<(Self, bool), ConformError> {
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
    pub fn cases(&self, wanted: Option<u64>) -> u64 {
        match self {
            Self::Generated(_) => wanted.unwrap_or(CASES),
            Self::Drives(pool) => wanted.unwrap_or_else(|| pool.total()),
        }
    }

    /// The kinds of records among them.
    pub fn kinds(&self) -> Vec<Kind> {
        match self {
            Self::Generated(generator) => generator.kinds.clone(),
            Self::Drives(_) => vec![Kind::Cycle],
        }
    }

    /// The kind of a case.
    pub fn kind(&self, case: u64) -> Kind {
        match self {
            Self::Generated(generator) => generator.kind(case),
            Self::Drives(_) => Kind::Cycle,
        }
    }

    /// Name and content of a case.
    pub fn case(&self, case: u64) -> (String, Question) {
        match self {
            Self::Generated(generator) => (format!("c-{case}"), generator.question(case)),
            Self::Drives(pool) => {
                let (name, cycle) = pool.cycle(case);
                (format!("c-{case} {name}"), Question::Cycle(Box::new(cycle)))
            }
        }
    }
}
