//! The fail-safe rule: what the CAV can always do, going on for tau at most and then braking along its
//! path, is examined against everything that moves or stands (H-14, `spec/hardened/H-14.md`).

mod beside;
mod cover;
mod excess;
mod meeting;
mod motion;
mod motions;
pub(crate) mod nodes;
pub(crate) mod path;
pub(crate) mod reach;
pub(crate) mod returns;
pub(crate) mod road;
mod spot;
pub(crate) mod times;
pub(crate) mod widening;
pub(crate) mod work;

use crate::hardened::detection_history::explained::Explained;
use crate::hardened::detection_history::lists::Lists;
use crate::hardened::detection_history::{DetectionHistory, Seen};
use crate::hardened::h14_fail_safe::meeting::Meeting;
use crate::hardened::h14_fail_safe::motions::Motions;
use crate::hardened::h14_fail_safe::nodes::Nodes;
use crate::input::cycle::{Cycle, TrackList, Trajectory};
use crate::input::scratch::Scratch;
use crate::numbers::time::elapsed_ns;
use crate::report::Witness;
use crate::stages::ii_trajectory_to_map::indexed_route::IndexedRoute;

/// What the rule examines; all of it current.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FailSafe<'c, 'a> {
    pub(crate) cycle: &'c Cycle<'a>,
    pub(crate) trajectory: &'c Trajectory<'a>,
    /// By how much the CAV is wider at its places, m.
    pub(crate) aside: f64,
    pub(crate) tracks: Option<&'c TrackList<'a>>,
    pub(crate) history: &'c DetectionHistory<'c, 'a>,
    pub(crate) route: IndexedRoute<'c, 'a>,
    /// What looking back at the tracks said.
    pub(crate) seen: Seen,
}

impl FailSafe<'_, '_> {
    /// Why stage iv fails, or the cycle in its place, if it does. After `look_back`, which left in the
    /// scratch what the CAV saw of the tracks.
    pub(crate) fn failure(&self, scratch: &mut Scratch<'_>) -> Option<Witness> {
        let &Self { cycle, trajectory, aside, tracks, history, .. } = self;
        let detections = history.detections;
        let objects = tracks.map_or(0, |list| list.items.len());
        let detected = detections.map_or(0, |list| list.items.len());
        // H-14.16
        if objects.max(detected) == 0 {
            return None;
        }
        let nodes = Nodes::new(cycle, trajectory.points);
        if let (Seen::Unclear(witness), true) = (self.seen, tracks.is_some()) {
            // Where stage i ran, it has failed.
            return Some(witness);
        }
        let explained = Explained::new(history, tracks, scratch);
        let mut motions = Motions {
            meeting: Meeting::new(nodes, trajectory.points, aside, self.route),
            history,
            lists: Lists::new(cycle, history, tracks),
            explained: &explained,
            first: None,
        };
        let age = |stamp_ns: i64| elapsed_ns(stamp_ns, cycle.now_ns);
        if let Some(list) = tracks {
            motions.tracks(list, age(list.stamp_ns));
        }
        if let Some(list) = detections {
            motions.detections(list, age(list.stamp_ns), tracks, scratch);
        }
        let failure = motions.lists.work.failure();
        failure.or_else(|| motions.first.map(|found| found.witness))
    }
}
