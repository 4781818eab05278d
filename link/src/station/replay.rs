//! The stand-in services: what a drive holds, at the place and time where the vehicle is.

use mufasa::input::cycle::{Ego, Track, TrajectoryPoint};
use mufasa_props::bridge;

use crate::play::{Played, moved};

/// Where in its drive a vehicle is.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Replay {
    /// From the time of the drive to the shared clock, ns.
    later_ns: Option<i64>,
}

impl Replay {
    /// Takes the state of the vehicle, and plans: the trajectory of the cycle that it senses, with its
    /// stamp, if there is one. `None`: it is not on the drive.
    pub(super) fn state(
        &mut self,
        played: &Played,
        stamp_ns: i64,
        ego: &Ego,
    ) -> Option<Option<(i64, Vec<TrajectoryPoint>)>> {
        let about_ns = self.later_ns.map(|later_ns| stamp_ns.saturating_sub(later_ns));
        let cycle = played.cycle(played.find(ego, about_ns)?)?;
        let later_ns = stamp_ns.saturating_sub(Played::sensed_ns(cycle));
        self.later_ns = Some(later_ns);
        let owned = bridge::to_impl(cycle);
        let trajectory = owned.borrow(&[]).trajectory;
        Some(trajectory.map(|it| (it.stamp_ns.saturating_add(later_ns), moved(it, later_ns))))
    }

    /// Tracks what was detected at that time: the tracks of the drive with their stamp, numbered from 0,
    /// if there are any.
    pub(super) fn tracks(&self, played: &Played, stamp_ns: i64) -> Option<(i64, Vec<Track>)> {
        let later_ns = self.later_ns?;
        let owned = bridge::to_impl(played.at(stamp_ns.saturating_sub(later_ns))?);
        let list = owned.borrow(&[]).tracks?;
        let numbered = (0..).zip(list.items).map(|(id, track)| Track { id, ..*track });
        Some((list.stamp_ns.saturating_add(later_ns), numbered.collect()))
    }
}
