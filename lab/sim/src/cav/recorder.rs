//! Keeps cycles that the monitor is asked about as the model has them: to be checked by it, and for logs. That they are
//! the monitor's is tested by their verdicts (`lab/sim/tests/loop/records.rs`).

use mufasa::input::cycle::CrossSection;
use mufasa_model::input::cycle::Cycle;
use mufasa_props::bridge;

use super::assembled::{Cycles, Known, Results};
use super::sensing::Sensed;
use crate::settings::Settings;
pub use crate::settings::Share;

/// Keeps cycles.
#[derive(Debug)]
pub(super) struct Recorder<'s> {
    share: Share,
    /// None: nothing is recorded.
    cycles: Option<Cycles<'s>>,
    /// Cycles up to now.
    count: u64,
}

impl<'s> Recorder<'s> {
    /// Keeps the share of the cycles that is set.
    pub(super) fn new(settings: &'s Settings, cross_sections: &[CrossSection]) -> Self {
        let share = settings.recorded;
        let cycles = Cycles::new(settings, cross_sections).filter(|_| share.every > 0);
        Self { share, cycles, count: 0 }
    }

    /// The cycle that is about to be decided, if it is of the share.
    pub(super) fn cycle(&mut self, known: &Known<'_>, results: Results<'_>) -> Option<Box<Cycle>> {
        let cycles = self.cycles.as_ref()?;
        let Share { every, first } = self.share;
        let is_kept = self.count % every == first % every;
        self.count += 1;
        is_kept.then(|| Box::new(cycles.with(known, results, bridge::from_impl)))
    }

    /// The cycle with the results of the CAV's own services alone.
    pub(super) fn local(&self, known: &Known<'_>, results: Results<'_>) -> Option<Cycle> {
        self.cycles.as_ref().map(|it| it.with(known, results, bridge::from_impl))
    }

    /// The cycle was one with valid input: its detections are those of later cycles' history.
    pub(super) fn see(&mut self, sensed: &Sensed) {
        if let Some(cycles) = &mut self.cycles {
            cycles.see(sensed.stamp_ns, &sensed.detections);
        }
    }
}
