//! What the requester remembers of a group (`spec/2-offloading.md#requester`).

use std::hash::{Hash, Hasher};

/// The use of other stations for one group.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Use {
    Local,
    Requested { station: i64, session: i64, deadline_ns: i64 },
    Remote(Session),
}

impl Use {
    /// Station and session that the group is requested from or runs on.
    pub(super) fn partner(&self) -> Option<(i64, i64)> {
        match *self {
            Self::Local => None,
            Self::Requested { station, session, .. }
            | Self::Remote(Session { station, number: session, .. }) => Some((station, session)),
        }
    }
}

/// Whether who is left is told.
#[derive(Clone, Copy)]
pub(super) enum Farewell {
    Release,
    Silent,
}

/// A running session. `spec/2-offloading.md#quality-of-service`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Session {
    /// On which station, >= 1.
    pub station: i64,
    /// Number of the request that led here.
    pub number: i64,
    /// Time of the last arrival, or of the activation.
    pub last_arrival_ns: i64,
    /// Generation time of the last element used since the activation.
    pub last_used_generated_ns: Option<i64>,
    /// Whether the local services of the group still compute (H-08).
    pub local_computes: bool,
}

/// A number for information only: it makes no two states different.
#[derive(Clone, Copy, Debug)]
pub(super) struct Count(pub(super) u64);

impl PartialEq for Count {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Eq for Count {}

impl Hash for Count {
    fn hash<H: Hasher>(&self, _: &mut H) {}
}
