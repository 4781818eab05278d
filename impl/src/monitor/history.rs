//! The CAV's own earlier detections, copied into lent memory
//! (`spec/5-interfaces.md#monitor`, `spec/3-stages.md#what-the-cav-saw-itself`).

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
const USABLE_NS: [i64; 2] = [200_000_000, 1_000_000_000];

/// A list that is kept.
#[derive(Clone, Copy, Debug)]
struct Kept {
    stamp_ns: i64,
    count: usize,
    shape: Shape,
}

/// The lists of the last second.
#[derive(Debug)]
pub(super) struct History<'a> {
    kept: [Option<Kept>; PLACES],
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
    pub(super) fn new(
        detections: &'a mut [Detection],
        slots: &'a mut [Slot],
        capacity: usize,
    ) -> Option<Self> {
        let (current, slots) = slots.split_at_mut_checked(capacity)?;
        Some(Self { kept: [None; PLACES], detections, slots, current, capacity })
    }

    /// Whether a list can be kept.
    pub(super) const fn holds(&self, list: &DetectionList<'_>) -> bool {
        list.items.len() <= self.capacity
    }

    /// Those of the usable lists whose ages are nearest to 300, 500 and 800 ms (of two the younger),
    /// and the indexes; the current list has none when it is invalid or too long.
    pub(super) fn select<'s>(&'s mut self, current: &DetectionList<'s>) -> Selection<'s> {
        let Self { kept, detections, slots, current: memory, capacity } = self;
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
        for wanted_ns in WANTED_NS {
            let nearest = nearest(kept, current.stamp_ns, wanted_ns);
            if nearest.is_none() || nearest == before {
                continue;
            }
            before = nearest;
            let list = nearest.and_then(|at| {
                let Kept { stamp_ns, count, shape } = (*kept.get(at)?)?;
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
    pub(super) fn keep(&mut self, list: &DetectionList<'_>, shape: Shape) {
        let youngest_ns = self.kept.iter().flatten().map(|kept| kept.stamp_ns).max();
        let since_ns = youngest_ns.map_or(i64::MAX, |last_ns| elapsed_ns(last_ns, list.stamp_ns));
        let [_, longest_ns] = USABLE_NS;
        if since_ns < longest_ns.saturating_neg() {
            // The clock was set back.
            self.kept = [None; PLACES];
        } else if since_ns < SPACING_NS {
            return;
        }
        let age = |kept: &Option<Kept>| kept.map_or(i64::MIN, |kept| kept.stamp_ns);
        let oldest = self.kept.iter_mut().enumerate().min_by_key(|(_, kept)| age(kept));
        let Some((at, kept)) = oldest else { return };
        let count = list.items.len();
        *kept = Some(Kept { stamp_ns: list.stamp_ns, count, shape });
        let first = at.saturating_mul(self.capacity);
        let places = self.detections.iter_mut().skip(first);
        places.zip(list.items).for_each(|(place, item)| *place = *item);
        let places = self.slots.iter_mut().skip(first).take(count);
        places.zip(&*self.current).for_each(|(place, slot)| *place = *slot);
    }
}

/// The place of the usable list whose age is nearest to this, of two the younger.
fn nearest(kept: &[Option<Kept>; PLACES], stamp_ns: i64, wanted_ns: i64) -> Option<usize> {
    let [least_ns, most_ns] = USABLE_NS;
    let ages = kept.iter().enumerate().filter_map(|(at, kept)| {
        let age_ns = elapsed_ns((*kept)?.stamp_ns, stamp_ns);
        (least_ns <= age_ns && age_ns <= most_ns).then_some((at, age_ns))
    });
    let order = |&(_, age_ns): &(usize, i64)| (age_ns.abs_diff(wanted_ns), age_ns);
    ages.min_by_key(order).map(|(at, _)| at)
}

/// The memory of a place.
fn region<T>(all: &[T], at: usize, capacity: usize) -> Option<&[T]> {
    let first = at.saturating_mul(capacity);
    all.get(first..first.saturating_add(capacity))
}
