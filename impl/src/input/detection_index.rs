//! A list of detections that has been checked and sorted by place once, for the cycle in which it
//! is current and for those in which it is history (`spec/hardened/what-the-cav-saw.md`). No
//! verdict depends on it, only time.
//!
//! Plain doubles: coordinates are below 2^25 m, so that a place and its cell err by less than 1e-7 m;
//! whoever searches makes what is searched larger by `MARGIN` of `squares`.

use core::ops::Range;

use crate::input::cycle::{Detection, DetectionList};
use crate::input::domain::check_detection_items;
use crate::input::scratch::short;
use crate::numbers::range::{EMPTY, extend, larger, smaller};
use crate::report::{InvalidInput, Problem};

/// Working memory for the index: an item by its place, and where a cell ends. Source:
/// `spec/hardened/what-the-cav-saw.md`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Slot {
    place: [f64; 2],
    /// What is nearer to the item than the root of this is nearer to no other one, m^2; below 0 where
    /// nothing is known.
    clear: f64,
    item: u16,
    /// Of the cell with the index of this slot: its first slot, and the first one behind it.
    start: u16,
    end: u16,
}

impl Slot {
    /// A place to be lent; a constant, so that it needs no heap. Source:
    /// `spec/hardened/what-the-cav-saw.md`.
    pub const EMPTY: Self = Self { place: [0.0; 2], clear: 0.0, item: 0, start: 0, end: 0 };
}

/// Valid detections with their index: a grid over all of them with about as many cells, and the
/// items cell by cell. Source: `spec/hardened/what-the-cav-saw.md`.
#[derive(Clone, Copy, Debug)]
pub struct DetectionIndex<'a> {
    pub(crate) items: &'a [Detection],
    slots: &'a [Slot],
    /// The least coordinates, m, in the middle of the first cell.
    least: [f64; 2],
    /// Of a cell, m, and cells per m.
    side: f64,
    scale: f64,
    /// The last column and the last row.
    last: [f64; 2],
    columns: usize,
    /// No item reaches farther from its centre, m.
    pub(crate) reach: f64,
}

/// An index but for what it borrows, for those who keep the detections and the slots themselves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shape {
    least: [f64; 2],
    side: f64,
    scale: f64,
    last: [f64; 2],
    columns: usize,
    reach: f64,
}

impl<'a> DetectionIndex<'a> {
    /// The index but for what it borrows.
    pub(crate) const fn shape(&self) -> Shape {
        let Self { least, side, scale, last, columns, reach, .. } = *self;
        Shape { least, side, scale, last, columns, reach }
    }

    /// The index again, of copies of its detections and of its slots.
    pub(crate) fn of_kept(shape: Shape, items: &'a [Detection], slots: &'a [Slot]) -> Option<Self> {
        let Shape { least, side, scale, last, columns, reach } = shape;
        let slots = slots.get(..items.len())?;
        Some(Self { items, slots, least, side, scale, last, columns, reach })
    }

    /// Of an empty list. Source: `spec/hardened/what-the-cav-saw.md`.
    pub const EMPTY: Self = Self {
        items: &[],
        slots: &[],
        least: [0.0; 2],
        side: 0.0,
        scale: 0.0,
        last: [0.0; 2],
        columns: 1,
        reach: 0.0,
    };

    /// Checks the detections and sorts them in the caller's memory, at least a slot for each. Time:
    /// linear in the detections, some hundred operations for each.
    ///
    /// Errors: the first invalid value; too little memory. Source:
    /// `spec/3-stages.md#invalid-input`.
    pub fn new(list: &DetectionList<'a>, memory: &'a mut [Slot]) -> Result<Self, InvalidInput> {
        let items = list.items;
        check_detection_items(items)?;
        let Some(slots) = memory.get_mut(..items.len()) else {
            let problem = Problem::ScratchTooSmall;
            return Err(InvalidInput { field: "detections.items", index: None, problem });
        };
        let mut extent = [EMPTY; 2];
        items.iter().for_each(|item| extend(&mut extent, [item.x, item.y], [0.0; 2]));
        let [[left, right], [bottom, top]] = if items.is_empty() { [[0.0; 2]; 2] } else { extent };
        let size = [right - left, top - bottom];
        let reach = items.iter().map(|item| item.length + item.width).fold(0.0, larger);
        let mut index = Self { items, least: [left, bottom], reach, ..Self::EMPTY };
        index.choose_cells(size);
        index.sort(slots);
        for at in 0..slots.len() {
            let clear = index.clear(slots, at);
            slots.get_mut(at).into_iter().for_each(|slot| slot.clear = clear);
        }
        index.slots = slots;
        Ok(index)
    }

