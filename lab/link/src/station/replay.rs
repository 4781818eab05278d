//! The stand-in services: what a drive holds, at the place and time where the vehicle is.

use mufasa::input::cycle::{Ego, Track, TrajectoryPoint};
use mufasa_model::input::cycle::Cycle;
use mufasa_props::bridge;

use crate::play::{Played, moved};

/// Where in its drive a vehicle is.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Replay {
    /// From the time of the drive to the shared clock, ns.
    later_ns: Option<i64>,
}

impl Replay {
    /// Takes the state of the vehicle at a time, ns. Whether it is on the drive.
    pub(super) fn locate(&mut self, played: &Played, stamp_ns: i64, ego: &Ego) -> bool {
        let about_ns = self.later_ns.map(|later_ns| stamp_ns.saturating_sub(later_ns));
        let Some(cycle) = played.find(ego, about_ns).and_then(|index| played.cycle(index)) else {
            return false;
        };
        self.later_ns = Some(stamp_ns.saturating_sub(Played::sensed_ns(cycle)));
        true
    }

    /// The cycle of that time.
    pub(super) fn cycle<'p>(&self, played: &'p Played, stamp_ns: i64) -> Option<&'p Cycle> {
        played.at(stamp_ns.saturating_sub(self.later_ns?))
    }

    /// Plans for that time: the trajectory of the drive with its stamp, if there is one.
    pub(super) fn trajectory(
        &self,
        played: &Played,
        stamp_ns: i64,
    ) -> Option<(i64, Vec<TrajectoryPoint>)> {
        let later_ns = self.later_ns?;
        let owned = bridge::to_impl(self.cycle(played, stamp_ns)?);
        let trajectory = owned.borrow(&[]).trajectory?;
        Some((trajectory.stamp_ns.saturating_add(later_ns), moved(trajectory, later_ns)))
    }

    /// Tracks what was detected at that time: the tracks of the drive with their stamp, numbered from 0,
    /// if there are any.
    pub(super) fn tracks(&self, played: &Played, stamp_ns: i64) -> Option<(i64, Vec<Track>)> {
        let later_ns = self.later_ns?;
        let owned = bridge::to_impl(self.cycle(played, stamp_ns)?);
        let list = owned.borrow(&[]).tracks?;
        let numbered = (0..).zip(list.items).map(|(id, track)| Track { id, ..*track });
        Some((list.stamp_ns.saturating_add(later_ns), numbered.collect()))
    }
}
