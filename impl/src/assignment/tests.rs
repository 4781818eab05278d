//! Against all assignments there are.

use std::vec;
use std::vec::Vec;

use super::assign;
use crate::random::Random;
use crate::scratch::{Column, NONE, Row};

type Costs = Vec<Vec<Option<i64>>>;

fn run(costs: &Costs, columns: usize) -> (usize, i64) {
    let mut rows = vec![Row::default(); costs.len()];
    let mut table = vec![Column::default(); columns];
    let assigned = assign(&mut rows, costs.len(), &mut table, |_, row, column| costs[row][column]);
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
    let mut random = Random(6);
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
    let mut random = Random(8);
    for (rows, columns) in [(1, 1), (7, 9), (60, 60), (60, 90), (200, 210)] {
        for range in [50, 1 << 40] {
            let mut cost = || Some(random.below(range) as i64);
            let costs: Costs = (0..rows).map(|_| (0..columns).map(|_| cost()).collect()).collect();
            let mut lines = vec![Row::default(); rows];
            let mut table = vec![Column::default(); columns];
            let count = assign(&mut lines, rows, &mut table, |_, row, column| costs[row][column]);
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
