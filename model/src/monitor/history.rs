//! The earlier detections that a monitor keeps (`spec/monitor.md`, the history of detections).

use crate::input::cycle::DetectionList;
use crate::input::profile::{HardenedRule, Profile};

/// Lists that are kept. [MON-13]
const LISTS: usize = 12;
/// A list is at least so much younger than the one before, ns: 1/12 s, rounded up. [MON-12]
const APART_NS: i128 = 83_333_334;
/// A list that is older than the last one by more than this takes the place of all, ns. [MON-14]
const SET_BACK_NS: i128 = 1_000_000_000;
/// Ages of usable lists, ns (SEEN-01).
const USABLE_NS: [i128; 2] = [200_000_000, 1_000_000_000];
/// A usable list is at most so much older than now, ns (SEEN-01).
const STALE_NS: i128 = 60_000_000_000;
/// The ages that lists are chosen for, ns. [MON-15]
const WANTED_NS: [i128; 3] = [300_000_000, 500_000_000, 800_000_000];
/// Ages of a list with which a request may be sent, ns. [MON-43]
const SEEN_LONG_NS: [i128; 2] = [500_000_000, 1_000_000_000];

/// The lists that are kept, the youngest first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct History(Vec<DetectionList>);

/// Whether a monitor of this profile keeps lists: the rules that look at them are in force. [MON-17]
pub fn is_kept(profile: Profile) -> bool {
    profile.has(HardenedRule::H01) || profile.has(HardenedRule::H14)
}

impl History {
    /// Keeps current detections of valid local input, if they are to be kept. [MON-12] to [MON-14]
    pub fn keep(&mut self, detections: &DetectionList) {
        let younger_by = self.0.first().map(|last| age_ns(detections.stamp_ns, last));
        match younger_by {
            Some(by) if by < -SET_BACK_NS => self.0 = vec![detections.clone()],
            Some(by) if by < APART_NS => {}
            Some(_) | None => {
                self.0.insert(0, detections.clone());
                self.0.truncate(LISTS);
            }
        }
    }

    /// The history of a cycle with these detections, which are current if they are there: of the usable
    /// lists those whose ages are nearest to 300, 500 and 800 ms. [MON-15] [MON-16]
    pub fn of_cycle(&self, now_ns: i64, detections: Option<&DetectionList>) -> Vec<DetectionList> {
        let Some(DetectionList { stamp_ns, .. }) = detections else { return Vec::new() };
        let [least, most] = USABLE_NS;
        let is_usable = |list: &&DetectionList| {
            (least..=most).contains(&age_ns(*stamp_ns, list)) && age_ns(now_ns, list) <= STALE_NS
        };
        let usable: Vec<&DetectionList> = self.0.iter().filter(is_usable).collect();
        let nearest = |wanted: i128| {
            let distance = |list: &&&DetectionList| {
                let age = age_ns(*stamp_ns, list);
                ((age - wanted).abs(), age)
            };
            usable.iter().min_by_key(distance).map(|list| list.stamp_ns)
        };
        let chosen = WANTED_NS.map(nearest);
        let is_chosen = |list: &&DetectionList| chosen.contains(&Some(list.stamp_ns));
        usable.into_iter().filter(is_chosen).cloned().collect()
    }

    /// The stamps of the lists, ns, the youngest first.
    pub fn stamps_ns(&self) -> impl Iterator<Item = i64> {
        self.0.iter().map(|list| list.stamp_ns)
    }

    /// Whether a list is at least 500 ms and at most 1 s older than a tick. [MON-43]
    pub fn has_seen_long(&self, tick_ns: i64) -> bool {
        let [least, most] = SEEN_LONG_NS;
        self.0.iter().any(|list| (least..=most).contains(&age_ns(tick_ns, list)))
    }
}

/// How much older a list is than a time, ns.
fn age_ns(t_ns: i64, list: &DetectionList) -> i128 {
    i128::from(t_ns) - i128::from(list.stamp_ns)
}
