//! The state of one group (`spec/2-offloading.md#requester`).

use crate::input::profile::{HardenedRule, Profile};
use crate::offloading::quality_of_service::Arrivals;
use crate::services::configuration::Source;

/// The state of a group as the protocol names it. Source: `spec/2-offloading.md#requester`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum GroupState {
    /// It runs on station 0.
    Local,
    /// It runs on station 0, and a station was asked to run it.
    Requested {
        /// The station's id.
        station: i64,
        /// The number of the request.
        session: i64,
        /// A confirmation must come before this time, in ns.
        deadline_ns: i64,
    },
    /// It runs on a station.
    Remote {
        /// The station's id.
        station: i64,
        /// The number of the request.
        session: i64,
    },
}

/// The state of a group with what quality of service and H-08 need.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Slot {
    Local,
    Requested { station: i64, session: i64, deadline_ns: i64 },
    Remote { station: i64, session: i64, arrivals: Arrivals, local_computes: bool },
}

impl Slot {
    /// A session confirmed at `now_ns`. By H-08 the local services go on.
    pub(super) const fn activated(
        profile: Profile,
        now_ns: i64,
        station: i64,
        session: i64,
    ) -> Self {
        // CONF-02, CONF-03
        // H-08.2
        let local_computes = profile.has(HardenedRule::H08);
        let arrivals = Arrivals::since_activation(now_ns);
        Self::Remote { station, session, arrivals, local_computes }
    }

    pub(super) const fn state(&self) -> GroupState {
        match *self {
            Self::Local => GroupState::Local,
            Self::Requested { station, session, deadline_ns } => {
                GroupState::Requested { station, session, deadline_ns }
            }
            Self::Remote { station, session, .. } => GroupState::Remote { station, session },
        }
    }

    /// Station and session that the group is requested from or runs on.
    pub(super) const fn in_use(&self) -> Option<(i64, i64)> {
        match *self {
            Self::Local => None,
            Self::Requested { station, session, .. } | Self::Remote { station, session, .. } => {
                Some((station, session))
            }
        }
    }

    /// Whether the local services of the group compute.
    pub(super) const fn local_computes(&self) -> bool {
        match *self {
            Self::Local | Self::Requested { .. } => true,
            Self::Remote { local_computes, .. } => local_computes,
        }
    }

    pub(super) const fn source(&self) -> Source {
        let remote = match *self {
            Self::Local | Self::Requested { .. } => None,
            Self::Remote { station, .. } => Some(station),
        };
        // CONF-01
        Source::of(self.local_computes(), remote)
    }

    /// Without H-08 no local services compute beside remote ones; with it none are stopped before a
    /// result was used.
    pub(super) const fn is_valid(&self, profile: Profile) -> bool {
        match *self {
            Self::Local | Self::Requested { .. } => true,
            Self::Remote { arrivals, local_computes, .. } if profile.has(HardenedRule::H08) => {
                local_computes || arrivals.has_used()
            }
            Self::Remote { local_computes, .. } => !local_computes,
        }
    }
}
