//! A requester from its parts: to take up one that was stored, or to reason about an arbitrary one.
//!
//! Nothing is repaired here. `Requester::is_valid` says of the resumed requester whether its parts
//! fit together as those of every reachable one do; only then do the guarantees of
//! `spec/2-offloading.md` hold of it.

use super::inspect::{Running, Suspended};
use super::per_group::PerGroup;
use super::slot::Slot;
use super::{Group, Groups, Parameters, StationRecord};
use crate::input::profile::Profile;
use crate::offloading::quality_of_service::Arrivals;

/// All that a requester remembers of one group. Source: `spec/2-offloading.md#requester`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum GroupRecord {
    /// It runs on station 0.
    Local,
    /// A station was asked to run it.
    Requested {
        /// The station's id.
        station: i64,
        /// The number of the request.
        session: i64,
        /// A confirmation must come before this time, in ns.
        deadline_ns: i64,
    },
    /// It runs on a station.
    Remote(Running),
}

/// All that a requester remembers, but for its table. Times in ns. Source:
/// `spec/2-offloading.md#requester`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Parts {
    /// Profile in force.
    pub profile: Profile,
    /// Times in force.
    pub parameters: Parameters,
    /// MOT and PLAN.
    pub groups: [GroupRecord; 2],
    /// End of the last hold.
    pub hold_until_ns: Option<i64>,
    /// The groups that may be offloaded here (CODM).
    pub area: Groups,
    /// The number of requests so far.
    pub sessions: i64,
    /// How many elements of MOT and PLAN were dropped as of another session.
    pub dropped: [u64; 2],
}

impl Suspended {
    /// The requester with these parts, put aside; `Requester::resume` gives it its table. Source:
    /// `spec/2-offloading.md#requester`.
    pub const fn from_parts(parts: &Parts) -> Self {
        let [mot, plan] = parts.groups;
        let [dropped_mot, dropped_plan] = parts.dropped;
        Self {
            profile: parts.profile,
            parameters: parts.parameters,
            slots: PerGroup::new(slot(mot), slot(plan)),
            hold_until_ns: parts.hold_until_ns,
            area: parts.area,
            sessions: parts.sessions,
            dropped: PerGroup::new(dropped_mot, dropped_plan),
        }
    }

    /// The parts of the requester that was put aside. Source: `spec/2-offloading.md#requester`.
    pub const fn parts(&self) -> Parts {
        Parts {
            profile: self.profile,
            parameters: self.parameters,
            groups: [record(self.slots.get(Group::Mot)), record(self.slots.get(Group::Plan))],
            hold_until_ns: self.hold_until_ns,
            area: self.area,
            sessions: self.sessions,
            dropped: [*self.dropped.get(Group::Mot), *self.dropped.get(Group::Plan)],
        }
    }
}

impl StationRecord {
    /// The place of a station. `last_request`: the sessions of its last requests for MOT and PLAN.
    /// A station that offers nothing and was never asked leaves its place free. Source:
    /// `spec/2-offloading.md#requester`.
    pub const fn from_parts(station: i64, offer: Groups, last_request: [Option<i64>; 2]) -> Self {
        let [mot, plan] = last_request;
        Self { station, offer, last_request: PerGroup::new(number(mot), number(plan)) }
    }
}

const fn number(session: Option<i64>) -> i64 {
    match session {
        Some(session) => session,
        None => 0,
    }
}

const fn slot(record: GroupRecord) -> Slot {
    match record {
        GroupRecord::Local => Slot::Local,
        GroupRecord::Requested { station, session, deadline_ns } => {
            Slot::Requested { station, session, deadline_ns }
        }
        GroupRecord::Remote(running) => {
            let Running { station, session, last_arrival_ns, last_used_ns, local_computes } =
                running;
            let arrivals = Arrivals::from_parts(last_arrival_ns, last_used_ns);
            Slot::Remote { station, session, arrivals, local_computes }
        }
    }
}

