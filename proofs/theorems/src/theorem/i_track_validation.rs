//! What the mean of stage i can hide (F-01, H-01).

use crate::claim::{Theorem, Wrong};
use crate::numbers::assignment::{Costs, costs_less};
use crate::numbers::real::Real;
use crate::numbers::real::formula::{Formula, at_most, given, less};

/// The theorems of this file.
pub const THEOREMS: &[Theorem] = &[
    Theorem {
        id: "a_ghost_k_theta_from_every_detection_is_caught",
        statement: "F-01: when all k gated tracks are assigned and one is at least k theta_tr from every \
                    detection, the least cost is not below k theta_tr",
        domain: "k = 1 and 1 or 2 detections, k = 2 and 2; all other distances >= 0, theta_tr > 0",
        claim: || ghost_is_caught(Real::from_integer),
        wrong: Wrong {
            statement: "at least (k - 1/2) theta_tr from every detection",
            claim: || ghost_is_caught(|k| Real::from_integer(k) - Real::ratio(1, 2)),
        },
    },
    Theorem {
        id: "a_ghost_nearer_than_k_theta_can_hide_in_the_mean",
        statement: "F-01: k - 1 tracks on their detections and a ghost nearer than k theta_tr to its own \
                    cost less than k theta_tr: the bound is tight",
        domain: "k = 1, 2, 3; the ghost's distances to other detections at least its own",
        claim: || ghost_hides(1),
        wrong: Wrong { statement: "nearer than (k + 1) theta_tr", claim: || ghost_hides(2) },
    },
    Theorem {
        id: "a_ghost_that_no_detection_is_near_has_no_assignment",
        statement: "H-01, F-01: a gated track without a detection closer than theta_track_max leaves no \
                    assignment of all k gated tracks",
        domain: "k = 1, 2, 3 tracks and k to 3 detections; every choice of pairs closer than theta_track_max, all \
                 distances",
        claim: || no_assignment(true),
        wrong: Wrong { statement: "also when it has one", claim: || no_assignment(false) },
    },
];

/// Which of these sizes: a branch that the solver knows nothing of.
fn one_of<T: Copy>(sizes: &[T]) -> T {
    let (last, others) = sizes.split_last().expect("some sizes");
    *others.iter().find(|_| coin()).unwrap_or(last)
}

/// Both answers, each on a path of its own.
fn coin() -> bool {
    Real::variable("coin") < Real::zero()
}

/// A number >= 0.
fn distance(name: &str) -> Real {
    let distance = Real::variable(name);
    given(at_most(&Real::zero(), &distance));
    distance
}

fn theta_tr() -> Real {
    let theta_tr = Real::variable("theta_tr");
    given(less(&Real::zero(), &theta_tr));
    theta_tr
}

/// Distances of k tracks to detections.
fn distances(k: usize, columns: usize, of: impl Fn(usize, usize) -> Option<Real>) -> Costs {
    (0..k).map(|row| (0..columns).map(|column| of(row, column)).collect()).collect()
}

fn number(k: usize) -> i128 {
    i128::try_from(k).expect("a small size")
}

fn ghost_is_caught(factor: fn(i128) -> Real) -> Formula {
    let (k, columns) = one_of(&[(1, 1), (1, 2), (2, 2)]);
    let theta_tr = theta_tr();
    let costs = distances(k, columns, |row, column| {
        let distance = distance(&format!("c {row} {column}"));
        if row == 0 {
            given(at_most(&(factor(number(k)) * &theta_tr), &distance));
        }
        Some(distance)
    });
    let bound = Real::from_integer(number(k)) * &theta_tr;
    Formula::from(costs_less(&costs, k, &bound).is_ok_and(|answer| !answer.less))
}

fn ghost_hides(beyond: i128) -> Formula {
    let k = one_of(&[1, 2, 3]);
    let theta_tr = theta_tr();
    let ghost = distance("ghost");
    given(less(&ghost, &(Real::from_integer(number(k) + beyond - 1) * &theta_tr)));
    let costs = distances(k, k, |row, column| {
        if row == column {
            return Some(if row == 0 { ghost.clone() } else { Real::zero() });
        }
        let other = distance(&format!("c {row} {column}"));
        if row == 0 {
            given(at_most(&ghost, &other));
        }
        Some(other)
    });
    let bound = Real::from_integer(number(k)) * &theta_tr;
    Formula::from(costs_less(&costs, k, &bound).is_ok_and(|answer| answer.less))
}

fn no_assignment(alone: bool) -> Formula {
    let (k, columns) = one_of(&[(1, 1), (1, 2), (1, 3), (2, 2), (2, 3), (3, 3)]);
    let costs = distances(k, columns, |row, column| {
        let near = if row == 0 { !alone } else { coin() };
        near.then(|| distance(&format!("c {row} {column}")))
    });
    Formula::from(costs_less(&costs, k, &theta_tr()).is_err())
}
