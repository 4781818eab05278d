//! The experiments behind one face: what is made, and how it is shown.

use mufasa_sim::cav::guard::Variant;
use mufasa_sim::experiment::attacks::{self, Attacks};
use mufasa_sim::experiment::availability::{self, Availability};
use mufasa_sim::experiment::combinations::{self, Combinations};
use mufasa_sim::experiment::failures::{self, Failures};
use mufasa_sim::experiment::job::{Campaign, ExperimentError, Job, Options};
use mufasa_sim::experiment::left_out::{self, LeftOuts};
use mufasa_sim::experiment::readings::{self, Readings};
use mufasa_sim::experiment::stages::{self, Stages};
use mufasa_sim::map::Town;
use mufasa_sim::run::End;
use serde::Serialize;

use super::plots::figures::{self, Figure};
use super::tables;
use crate::rows::Rows;

/// A run that failed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Failed {
    pub(super) id: String,
    pub(super) variant: Variant,
    pub(super) end: End,
}

/// An experiment that was made.
pub(super) trait Shown: Serialize + Sized {
    /// Its name.
    const NAME: &'static str;
    /// How large it is by default.
    const OPTIONS: Options;
    /// A row of its table.
    type Row: Serialize;
    /// A run.
    type Run: Serialize;

    /// Its runs.
    fn jobs(town: &Town, options: Options) -> Vec<Job<()>>;

    /// Makes it.
    fn make(campaign: &Campaign<'_>) -> Result<Self, ExperimentError>;

    fn rows(&self) -> &[Self::Row];
    fn runs(&self) -> &[Self::Run];
    fn failed(&self) -> Vec<Failed>;
    fn table(&self) -> Rows;
    fn figures(&self) -> Vec<Figure>;
}

/// The modules of experiments, what each makes, and how a run of it ended.
macro_rules! shown {
    ($($module:ident: $made:ident, $end:expr;)*) => {$(
        impl Shown for $made {
            const NAME: &'static str = $module::NAME;
            const OPTIONS: Options = $module::OPTIONS;
            type Row = $module::Row;
            type Run = $module::Run;

            fn jobs(town: &Town, options: Options) -> Vec<Job<()>> {
                $module::jobs(town, options).into_iter().map(Job::plain).collect()
            }

            fn make(campaign: &Campaign<'_>) -> Result<Self, ExperimentError> {
                $module::experiment(campaign)
            }

            fn rows(&self) -> &[Self::Row] {
                &self.rows
            }

            fn runs(&self) -> &[Self::Run] {
                &self.runs
            }

            fn failed(&self) -> Vec<Failed> {
                let end: fn(&Self::Run) -> Option<End> = $end;
                let failed = self.runs.iter().filter_map(|run| {
                    let end = end(run).filter(|end| end.is_failure())?;
                    Some(Failed { id: run.id.clone(), variant: run.variant, end })
                });
                failed.collect()
            }

            fn table(&self) -> Rows {
                tables::$module(self)
            }

            fn figures(&self) -> Vec<Figure> {
                figures::$module(self)
            }
        }
    )*};
}

shown! {
    failures: Failures, |run| Some(run.end);
    readings: Readings, |run| Some(run.end);
    stages: Stages, |run| Some(run.end);
    attacks: Attacks, |run| Some(run.end);
    combinations: Combinations, |run| Some(run.end);
    availability: Availability, |run| Some(run.end);
    left_out: LeftOuts, |_| None;
}
