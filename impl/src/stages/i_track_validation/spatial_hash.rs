//! The columns of an assignment in the square cells of a grid over their places, so that a row
//! meets near ones first (`spec/3-stages.md#stage-i-track-validation`).

use core::iter::once;
use core::ops::Range;

use crate::input::scratch::{Column, NONE, short};
use crate::numbers::range::{EMPTY, extend, float};

/// Lists of columns: list 0 is of those that have no place, which every row meets; the others are
/// the cells, row by row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ColumnsByCell {
    /// Where the first cell begins, m.
    corner: [f64; 2],
    /// Of a cell, m; above 0.
    side: f64,
    /// How many across and up; one has none when there is but one list.
    counts: [i64; 2],
}

/// More than coordinates below 2^25 m lose in a few roundings, m.
const MARGIN: f64 = 1e-6;

impl ColumnsByCell {
    /// Lists the columns by their places, in at most as many cells as there are columns less one.
    pub(crate) fn new(columns: &mut [Column], place: impl Fn(usize) -> Option<[f64; 2]>) -> Self {
        let mut ranges = [EMPTY; 2];
        (0..columns.len()).filter_map(&place).for_each(|at| extend(&mut ranges, at, [0.0; 2]));
        let corner = ranges.map(|[least, _]| least);
        let [width, height] = ranges.map(|[least, most]| most - least);
        // The least side with (width + side) (height + side) <= (more + 1) side^2.
        let more = float(i64::try_from(columns.len()).unwrap_or(0)) - 2.0;
        let sum = width + height;
        let root = libm::sqrt(sum * sum + 4.0 * more * width * height);
        let side =
            if more > 0.0 { 0.5 * (sum + root) / more * (1.0 + 1e-9) + MARGIN } else { sum + 1.0 };
        let count = |length: f64| index(length / side).saturating_add(1);
        let counts = if more >= 0.0 { [count(width), count(height)] } else { [0, 0] };
        let cells = Self { corner, side, counts };
        columns.iter_mut().for_each(|column| column.near.head = NONE);
        for index in 0..columns.len() {
            let list = place(index).map_or(0, |at| cells.list(cells.cell(at)));
            let Some(first) = columns.get_mut(list) else { continue };
            let next = core::mem::replace(&mut first.near.head, short(index));
            if let Some(column) = columns.get_mut(index) {
                column.near.next = next;
            }
        }
        cells
    }

    /// The cell that a place is in, or the nearest one.
    fn cell(&self, [x, y]: [f64; 2]) -> [i64; 2] {
        let ([left, bottom], [across, up]) = (self.corner, self.counts);
        let cell = |from: f64, count: i64| index(from / self.side).min(count.saturating_sub(1));
        [cell(x - left, across), cell(y - bottom, up)]
    }

    fn list(&self, [i, k]: [i64; 2]) -> usize {
        let [across, _] = self.counts;
        let list = k.saturating_mul(across).saturating_add(i).saturating_add(1);
        usize::try_from(list).unwrap_or(0)
    }

    /// The lists from near ones to far ones, each time some that follow one another, with a lower
    /// bound on the distance from the place to whatever is in these lists or in later ones, m.
    pub(crate) fn around(self, place: [f64; 2]) -> impl Iterator<Item = (f64, Range<usize>)> {
        let own = self.cell(place);
        // Frames around the own cell, each twice as wide as the one before: 0, 1, 2 to 3, 4 to 7, ...
        let frames = (0_u32..62).map(|frame| (1_i64 << frame) >> 1);
        let frames = frames.map_while(move |near| Some((self.beyond(place, own, near)?, near)));
        let lists = frames
            .flat_map(move |(bound, near)| self.frame(own, near).map(move |lists| (bound, lists)));
        once((0.0, 0..1)).chain(lists)
    }

    /// How far everything is at least that is so many rows or columns away; `None` when nothing is.
    fn beyond(&self, place: [f64; 2], own: [i64; 2], near: i64) -> Option<f64> {
        if near == 0 {
            return Some(0.0);
        }
        let mut least = None;
        let axes = self.corner.into_iter().zip(self.counts).zip(place).zip(own);
        for (((corner, count), at), own) in axes {
            let (below, above) = (own.saturating_sub(near), own.saturating_add(near));
            let edge = |cells: i64| corner + float(cells) * self.side;
            let under = (below >= 0).then(|| at - edge(below.saturating_add(1)));
            let over = (above < count).then(|| edge(above) - at);
            for gap in [under, over].into_iter().flatten() {
                least = Some(least.map_or(gap, |least: f64| least.min(gap)));
            }
        }
        least.map(|least| least - MARGIN)
    }

    /// The cells that are `near` or more, but less than twice as many, rows or columns from one: few ranges, however few
    /// columns there are, as whole rows follow one another.
    fn frame(self, [i, k]: [i64; 2], near: i64) -> impl Iterator<Item = Range<usize>> {
        let [across, up] = self.counts;
        let far = near.saturating_mul(2).saturating_sub(1).max(0);
        let around = |at: i64, by: i64, most: i64| {
            (at.saturating_sub(by).max(0), at.saturating_add(by).saturating_add(1).min(most))
        };
        let ((left, right), (bottom, top)) = (around(i, far, across), around(k, far, up));
        let (inner, end) = (i.saturating_sub(near).saturating_add(1), i.saturating_add(near));
        // Of these rows only what is left of `inner` and right of `end`.
        let lower = k.saturating_sub(near).saturating_add(1).max(bottom);
        let upper = k.saturating_add(near).min(top).max(lower);
        let between = if left < inner || end < right { lower..upper } else { 0..0 };
        let sides = between.flat_map(move |row| {
            let parts = [(left, inner), (end, right)].into_iter().filter(|(from, to)| from < to);
            parts.map(move |(from, to)| self.list([from, row])..self.list([to, row]))
        });
        let is_whole = left == 0 && right == across;
        let rows = move |from: i64, to: i64| {
            let pieces = if is_whole { i64::from(from < to) } else { to.saturating_sub(from) };
            (0..pieces).map(move |piece| {
                let first = from.saturating_add(piece);
                let last = if is_whole { to.saturating_sub(1) } else { first };
                self.list([left, first])..self.list([right, last])
            })
        };
        rows(bottom, lower).chain(sides).chain(rows(upper, top))
    }
}

/// The integer below a number; 0 below 0.
#[allow(clippy::cast_possible_truncation, reason = "saturates")]
fn index(value: f64) -> i64 {
    (value as i64).max(0)
}

#[cfg(test)]
mod tests;
