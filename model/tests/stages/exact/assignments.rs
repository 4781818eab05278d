//! The least cost of an assignment: by trying all up to 7 x 7, and by `pathfinding` beyond.

use std::ops::Add;

use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_model::numbers::assignment::{Costs, costs_less, least_cost};
use mufasa_model::numbers::real::Real;
use mufasa_model::services::configuration::Configuration::MotRemote;
use pathfinding::matrix::Matrix;
use pathfinding::prelude::kuhn_munkres_min;

use super::Draw;
use crate::base::{base, detection, detections, failed, track, tracks};

/// Far less than two different sums of a few small integers can be apart.
const TINY: f64 = 1e-12;

/// The cheapest of all assignments of every row to a column of its own; `None` without one.
fn cheapest<N: Clone + PartialOrd + Add<Output = N>>(
    costs: &[Vec<N>],
    zero: &N,
    used: u32,
) -> Option<N> {
    let Some((row, rest)) = costs.split_first() else { return Some(zero.clone()) };
    let free = row.iter().enumerate().filter(|(column, _)| used >> column & 1 == 0);
    let sums = free.filter_map(|(column, cost)| {
        cheapest(rest, zero, used | 1 << column).map(|sum| cost.clone() + sum)
    });
    sums.reduce(|least, sum| if sum < least { sum } else { least })
}

/// The cheapest assignment of as many pairs as there can be.
fn least<N: Clone + PartialOrd + Add<Output = N>>(costs: &[Vec<N>], zero: &N) -> N {
    let columns = costs.first().map_or(0, Vec::len);
    let transposed: Vec<Vec<N>> =
        (0..columns).map(|column| costs.iter().map(|row| row[column].clone()).collect()).collect();
    let wide = if costs.len() <= columns { costs } else { &transposed };
    cheapest(wide, zero, 0).expect("not more rows than columns")
}

fn exactly(costs: &[Vec<f64>]) -> Costs {
    let row = |row: &Vec<f64>| row.iter().map(|cost| Some(Real::from_double(*cost))).collect();
    costs.iter().map(row).collect()
}

fn less(costs: &Costs, pairs: usize, bound: f64) -> bool {
    let bound = Real::from_double(bound);
    costs_less(costs, pairs, &bound).expect("nothing is forbidden").less
}

#[test]
fn all_assignments_up_to_7_by_7_have_the_least_cost_of_the_model() {
    let mut draw = Draw::new(1);
    for (rows, columns) in (1..=7).flat_map(|rows| (1..=7).map(move |columns| (rows, columns))) {
        for highest in [1, 3, 9, 1000] {
            let mut row = || (0..columns).map(|_| f64::from(draw.between(0, highest))).collect();
            let costs: Vec<Vec<f64>> = (0..rows).map(|_| row()).collect();
            let (least, pairs) = (least(&costs, &0.0), rows.min(columns));
            let exact = exactly(&costs);
            assert!(!less(&exact, pairs, least) && !less(&exact, pairs, least - TINY));
            assert!(less(&exact, pairs, least + TINY), "{costs:?}");
            let found = least_cost(&exact, pairs).expect("nothing is forbidden");
            assert!(found.cost == Real::from_double(least), "{costs:?}");
        }
    }
}

/// The cheapest of all assignments of so many pairs, none of them forbidden; H-01 asks for fewer
/// pairs than tracks.
fn cheapest_of(costs: &[Vec<Option<f64>>], pairs: usize, used: u32) -> Option<f64> {
    if pairs == 0 {
        return Some(0.0);
    }
    let (row, rest) = costs.split_first()?;
    let free = row.iter().enumerate().filter(|(column, _)| used >> column & 1 == 0);
    let sums = free.filter_map(|(column, cost)| {
        Some((*cost)? + cheapest_of(rest, pairs - 1, used | 1 << column)?)
    });
    sums.chain(cheapest_of(rest, pairs, used)).reduce(f64::min)
}

/// H-01
#[test]
fn fewer_pairs_some_of_them_forbidden_are_decided_as_by_trying_all() {
    let mut draw = Draw::new(12);
    let (mut possible, mut impossible) = (0, 0);
    for case in 0..300 {
        let (rows, columns) = (draw.between(1, 7), draw.between(1, 7));
        let mut cost = || {
            let (is_allowed, cost) = (draw.between(0, 9) >= case % 10, draw.between(0, 9));
            is_allowed.then_some(f64::from(cost))
        };
        let costs: Vec<Vec<Option<f64>>> =
            (0..rows).map(|_| (0..columns).map(|_| cost()).collect()).collect();
        let exact = |cost: &Option<f64>| cost.map(Real::from_double);
        let table: Costs = costs.iter().map(|row| row.iter().map(exact).collect()).collect();
        let columns = costs[0].len();
        for pairs in 1..=costs.len().min(columns) {
            let less =
                |bound: f64| costs_less(&table, pairs, &Real::from_double(bound)).map(|it| it.less);
            if let Some(least) = cheapest_of(&costs, pairs, 0) {
                assert_eq!(
                    [least - TINY, least, least + TINY].map(less),
                    [Ok(false), Ok(false), Ok(true)]
                );
                possible += 1;
            } else {
                let most = less(0.0).expect_err("there is no assignment of so many pairs");
                assert!(most < pairs && cheapest_of(&costs, most, 0).is_some(), "{costs:?}");
                impossible += 1;
            }
        }
    }
    assert!(possible > 100 && impossible > 50, "{possible} {impossible}");
}

