//! Minimal assignment of rows to columns by shortest augmenting paths (Hungarian method; paper
//! Sec. IV-B): one search for each row, and no matrix. Only columns that are near enough to matter
//! are looked at; at most, rows^2 columns evaluations of the cost.
//!
//! Costs are integers, so that potentials never round: the assignment is minimal for the costs as
//! given. With at most 1024 rows and costs of at most 2^52 + 1 no path or potential reaches 2^63: a
//! path, and a potential, which is that of a path to a column that no row has taken and whose
//! potential is 0, costs what its edges cost, every second one taken off (where edges are missing,
//! at most 1024 edges of 2^46 + 1; else one edge would do).

use core::ops::Range;

use crate::input::scratch::{Column, NONE, Row, UNKNOWN, short};

/// What the pairs cost, and in which order a row meets the columns.
pub(crate) trait Costs {
    /// Where a row is.
    type Place: Copy;

    fn place(&self, rows: &[Row], row: usize) -> Option<Self::Place>;

    /// The cost of a row and a column, at least 0; `None` where the two must not be paired.
    fn cost(&self, rows: &[Row], row: Self::Place, column: usize) -> Option<i64>;

    /// The lists of columns (`Column::near`) that a row may be paired with, some
    /// at a time, with a bound: no column of these lists or of later ones costs less.
    fn lists(&self, row: Self::Place) -> impl Iterator<Item = (i64, Range<usize>)>;
}

/// Assigns the first `count` rows one after the other, at the least cost (S1-05). The result is in
/// `Column::row`; returned is how many rows have got a column, which is as many as is possible at
/// all.
pub(crate) fn assign(
    rows: &mut [Row],
    count: usize,
    columns: &mut [Column],
    costs: &impl Costs,
) -> usize {
    for row in rows.iter_mut() {
        row.column = NONE;
        row.potential = 0;
    }
    for column in columns.iter_mut() {
        column.row = NONE;
        column.potential = 0;
        column.distance = UNKNOWN;
    }
    // S1-04
    (0..count).filter(|&start| augment(rows, columns, start, costs).is_some()).count()
}

/// A search that has settled this share of the columns looks at all of them.
const DEEP: usize = 64;

/// What the edges of a row have in common.
struct Edges<P> {
    /// How far away they begin: the length of the path to the row, less its potential.
    base: i64,
    /// That of the path.
    length: i64,
    from: usize,
    row: P,
}

/// A column without a row, and the shortest path to it that is known.
struct Sink {
    distance: i64,
    column: usize,
    /// The row before it on the path.
    before: usize,
}

/// Shortest paths from one row: `reached` of the columns is the list of columns with a row that
/// have been reached, of which the first ones are settled, their paths being final.
#[derive(Default)]
struct Paths {
    settled: usize,
    reached: usize,
    sink: Option<Sink>,
}

/// Finds the shortest path from row `start` to a free column and assigns along it; `None` when
/// there is no path, and then nothing is changed.
fn augment(
    rows: &mut [Row],
    columns: &mut [Column],
    start: usize,
    costs: &impl Costs,
) -> Option<()> {
    let mut paths = Paths::default();
    let (mut from, mut length) = (start, 0);
    loop {
        paths.extend(rows, columns, from, length, costs);
        let Some(nearest) = paths.settle(columns, length) else { break };
        from = usize::from(columns.get(nearest)?.row);
        length = columns.get(nearest)?.distance;
    }
    let (settled, reached) = (paths.settled, paths.reached);
    for index in 0..reached {
        let column = reached_column(columns, index)?;
        let distance = core::mem::replace(&mut column.distance, UNKNOWN);
        if let (true, Some(sink)) = (index < settled, &paths.sink) {
            let slack = sink.distance.saturating_sub(distance);
            column.potential = column.potential.saturating_sub(slack);
            let row = rows.get_mut(usize::from(column.row))?;
            row.potential = row.potential.saturating_add(slack);
        }
    }
    let Sink { distance, column, before } = paths.sink?;
    let row = rows.get_mut(start)?;
    row.potential = row.potential.saturating_add(distance);
    columns.get_mut(column)?.before = short(before);
    // A path has no column twice, so that this ends at the row without one.
    let mut next = short(column);
    for _ in 0..columns.len() {
        let Some(column) = columns.get_mut(usize::from(next)) else { break };
        column.row = column.before;
        let row = rows.get_mut(usize::from(column.before))?;
        next = core::mem::replace(&mut row.column, next);
    }
    Some(())
}

