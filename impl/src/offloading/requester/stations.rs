//! What the requester remembers of stations: current offers and last requests, in a table that
//! the caller lends (`spec/2-offloading.md#requester`).

use super::per_group::PerGroup;
use crate::services::configuration::{Group, Groups};

/// One place of the table. A place is taken by every station that has a current offer, and for
/// good by every station that was ever asked, because a withdrawal forgets nothing. A table of
/// as many places as stations can ever offer something never becomes full. Source:
/// `spec/2-offloading.md#requester`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct StationRecord {
    /// The station's id, or 0 in a free place.
    pub(super) station: i64,
    /// What it offers; nothing, once it has withdrawn.
    pub(super) offer: Groups,
    /// The session of its last request for each group; 0 is never. Sessions are numbered in the
    /// order of the requests.
    pub(super) last_request: PerGroup<i64>,
}

impl StationRecord {
    /// A free place.
    pub const FREE: Self =
        Self { station: 0, offer: Groups::NONE, last_request: PerGroup::new(0, 0) };

    /// The station's id; `None` in a free place.
    pub const fn station(&self) -> Option<i64> {
        if self.is_free() { None } else { Some(self.station) }
    }

    /// What the station offers now. Source: `spec/2-offloading.md#requester`.
    pub const fn offer(&self) -> Groups {
        self.offer
    }

    /// The session of the last request for `group` to this station; `None` if it was never asked.
    /// Source: `spec/2-offloading.md#requester`.
    pub const fn last_request(&self, group: Group) -> Option<i64> {
        match *self.last_request.get(group) {
            0 => None,
            session => Some(session),
        }
    }

    /// Whether nothing has to be remembered of the station.
    const fn is_free(&self) -> bool {
        // REQ-09
        self.offer.is_empty()
            && self.last_request(Group::Mot).is_none()
            && self.last_request(Group::Plan).is_none()
    }

    fn is_valid(&self, sessions: i64) -> bool {
        let numbered = |group| (0..=sessions).contains(self.last_request.get(group));
        let [mot, plan] = Group::ALL.map(|group| self.last_request(group));
        Group::ALL.into_iter().all(numbered)
            && (self.is_free() || (self.station >= 1 && (mot.is_none() || mot != plan)))
    }
}

impl Default for StationRecord {
    fn default() -> Self {
        Self::FREE
    }
}

/// The table.
#[derive(Debug)]
pub(super) struct Stations<'a> {
    records: &'a mut [StationRecord],
}

impl<'a> Stations<'a> {
    /// The table with every place free.
    pub(super) fn new(records: &'a mut [StationRecord]) -> Self {
        records.fill(StationRecord::FREE);
        Self { records }
    }

    /// The table as it stands.
    pub(super) const fn resume(records: &'a mut [StationRecord]) -> Self {
        Self { records }
    }

    pub(super) const fn records(&self) -> &[StationRecord] {
        self.records
    }

    /// Replaces the offer of a station; the empty one removes it. `false`: nothing has changed,
    /// because there is no place for a station that was not remembered.
    pub(super) fn set_offer(&mut self, station: i64, groups: Groups) -> bool {
        if let Some(known) = self.find_mut(station) {
            known.offer = groups;
        } else if !groups.is_empty() {
            let Some(place) = self.records.iter_mut().find(|record| record.is_free()) else {
                return false;
            };
            *place = StationRecord { station, offer: groups, ..StationRecord::FREE };
        }
        true
    }

    /// The station to be asked for `group`: among those that offer it one never asked for it
    /// first, the smallest id; then the one whose last request for it is the oldest.
    pub(super) fn next_for(&self, group: Group) -> Option<i64> {
        let offering = self.records.iter().filter(|record| record.offer.contains(group));
        // The session 0 of a station never asked is below every other, and no two stations
        // share another one, so ids decide among stations never asked and nowhere else.
        // REQ-07, REQ-08
        let order = |record: &StationRecord| (*record.last_request.get(group), record.station);
        offering.map(order).min().map(|(_, station)| station)
    }

    /// Remembers that `station` was asked for `group`.
    pub(super) fn asked(&mut self, station: i64, group: Group, session: i64) {
        if let Some(record) = self.find_mut(station) {
            *record.last_request.get_mut(group) = session;
        }
    }

    /// Whether no station and no session is in two places and every session is at most
    /// `sessions`, the number of requests so far.
    pub(super) fn is_valid(&self, sessions: i64) -> bool {
        let mut rest = self.records();
        while let [first, tail @ ..] = rest {
            let apart = |other: &StationRecord| {
                first.is_free()
                    || other.is_free()
                    || (first.station != other.station && !share_a_session(first, other))
            };
            if !first.is_valid(sessions) || !tail.iter().all(apart) {
                return false;
            }
            rest = tail;
        }
        true
    }

    pub(super) fn find(&self, station: i64) -> Option<&StationRecord> {
        self.records.iter().find(|record| record.station() == Some(station))
    }

    fn find_mut(&mut self, station: i64) -> Option<&mut StationRecord> {
        self.records.iter_mut().find(|record| record.station() == Some(station))
    }
}

fn share_a_session(one: &StationRecord, other: &StationRecord) -> bool {
    let of = |record: &StationRecord| Group::ALL.map(|group| record.last_request(group));
    of(one).into_iter().flatten().any(|session| of(other).contains(&Some(session)))
}

#[cfg(test)]
mod tests {
    use super::{StationRecord, Stations};
    use crate::services::configuration::{Group, Groups};

    /// REQ-07, REQ-08
    #[test]
    fn one_never_asked_first_then_the_oldest_request() {
        let mut table = [StationRecord::FREE; 3];
        let mut stations = Stations::new(&mut table);
        for station in [9, 4, 7] {
            assert!(stations.set_offer(station, Groups::ALL));
        }
        for (session, expected) in [(1, 4), (2, 7), (3, 9), (4, 4), (5, 7)] {
            assert_eq!(stations.next_for(Group::Mot), Some(expected));
            stations.asked(expected, Group::Mot, session);
            assert!(stations.is_valid(session));
        }
        assert_eq!(stations.next_for(Group::Plan), Some(4), "asked for MOT only");
        assert!(!stations.is_valid(4), "a request that was not yet numbered");
    }

    /// A place is free again only when nothing has to be remembered of its station.
    #[test]
    fn a_place_is_reused_only_when_its_station_was_never_asked() {
        let mut table = [StationRecord::FREE; 1];
        let mut stations = Stations::new(&mut table);
        assert!(stations.set_offer(1, Groups::ALL));
        assert!(!stations.set_offer(2, Groups::ALL), "full");
        assert!(stations.set_offer(2, Groups::NONE), "nothing to remember");
        assert!(stations.set_offer(1, Groups::NONE));
        assert!(stations.set_offer(2, Groups::ALL), "reused");
        stations.asked(2, Group::Plan, 1);
        assert!(stations.set_offer(2, Groups::NONE));
        assert!(!stations.set_offer(1, Groups::ALL), "station 2 is remembered");
        assert_eq!(stations.next_for(Group::Plan), None, "but it offers nothing");
    }

    /// The table that is lent may hold anything.
    #[test]
    fn a_new_table_is_empty() {
        let mut table = [StationRecord { station: 5, offer: Groups::ALL, ..StationRecord::FREE }];
        let stations = Stations::new(&mut table);
        assert_eq!(stations.records(), [StationRecord::default()]);
        assert_eq!(stations.next_for(Group::Mot), None);
    }
}