    /// About as many cells as items, and not more.
    fn choose_cells(&mut self, [width, height]: [f64; 2]) {
        let count = larger(f64::from(short(self.items.len())), 1.0);
        let mut side = larger(libm::sqrt(width * height / count), larger(width, height) / count);
        side = larger(side, 1e-3);
        // Each time there are fewer; after at most so many times one.
        for _ in 0..128 {
            let last = [width, height].map(|extent| libm::floor(extent / side + 0.5));
            let [columns, rows] = last.map(|last| last + 1.0);
            if columns * rows <= count {
                (self.side, self.scale, self.last) = (side, 1.0 / side, last);
                self.columns = whole(columns);
                return;
            }
            side *= 1.03;
        }
    }

    /// Counts the items of each cell, then puts each where the cells before it end.
    fn sort(&self, slots: &mut [Slot]) {
        slots.iter_mut().for_each(|slot| slot.end = 0);
        for item in self.items {
            if let Some(slot) = slots.get_mut(self.cell([item.x, item.y])) {
                slot.end = slot.end.saturating_add(1);
            }
        }
        let mut start = 0_u16;
        for slot in slots.iter_mut() {
            slot.start = start;
            start = start.saturating_add(slot.end);
            slot.end = slot.start;
        }
        for (item, index) in self.items.iter().zip(0_u16..) {
            let Some(cell) = slots.get_mut(self.cell([item.x, item.y])) else { continue };
            let at = usize::from(cell.end);
            cell.end = cell.end.saturating_add(1);
            if let Some(slot) = slots.get_mut(at) {
                (slot.place, slot.item) = ([item.x, item.y], index);
            }
        }
    }

    /// What is nearer to an item than half of its distance to the next one is nearer to no other
    /// one, not even by rounding errors; of an item in a crowd nothing is said.
    fn clear(&self, slots: &[Slot], at: usize) -> f64 {
        let Some(&Slot { place: [x, y], .. }) = slots.get(at) else { return UNCLEAR };
        // Whatever is in none of these cells is farther than a side.
        let (mut nearest, side) = (self.side * self.side, self.side + MARGIN);
        let [first, low] = self.square([x - side, y - side]).map(whole);
        let [last, high] = self.square([x + side, y + side]).map(whole);
        for row in low..high.saturating_add(1) {
            let start = row.wrapping_mul(self.columns);
            let range = range_of(slots, start.wrapping_add(first), start.wrapping_add(last));
            if range.len() > CROWD {
                return UNCLEAR;
            }
            for (other, slot) in range.clone().zip(slots.get(range).unwrap_or(&[])) {
                let [to_x, to_y] = [slot.place[0] - x, slot.place[1] - y];
                let squared = to_x * to_x + to_y * to_y;
                nearest = if other == at { nearest } else { smaller(nearest, squared) };
            }
        }
        let clear = 0.5 * libm::sqrt(nearest) - MARGIN;
        if clear > 0.0 { clear * clear } else { UNCLEAR }
    }

    /// Whether this is the index of these very detections: they are borrowed, so that they have not
    /// changed since.
    pub(crate) fn is_of(&self, items: &[Detection]) -> bool {
        core::ptr::eq(self.items, items)
    }

    /// Column and row, before they are rounded; never decreases with a coordinate.
    #[inline]
    fn square(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let ([left, bottom], [right, top]) = (self.least, self.last);
        let within = |value: f64, last: f64| larger(smaller(value, last), 0.0);
        [within((x - left) * self.scale, right), within((y - bottom) * self.scale, top)]
    }

