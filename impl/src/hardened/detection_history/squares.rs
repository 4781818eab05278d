//! The items of a list by the squares of a uniform grid, so that what is near a place is found
//! without a look at every item.
//!
//! Plain doubles: coordinates are below 2^25 m, so that a place and its square err by less than
//! 1e-7 m; whoever searches makes what is searched larger by `MARGIN`.

use crate::input::cycle::Detection;
use crate::input::detection_index::DetectionIndex;
use crate::input::scratch::{Column, Link, NONE, short};
use crate::numbers::range::smaller;

/// m
pub(crate) const MARGIN: f64 = 1e-6;

/// What is closer than this to a bound is too close to call, m or m/s.
pub(crate) const CLOSE: f64 = 1e-9;

/// Added to a number below 2^51, this leaves the nearest integer in its low bits.
const INTEGER: f64 = 6_755_399_441_055_744.0;

/// A square: column and row of the grid.
type Square = [u64; 2];

/// The grid, and where the lists are.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Squares<'a> {
    items: &'a [Detection],
    /// When the caller keeps an index, it is used, and nothing else here.
    index: Option<&'a DetectionIndex<'a>>,
    /// Which of the lists of `Column::squares`.
    list: usize,
    mask: u64,
    /// Of a square, m, and squares per m.
    side: f64,
    scale: f64,
}

/// Items, with the index that the caller keeps of them.
pub(crate) type Listed<'a> = (&'a [Detection], Option<&'a DetectionIndex<'a>>);

impl<'a> Squares<'a> {
    /// The items by squares: by the index, if there is one, else as `new`.
    pub(crate) fn of(
        (items, index): Listed<'a>,
        side: f64,
        list: usize,
        columns: &mut [Column],
    ) -> Self {
        match index {
            Some(_) => Self { items, index, list, mask: 0, side, scale: 1.0 },
            None => Self::new(items, side, list, columns),
        }
    }

    /// Lists the items. `side`: of a square, m, at least 1e-3; there have to be as many columns as
    /// items.
    pub(crate) fn new(
        items: &'a [Detection],
        side: f64,
        list: usize,
        columns: &mut [Column],
    ) -> Self {
        let mask = match items.len().checked_ilog2() {
            Some(log) => (1_u64 << log).wrapping_sub(1),
            None => 0,
        };
        let squares = Self { items, index: None, list, mask, side, scale: 1.0 / side };
        for link in columns.iter_mut().take(items.len()).filter_map(|it| it.squares.get_mut(list)) {
            link.head = NONE;
        }
        for (index, item) in items.iter().enumerate() {
            let hash = squares.hash(squares.square([item.x, item.y]));
            let Some(first) = link_of(columns, hash, list) else { continue };
            let before = core::mem::replace(&mut first.head, short(index));
            if let Some(item) = link_of(columns, index, list) {
                item.next = before;
            }
        }
        squares
    }

    pub(crate) const fn items(&self) -> &'a [Detection] {
        self.items
    }

    pub(crate) const fn index(&self) -> Option<&'a DetectionIndex<'a>> {
        self.index
    }

    /// Column and row, both counted from far off. Never decreases with a coordinate.
    fn square(&self, place: [f64; 2]) -> Square {
        place.map(|value| (value * self.scale + INTEGER).to_bits())
    }

    fn hash(&self, [i, k]: Square) -> usize {
        let mixed = i.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ k.wrapping_mul(0xC2B2_AE3D_27D4_EB4F);
        usize::try_from((mixed >> 32) & self.mask).unwrap_or(0)
    }

    /// Of a list, or an item, with this index; there is none beyond the columns.
    fn link(&self, columns: &[Column], index: usize) -> Link {
        let link = columns.get(index).and_then(|column| column.squares.get(self.list));
        link.copied().unwrap_or(Link { head: NONE, next: NONE })
    }

    /// Calls `look` for some items, at least those within `away` of the place, when these are
    /// all in the square of the place; returns `away`, 0 at the border.
    #[inline]
    pub(crate) fn for_each_beside(
        &self,
        columns: &[Column],
        place: [f64; 2],
        mut look: impl FnMut(usize, [f64; 2]),
    ) -> f64 {
        if let Some(index) = self.index {
            return index.for_each_beside(place, look) - MARGIN;
        }
        let [left, up] = place.map(|value| {
            let scaled = value * self.scale;
            0.5 - (scaled - ((scaled + INTEGER) - INTEGER)).abs()
        });
        let mut next = self.link(columns, self.hash(self.square(place))).head;
        while let Some(item) = self.items.get(usize::from(next)) {
            look(usize::from(next), [item.x, item.y]);
            next = self.link(columns, usize::from(next)).next;
        }
        smaller(left, up) * self.side - MARGIN
    }

    /// Calls `look` for every item of the squares that the box touches, and for no item twice.
    #[inline]
    pub(crate) fn for_each_in(
        &self,
        columns: &[Column],
        area: [[f64; 2]; 2],
        mut look: impl FnMut(usize, [f64; 2]),
    ) {
        if let Some(index) = self.index {
            return index.for_each_in(area, look);
        }
        let [[left, right], [bottom, top]] = area;
        let ([i0, k0], [i1, k1]) = (self.square([left, bottom]), self.square([right, top]));
        if i1 < i0 || k1 < k0 {
            return;
        }
        let across = i1.wrapping_sub(i0).saturating_add(1);
        let up = k1.wrapping_sub(k0).saturating_add(1);
        let squares = across.saturating_mul(up);
        if squares > 1 && squares > self.mask {
            // More squares than lists.
            self.items.iter().enumerate().for_each(|(index, item)| look(index, [item.x, item.y]));
            return;
        }
        for k in (0..up).map(|step| k0.wrapping_add(step)) {
            for i in (0..across).map(|step| i0.wrapping_add(step)) {
                let mut next = self.link(columns, self.hash([i, k])).head;
                while let Some(item) = self.items.get(usize::from(next)) {
                    if squares == 1 || self.square([item.x, item.y]) == [i, k] {
                        look(usize::from(next), [item.x, item.y]);
                    }
                    next = self.link(columns, usize::from(next)).next;
                }
            }
        }
    }
}

fn link_of(columns: &mut [Column], index: usize, list: usize) -> Option<&mut Link> {
    columns.get_mut(index)?.squares.get_mut(list)
}

#[cfg(test)]
mod tests;
