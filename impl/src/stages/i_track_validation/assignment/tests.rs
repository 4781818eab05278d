//! Against all assignments there are.

use core::ops::Range;
use std::vec;
use std::vec::Vec;

use super::assign;
use crate::input::scratch::{Column, Link, NONE, Row, short};
use crate::random::Random;

type Costs = Vec<Vec<Option<i64>>>;

/// Column c is in list c alone, and each row meets the lists by their costs, with these as bounds;
/// or all columns are in list 0, about which nothing is known.
struct Matrix<'a> {
    costs: &'a Costs,
    sorted: bool,
}

impl super::Costs for Matrix<'_> {
    type Place = usize;

    fn place(&self, _: &[Row], row: usize) -> Option<usize> {
        Some(row)
    }

    fn cost(&self, _: &[Row], row: usize, column: usize) -> Option<i64> {
        self.costs[row][column]
    }

    fn lists(&self, row: usize) -> impl Iterator<Item = (i64, Range<usize>)> {
        let mut lists: Vec<_> =
            self.costs[row].iter().zip(0..).filter_map(|(cost, at)| Some(((*cost)?, at))).collect();
        lists.sort_unstable();
        let lists = if self.sorted { lists } else { vec![(0, 0)] };
        lists.into_iter().map(|(bound, at)| (bound, at..at + 1))
    }
}

fn table(columns: usize, sorted: bool) -> Vec<Column> {
    let chain = |at: usize| Column {
        near: Link {
            head: if sorted { short(at) } else { 0 },
            next: if sorted || at + 1 == columns { NONE } else { short(at + 1) },
        },
        ..Column::default()
    };
    (0..columns).map(chain).collect()
}

/// How many rows were assigned, and what that costs, which does not depend on the lists.
fn run(costs: &Costs, columns: usize) -> (usize, i64) {
    let result = run_listed(costs, columns, false);
    assert_eq!(run_listed(costs, columns, true), result, "{costs:?}");
    result
}

fn run_listed(costs: &Costs, columns: usize, sorted: bool) -> (usize, i64) {
    let mut rows = vec![Row::default(); costs.len()];
    let mut table = table(columns, sorted);
    let assigned = assign(&mut rows, costs.len(), &mut table, &Matrix { costs, sorted });
    let mut seen = vec![false; costs.len()];
    let pairs = table
        .iter()
        .enumerate()
        .filter(|(_, column)| column.row != NONE)
        .map(|(at, column)| (usize::from(column.row), at));
    let total = pairs.map(|(row, column)| {
        assert!(!core::mem::replace(&mut seen[row], true), "a row has two columns");
        costs[row][column].expect("a pair that must not be")
    });
    let sum = total.sum();
    assert_eq!(seen.iter().filter(|&&row| row).count(), assigned);
    (assigned, sum)
}

/// Most rows that can be assigned, and the least cost of assigning so many.
fn best(costs: &[Vec<Option<i64>>], taken: &mut Vec<bool>) -> (usize, i64) {
    let Some((row, rest)) = costs.split_first() else { return (0, 0) };
    let mut result = best(rest, taken);
    for column in 0..taken.len() {
        if let (false, Some(cost)) = (taken[column], row[column]) {
            taken[column] = true;
            let (count, sum) = best(rest, taken);
            taken[column] = false;
            if count + 1 > result.0 || (count + 1 == result.0 && sum + cost < result.1) {
                result = (count + 1, sum + cost);
            }
        }
    }
    result
}

#[test]
fn no_assignment_is_cheaper() {
    let mut random = Random::new(6);
    let mut left_out = 0;
    for _ in 0..3_000 {
        let rows = 1 + random.below(5) as usize;
        let columns = rows + random.below(3) as usize;
        let (range, gaps) = ([3, 100, 1 << 52][random.below(3) as usize], random.below(8));
        let mut cost = || (random.below(10) >= gaps).then(|| random.below(range) as i64);
        let costs: Costs = (0..rows).map(|_| (0..columns).map(|_| cost()).collect()).collect();
        let (assigned, sum) = run(&costs, columns);
        let (most, least) = best(&costs, &mut vec![false; columns]);
        assert_eq!(assigned, most, "{costs:?}");
        if most == rows {
            assert_eq!(sum, least, "{costs:?}");
        } else {
            left_out += 1;
        }
    }
    assert!(left_out > 100, "{left_out}");
}

#[test]
fn more_rows_than_columns() {
    let costs: Costs = vec![vec![Some(4)], vec![Some(3)]];
    let (assigned, sum) = run(&costs, 1);
    assert_eq!((assigned, sum), (1, 4));
}

/// The largest costs and sizes: potentials stay in range, and the least sum is known.
#[test]
fn costs_at_the_limit() {
    let cap = (1_i64 << 52) + 1;
    let cost = |row: usize, column: usize| if row == column { cap - 1 } else { cap };
    let costs: Costs =
        (0..300).map(|row| (0..300).map(|column| Some(cost(row, column))).collect()).collect();
    assert_eq!(run(&costs, 300).1, 300 * (cap - 1));
}

/// Dual potentials prove larger assignments minimal: no cost is below the sum of its potentials,
/// equality holds for the pairs, no column has one above 0, and columns without a row have 0.
#[test]
fn potentials_prove_that_nothing_is_cheaper() {
    let mut random = Random::new(8);
    for (rows, columns) in [(1, 1), (7, 9), (60, 60), (60, 90), (200, 210)] {
        for range in [50, 1 << 40] {
            let mut cost = || Some(random.below(range) as i64);
            let costs: Costs = (0..rows).map(|_| (0..columns).map(|_| cost()).collect()).collect();
            let mut lines = vec![Row::default(); rows];
            let sorted = random.below(2) == 0;
            let mut table = table(columns, sorted);
            let count = assign(&mut lines, rows, &mut table, &Matrix { costs: &costs, sorted });
            assert_eq!(count, rows);
            for (at, column) in table.iter().enumerate() {
                assert!(column.potential <= 0 && (column.row != NONE || column.potential == 0));
                for (row, line) in lines.iter().enumerate() {
                    let left = costs[row][at].map(|cost| cost - line.potential - column.potential);
                    assert!(left.is_some_and(|left| left >= 0), "{row} {at}");
                    assert!(usize::from(column.row) != row || left == Some(0), "{row} {at}");
                }
            }
        }
    }
}
