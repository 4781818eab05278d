//! The CAV's own detections of the last second, as the monitor keeps them
//! (`spec/hardened/what-the-cav-saw.md`).

use std::collections::VecDeque;
use std::ops::RangeInclusive;

use mufasa::input::cycle::{Detection, DetectionList};

/// Ages of earlier detections that are looked for, of those that can be used at all, and between two lists
/// that are kept, ns.
const WANTED_NS: [i64; 3] = [300_000_000, 500_000_000, 800_000_000];
const USABLE_NS: RangeInclusive<i64> = 200_000_000..=1_000_000_000;
const SPACING_NS: i64 = 83_333_334;

/// Lists with their stamps, the oldest first.
#[derive(Clone, Debug, Default)]
pub(super) struct Seen(VecDeque<(i64, Vec<Detection>)>);

impl Seen {
    /// Keeps what was detected at a time, if it has come, ns.
    pub(super) fn see(&mut self, now_ns: i64, detections: &[Detection]) {
        let youngest = self.0.back().map(|(stamp_ns, _)| *stamp_ns);
        if youngest.is_some_and(|it| now_ns - it < SPACING_NS) {
            return;
        }
        self.0.push_back((now_ns, detections.to_vec()));
        while self.0.front().is_some_and(|it| now_ns - it.0 > *USABLE_NS.end()) {
            self.0.pop_front();
        }
    }

    /// The lists whose ages are nearest to those wanted, the youngest first.
    pub(super) fn history(&self, stamp_ns: i64) -> Vec<DetectionList<'_>> {
        let usable = || self.0.iter().rev().filter(|it| USABLE_NS.contains(&(stamp_ns - it.0)));
        let mut lists: Vec<DetectionList<'_>> = Vec::new();
        for wanted in WANTED_NS {
            // Of two that are as near the younger: the first.
            let nearest = usable().min_by_key(|it| (stamp_ns - it.0 - wanted).abs());
            if let Some((stamp_ns, items)) = nearest
                && lists.iter().all(|list| list.stamp_ns != *stamp_ns)
            {
                lists.push(DetectionList { stamp_ns: *stamp_ns, items });
            }
        }
        lists
    }
}
