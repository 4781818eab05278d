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

/// A weave along which the rear axle goes, on arcs; the points are so far ahead of it.
#[test]
fn a_trajectory_that_is_driven_passes() {
    for count in [60, MOST] {
        let step = 51.0 / count as f64;
        for ahead in [0.0, 1.0, 2.25] {
            let angle = |i: usize| 0.3 * (0.6 * step * i as f64).sin();
            let (mut rear, mut points) = ([-ahead, 0.0], Vec::new());
            for i in 0..count {
                let (sin, cos) = angle(i).sin_cos();
                points.push([rear[0] + ahead * cos, rear[1] + ahead * sin, angle(i)]);
                // The chord of an arc goes along the middle heading.
                let (sin, cos) = f64::midpoint(angle(i), angle(i + 1)).sin_cos();
                rear = [rear[0] + step * cos, rear[1] + step * sin];
            }
            assert_eq!(aside(&driven(points, (step / 5.0 * 1e9) as i64)), None, "{ahead}");
        }
    }
}

/// Eleven small turns to and fro within 57 ms, to one side with the rear axle and back with what is
/// L/2 ahead of it: 0.1 m aside each.
#[test]
fn turns_to_and_fro_lead_nowhere() {
    for side in [1.0, -1.0] {
        let (turn, step) = (0.05_f64, 0.026);
        let mut points = vec![[0.0, 0.0, 0.0]];
        for i in 1..=22 {
            let [x, y, _] = points[i - 1];
            let out = i % 2 == 1;
            // The chord, and what swings out when a vehicle turns that is pointed at L/2 ahead.
            let (sin, cos) = (0.5 * turn).sin_cos();
            let swing = if out { 4.0 * 0.5 * turn.sin() } else { 0.0 };
            let to = if out { side * turn } else { 0.0 };
            points.push([x + step * cos, y + side * (step * sin + swing), to]);
        }
        for i in 0..10 {
            points.push([0.6 + 0.1 * f64::from(i), points[22][1], 0.0]);
        }
        let mut scene = driven(points, 2_600_000);
        (scene.ego.length, scene.ego.speed) = (4.0, 10.0);
        (scene.points).iter_mut().skip(23).zip(1_i64..).for_each(|(point, i)| {
            point.t_ns = NOW_NS + 57_200_000 + 190_000_000 * i;
            point.x += 1.5 * i as f64;
        });
        // The first turn to and fro leads 0.2 m aside in both headings; 0.11 m are left open.
        assert_eq!(aside(&scene), Some(2), "{side}");
    }
}

/// Where a trajectory stands, it may be measured 5 cm and 1 cm/s aside.
#[test]
fn what_stands_does_not_slide() {
    for (off, found) in [(-1e-7, None), (1e-7, Some(1))] {
        let place =
            |i: u32| [0.0, if i == 0 { 0.0 } else { 0.05 + 0.001 * f64::from(i) + off }, 0.0];
        let mut scene = driven((0..30).map(place).collect(), 100_000_000);
        scene.ego.speed = 0.0;
        assert_eq!(aside(&scene), found, "{off}");
    }
}

/// What was gained in a turn is lost when it is turned back on the spot, by 0.014 in each of ten
/// steps, which H-11 leaves open everywhere: steps of length 0 count. Five are too many.
#[test]
fn a_turn_back_on_the_spot_counts() {
    let sin = 0.14_f64;
    // u x (h1 + h2) of the turn to the left is -L sin and, up to the sixth point, a slack of 0.6 m.
    let most = |off: f64| 0.5 * (4.5 * sin + off);
    for (back, found) in [(0.0, None), (1.0, Some(10))] {
        let angle = |i: usize| match i {
            0..=4 => 0.0,
            _ => sin.asin() * (1.0 - 0.1 * back * (i.min(15) - 5) as f64),
        };
        let place = |i: usize| {
            let y = if i < 5 { 0.0 } else { most(0.4) };
            [0.5 * i.min(5) as f64, y, angle(i)]
        };
        let mut scene = driven((0..30).map(place).collect(), 100_000_000);
        (scene.ego.speed, scene.parameters.start_tolerance) = (0.0, 5.0);
        assert_eq!(aside(&scene), found, "{back}");
    }
}
