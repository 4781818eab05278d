//! Starts and steps of a trajectory, and the gap, on both sides of their thresholds (H-04, H-07, H-10
//! and H-11 of `spec/hardened/README.md`).

use crate::scene::{NOW_NS, Scene, detection, scene};
use mufasa::input::cycle::Lead;
use mufasa::input::profile::Profile;
use mufasa::report::{Outcome, Rule, Stage};
use mufasa::services::configuration::Configuration::{AllRemote, MotRemote, PlanRemote};

fn base() -> Scene {
    scene(Profile::HARDENED, MotRemote, [0.0, 0.0])
}

/// What a change of the base makes fail, on either side of a threshold: by -1e-7 and by 1e-7.
fn sides(change: impl Fn(&mut Scene, f64)) -> [Option<Rule>; 2] {
    [-1e-7, 1e-7].map(|off| {
        let mut scene = base();
        change(&mut scene, off);
        scene.rule()
    })
}

#[test]
fn a_trajectory_starts_in_the_direction_of_the_cav() {
    let turned = |scene: &mut Scene, sin: f64| {
        (scene.ego.sin, scene.ego.cos) = (sin, (1.0 - sin * sin).sqrt());
    };
    for sign in [1.0, -1.0] {
        let found = sides(|scene, off| turned(scene, sign * (0.17 + off)));
        assert_eq!(found, [None, Some(Rule::StartHeading)]);
    }
    let mut scene = base();
    scene.ego.cos = -1.0;
    assert_eq!(scene.rule(), Some(Rule::StartHeading));
}

#[test]
fn a_trajectory_starts_no_farther_aside_than_the_tolerance() {
    for sign in [1.0, -1.0] {
        let found = sides(|scene, off| scene.ego.y = sign * (0.5 + off));
        assert_eq!(found, [None, Some(Rule::StartOffset)]);
    }
    // Along the first heading the other tolerance holds.
    let found = sides(|scene, off| scene.ego.x = -2.0 - off);
    assert_eq!(found, [None, Some(Rule::StartPosition)]);
}

/// The base with the points from the sixth on moved.
fn moved(dx: f64, dy: f64) -> Scene {
    let mut scene = base();
    scene.points.iter_mut().skip(5).for_each(|point| {
        point.x += dx;
        point.y += dy;
    });
    scene
}

#[test]
fn a_step_back_is_noise_up_to_a_tenth_of_a_metre_per_second() {
    // A step of 0.5 m in 0.1 s less what is moved.
    for (back, rule) in [(0.01 - 1e-7, None), (0.01 + 1e-7, Some(Rule::StepForward))] {
        assert_eq!(moved(-0.5 - back, 0.0).rule(), rule, "{back}");
    }
}

/// Up to the sixth point 0.1 of twice 2.5 m, 0.1 m and 0.02 m/s: 0.61 m for both headings together.
#[test]
fn a_step_lies_along_its_headings() {
    for sign in [1.0, -1.0] {
        for (aside, rule) in [(0.305 - 1e-7, None), (0.305 + 1e-7, Some(Rule::Slide))] {
            assert_eq!(moved(0.0, sign * aside).rule(), rule, "{aside}");
        }
    }
    // A step of length 0 leads nowhere.
    assert_eq!(moved(-0.5, 0.0).rule(), None);
}

/// On an arc a vehicle may be pointed at from the rear axle to L/2 ahead of it: from 0 to L times
/// half the sine to the side, in both headings, and the slack of all steps so far.
#[test]
fn a_step_on_an_arc() {
    let sin = 0.02_f64;
    let cos = (1.0 - sin * sin).sqrt();
    for (inward, sign, rule) in [
        (0.0, -1.0, Some(Rule::Slide)),
        (0.0, 1.0, None),
        (1.0, 1.0, Some(Rule::Slide)),
        (1.0, -1.0, None),
    ] {
        let mut scene = base();
        // u x (h1 + h2) = x sin - y (1 + cos) is from -L sin to 0, and slack to both sides; the
        // slack is of u . (h1 + h2), which has y sin in it. Four steps ahead before.
        let (x, length) = (0.5, scene.ego.length);
        let slack = |y: f64| 0.1 * (4.0 + x * (1.0 + cos) + y * sin) + 0.1 + 0.02 * 0.5;
        let aside = |y: f64| -inward * length * sin + (1.0 - 2.0 * inward) * slack(y);
        let mut y = 0.0;
        for _ in 0..20 {
            y = (x * sin - aside(y)) / (1.0 + cos);
        }
        let y = y + sign * 1e-7;
        scene.points.iter_mut().skip(5).for_each(|point| {
            let along = point.x - 2.0 - x;
            (point.x, point.y) = (2.0 + x + along * cos, y + along * sin);
            (point.cos, point.sin) = (cos, sin);
        });
        assert_eq!(scene.rule(), rule, "{inward} {sign}");
    }
}

/// H-10: the grid is examined whatever else ran.
#[test]
fn the_grid_map_is_examined_beside_detections() {
    for configuration in [AllRemote, PlanRemote] {
        let mut scene = scene(Profile::HARDENED, configuration, [0.0, 0.0]);
        // The cell of the CAV itself: 100 m from the origin of the grid of 1 m cells.
        let bit = 100 * 200 + 102;
        scene.occupied.as_mut().expect("a grid")[bit / 8] |= 1 << (bit % 8);
        scene.detections = Some(vec![detection(3.0, 50.1)]);
        assert_eq!(
            scene.failure().map(|(stage, it)| (stage, it.rule)),
            Some((Stage::V, Rule::Occupied))
        );
        scene.occupied = None;
        let report = scene.report();
        assert_eq!(report.failed_stage, None);
        assert!(matches!(report.stages[3], Outcome::Skipped(_)), "stage iii ran");
    }
}

/// `s_follow` at equal speeds is 9 m where stage iv runs, as in the paper. Elsewhere `s_react` is what
/// `s_stop` is more than `s_b` of the leader: 2.270_625 m less 1.5625 m.
#[test]
fn the_gap_is_compared_when_stage_iv_does_not_run() {
    let with = |configuration, gap: f64, speed: f64| {
        let mut scene = scene(Profile::HARDENED, configuration, [0.0, 0.0]);
        scene.parameters.safety_time = gap;
        scene.parameters.theta_tr = speed;
        scene.change = |cycle| {
            let (gap, speed) = (cycle.parameters.safety_time, cycle.parameters.theta_tr);
            cycle.parameters = mufasa::input::parameters::Parameters::default();
            cycle.lead = Some(Lead { stamp_ns: NOW_NS, gap, speed });
        };
        scene.failure().map(|(stage, it)| (stage, it.rule))
    };
    let failed = Some((Stage::Iv, Rule::Gap));
    for configuration in [AllRemote, PlanRemote] {
        assert_eq!(with(configuration, 0.708_125 - 1e-7, 5.0), failed);
        assert_eq!(with(configuration, 0.708_125 + 1e-7, 5.0), None);
        // A faster leader leaves more than is needed.
        assert_eq!(with(configuration, 0.0, 7.0), failed);
        assert_eq!(with(configuration, 1e-7, 7.0), None);
    }
    assert_eq!(with(MotRemote, 9.0, 5.0), failed);
    assert_eq!(with(MotRemote, 9.0 + 1e-7, 5.0), None);
}
