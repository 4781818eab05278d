//! The requester of the CAV: which group runs where, and the fallback to local services
//! (`spec/2-offloading.md#requester`, `#quality-of-service`, `#fallback`).
//!
//! Where the text leaves a choice, this is how it is read:
//!
//! * A message speaks of a session only if station, group and number all fit: another station can
//!   neither reject nor confirm it, and is answered as for any other session.
//! * The hold bars requests. A group that the hold did not return to local (with `qos_hold`, the
//!   other one) stays in use.
//! * After the request numbered 2^63 - 1 no request is sent any more; everything else goes on.

mod event;
mod inspect;
pub(crate) mod parameters;
pub(crate) mod per_group;
mod restore;
mod slot;
mod stations;
mod steps;

#[cfg(test)]
mod tests;

pub(crate) use self::event::ByKind;
pub use self::event::{Action, Actions, Event, EventKind, Sessions};
pub use self::inspect::{Running, Suspended};
pub use self::parameters::Parameters;
pub use self::restore::{GroupRecord, Parts};
pub use self::slot::GroupState;
pub use self::stations::StationRecord;
pub use crate::services::configuration::{Group, Groups, Source};

use self::per_group::PerGroup;
use self::slot::Slot;
use self::stations::Stations;
use crate::input::profile::Profile;
use crate::services::configuration::Configuration;

/// Why a requester could not be made, or an event not be taken; then nothing has changed. Source:
/// `spec/2-offloading.md#requester`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RequesterError {
    /// A parameter is below 0; it must be from 0 to 2^63 - 1.
    NegativeParameter {
        /// The parameter.
        field: &'static str,
    },
    /// The event names a station below 1; station 0 is the CAV itself.
    Station {
        /// The station's id.
        station: i64,
    },
    /// An offer of a station that is not in the table, which is full. Lend a table of as many
    /// places as there are stations that ever offer something.
    TableFull {
        /// The station's id.
        station: i64,
        /// Places of the table.
        capacity: usize,
    },
}

impl core::fmt::Display for RequesterError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match *self {
            Self::NegativeParameter { field } => {
                write!(f, "{field} is below 0; it must be from 0 to 2^63 - 1")
            }
            Self::Station { station } => {
                write!(f, "station {station} is below 1; stations of events are remote")
            }
            Self::TableFull { station, capacity } => write!(
                f,
                "no place for station {station}: all {capacity} places of the table are taken; \
                 lend a larger table"
            ),
        }
    }
}

impl core::error::Error for RequesterError {}

/// The requester. The same events give the same states and actions; time is an argument of every
/// event. Source: `spec/2-offloading.md#requester`.
#[derive(Debug)]
pub struct Requester<'a> {
    profile: Profile,
    parameters: Parameters,
    // REQ-26
    slots: PerGroup<Slot>,
    hold_until_ns: Option<i64>,
    area: Groups,
    /// The number of requests so far, which is the last session.
    sessions: i64,
    dropped: PerGroup<u64>,
    stations: Stations<'a>,
}

impl<'a> Requester<'a> {
    /// Both groups local, no offers, no hold, all groups in the area. `table` is cleared.
    ///
    /// Errors: a parameter below 0. Source: `spec/2-offloading.md#requester`.
    pub fn new(
        profile: Profile,
        parameters: Parameters,
        table: &'a mut [StationRecord],
    ) -> Result<Self, RequesterError> {
        if let Some(field) = parameters.negative() {
            return Err(RequesterError::NegativeParameter { field });
        }
        Ok(Self {
            profile,
            parameters,
            slots: PerGroup::new(Slot::Local, Slot::Local),
            hold_until_ns: None,
            // REQ-17
            area: Groups::ALL,
            sessions: 0,
            dropped: PerGroup::new(0, 0),
            stations: Stations::new(table),
        })
    }

    /// The state of a group. Source: `spec/2-offloading.md#requester`.
    pub const fn state(&self, group: Group) -> GroupState {
        self.slots.get(group).state()
    }

    /// No request is sent before this time, in ns; the last value stays when it has passed.
    /// `None`: there never was a hold. Source: `spec/2-offloading.md#fallback`.
    pub const fn hold_until_ns(&self) -> Option<i64> {
        self.hold_until_ns
    }

    /// Whose results of a group may reach control. Source: `spec/1-services.md#configuration`.
    pub const fn source(&self, group: Group) -> Source {
        self.slots.get(group).source()
    }

    /// The configuration for the stages: a group is remote from its confirmation on, also while
    /// its local services still compute (H-08), because its results have to be checked first.
    /// Source: `spec/1-services.md#configuration`.
    pub const fn configuration(&self) -> Configuration {
        Configuration::of(Groups {
            mot: matches!(self.state(Group::Mot), GroupState::Remote { .. }),
            plan: matches!(self.state(Group::Plan), GroupState::Remote { .. }),
        })
    }

    /// How many elements of a group were dropped because their session was not the running one.
    /// Source: `spec/2-offloading.md#requester`.
    pub const fn dropped(&self, group: Group) -> u64 {
        *self.dropped.get(group)
    }

    /// The number of requests so far, which is the last session. Source:
    /// `spec/2-offloading.md#requester`.
    pub const fn sessions(&self) -> i64 {
        self.sessions
    }

    /// The table with the stations that are remembered. Source: `spec/2-offloading.md#requester`.
    pub const fn stations(&self) -> &[StationRecord] {
        self.stations.records()
    }

    /// What holds in every reachable state: a group in use is in the area, its station offers it
    /// and was asked for it last in this session; sessions are numbered within the requests so
    /// far, and no two are the same; local services are stopped only as the profile allows. Source:
    /// `spec/2-offloading.md#requester`.
    pub fn is_valid(&self) -> bool {
        let group_is_valid = |group| {
            let slot = self.slots.get(group);
            slot.is_valid(self.profile)
                && slot.in_use().is_none_or(|(station, session)| {
                    let offered_and_asked = |record: &StationRecord| {
                        record.offer().contains(group)
                            && record.last_request(group) == Some(session)
                    };
                    self.area.contains(group)
                        && self.stations.find(station).is_some_and(offered_and_asked)
                })
        };
        self.parameters.negative().is_none()
            && self.sessions >= 0
            && self.stations.is_valid(self.sessions)
            && Group::ALL.into_iter().all(group_is_valid)
    }
}
