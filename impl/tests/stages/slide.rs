//! Where the headings of all steps lead together, on both sides of the bound (H-11 of
//! `spec/hardened/H-11.md`, `findings/F-41.md`).

use crate::scene::{NOW_NS, Scene, scene};
use mufasa::input::cycle::TrajectoryPoint;
use mufasa::input::profile::Profile;
use mufasa::report::Rule;
use mufasa::services::configuration::Configuration::MotRemote;

/// The most points that a trajectory may have.
const MOST: usize = 1024;

/// The scene with these points, so many ns after one another, and a wide road.
fn driven(points: Vec<[f64; 3]>, step_ns: i64) -> Scene {
    let mut scene = scene(Profile::HARDENED, MotRemote, [0.0, 0.0]);
    for section in &mut scene.cross_sections {
        (section.left[1], section.right[1]) = (40.0, -40.0);
    }
    let point = |(t_ns, [x, y, angle]): (i64, [f64; 3])| {
        let (sin, cos) = angle.sin_cos();
        TrajectoryPoint { t_ns, x, y, cos, sin }
    };
    let times = (0..).map(|i| NOW_NS + i * step_ns);
    scene.points = times.zip(points).map(point).collect();
    scene
}

/// The point that lies aside, if one does and nothing else is wrong.
fn aside(scene: &Scene) -> Option<usize> {
    let (_, witness) = scene.failure()?;
    assert_eq!(witness.rule, Rule::Slide);
    witness.point
}

/// A turn in the first step, then straight headings, and each point from the third on as far to
/// their side as it may be by the turn and the slack of all steps: less by `inside`, one point more
/// by as much.
fn along_the_bound([turn, step]: [f64; 2], inside: f64, points: &Points) -> Option<usize> {
    let (sin, cos) = turn.sin_cos();
    let [found, mirrored] = [1.0, -1.0].map(|side| {
        let place = |i: usize| {
            let (along, t) = (step * (i as f64 - 1.0), step / 5.0 * i as f64);
            let slack = 0.1 * (step * (1.0 + cos) + 2.0 * along) + 0.1 + 0.02 * t;
            let off = if points.outside == Some(i) { inside } else { -inside };
            match i {
                0 => [0.0; 3],
                1 => [step, 0.0, side * turn],
                _ => {
                    let aside = 0.5 * (4.5 * sin + step * sin + slack) + off;
                    let [x, y] = [along * cos - aside * sin, along * sin + aside * cos];
                    [step + x, side * y, side * turn]
                }
            }
        };
        aside(&driven((0..points.count).map(place).collect(), (step / 5.0 * 1e9).round() as i64))
    });
    assert_eq!(found, mirrored);
    found
}

/// So many, with none or one beyond the bound.
struct Points {
    count: usize,
    outside: Option<usize>,
}

const TURNS: [f64; 2] = [0.0, 0.06];

#[test]
fn the_ways_aside_of_steps_add_up() {
    for turn in TURNS {
        for outside in [None, Some(2), Some(7), Some(29)] {
            let points = Points { count: 30, outside };
            assert_eq!(along_the_bound([turn, 0.5], 1e-7, &points), outside, "{turn}");
        }
    }
}

/// So near the bound plain doubles decide nothing: each point adds its step to the exact sums.
#[test]
fn they_add_up_over_the_longest_trajectory() {
    for turn in TURNS {
        for inside in [1e-7, 1e-9] {
            for outside in [None, Some(600), Some(1000), Some(1023)] {
                let points = Points { count: MOST, outside };
                let found = along_the_bound([turn, 0.05], inside, &points);
                assert_eq!(found, outside, "{turn} {inside}");
            }
        }
    }
}
