//! Minimal one-to-one assignment of rows to columns by shortest augmenting paths (Hungarian
//! method; paper Sec. IV-B), in O(rows^2 columns) evaluations of the cost and no matrix.
//!
//! Costs are integers, so that potentials never round: the assignment is minimal for the costs as
//! given. With at most 1024 rows and costs of at most 2^52 + 1 no path or potential reaches 2^63: a
//! column that no row has taken has potential 0, so that a path is at most as long as one edge to
//! it (or, where edges are missing, as 1024 edges of at most 2^42), and potentials add up paths.

use crate::scratch::{Column, NONE, Row, UNKNOWN, short};

/// Assigns the first `count` rows one after the other; `cost` of a row and a column is `None` where
/// the two must not be paired. The result is in `Column::row`; returned is how many rows have got a
/// column, which is as many as is possible at all.
pub(crate) fn assign(
    rows: &mut [Row],
    count: usize,
    columns: &mut [Column],
    cost: impl Fn(&[Row], usize, usize) -> Option<i64>,
) -> usize {
    for row in rows.iter_mut() {
        row.column = NONE;
        row.potential = 0;
    }
    for column in columns.iter_mut() {
        column.row = NONE;
        column.potential = 0;
    }
    (0..count).filter(|&start| augment(rows, columns, start, &cost).is_some()).count()
}

/// Finds the shortest path from row `start` to a free column and assigns along it; `None` when
/// there is no path, and then nothing is changed.
fn augment(
    rows: &mut [Row],
    columns: &mut [Column],
    start: usize,
    cost: &impl Fn(&[Row], usize, usize) -> Option<i64>,
) -> Option<()> {
    for column in columns.iter_mut() {
        column.distance = UNKNOWN;
        column.scanned = false;
    }
    let mut from = start;
    let mut length = 0;
    let sink = loop {
        let (distance, nearest) = reach(rows, columns, from, length, cost)?;
        length = distance;
        let column = columns.get_mut(nearest)?;
        column.scanned = true;
        if column.row == NONE {
            break nearest;
        }
        from = usize::from(column.row);
    };
    for column in columns.iter_mut().filter(|column| column.scanned) {
        let slack = length.saturating_sub(column.distance);
        column.potential = column.potential.saturating_sub(slack);
        if let Some(row) = rows.get_mut(usize::from(column.row)) {
            row.potential = row.potential.saturating_add(slack);
        }
    }
    let row = rows.get_mut(start)?;
    row.potential = row.potential.saturating_add(length);
    let mut next = short(sink);
    while next != NONE {
        let column = columns.get_mut(usize::from(next))?;
        column.row = column.before;
        let row = rows.get_mut(usize::from(column.before))?;
        next = core::mem::replace(&mut row.column, next);
    }
    Some(())
}

/// Extends the known paths by the edges of row `from`, which is `length` away, and returns the
/// nearest column that is not final yet: free ones first, then in order.
fn reach(
    rows: &[Row],
    columns: &mut [Column],
    from: usize,
    length: i64,
    cost: &impl Fn(&[Row], usize, usize) -> Option<i64>,
) -> Option<(i64, usize)> {
    let base = length.saturating_sub(rows.get(from)?.potential);
    let mut nearest: Option<(i64, bool, usize)> = None;
    for (index, column) in columns.iter_mut().enumerate().filter(|(_, column)| !column.scanned) {
        if let Some(cost) = cost(rows, from, index) {
            let distance = base.saturating_add(cost).saturating_sub(column.potential);
            if distance < column.distance {
                column.distance = distance;
                column.before = short(from);
            }
        }
        if column.distance == UNKNOWN {
            continue;
        }
        let candidate = (column.distance, column.row != NONE, index);
        if nearest.is_none_or(|known| candidate < known) {
            nearest = Some(candidate);
        }
    }
    nearest.map(|(distance, _, index)| (distance, index))
}

#[cfg(test)]
mod tests;
