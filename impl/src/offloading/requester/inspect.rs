//! What a requester remembers, for those who compare it, and a requester put aside and taken up.

use super::per_group::PerGroup;
use super::slot::Slot;
use super::stations::Stations;
use super::{Group, Groups, Parameters, Requester, StationRecord};
use crate::input::profile::Profile;

/// A running session. Source: `spec/2-offloading.md#quality-of-service`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Running {
    /// The station's id.
    pub station: i64,
    /// The number of the request that led here.
    pub session: i64,
    /// Time of the last arrival, or of the activation, in ns.
    pub last_arrival_ns: i64,
    /// Generation time of the last element used since the activation, in ns.
    pub last_used_ns: Option<i64>,
    /// Whether the local services of the group still compute (H-08).
    pub local_computes: bool,
}

/// All of a requester but its table. Source: `spec/2-offloading.md#requester`.
#[derive(Clone, Copy, Debug)]
pub struct Suspended {
    pub(super) profile: Profile,
    pub(super) parameters: Parameters,
    pub(super) slots: PerGroup<Slot>,
    pub(super) hold_until_ns: Option<i64>,
    pub(super) area: Groups,
    pub(super) sessions: i64,
    pub(super) dropped: PerGroup<u64>,
}

impl<'a> Requester<'a> {
    /// The running session of a remote group. Source: `spec/2-offloading.md#requester`.
    pub const fn session_of(&self, group: Group) -> Option<Running> {
        match *self.slots.get(group) {
            Slot::Local | Slot::Requested { .. } => None,
            Slot::Remote { station, session, arrivals, local_computes } => Some(Running {
                station,
                session,
                last_arrival_ns: arrivals.last_arrival_ns(),
                last_used_ns: arrivals.last_used_ns(),
                local_computes,
            }),
        }
    }

    /// Whether a tick now would end the session of a remote group for its silence.
    pub(crate) fn is_silent(&self, group: Group, now_ns: i64) -> bool {
        match self.slots.get(group) {
            Slot::Local | Slot::Requested { .. } => false,
            Slot::Remote { arrivals, .. } => {
                arrivals.silence(now_ns, self.parameters.limits()).is_some()
            }
        }
    }

    /// The groups that may be offloaded here (CODM). Source: `spec/2-offloading.md#requester`.
    pub const fn area(&self) -> Groups {
        self.area
    }

    /// Times in force.
    pub(crate) const fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    /// The requester without its table, so that the table need not stay borrowed between events.
    /// Source: `spec/2-offloading.md#requester`.
    pub const fn suspend(&self) -> Suspended {
        Suspended {
            profile: self.profile,
            parameters: self.parameters,
            slots: self.slots,
            hold_until_ns: self.hold_until_ns,
            area: self.area,
            sessions: self.sessions,
            dropped: self.dropped,
        }
    }

    /// The requester again. `table`: the one it had, or a copy, unchanged since; with another one
    /// it remembers other offers and requests, which `is_valid` may tell. Source:
    /// `spec/2-offloading.md#requester`.
    pub const fn resume(suspended: Suspended, table: &'a mut [StationRecord]) -> Self {
        let Suspended { profile, parameters, slots, hold_until_ns, area, sessions, dropped } =
            suspended;
        Self {
            profile,
            parameters,
            slots,
            hold_until_ns,
            area,
            sessions,
            dropped,
            stations: Stations::resume(table),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::input::profile::Profile;
    use crate::offloading::requester::{
        Event, EventKind, Group, Groups, Parameters, Requester, RequesterError, Sessions,
        StationRecord,
    };

    #[test]
    fn a_requester_put_aside_goes_on_as_if_nothing_had_been() -> Result<(), RequesterError> {
        let events = [
            EventKind::Offer { station: 2, groups: Groups::ALL },
            EventKind::Tick,
            EventKind::Confirm { station: 2, group: Group::Plan, session: 2 },
            EventKind::Data { station: 2, group: Group::Plan, session: 2, generated_ns: 0 },
            EventKind::Verdict { safe: true, sessions: Sessions { mot: None, plan: Some(2) } },
            EventKind::Area { groups: Groups::from(Group::Mot) },
            EventKind::Verdict { safe: false, sessions: Sessions::NONE },
            EventKind::Tick,
        ];
        for profile in [Profile::PAPER, Profile::HARDENED] {
            let mut table = [StationRecord::FREE; 2];
            let mut whole = Requester::new(profile, Parameters::default(), &mut table)?;
            let mut copy = [StationRecord::FREE; 2];
            let mut aside = whole.suspend();
            for (t_ns, kind) in (0..).zip(events) {
                let event = Event { t_ns, kind };
                let mut resumed = Requester::resume(aside, &mut copy);
                assert_eq!(resumed.step(&event)?, whole.step(&event)?);
                for group in Group::ALL {
                    assert_eq!(resumed.state(group), whole.state(group));
                    assert_eq!(resumed.session_of(group), whole.session_of(group));
                }
                assert_eq!(resumed.area(), whole.area());
                assert_eq!(resumed.hold_until_ns(), whole.hold_until_ns());
                aside = resumed.suspend();
                assert_eq!(copy.as_slice(), whole.stations());
            }
            assert!(whole.hold_until_ns().is_some() && whole.sessions() == 2);
        }
        Ok(())
    }
}
