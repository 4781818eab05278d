//! What the requester remembers, for those who compare or explore it; nothing here decides.

use super::Requester;
use super::state::{Session, Use};
use crate::services::configuration::{Group, Groups};

impl Requester {
    /// The running session of a remote group. `spec/2-offloading.md#quality-of-service`.
    pub fn session_of(&self, group: Group) -> Option<Session> {
        match *self.group(group) {
            Use::Remote(session) => Some(session),
            Use::Local | Use::Requested { .. } => None,
        }
    }

    /// The groups that a station offers now. `spec/2-offloading.md#requester`.
    pub fn offered(&self, station: i64) -> Groups {
        self.offers.get(&station).copied().unwrap_or(Groups::NONE)
    }

    /// The groups that may be offloaded here (CODM). `spec/2-offloading.md#requester`.
    pub fn in_area(&self) -> Groups {
        self.area
    }

    /// Number of the last request to a station for a group. `spec/2-offloading.md#requester`.
    pub fn last_asked(&self, group: Group, station: i64) -> Option<i64> {
        self.last_asked.get(&(group, station)).copied()
    }

    /// Number of the last request; 0 before the first. `spec/2-offloading.md#requester`.
    pub fn last_session(&self) -> i64 {
        self.last_session
    }
}