    #[inline]
    fn cell(&self, place: [f64; 2]) -> usize {
        let [column, row] = self.square(place).map(whole);
        row.wrapping_mul(self.columns).wrapping_add(column)
    }

    /// The items of some cells of a row.
    #[inline]
    fn between(&self, first: usize, last: usize) -> &'a [Slot] {
        self.slots.get(range_of(self.slots, first, last)).unwrap_or(&[])
    }

    /// An item to which a place, moved on, is nearer than to any other one by more than `MARGIN`, and
    /// the square of their distance, m^2; `None` when the cell of the place does not tell.
    #[inline]
    pub(crate) fn clearly_nearest(
        &self,
        [x, y]: [f64; 2],
        [dx, dy]: [f64; 2],
    ) -> Option<(u16, f64)> {
        let slots = self.slots;
        let &Slot { start, end, .. } = slots.get(self.cell([x + dx, y + dy]))?;
        let (mut at, end) = (usize::from(start), usize::from(end));
        while at < end {
            let slot = slots.get(at)?;
            let [at_x, at_y] = slot.place;
            let (to_x, to_y) = ((x - at_x) + dx, (y - at_y) + dy);
            let squared = to_x * to_x + to_y * to_y;
            if squared < slot.clear {
                return Some((slot.item, squared));
            }
            at = at.wrapping_add(1);
        }
        None
    }

    /// Calls `look` for some items, at least those within `away` of the place, when these are
    /// all in the cell of the place; returns `away`, 0 or less at the border or outside.
    #[inline]
    pub(crate) fn for_each_beside(
        &self,
        [x, y]: [f64; 2],
        mut look: impl FnMut(usize, [f64; 2]),
    ) -> f64 {
        let ([left, bottom], [across, up]) = (self.least, self.square([x, y]));
        let cell = whole(up).wrapping_mul(self.columns).wrapping_add(whole(across));
        self.between(cell, cell).iter().for_each(|slot| look(usize::from(slot.item), slot.place));
        let aside = |at: f64, within: f64| 0.5 - (at * self.scale - rounded(within)).abs();
        smaller(aside(x - left, across), aside(y - bottom, up)) * self.side
    }

    /// Calls `look` for every item of the cells that the box touches, and for no item twice.
    #[inline]
    pub(crate) fn for_each_in(
        &self,
        [[left, right], [bottom, top]]: [[f64; 2]; 2],
        mut look: impl FnMut(usize, [f64; 2]),
    ) {
        let [first, low] = self.square([left, bottom]).map(whole);
        let [last, high] = self.square([right, top]).map(whole);
        if right < left {
            return;
        }
        for row in low..high.saturating_add(1) {
            let start = row.wrapping_mul(self.columns);
            let slots = self.between(start.wrapping_add(first), start.wrapping_add(last));
            slots.iter().for_each(|slot| look(usize::from(slot.item), slot.place));
        }
    }
}

/// The slots of some cells of a row.
#[inline]
fn range_of(slots: &[Slot], first: usize, last: usize) -> Range<usize> {
    let (Some(first), Some(last)) = (slots.get(first), slots.get(last)) else { return 0..0 };
    usize::from(first.start)..usize::from(last.end)
}

/// m, more than distances err.
const MARGIN: f64 = 1e-6;

/// m^2
const UNCLEAR: f64 = -1.0;

/// With more items in three cells next to each other, none of them is compared with the others, so
/// that the time stays linear.
const CROWD: usize = 16;

/// The nearest whole number, for numbers from 0 to 2^16.
#[inline]
#[allow(clippy::cast_possible_truncation, reason = "the lowest bits are what is wanted")]
fn whole(value: f64) -> usize {
    usize::from((value + SHIFT).to_bits() as u16)
}

/// Added to a number, this leaves the nearest integer in the lowest bits.
const SHIFT: f64 = 4_503_599_627_370_496.0;

/// The same as a double.
#[inline]
fn rounded(value: f64) -> f64 {
    (value + SHIFT) - SHIFT
}
