//! What a monitor remembers, for those who compare or explore it; nothing here decides.

use super::Monitor;
use super::elements::of_session;
use super::wait::Use;
use crate::offloading::requester::Requester;
use crate::services::configuration::Group;

impl Monitor {
    /// The requester beneath it.
    pub fn requester(&self) -> &Requester {
        &self.requester
    }

    /// Of what use the running session of a group was.
    pub fn use_of(&self, group: Group) -> Option<Use> {
        self.uses.get(&group).map(|(_, used)| *used)
    }

    /// Stamp of the element of a group that a cycle would use now, ns.
    pub fn stamp_ns(&self, group: Group) -> Option<i64> {
        let running = self.requester.session_of(group);
        match group {
            Group::Mot => of_session(self.tracks.as_ref(), running).map(|it| it.content.stamp_ns),
            Group::Plan => {
                of_session(self.trajectory.as_ref(), running).map(|it| it.content.stamp_ns)
            }
        }
    }

    /// Stamps of the lists of detections that are kept, ns, the youngest first.
    pub fn kept_ns(&self) -> impl Iterator<Item = i64> {
        self.history.stamps_ns()
    }
}
