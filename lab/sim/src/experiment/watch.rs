//! What an experiment sees of a run while it is made.

use crate::attack::Attack;
use crate::cav::Cav;
use crate::cav::guard::Decided;
use crate::named::named;
use crate::run::{Cycle, Watcher};
use crate::snapshot::Snapshot;

named! {
    /// Where a cycle failed.
    By {
        /// Track validation.
        I = "i",
        /// Trajectory to map validation.
        Ii = "ii",
        /// Trajectory validation with tracks.
        Iii = "iii",
        /// Trajectory validation with detections.
        Iv = "iv",
        /// Trajectory validation with the grid.
        V = "v",
        /// Nothing examined the trajectory (H-05).
        NoObstacleCheck = "no obstacle check",
        /// The input was invalid.
        Input = "input",
    }
}

impl By {
    pub(super) fn of(code: u8) -> Option<Self> {
        Self::ALL.get(usize::from(code).checked_sub(1)?).copied()
    }
}

/// The first detection after a time, counted over the cycles with something remote.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct First {
    /// Where the cycle failed.
    pub by: By,
    /// Cycles with something remote up to this one, which counts.
    pub cycles: u64,
    /// Way driven in them, m.
    pub metres: f64,
}

/// Counts how offloading ends, and how many attacks go on at the same time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Watch {
    from: f64,
    attacks: Vec<Attack>,
    last: Option<Cycle>,
    /// Cycles with something remote from the time on, until the first detection.
    pub cycles: u64,
    /// Way driven in them, m.
    pub metres: f64,
    /// The first detection from the time on.
    pub first: Option<First>,
    /// Cycles with something remote that failed: each takes everything back.
    pub fallbacks: u64,
    /// Cycles with both groups remote.
    pub both: u64,
    /// How often a group was no longer remote although the cycle before was safe: late data or silence, or
    /// the end of its area.
    pub lost: u64,
    /// When something was remote last, s.
    pub remote_at: Option<f64>,
    /// The most attacks that went on at the same time.
    pub most_at_once: usize,
    /// Cycles in which two attacks or more went on.
    pub several: u64,
}

impl Watch {
    /// Looks for the first detection from this time on, s, in a run with these attacks.
    pub fn new(from: f64, attacks: &[Attack]) -> Self {
        Self { from, attacks: attacks.to_vec(), ..Self::default() }
    }

    /// Counts a cycle.
    pub fn see(&mut self, cycle: &Cycle) {
        let failed = By::of(cycle.failed).filter(|_| cycle.remote != 0);
        let before = self.last.replace(*cycle);
        self.fallbacks += u64::from(failed.is_some());
        self.remote_at = Some(cycle.t).filter(|_| cycle.remote != 0).or(self.remote_at);
        self.both += u64::from(cycle.remote == 3);
        let going_on = |it: &&Attack| it.from <= cycle.t && cycle.t < it.until;
        let count = self.attacks.iter().filter(going_on).count();
        self.most_at_once = self.most_at_once.max(count);
        self.several += u64::from(count > 1);
        let ended = before.filter(|it| it.failed == 0).map_or(0, |it| it.remote & !cycle.remote);
        self.lost += u64::from(ended.count_ones());
        if cycle.remote == 0 || cycle.t < self.from || self.first.is_some() {
            return;
        }
        self.cycles += 1;
        let driven = before.filter(|it| it.t >= self.from && it.remote != 0);
        self.metres += driven.map_or(0.0, |it| cycle.s - it.s);
        self.first = failed.map(|by| First { by, cycles: self.cycles, metres: self.metres });
    }
}

impl Watcher for Watch {
    fn cycle(&mut self, _: &Snapshot, _: &Cav<'_>, _: &Decided, cycle: &Cycle) {
        self.see(cycle);
    }
}
