//! Horizons, starts, steps, turns and progress of a trajectory on both sides of their thresholds
//! (H-04, H-07 and H-10 to H-12 of `spec/3-stages.md#hardened-profile`).

use crate::scene::{NOW_NS, Scene, detection, scene, track};
use mufasa::input::cycle::{Lead, TrajectoryPoint};
use mufasa::input::profile::Profile::Hardened;
use mufasa::report::{Outcome, Rule, Stage};
use mufasa::services::configuration::Configuration::{self, AllRemote, MotRemote, PlanRemote};

fn base() -> Scene {
    scene(Hardened, MotRemote, [0.0, 0.0])
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

/// Points on a straight line at these times in s, places and headings.
fn points(at: &[(f64, f64, f64, f64)]) -> Vec<TrajectoryPoint> {
    let point = |&(t, x, y, sin): &(f64, f64, f64, f64)| {
        let t_ns = NOW_NS + (t * 1e9).round() as i64;
        TrajectoryPoint { t_ns, x, y, cos: (1.0 - sin * sin).sqrt(), sin }
    };
    at.iter().map(point).collect()
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

/// The turn of the fourth point against the first, its mark, 0.3 s and this way later.
fn turning(sin: f64, way: f64) -> Option<Rule> {
    let mut scene = base();
    scene.ego.speed = 0.0;
    scene.parameters.start_tolerance = 1000.0;
    scene.ego.length = 12.0;
    scene.ego.width = 4.0;
    for section in &mut scene.cross_sections {
        (section.left[1], section.right[1]) = (40.0, -40.0);
    }
    // Two headings between, so that no step turns by 30 degrees.
    let step = way / 3.0;
    let angle = |i: f64| (i / 3.0 * sin.asin(), step);
    let mut at = vec![(0.0_f64, 0.0_f64, 0.0_f64, 0.0_f64)];
    for i in 1..=3 {
        let (_, x, y, before) = at[at.len() - 1];
        let (heading, step) = angle(f64::from(i));
        // Along the heading of the step's first point, which is what the way counts.
        let cos = (1.0 - before * before).sqrt();
        at.push((0.1 * f64::from(i), x + step * cos, y + step * before, heading.sin()));
    }
    scene.points = points(&at);
    scene.rule()
}

#[test]
fn no_vehicle_turns_on_the_spot() {
    // 0.05 + 0.03 + half the way.
    for way in [0.0, 0.2] {
        let most = 0.08 + 0.5 * way;
        assert_eq!(turning(most - 1e-6, way), None, "{way}");
        assert_eq!(turning(most + 1e-6, way), Some(Rule::TurnOnTheSpot), "{way}");
    }
}

#[test]
fn no_vehicle_turns_harder_than_tyres_hold() {
    // sin w <= 0.1 w + 11.5 * 0.09.
    let way = 6.0;
    let most = 0.1 + 11.5 * 0.09 / way;
    assert_eq!(turning(most - 1e-6, way), None);
    assert_eq!(turning(most + 1e-6, way), Some(Rule::TurnHard));
    // What measuring leaves open is no turn, however fast.
    assert_eq!(turning(0.099, 35.0), None);
}

/// Marks are half a second apart: a turn is judged against the last one before it.
#[test]
fn turns_are_judged_against_marks() {
    let turned = |from: usize, sin: f64| {
        let mut scene = base();
        scene.ego.speed = 0.0;
        // In two steps: one may turn by 0.11.
        let turned = |i: usize| match i + 1 {
            next if next < from => 0.0,
            next if next == from => 0.5 * sin,
            _ => sin,
        };
        let at = |i: usize| (0.1 * i as f64, 0.0, 0.0, turned(i));
        scene.points = points(&(0..30).map(at).collect::<Vec<_>>());
        scene.rule()
    };
    // At 0.4 s 0.05 + 0.04 is allowed; at 0.5 s, still against the first point, 0.1; at 0.7 s
    // against the point at 0.5 s, 0.07; at 1 s, the next mark, 0.1.
    for (from, most) in [(4, 0.09), (5, 0.1), (7, 0.07), (10, 0.1)] {
        assert_eq!(turned(from, most - 1e-7), None, "{from}");
        assert_eq!(turned(from, most + 1e-7), Some(Rule::TurnOnTheSpot), "{from}");
    }
}

/// Braking at `a_b` from 5 m/s to standstill after 1.5625 m.
fn braking(configuration: Configuration) -> Scene {
    let mut scene = scene(Hardened, configuration, [0.0, 0.0]);
    let at = |i: u32| {
        let t = (0.1 * f64::from(i)).min(0.625);
        (0.1 * f64::from(i), 5.0 * t - 4.0 * t * t, 0.0, 0.0)
    };
    scene.points = points(&(0..8).map(at).collect::<Vec<_>>());
    scene
}

/// `s_stop` is 2.270_625 m; places beyond the end are quarters of a metre: the first that is not
/// below 1.4 m + 0.708_125 m is 2.25 m, and half the length in front of it.
#[test]
fn a_trajectory_that_ends_soon_is_examined_beyond_its_end() {
    let front = 1.5625 + 2.25 + 2.25 + 2.0;
    for (x, met) in [(front - 1e-7, true), (front + 1e-7, false)] {
        for configuration in [MotRemote, AllRemote, PlanRemote] {
            let mut scene = braking(configuration);
            scene.tracks = None;
            scene.detections = Some(vec![detection(x, 0.0)]);
            let rule = met.then_some(Rule::Collision);
            assert_eq!(scene.rule(), rule, "{x} {configuration:?}");
            scene.ego.x = -0.3;
            assert_eq!(scene.rule(), rule, "behind the first point");
        }
    }
}

/// A CAV that is shorter than a quarter of a metre is examined at each multiple of its length.
#[test]
fn a_short_cav_is_examined_at_multiples_of_its_length() {
    let met = |x: f64| {
        let mut scene = braking(MotRemote);
        (scene.ego.length, scene.ego.center_offset) = (0.2, 0.0);
        // 4 m/s in short steps, and an end 0.15 m before s_stop.
        let at = |i: u32| (0.01 * f64::from(i), (0.04 * f64::from(i)).min(2.120_625), 0.0, 0.0);
        scene.points = points(&(0..70).map(at).collect::<Vec<_>>());
        scene.tracks = None;
        scene.detections = Some(vec![detection(x, 0.0)]);
        scene.rule()
    };
    // 0.15 m is missing: at 0.2 m, once.
    let front = 2.120_625 + 0.2 + 0.1 + 2.0;
    assert_eq!(met(front - 1e-7), Some(Rule::Collision));
    assert_eq!(met(front + 1e-7), None);
}

/// e counts only when the CAV is ahead of the first point.
#[test]
fn a_cav_behind_the_first_point_has_no_start_to_make_up_for() {
    // s_stop and its next point, 2.5 m, or with 0.3 m ahead 3 m.
    let met = |x: f64, ahead: f64| {
        let mut scene = base();
        scene.tracks = None;
        scene.ego.x = ahead;
        scene.detections = Some(vec![detection(x, 0.0)]);
        scene.rule().is_some()
    };
    let front = 2.5 + 1.4 + 2.25 + 2.0;
    assert!(met(front - 1e-7, 0.0) && !met(front + 1e-7, 0.0));
    assert!(!met(front + 1e-7, -0.3));
    assert!(met(front + 0.5 - 1e-7, 0.3) && !met(front + 0.5 + 1e-7, 0.3));
}

/// Where the front of the CAV is at the last point that stage iii examines, `s_CAV` being so many m.
fn examined_with(s_cav: f64) -> f64 {
    let met = |x: f64| {
        let mut scene = scene(Hardened, PlanRemote, [0.0, 0.0]);
        scene.parameters.safety_time = s_cav / scene.ego.speed;
        scene.tracks = Some(vec![track(1, x, 0.0)]);
        scene.rule().is_some()
    };
    let fronts = (0..30).map(|i| 0.5 * f64::from(i)).filter(|way| {
        let touching = way + 1.4 + 2.25 + 2.0;
        met(touching - 1e-7) && !met(touching + 1e-7)
    });
    fronts.fold(f64::NAN, f64::max)
}

/// `s_stop` is 2.270_625 m, and the points are at each 0.5 m.
#[test]
fn the_next_point_is_the_first_beyond_s_stop() {
    // Within `s_CAV`, where that is farther, or behind it.
    for (s_cav, farthest) in
        [(0.0, 2.5), (2.2, 2.5), (2.4, 2.5), (2.5, 2.5), (2.99, 2.5), (3.0, 3.0), (3.2, 3.0)]
    {
        assert!((examined_with(s_cav) - farthest).abs() < 1e-9, "{s_cav}");
    }
    // A point at (1 + 1e-6) s_stop is not beyond it; without tau s_stop is s_b.
    let met = |v: f64| {
        let mut scene = base();
        (scene.parameters.tau, scene.ego.speed) = (0.0, v);
        (scene.tracks, scene.detections) = (None, Some(vec![detection(3.0 + 5.65 - 1e-7, 0.0)]));
        scene.rule().is_some()
    };
    // s_b = v^2/16 is 2.5 m.
    let v = 40.0_f64.sqrt();
    assert!(met(v + 1e-7) && met(v) && !met(v - 1e-5));
}

/// Between now and the time of the first point the CAV may brake or accelerate: d = 50 ms.
#[test]
fn the_speed_at_the_first_point_is_from_now_on_or_since() {
    for (shift_ns, most) in [(-50_000_000, 8.0), (50_000_000, 3.0)] {
        // v_hi = 5 m/s + rate * 0.05 s; after 1.2 s, with 3 m/s^2 and 2 m.
        let v_hi = 5.0 + most * 0.05;
        let farthest = v_hi * 1.2 + 1.5 * 1.44 + 2.0;
        for (off, lag, rule) in [
            (-1e-6, 1e-3, None),
            (-1e-6, 1e3, None),
            (1e-6, 1e-3, Some(Rule::ArcTooLong)),
            (1e-6, 1e3, Some(Rule::ArcTooLong)),
        ] {
            let mut scene = base();
            let speed = (farthest + off) / 1.2;
            (scene.parameters.start_tolerance, scene.parameters.lag_tolerance) = (2.0, lag);
            let at = |i: u32| {
                let t = 0.1 * f64::from(i);
                (
                    t,
                    if i <= 12 { speed * t } else { farthest + off + 0.1 * f64::from(i - 12) },
                    0.0,
                    0.0,
                )
            };
            scene.points = points(&(0..20).map(at).collect::<Vec<_>>());
            scene.points.iter_mut().for_each(|point| point.t_ns += shift_ns);
            assert_eq!(scene.rule(), rule, "{shift_ns} {off} {lag}");
        }
    }
}

/// The last point is as late as braking from `v_lo` takes: 0.625 s at 5 m/s, less or more by what
/// was accelerated since, or may be braked until then.
#[test]
fn a_trajectory_ends_at_standstill() {
    for (shift_ns, rate) in [(-50_000_000, 3.0), (50_000_000, 8.0)] {
        let needed_ns = ((5.0 - rate * 0.05) / 8.0 * 1e9_f64).ceil() as i64;
        for (end_ns, rule) in [(needed_ns, None), (needed_ns - 1, Some(Rule::EndsTooSoon))] {
            let mut scene = base();
            scene.points = points(
                &(0..6)
                    .map(|i| (0.1 * f64::from(i), 0.5 * f64::from(i), 0.0, 0.0))
                    .collect::<Vec<_>>(),
            );
            scene.points.extend(points(&[(end_ns as f64 * 1e-9, 3.0, 0.0, 0.0)]));
            scene.points.iter_mut().for_each(|point| point.t_ns += shift_ns);
            assert_eq!(scene.rule(), rule, "{shift_ns} {end_ns}");
        }
    }
}

/// H-10: the grid is examined whatever else ran.
#[test]
fn the_grid_map_is_examined_beside_detections() {
    for configuration in [AllRemote, PlanRemote] {
        let mut scene = scene(Hardened, configuration, [0.0, 0.0]);
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
        assert_eq!(matches!(report.stages[3], Outcome::Passed), configuration == AllRemote);
    }
}

/// `s_follow` at equal speeds is 9 m.
#[test]
fn the_gap_is_compared_when_stage_iv_does_not_run() {
    let mut scene = scene(Hardened, PlanRemote, [0.0, 0.0]);
    scene.change = |cycle| {
        cycle.lead = Some(Lead { stamp_ns: NOW_NS, gap: 9.0, speed: 5.0 });
    };
    assert_eq!(scene.rule(), Some(Rule::Gap));
    scene.change = |cycle| {
        cycle.lead = Some(Lead { stamp_ns: NOW_NS, gap: 9.0 + 1e-7, speed: 5.0 });
    };
    assert_eq!(scene.rule(), None);
}