const fn record(slot: &Slot) -> GroupRecord {
    match *slot {
        Slot::Local => GroupRecord::Local,
        Slot::Requested { station, session, deadline_ns } => {
            GroupRecord::Requested { station, session, deadline_ns }
        }
        Slot::Remote { station, session, arrivals, local_computes } => {
            GroupRecord::Remote(Running {
                station,
                session,
                last_arrival_ns: arrivals.last_arrival_ns(),
                last_used_ns: arrivals.last_used_ns(),
                local_computes,
            })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{GroupRecord, Parts, Running};
    use crate::input::profile::Profile;
    use crate::offloading::requester::{
        Event, EventKind, Group, Groups, Parameters, Requester, RequesterError, Sessions,
        StationRecord, Suspended,
    };

    #[test]
    fn a_requester_from_its_parts_goes_on_as_if_nothing_had_been() -> Result<(), RequesterError> {
        let events = [
            EventKind::Offer { station: 2, groups: Groups::ALL },
            EventKind::Tick,
            EventKind::Confirm { station: 2, group: Group::Plan, session: 2 },
            EventKind::Data { station: 2, group: Group::Plan, session: 2, generated_ns: 0 },
            EventKind::Data { station: 2, group: Group::Mot, session: 9, generated_ns: 0 },
            EventKind::Verdict { safe: false, sessions: Sessions::NONE },
        ];
        for profile in [Profile::PAPER, Profile::HARDENED] {
            let (mut table, mut copy) = ([StationRecord::FREE; 2], [StationRecord::FREE; 2]);
            let mut whole = Requester::new(profile, Parameters::default(), &mut table)?;
            for (t_ns, kind) in (0..).zip(events) {
                let parts = whole.suspend().parts();
                let rebuilt = whole.stations().iter().zip(&mut copy);
                rebuilt.for_each(|(record, place)| {
                    let last_request = Group::ALL.map(|group| record.last_request(group));
                    let station = record.station().unwrap_or(0);
                    *place = StationRecord::from_parts(station, record.offer(), last_request);
                });
                let mut again = Requester::resume(Suspended::from_parts(&parts), &mut copy);
                assert!(again.is_valid());
                let event = Event { t_ns, kind };
                assert_eq!(again.step(&event)?, whole.step(&event)?);
                assert_eq!(again.suspend().parts(), whole.suspend().parts());
                assert_eq!(again.stations(), whole.stations());
            }
            assert!(whole.hold_until_ns().is_some() && whole.dropped(Group::Mot) == 1);
        }
        Ok(())
    }
    /// A change of parts that fit together, and of their table.
    type Break = fn(&mut Parts, &mut [StationRecord; 2]);

    #[test]
    fn parts_that_do_not_fit_together_are_told() {
        const RUNNING: Running = Running {
            station: 2,
            session: 2,
            last_arrival_ns: 0,
            last_used_ns: None,
            local_computes: true,
        };
        let fits = |change: Break| {
            let mut parts = Parts {
                profile: Profile::HARDENED,
                parameters: Parameters::default(),
                groups: [GroupRecord::Local, GroupRecord::Remote(RUNNING)],
                hold_until_ns: None,
                area: Groups::ALL,
                sessions: 2,
                dropped: [0; 2],
            };
            let mut table = [
                StationRecord::from_parts(2, Groups::ALL, [Some(1), Some(2)]),
                StationRecord::from_parts(3, Groups::ALL, [None; 2]),
            ];
            change(&mut parts, &mut table);
            Requester::resume(Suspended::from_parts(&parts), &mut table).is_valid()
        };
        assert!(fits(|_, _| ()));
        let broken: [Break; 13] = [
            |parts, _| parts.parameters.t_wait_ns = -1,
            |parts, table| (parts.sessions, *table) = (-1, [StationRecord::FREE; 2]),
            |parts, _| parts.sessions = 1,
            |parts, _| parts.area = Groups::NONE,
            |parts, _| parts.groups[1] = GroupRecord::Remote(Running { session: 1, ..RUNNING }),
            |parts, _| parts.groups[1] = GroupRecord::Remote(Running { station: 7, ..RUNNING }),
            |_, table| table[0].offer = Groups::NONE,
            |_, table| table[1].station = -1,
            |_, table| table[0] = StationRecord::from_parts(2, Groups::ALL, [Some(2); 2]),
            |_, table| table[1].station = 2,
            |_, table| table[1] = StationRecord::from_parts(3, Groups::ALL, [Some(1), None]),
            |parts, _| {
                parts.groups[1] = GroupRecord::Remote(Running { local_computes: false, ..RUNNING });
            },
            |parts, _| parts.profile = Profile::PAPER,
        ];
        for (index, change) in broken.into_iter().enumerate() {
            assert!(!fits(change), "{index}");
        }
    }
}
