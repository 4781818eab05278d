//! Keeps cycles that the monitor is asked about as the model has them: to be checked by it, and for logs.
//!
//! The monitor lets nobody look at its cycle. So it is put together a second time, by rules of the same
//! text (`spec/monitor.md#monitor`); that both are one is tested by their verdicts
//! (`lab/sim/tests/loop/records.rs`).

use mufasa::input::cycle::{Ego, Route};
use mufasa::input::parameters::Parameters;
use mufasa::input::profile::Profile;
use mufasa::offloading::requester::Requester;
use mufasa_model::input::cycle::Cycle;
use mufasa_props::bridge;

use super::assembled::{self, Chosen, Fixed};
use super::seen::Seen;
use super::sensing::Sensed;
use super::withheld::Withheld;

/// Which cycles are kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Share {
    /// Each so many is; 0: none is.
    pub every: u64,
    /// The first is so many cycles after the start, modulo `every`.
    pub first: u64,
}

impl Share {
    /// All.
    pub const ALL: Self = Self { every: 1, first: 0 };
}

/// Keeps cycles.
#[derive(Debug, Default)]
pub struct Recorder {
    share: Share,
    /// None: nothing is recorded.
    fixed: Option<Fixed>,
    /// Cycles up to now.
    count: u64,
    seen: Seen,
}

impl Recorder {
    /// Keeps this share of the cycles of a profile.
    pub fn new(share: Share, profile: Profile, parameters: Parameters) -> Self {
        let fixed = Fixed { profile, parameters, route: (false, Vec::new()), withheld: None };
        let fixed = Some(fixed).filter(|_| share.every > 0);
        Self { share, fixed, ..Self::default() }
    }

    /// The same without what the stages do not get.
    pub(super) fn withhold(&mut self, withheld: Option<Withheld>) {
        if let Some(fixed) = &mut self.fixed {
            fixed.withheld = withheld;
        }
    }

    pub(super) fn set_route(&mut self, route: &Route<'_>) {
        if let Some(fixed) = &mut self.fixed {
            fixed.route = (route.closed, route.cross_sections.to_vec());
        }
    }

    /// The cycle that is about to be decided, if it is of the share.
    pub(super) fn cycle(
        &mut self,
        requester: &Requester<'_>,
        moment: (i64, Ego),
        sensed: &Sensed,
        chosen: Chosen<'_>,
    ) -> Option<Box<Cycle>> {
        let fixed = self.fixed.as_ref()?;
        let Share { every, first } = self.share;
        let count = self.count;
        self.count += 1;
        if count % every != first % every {
            return None;
        }
        let history = if fixed.profile.looks_back() {
            self.seen.history(sensed.stamp_ns)
        } else {
            Vec::new()
        };
        let cycle =
            assembled::cycle(fixed, requester.configuration(), moment, sensed, chosen, &history);
        Some(Box::new(bridge::from_impl(&cycle)))
    }

    /// The cycle was one with valid input: its detections are those of later cycles' history.
    pub(super) fn see(&mut self, sensed: &Sensed) {
        if self.fixed.is_some() {
            self.seen.see(sensed.stamp_ns, &sensed.detections);
        }
    }
}
