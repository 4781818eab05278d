//! Cases near a threshold, and what the three readings say of them (`spec/4-arithmetic.md#strict-and-lax`).

use mufasa_model::cycle::check;
use mufasa_model::input::cycle::{Cycle, Profile, Trajectory, TrajectoryPoint};
use mufasa_model::numbers::real::unfiltered;
use mufasa_model::report::{Reading, Rule, Stage};
use mufasa_model::services::configuration::Configuration;

use crate::base::*;

/// Safe in the readings strict, exact, lax.
pub fn safe(cycle: &Cycle) -> [bool; 3] {
    [Reading::Strict, Reading::Exact, Reading::Lax]
        .map(|reading| check(cycle, reading).expect("valid").failed_stage.is_none())
}

pub const YES: [bool; 3] = [true; 3];
pub const NO: [bool; 3] = [false; 3];
/// Within the margin on the safe side.
pub const NEAR_SAFE: [bool; 3] = [false, true, true];
/// Within the margin on the unsafe side.
pub const NEAR_UNSAFE: [bool; 3] = [false, false, true];

/// Cases near a threshold: `(configuration, profile, offset -> cycle)`, positive offsets unsafe.
pub type Near = (&'static str, Configuration, Profile, fn(&mut Cycle, f64));

pub fn points(cycle: &mut Cycle) -> &mut Vec<TrajectoryPoint> {
    &mut cycle.trajectory.as_mut().expect("there is one").points
}

pub fn two_points(cycle: &mut Cycle, millis: i64, [x, y]: [f64; 2]) {
    cycle.ego.speed = 0.0;
    cycle.parameters.start_tolerance = 100.0;
    let points = vec![at_time(0, 0.0, 0.0), at_time(millis * 1_000_000, x, y)];
    cycle.trajectory = Some(Trajectory { stamp_ns: NOW, points });
    cycle.tracks = tracks(vec![]);
}

/// Strict and lax move each comparison by the margin, towards rejection and towards acceptance, by no
/// more than the margin, and farther with a larger one. The interval filter in front of the exact
/// arithmetic changes no report of them.
pub fn margins_move(cases: &[Near]) {
    margins_move_strictly(cases, 1e-6);
}

/// The same; strictly the margin is at least `least`.
pub fn margins_move_strictly(cases: &[Near], least: f64) {
    for (name, configuration, profile, with) in cases {
        let at = |offset: f64, delta: f64| {
            let mut cycle = base(*profile, *configuration);
            with(&mut cycle, offset);
            cycle.parameters.delta = delta;
            safe(&cycle)
        };
        assert_eq!(at(-3.0 * least, 1e-6), YES, "{name}: safe by three margins");
        assert_eq!(at(-0.5 * least, 1e-6), NEAR_SAFE, "{name}: safe by half a margin");
        assert_eq!(at(0.5e-6, 1e-6), NEAR_UNSAFE, "{name}: unsafe by half a margin");
        assert_eq!(at(3e-6, 1e-6), NO, "{name}: unsafe by three margins");
        assert_eq!(at(-3.0 * least, 10.0 * least), NEAR_SAFE, "{name}: a larger delta");
        assert_eq!(at(3e-6, 1e-5), NEAR_UNSAFE, "{name}: a larger delta");
        for offset in [-1e-6, 0.0, 1e-6] {
            let mut cycle = base(*profile, *configuration);
            with(&mut cycle, offset);
            // Exact arithmetic alone takes its time: a short trajectory will do.
            cycle.trajectory.iter_mut().for_each(|list| list.points.truncate(20));
            for reading in [Reading::Strict, Reading::Exact, Reading::Lax] {
                let plain = unfiltered(|| check(&cycle, reading));
                assert_eq!(check(&cycle, reading), plain);
            }
        }
    }
}

/// The same, and beyond the margin each case breaks the rule of stage ii that it is about.
pub fn margins_move_rules(cases: &[Near], rules: &[Rule]) {
    margins_move(cases);
    assert_eq!(cases.len(), rules.len());
    for ((name, configuration, profile, with), expected) in cases.iter().zip(rules) {
        let mut cycle = base(*profile, *configuration);
        with(&mut cycle, 3e-6);
        assert_eq!(rule(&cycle, Stage::Ii), Some(*expected), "{name}");
    }
}