impl Paths {
    /// Extends the known paths by the edges of row `from`, which is `length` away, as long as they
    /// may lead to a path shorter than that to the sink: potentials of columns are at most 0, so
    /// that no path is shorter than its last edge with what is before it.
    fn extend<C: Costs>(
        &mut self,
        rows: &[Row],
        columns: &mut [Column],
        from: usize,
        length: i64,
        costs: &C,
    ) {
        let (Some(row), Some(potential)) =
            (costs.place(rows, from), rows.get(from).map(|row| row.potential))
        else {
            return;
        };
        let edges = Edges { base: length.saturating_sub(potential), length, from, row };
        // Where so much has been settled already, it takes less to meet all columns than those near first.
        if self.settled.saturating_mul(DEEP) >= columns.len() {
            (0..columns.len()).for_each(|index| self.meet(rows, columns, index, &edges, costs));
            return;
        }
        for (bound, lists) in costs.lists(row) {
            if edges.base.saturating_add(bound) >= self.limit() {
                return;
            }
            for list in lists {
                let mut next = columns.get(list).map_or(NONE, |column| column.near.head);
                while let Some(column) = columns.get(usize::from(next)) {
                    let index = usize::from(core::mem::replace(&mut next, column.near.next));
                    self.meet(rows, columns, index, &edges, costs);
                }
            }
        }
    }

    /// The edge to one column, unless paths that are that short are final.
    fn meet<C: Costs>(
        &mut self,
        rows: &[Row],
        columns: &mut [Column],
        index: usize,
        edges: &Edges<C::Place>,
        costs: &C,
    ) {
        let Some(column) = columns.get(index).filter(|it| it.distance > edges.length) else {
            return;
        };
        if let Some(cost) = costs.cost(rows, edges.row, index) {
            let distance = edges.base.saturating_add(cost).saturating_sub(column.potential);
            self.reach(columns, index, distance, edges.from);
        }
    }

    /// A path to a column, with the row before it; only the shortest is kept.
    fn reach(&mut self, columns: &mut [Column], index: usize, distance: i64, from: usize) {
        let Some(column) = columns.get_mut(index) else { return };
        if distance >= column.distance || distance >= self.limit() {
            return;
        }
        if column.row == NONE {
            self.sink = Some(Sink { distance, column: index, before: from });
            return;
        }
        let is_new = column.distance == UNKNOWN;
        (column.distance, column.before) = (distance, short(from));
        if let (true, Some(end)) = (is_new, columns.get_mut(self.reached)) {
            end.reached = short(index);
            self.reached = self.reached.saturating_add(1);
        }
    }

    /// Nothing as far as this is of interest.
    fn limit(&self) -> i64 {
        self.sink.as_ref().map_or(UNKNOWN, |sink| sink.distance)
    }

    /// Settles the nearest column that is not settled yet, if it is nearer than the sink; none is
    /// nearer than `length`, where the last one was.
    fn settle(&mut self, columns: &mut [Column], length: i64) -> Option<usize> {
        let mut nearest: Option<(i64, usize)> = None;
        for place in self.settled..self.reached {
            let distance = reached_column(columns, place)?.distance;
            if nearest.is_none_or(|(least, _)| distance < least) {
                nearest = Some((distance, place));
                if distance <= length {
                    break;
                }
            }
        }
        let (_, place) = nearest.filter(|&(distance, _)| distance < self.limit())?;
        let first = columns.get(self.settled)?.reached;
        let found = core::mem::replace(&mut columns.get_mut(place)?.reached, first);
        columns.get_mut(self.settled)?.reached = found;
        self.settled = self.settled.saturating_add(1);
        Some(usize::from(found))
    }
}

fn reached_column(columns: &mut [Column], place: usize) -> Option<&mut Column> {
    let index = columns.get(place)?.reached;
    columns.get_mut(usize::from(index))
}

#[cfg(test)]
mod tests;
