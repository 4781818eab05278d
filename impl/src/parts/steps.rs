//! Loops whose passes are counted, for the proofs that they are no more than their steps.

use core::cell::Cell;
use core::ops::Range;

use crate::hardened::detection_history::squares::Squares;
use crate::input::cycle::{Detection, DetectionList};
use crate::input::detection_index::{DetectionIndex, Slot};
use crate::input::scratch::{Column, Link, NONE, Row, short};
use crate::stages::i_track_validation::assignment::{Costs, assign};

/// Costs of two rows and three columns, and how often one is asked for.
struct Counted {
    costs: [[Option<i64>; 3]; 2],
    asked: Cell<u32>,
}

impl Costs for Counted {
    type Place = usize;

    fn place(&self, _: &[Row], row: usize) -> Option<usize> {
        Some(row)
    }

    fn cost(&self, _: &[Row], row: usize, column: usize) -> Option<i64> {
        self.asked.set(self.asked.get().saturating_add(1));
        self.costs.get(row)?.get(column).copied().flatten()
    }

    fn lists(&self, _: usize) -> impl Iterator<Item = (i64, Range<usize>)> {
        core::iter::once((0, 0..1))
    }
}

/// How many of two rows are assigned to three columns, and how many costs that asks for. Source:
/// `spec/4-arithmetic.md#steps`.
pub fn assignment(costs: [[Option<i64>; 3]; 2]) -> (usize, u32) {
    let mut columns = [Column::EMPTY; 3];
    for (column, at) in columns.iter_mut().zip(0_usize..) {
        let next = if at < 2 { short(at.wrapping_add(1)) } else { NONE };
        column.near = Link { head: 0, next };
    }
    let counted = Counted { costs, asked: Cell::new(0) };
    let assigned = assign(&mut [Row::EMPTY; 2], 2, &mut columns, &counted);
    (assigned, counted.asked.get())
}

/// How often a search in this box, m, looks at each of three detections: by their index, or by squares of 1 m.
/// `None`: they are invalid. Source: `spec/hardened/what-the-cav-saw.md`.
pub fn looks(items: &[Detection; 3], area: [[f64; 2]; 2], by_index: bool) -> Option<[u32; 3]> {
    let (mut slots, mut columns, mut looks) = ([Slot::EMPTY; 3], [Column::EMPTY; 3], [0_u32; 3]);
    let mut look = |item: usize, _: [f64; 2]| {
        looks.get_mut(item).into_iter().for_each(|it| *it = it.saturating_add(1));
    };
    if by_index {
        let list = DetectionList { stamp_ns: 0, items };
        DetectionIndex::new(&list, &mut slots).ok()?.for_each_in(area, look);
    } else {
        Squares::new(items, 1.0, 0, &mut columns).for_each_in(&columns, area, &mut look);
    }
    Some(looks)
}
