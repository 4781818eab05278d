//! The columns of an assignment in slabs of equal width across the longer side of the box around
//! their places, so that a row meets near ones first (`spec/3-stages.md#stage-i-track-validation`).

use core::iter::{from_fn, once};

use crate::range::{EMPTY, extend, float};
use crate::scratch::{Column, NONE, short};

/// List 0 is of the columns that have no place, which every row meets; the others are slabs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slabs {
    /// 0 for x.
    axis: usize,
    /// Where the first slab begins, m.
    least: f64,
    /// Of a slab, m; above 0.
    width: f64,
    /// How many; 0 for a single column, which is in list 0.
    count: usize,
}

/// More than coordinates below 2^25 m lose in a few roundings, m.
const MARGIN: f64 = 1e-6;

impl Slabs {
    /// Lists the columns by their places.
    pub(crate) fn new(columns: &mut [Column], place: impl Fn(usize) -> Option<[f64; 2]>) -> Self {
        let mut ranges = [EMPTY; 2];
        (0..columns.len()).filter_map(&place).for_each(|at| extend(&mut ranges, at, [0.0; 2]));
        let [[left, right], [bottom, top]] = ranges;
        let wide = right - left > top - bottom;
        let (axis, least, most) = if wide { (0, left, right) } else { (1, bottom, top) };
        let count = columns.len().saturating_sub(1);
        let width = (most - least) / number(count) + MARGIN;
        let slabs = Self { axis, least, width, count };
        columns.iter_mut().for_each(|column| column.head = NONE);
        for index in 0..columns.len() {
            let list = place(index).map_or(0, |at| slabs.list(at));
            let Some(first) = columns.get_mut(list) else { continue };
            let next = core::mem::replace(&mut first.head, short(index));
            if let Some(column) = columns.get_mut(index) {
                column.next = next;
            }
        }
        slabs
    }

    fn coordinate(&self, [x, y]: [f64; 2]) -> f64 {
        if self.axis == 0 { x } else { y }
    }

    /// The list of the slab that a place is in, or the nearest one.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
    fn list(&self, place: [f64; 2]) -> usize {
        let before = (self.coordinate(place) - self.least) / self.width;
        (before as usize).saturating_add(1).min(self.count)
    }

    /// The lists from the nearest to the farthest, each with a lower bound on the distance from the
    /// place to whatever is in this list or in a later one, m.
    pub(crate) fn around(self, place: [f64; 2]) -> impl Iterator<Item = (f64, usize)> {
        let (at, own) = (self.coordinate(place), self.list(place));
        let edge = move |slabs: usize| self.least + number(slabs) * self.width;
        let (mut below, mut above) = (own.saturating_sub(1), own.saturating_add(1));
        let outward = from_fn(move || {
            let has_above = above <= self.count;
            if below == 0 && !has_above {
                return None;
            }
            let (under, over) = (at - edge(below), edge(above.saturating_sub(1)) - at);
            if below > 0 && (!has_above || under < over) {
                below = below.saturating_sub(1);
                Some((under - MARGIN, below.saturating_add(1)))
            } else {
                above = above.saturating_add(1);
                Some((over - MARGIN, above.saturating_sub(1)))
            }
        });
        once((0.0, 0)).chain((own > 0).then_some((0.0, own))).chain(outward)
    }
}

fn number(count: usize) -> f64 {
    float(i64::try_from(count).unwrap_or(i64::MAX))
}

#[cfg(test)]
mod tests;
