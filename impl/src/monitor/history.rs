//! The CAV's own earlier detections, copied into lent memory
//! (`spec/monitor.md#monitor`, SEEN-01).

use super::memory::PLACES;
use crate::input::cycle::{Detection, DetectionList};
use crate::input::detection_index::{DetectionIndex, Shape, Slot};
use crate::numbers::time::elapsed_ns;

/// A list is kept when it is at least so much younger than the last one kept, ns. After `PLACES` of them
/// more than 1 s has passed, so that the oldest list is never usable any more when its place is taken.
const SPACING_NS: i64 = 83_333_334;
/// Ages that are looked for, ns.
const WANTED_NS: [i64; 3] = [300_000_000, 500_000_000, 800_000_000];
/// Ages of a usable list, ns.
const LEAST_NS: i64 = 200_000_000;
const LONGEST_NS: i64 = 1_000_000_000;

/// How far back the history of a CAV reaches that asks for a session, ns: the age of the reference list.
const REACH_NS: i64 = 500_000_000;

/// A list that is kept.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Kept {
    pub(crate) stamp_ns: i64,
    pub(crate) count: usize,
    pub(crate) shape: Shape,
}

/// The lists of the last second.
#[derive(Debug)]
pub(crate) struct History<'a> {
    pub(crate) kept: [Option<Kept>; PLACES],
    /// The place of the oldest list, or of none: the next to be taken.
    pub(crate) next: usize,
    pub(crate) youngest_ns: Option<i64>,
    detections: &'a mut [Detection],
    slots: &'a mut [Slot],
    /// For the index of the current list.
    current: &'a mut [Slot],
    capacity: usize,
}

/// Lists of the history, the youngest first, and the indexes of these and of the current list.
pub(super) struct Selection<'s> {
    pub(super) lists: [DetectionList<'s>; 3],
    pub(super) count: usize,
    pub(super) indexes: [DetectionIndex<'s>; 4],
}

impl<'a> History<'a> {
    /// Empty. Lists of at most `capacity` can be kept; `None`: there are too few slots for that.
    pub(crate) fn new(
        detections: &'a mut [Detection],
        slots: &'a mut [Slot],
        capacity: usize,
    ) -> Option<Self> {
        let (current, slots) = slots.split_at_mut_checked(capacity)?;
        let (kept, next, youngest_ns) = ([None; PLACES], 0, None);
        Some(Self { kept, next, youngest_ns, detections, slots, current, capacity })
    }

    /// Whether a list can be kept.
    pub(super) const fn holds(&self, list: &DetectionList<'_>) -> bool {
        // MON-19
        list.items.len() <= self.capacity
    }

    /// Whether a list is kept that is from 500 ms to 1 s old at this time: soon after it a cycle finds how
    /// what it sees has moved (H-14).
    pub(crate) fn reaches_back(&self, now_ns: i64) -> bool {
        // MON-43; A-03
        let ages = REACH_NS..=LONGEST_NS;
        self.kept.iter().flatten().any(|kept| ages.contains(&elapsed_ns(kept.stamp_ns, now_ns)))
    }

    /// Those of the usable lists whose ages are nearest to 300, 500 and 800 ms (of two the younger),
    /// and the indexes; the current list has none when it is invalid or too long.
    pub(super) fn select<'s>(&'s mut self, current: &DetectionList<'s>) -> Selection<'s> {
        let Self { kept, detections, slots, current: memory, capacity, .. } = self;
        let (detections, slots) = (&**detections, &**slots);
        let mut indexes = [DetectionIndex::EMPTY; 4];
        let mut lists = [DetectionList { stamp_ns: 0, items: &[] }; 3];
        let mut count = 0_usize;
        let [own, earlier @ ..] = &mut indexes;
        if let Ok(index) = DetectionIndex::new(current, memory) {
            *own = index;
        }
        let mut places = lists.iter_mut().zip(earlier);
        let mut before = None;
        for at in nearest(kept, current.stamp_ns).into_iter().flatten() {
            if before == Some(at) {
                continue;
            }
            before = Some(at);
            let list = kept.get(at).copied().flatten().and_then(|kept| {
                let Kept { stamp_ns, count, shape } = kept;
                let items = region(detections, at, *capacity)?.get(..count)?;
                let index = DetectionIndex::of_kept(shape, items, region(slots, at, *capacity)?)?;
                Some((DetectionList { stamp_ns, items }, index))
            });
            if let Some(((list, index), (list_place, index_place))) = list.zip(places.next()) {
                (*list_place, *index_place) = (list, index);
                count = count.saturating_add(1);
            }
        }
        Selection { lists, count, indexes }
    }

    /// Copies a list that is current and valid, and its index, if its time has come. `shape`: of its
    /// index, which `select` has left in the memory for the current list.
    pub(crate) fn keep(&mut self, list: &DetectionList<'_>, shape: Shape) {
        if let Some(youngest_ns) = self.youngest_ns {
            let since_ns = elapsed_ns(youngest_ns, list.stamp_ns);
            if since_ns < LONGEST_NS.saturating_neg() {
                // MON-14: the clock was set back.
                self.kept = [None; PLACES];
            } else if since_ns < SPACING_NS {
                // MON-12
                return;
            }
        }
        let at = self.next;
        let Some(kept) = self.kept.get_mut(at) else { return };
        self.next = if at.saturating_add(1) < PLACES { at.saturating_add(1) } else { 0 };
        self.youngest_ns = Some(list.stamp_ns);
        let count = list.items.len();
        *kept = Some(Kept { stamp_ns: list.stamp_ns, count, shape });
        let first = at.saturating_mul(self.capacity);
        let places = first..first.saturating_add(count);
        let items = self.detections.get_mut(places.clone()).unwrap_or_default();
        copy(items, list.items);
        let slots = self.slots.get_mut(places).unwrap_or_default();
        copy(slots, self.current);
    }
}

/// The places of the usable lists whose ages are nearest to those wanted, of two the younger.
pub(crate) fn nearest(kept: &[Option<Kept>; PLACES], stamp_ns: i64) -> [Option<usize>; 3] {
    let mut found = WANTED_NS.map(|wanted_ns| (wanted_ns, (u64::MAX, 0), None));
    for (at, kept) in kept.iter().enumerate() {
        let Some(kept) = kept else { continue };
        let age_ns = elapsed_ns(kept.stamp_ns, stamp_ns);
        if !(LEAST_NS..=LONGEST_NS).contains(&age_ns) {
            continue;
        }
        for (wanted_ns, nearest, place) in &mut found {
            // MON-15
            let offered = (age_ns.abs_diff(*wanted_ns), age_ns);
            if offered < *nearest {
                (*nearest, *place) = (offered, Some(at));
            }
        }
    }
    found.map(|(_, _, place)| place)
}

/// Copies as many as there are in both. As a function of its own it is one `memcpy`: here both are known
/// to be apart.
#[inline(never)]
fn copy<T: Copy>(to: &mut [T], from: &[T]) {
    to.iter_mut().zip(from).for_each(|(place, item)| *place = *item);
}

/// The memory of a place.
fn region<T>(all: &[T], at: usize, capacity: usize) -> Option<&[T]> {
    let first = at.saturating_mul(capacity);
    all.get(first..first.saturating_add(capacity))
}
