//! The experiments, and how each is shown.

use mufasa_sim::experiment::attacks::ATTACKS;
use mufasa_sim::experiment::availability::AVAILABILITY;
use mufasa_sim::experiment::combinations::COMBINATIONS;
use mufasa_sim::experiment::failures::FAILURES;
use mufasa_sim::experiment::left_out::LEFT_OUT;
use mufasa_sim::experiment::made::{Experiment, Made};
use mufasa_sim::experiment::readings::READINGS;
use mufasa_sim::experiment::row::Row;
use mufasa_sim::experiment::stages::STAGES;

use super::plots::figures::{self, Figure};
use super::tables::{self, Column};

/// An experiment, and how it is shown.
pub(super) struct Shown {
    pub(super) experiment: Experiment,
    pub(super) columns: &'static [Column<Row>],
    pub(super) figures: fn(&Made) -> Vec<Figure>,
    /// Whether a run that fails is named: where something is left out it is no failure of the profile.
    pub(super) names_failures: bool,
}

const fn shown(
    experiment: Experiment,
    columns: &'static [Column<Row>],
    figures: fn(&Made) -> Vec<Figure>,
) -> Shown {
    Shown { experiment, columns, figures, names_failures: true }
}

/// All.
pub(super) const EXPERIMENTS: [Shown; 7] = [
    shown(FAILURES, tables::FAILURES, figures::failures),
    shown(READINGS, tables::READINGS, figures::readings),
    shown(STAGES, tables::STAGES, figures::stages),
    shown(ATTACKS, tables::ATTACKS, figures::attacks),
    shown(COMBINATIONS, tables::COMBINATIONS, figures::combinations),
    shown(AVAILABILITY, tables::AVAILABILITY, figures::availability),
    Shown { names_failures: false, ..shown(LEFT_OUT, tables::LEFT_OUT, figures::left_out) },
];

/// The one of this name.
pub(super) fn named(name: &str) -> Option<&'static Shown> {
    const ALL: &[Shown] = &EXPERIMENTS;
    ALL.iter().find(|it| it.experiment.name == name)
}