/// Roots, which doubles round: on the least sum itself only exact numbers can tell.
#[test]
fn a_bound_that_is_the_least_sum_of_roots_is_not_undercut() {
    let mut draw = Draw::new(11);
    for (rows, columns) in [(1, 1), (2, 5), (5, 2), (4, 4), (6, 6), (6, 7), (7, 6), (7, 7)] {
        let mut root = || Real::from_integer(draw.between(1, 50).into()).sqrt();
        let costs: Vec<Vec<Real>> =
            (0..rows).map(|_| (0..columns).map(|_| root()).collect()).collect();
        let (least, pairs) = (least(&costs, &Real::zero()), rows.min(columns));
        let costs: Costs =
            costs.into_iter().map(|row| row.into_iter().map(Some).collect()).collect();
        let less =
            |bound: &Real| costs_less(&costs, pairs, bound).expect("nothing is forbidden").less;
        let tiny = Real::from_double(2f64.powi(-200));
        assert!(!less(&least) && !less(&(&least - &tiny)) && less(&(&least + &tiny)));
    }
}

/// A list in the field of view, or beyond it, passes stage i exactly when the mean of the cheapest
/// of all assignments is below `theta_tr`.
#[test]
fn stage_i_decides_up_to_7_tracks_and_detections_as_all_assignments_do() {
    let mut draw = Draw::new(2);
    let (mut decided, mut beyond) = (0, 0);
    while decided < 300 {
        let mut places = |count: i32| -> Vec<(f64, f64)> {
            let mut place = || f64::from(draw.between(-3000, 3000)) / 64.0;
            (0..count).map(|_| (place(), place())).collect()
        };
        let [place] = places(1)[..] else { unreachable!("one was asked for") };
        let (seen, sent) = (places(1 + decided % 7), places(1 + decided / 7 % 7));
        let apart = |a: (f64, f64), b: (f64, f64)| (a.0 - b.0).hypot(a.1 - b.1);
        let radius = seen.iter().map(|it| apart(place, *it)).fold(0.0, f64::max);
        if sent.iter().any(|it| (apart(place, *it) - radius).abs() < 1e-6) {
            continue;
        }
        let gated: Vec<_> = sent.iter().filter(|it| apart(place, **it) < radius).collect();
        let costs: Vec<Vec<f64>> =
            gated.iter().map(|a| seen.iter().map(|b| apart(**a, *b)).collect()).collect();
        let mut cycle = cycle(place, &sent, &seen);
        decided += 1;
        if gated.is_empty() {
            cycle.parameters.theta_tr = 1e-3;
            assert_eq!(failed(&cycle), None, "{cycle:?}");
            beyond += 1;
            continue;
        }
        let pairs = i32::try_from(gated.len().min(seen.len())).expect("at most 7");
        let mean = least(&costs, &0.0) / f64::from(pairs);
        for (factor, safe) in [(1.0 - 1e-9, false), (1.0 + 1e-9, true)] {
            cycle.parameters.theta_tr = mean * factor;
            assert_eq!(failed(&cycle).is_none(), safe, "{cycle:?}");
        }
    }
    assert!((5..150).contains(&beyond), "{beyond}");
}

#[test]
fn a_solver_of_others_finds_the_least_cost_of_the_model_in_large_tables() {
    let mut draw = Draw::new(3);
    for (rows, columns) in [(20, 60), (40, 40), (40, 50), (60, 60)] {
        let table = Matrix::from_fn(rows, columns, |_| i64::from(draw.between(0, 999)));
        let (least, _) = kuhn_munkres_min(&table);
        let least = f64::from(i32::try_from(least).expect("a small sum"));
        #[expect(clippy::cast_precision_loss, reason = "small integers")]
        let costs: Vec<Vec<f64>> =
            table.iter().map(|row| row.iter().map(|cost| *cost as f64).collect()).collect();
        let costs = exactly(&costs);
        assert!(!less(&costs, rows, least) && !less(&costs, rows, least - 1e-9));
        assert!(less(&costs, rows, least + 1e-9));
    }
}

/// On the line (3, 4) t distances are 5 |t - t'|: the solver of others sums them exactly, and a
/// mean of 32 of them is a double.
#[test]
fn a_mean_of_many_tracks_on_the_threshold_fails_and_one_double_below_passes() {
    let mut draw = Draw::new(4);
    for _ in 0..5 {
        let mut steps =
            |count: usize| -> Vec<i32> { (0..count).map(|_| draw.between(0, 2000)).collect() };
        let sent = steps(32);
        let mut seen = steps(40);
        // The farthest detection, so that every track is in view.
        seen.push(3000);
        let table = Matrix::from_fn(32, 41, |(i, j)| 5 * i64::from((sent[i] - seen[j]).abs()));
        let (least, _) = kuhn_munkres_min(&table);
        let mean = f64::from(i32::try_from(least).expect("a small sum")) / 32.0;
        let on_line = |t: &i32| (3.0 * f64::from(*t), 4.0 * f64::from(*t));
        let places = |list: &[i32]| list.iter().map(on_line).collect::<Vec<_>>();
        let mut cycle = cycle((-3.0, -4.0), &places(&sent), &places(&seen));
        assert!(mean > 0.01);
        for (theta_tr, safe) in [(mean, false), (mean.next_up(), true), (mean.next_down(), false)] {
            cycle.parameters.theta_tr = theta_tr;
            assert_eq!(failed(&cycle).is_none(), safe, "mean {mean}, theta_tr {theta_tr}");
        }
    }
}

fn cycle(place: (f64, f64), sent: &[(f64, f64)], seen: &[(f64, f64)]) -> Cycle {
    let mut cycle = base(Profile::PAPER, MotRemote);
    (cycle.ego.x, cycle.ego.y) = place;
    cycle.trajectory = None;
    cycle.tracks = tracks((1..).zip(sent).map(|(id, (x, y))| track(id, *x, *y)).collect());
    cycle.detections = detections(seen.iter().map(|(x, y)| detection(*x, *y)).collect());
    cycle
}
