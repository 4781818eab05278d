//! `spec/3-stages.md#hardened-profile`: the rules of the trajectory (H-07, H-11, H-12) on both
//! sides of their thresholds, and the paper profile beside them.

use mufasa_model::input::cycle::{CrossSection, Cycle, Profile, Route, Trajectory};
use mufasa_model::report::{Rule, Stage};
use mufasa_model::services::configuration::Configuration::PlanRemote;

use crate::base::*;

/// H-07 (F-16): the first point is due within max_age of now, before or after.
#[test]
fn h_07_the_trajectory_starts_now() {
    let with = |shift: i64| {
        hardened_and_paper(|cycle| {
            let points = &mut cycle.trajectory.as_mut().expect("there is one").points;
            for point in points {
                point.t_ns += shift;
            }
        })
    };
    for (shift, expected) in [
        (100_000_000, None),
        (100_000_001, Some(Rule::StartTime)),
        (-100_000_000, None),
        (-100_000_001, Some(Rule::StartTime)),
    ] {
        let [hardened, paper] = with(shift);
        assert_eq!(rule(&hardened, Stage::Ii), expected, "{shift}");
        assert!(passes(&paper, Stage::Ii));
    }
}

/// H-07 (F-10): the first point is at most start_tolerance + v_now max(now - t0, 0) from p.
#[test]
fn h_07_the_trajectory_starts_here() {
    let with = |x: f64, age: i64| {
        hardened_and_paper(|cycle| {
            cycle.ego.x = x;
            let points = &mut cycle.trajectory.as_mut().expect("there is one").points;
            for point in points {
                point.t_ns -= age;
            }
        })
    };
    let ii = |x: f64, age: i64| rule(&with(x, age)[0], Stage::Ii);
    assert_eq!(ii(2.0, 0), None);
    assert_eq!(ii(2.0f64.next_up(), 0), Some(Rule::StartPosition));
    assert_eq!(ii(3.0, 100_000_000), None);
    assert_eq!(ii(3.0f64.next_up(), 100_000_000), Some(Rule::StartPosition));
    assert_eq!(ii(2.0f64.next_up(), -100_000_000), Some(Rule::StartPosition));
    assert!(passes(&with(90.0, 0)[1], Stage::Ii), "the paper accepts any start");
}

/// H-07 (F-09): every point is inside the corridor, however near the reference path.
#[test]
fn h_07_every_point_is_inside_the_corridor() {
    let with = |y: f64| {
        hardened_and_paper(|cycle| {
            for cross_section in &mut cycle.route.cross_sections {
                (cross_section.left[1], cross_section.right[1]) = (0.125, -0.125);
            }
            cycle.trajectory.as_mut().expect("there is one").points[9].y = y;
        })
    };
    let [hardened, paper] = with(0.125f64.next_up());
    assert_eq!(rule(&hardened, Stage::Ii), Some(Rule::Corridor));
    assert!(passes(&paper, Stage::Ii));
    let [hardened, _] = with(0.125);
    assert!(passes(&hardened, Stage::Ii));
}

fn heading(cycle: &mut Cycle, cos: f64, sin: f64) {
    for point in &mut cycle.trajectory.as_mut().expect("there is one").points {
        (point.cos, point.sin) = (cos, sin);
    }
}

/// H-07 (F-10): heading . segment >= 0 for a nearest segment; across is allowed, against is not.
#[test]
fn h_07_nothing_drives_against_the_route() {
    // The CAV stands: H-12 asks for no way along the heading.
    let with = |cos: f64, sin: f64| {
        hardened_and_paper(|cycle| {
            cycle.ego.speed = 0.0;
            cycle.trajectory = Some(straight(3, 0.0));
            heading(cycle, cos, sin);
        })
    };
    assert_eq!(rule(&with(0.0, 1.0)[0], Stage::Ii), None);
    assert_eq!(rule(&with(-f64::MIN_POSITIVE, 1.0)[0], Stage::Ii), Some(Rule::Direction));
    assert_eq!(rule(&with(-1.0, 0.0)[0], Stage::Ii), Some(Rule::Direction));
    assert!(passes(&with(-1.0, 0.0)[1], Stage::Ii));
}

/// H-07: of several nearest segments one that goes forward is enough; a closing segment of length
/// 0 is none.
#[test]
fn h_07_one_of_the_nearest_segments_is_enough() {
    let cross_section =
        |x: f64, y: f64| CrossSection { x, y, left: [x, y + 50.0], right: [x, y - 50.0] };
    let with = |closed: bool, last: CrossSection| {
        let mut cycle = base(Profile::Hardened, PlanRemote);
        // A hairpin at the CAV: towards it along +x, away from it along -x.
        let cross_sections = vec![cross_section(-20.0, 0.0), cross_section(0.0, 0.0), last];
        cycle.route = Route { closed, cross_sections };
        cycle.ego.speed = 0.0;
        let points = vec![at_time(0, 0.0, 0.0)];
        cycle.trajectory = Some(Trajectory { stamp_ns: NOW, points });
        cycle
    };
    let mut hairpin = with(false, cross_section(-20.0, 1.0));
    assert_eq!(rule(&hairpin, Stage::Ii), None);
    heading(&mut hairpin, -1.0, 0.0);
    assert_eq!(rule(&hairpin, Stage::Ii), None);
    // A point that only one of them is nearest to.
    let point = &mut hairpin.trajectory.as_mut().expect("there is one").points[0];
    (point.x, point.y) = (-1.0, -0.5);
    assert_eq!(rule(&hairpin, Stage::Ii), Some(Rule::Direction));

    // First and last cross section equal, the CAV there and turned round: the segments that meet there
    // both go forward, and between them there is one of length 0.
    let mut cycle = base(Profile::Hardened, PlanRemote);
    let wide = |x: f64, y: f64| CrossSection { x, y, left: [x, 50.0], right: [x, -50.0] };
    let cross_sections = vec![
        wide(0.0, 0.0),
        wide(30.0, 0.0),
        wide(30.0, 20.0),
        wide(-30.0, 20.0),
        wide(-30.0, 0.0),
        wide(0.0, 0.0),
    ];
    cycle.route = Route { closed: true, cross_sections };
    cycle.ego.speed = 0.0;
    cycle.trajectory = Some(Trajectory { stamp_ns: NOW, points: vec![at_time(0, 0.0, 0.0)] });
    assert_eq!(rule(&cycle, Stage::Ii), None);
    heading(&mut cycle, -1.0, 0.0);
    assert_eq!(rule(&cycle, Stage::Ii), Some(Rule::Direction));
}

/// Two points, the second `after_ns` later at (x, y) with the direction (cos, sin); the CAV stands
/// and may be anywhere, so that only H-11 speaks.
fn step(after_ns: i64, [x, y]: [f64; 2], [cos, sin]: [f64; 2]) -> Cycle {
    let mut cycle = base(Profile::Hardened, PlanRemote);
    cycle.ego.speed = 0.0;
    cycle.parameters.start_tolerance = 100.0;
    // The CAV stands: only H-11 asks for a_b, and allows turns.
    cycle.parameters.a_b = 100.0;
    let mut last = at_time(after_ns, x, y);
    (last.cos, last.sin) = (cos, sin);
    cycle.trajectory = Some(Trajectory { stamp_ns: NOW, points: vec![at_time(0, 0.0, 0.0), last] });
    cycle.tracks = tracks(vec![]);
    cycle
}

/// H-11 (F-11, F-17): limits of a step in time, length, speed.
#[test]
fn h_11_steps_are_short() {
    let ii = |ns: i64, x: f64| rule(&step(ns, [x, 0.0], [1.0, 0.0]), Stage::Ii);
    assert_eq!(ii(200_000_000, 1.0), None);
    assert_eq!(ii(200_000_001, 1.0), Some(Rule::StepTime));
    assert_eq!(ii(100_000_000, 4.0), None);
    assert_eq!(ii(100_000_000, 4.0f64.next_up()), Some(Rule::StepLength));
    // v_max dt = 150 * 0.02 = 3 m
    assert_eq!(ii(20_000_000, 3.0), None);
    assert_eq!(ii(20_000_000, 3.0f64.next_up()), Some(Rule::StepSpeed));
    let mut paper = step(5_000_000_000, [90.0, 0.0], [1.0, 0.0]);
    paper.profile = Profile::Paper;
    assert!(passes(&paper, Stage::Ii));
}

/// H-11: a step goes along both headings, sideways by at most W/2 = 1 m.
#[test]
fn h_11_steps_go_forward() {
    let ii = |to: [f64; 2], heading: [f64; 2]| rule(&step(100_000_000, to, heading), Stage::Ii);
    assert_eq!(ii([0.0, 1.0], [1.0, 0.0]), None);
    assert_eq!(ii([0.0, 1.0f64.next_up()], [1.0, 0.0]), Some(Rule::StepLateral));
    assert_eq!(ii([-f64::MIN_POSITIVE, 0.0], [1.0, 0.0]), Some(Rule::StepForward));
    assert_eq!(ii([0.0, 0.0], [1.0, 0.0]), None, "a step of length 0");
    // Forward along the first heading, backwards along the second.
    let turned = [0.9, -0.19f64.sqrt()];
    assert_eq!(ii([0.1, 0.5], turned), Some(Rule::StepForward));
    assert_eq!(ii([1.9, 0.1], turned), None);
    // Sideways along the second heading only: u x heading = 2.2 * 0.4358.. < 1 < 2.4 * 0.4358..
    assert_eq!(ii([2.2, 0.0], turned), None);
    assert_eq!(ii([2.4, 0.0], turned), Some(Rule::StepLateral));
}

/// H-11, I-12: dot product of the headings >= the double nearest to 0.866.
#[test]
fn h_11_headings_turn_by_thirty_degrees_at_most() {
    let ii = |cos: f64| {
        let sin = (1.0 - cos * cos).sqrt();
        // 2 m along the middle of both headings.
        rule(&step(200_000_000, [1.931_85, 0.517_64], [cos, sin]), Stage::Ii)
    };
    assert_eq!(ii(0.866), None);
    assert_eq!(ii(0.866f64.next_down()), Some(Rule::StepTurn));
}

/// H-11 (F-29): nothing turns on the spot, or sideways harder than it brakes; equal headings pass.
#[test]
fn h_11_turns_are_drivable() {
    // 0.28 = 0.5 * 0.52 + 0.1 * 0.2.
    let ii = |u: f64, a_b: f64| {
        let mut cycle = step(200_000_000, [u, 0.0], [0.96, 0.28]);
        cycle.parameters.a_b = a_b;
        rule(&cycle, Stage::Ii)
    };
    assert_eq!(ii(0.5201, 100.0), None);
    assert_eq!(ii(0.5199, 100.0), Some(Rule::StepTurn));
    assert_eq!(ii(0.0, 100.0), Some(Rule::StepTurn), "on the spot");
    assert_eq!(ii(1.2, 8.401), None, "0.28 * 1.2 = 8.4 * 0.2^2");
    assert_eq!(ii(1.2, 8.399), Some(Rule::StepTurn));
    let mut still = step(1, [0.0, 0.0], [1.0, 0.0]);
    assert_eq!(rule(&still, Stage::Ii), None);
    still.trajectory.as_mut().expect("there is one").points[1].sin = 1e-9;
    assert_eq!(rule(&still, Stage::Ii), Some(Rule::StepTurn), "0.1 * 1 ns = 1e-10");
}

/// H-12 (F-22): no trajectory is slower than braking or faster than accelerating.
#[test]
fn h_12_arc_lengths_are_drivable() {
    let with = |step: f64| hardened_and_paper(|cycle| cycle.trajectory = Some(straight(51, step)));
    // 10 t - 4 t^2 - 2 > 0 from t = 0.3 s on; 10 t + 1.5 t^2 + 2 < 20 t from t = 0.3 s on.
    let [still, paper] = with(0.0);
    assert_eq!(
        (rule(&still, Stage::Ii), witness(&still, Stage::Ii).point),
        (Some(Rule::ArcTooShort), Some(3))
    );
    assert!(passes(&paper, Stage::Ii));
    let [fast, paper] = with(2.0);
    assert_eq!(
        (rule(&fast, Stage::Ii), witness(&fast, Stage::Ii).point),
        (Some(Rule::ArcTooLong), Some(3))
    );
    assert!(passes(&paper, Stage::Ii));
    assert!(passes(&with(0.5)[0], Stage::Ii), "braking gently");
}

/// H-12: the bounds on the point: at t = 0.5 s from 0 - start_tolerance + 4 m up to 5.375 m + it.
#[test]
fn h_12_the_bounds_are_inclusive() {
    let with = |x: f64| {
        let mut cycle = step(500_000_000, [x, 0.0], [1.0, 0.0]);
        cycle.parameters.step_max_ns = 1_000_000_000;
        cycle.parameters.start_tolerance = 0.5;
        cycle.parameters.a_b = 20.0;
        cycle.ego.length = 20.0;
        cycle.ego.speed = 10.0;
        rule(&cycle, Stage::Ii)
    };
    // a_b = 20: braking ends at t = 0.5 s after 2.5 m; above: 5 + 3 * 0.125 + 0.5.
    assert_eq!(with(2.0), None);
    assert_eq!(with(2.0f64.next_down()), Some(Rule::ArcTooShort));
    assert_eq!(with(5.875), None);
    assert_eq!(with(5.875f64.next_up()), Some(Rule::ArcTooLong));
}

/// H-12: after standstill b(t) stays s_b(v_lo); v_lo and v_hi allow for the time from now to t0.
#[test]
fn h_12_uncertain_start_widens_the_bounds() {
    let with = |shift: i64, x: f64| {
        let mut cycle = step(1_000_000_000, [x, 0.0], [1.0, 0.0]);
        cycle.parameters.step_max_ns = 1_000_000_000;
        cycle.parameters.start_tolerance = 0.5;
        cycle.parameters.a_b = 20.0;
        cycle.parameters.a_max = 10.0;
        cycle.ego.length = 40.0;
        cycle.ego.speed = 10.0;
        let points = &mut cycle.trajectory.as_mut().expect("there is one").points;
        for point in points {
            point.t_ns += shift;
        }
        rule(&cycle, Stage::Ii)
    };
    // d = 0: v_lo = 10, b = 100/40 = 2.5; above 10 + 5 + 0.5.
    assert_eq!(with(0, 2.0), None);
    assert_eq!(with(0, 2.0f64.next_down()), Some(Rule::ArcTooShort));
    assert_eq!(with(0, 15.5f64.next_up()), Some(Rule::ArcTooLong));
    // d = 0.1: v_lo = 9, b = 81/40 = 2.025; v_hi = 12: above 12 + 5 + 0.5.
    for shift in [100_000_000, -100_000_000] {
        assert_eq!(with(shift, 1.53), None);
        assert_eq!(with(shift, 1.52), Some(Rule::ArcTooShort));
        assert_eq!(with(shift, 17.5), None);
        assert_eq!(with(shift, 17.5f64.next_up()), Some(Rule::ArcTooLong));
    }
}

/// H-12 (F-23): the trajectory does not end before standstill, v_lo / a_b = 1.25 s.
#[test]
fn h_12_the_trajectory_is_long_enough() {
    let with =
        |count: u32| hardened_and_paper(|cycle| cycle.trajectory = Some(straight(count, 1.0)));
    assert_eq!(rule(&with(14)[0], Stage::Ii), None);
    assert_eq!(rule(&with(13)[0], Stage::Ii), Some(Rule::EndsTooSoon));
    assert!(passes(&with(13)[1], Stage::Ii));
}

/// H-12 (F-26): it ends at most L before s_stop = e + 1.015 + 10.3^2/16 = e + 7.645625 m, however
/// long it then stands there; e is how far the CAV is from the first point.
#[test]
fn h_12_the_end_is_not_far_before_s_stop() {
    let with = |start: f64, end: f64| {
        let mut cycle = base(Profile::Hardened, PlanRemote);
        cycle.tracks = tracks(vec![]);
        cycle.parameters.start_tolerance = 5.0;
        let places = (0..20).map(|i| (start + f64::from(i) * 0.75).min(end));
        let points = (0..).zip(places).map(|(i, x)| at_time(i * 100_000_000, x, 0.0));
        cycle.trajectory = Some(Trajectory { stamp_ns: NOW, points: points.collect() });
        let found = rule(&cycle, Stage::Ii);
        (found, found.and_then(|_| witness(&cycle, Stage::Ii).point))
    };
    let needed = 7.645_625;
    assert_eq!(with(0.0, needed - 3.999), (None, None));
    assert_eq!(with(0.0, needed - 4.001), (Some(Rule::ArcTooShort), Some(19)));
    // The CAV is 1 m ahead of the first point, or behind it: e = 1 m.
    assert_eq!(with(-1.0, needed - 3.999), (None, None));
    assert_eq!(with(-1.0, needed - 4.001), (Some(Rule::ArcTooShort), Some(19)));
    assert_eq!(with(1.0, needed + 2.0 - 3.999), (None, None));
    assert_eq!(with(1.0, needed + 2.0 - 4.001), (Some(Rule::ArcTooShort), Some(19)));
}

/// H-12: 50 s are always enough.
#[test]
fn h_12_fifty_seconds_are_enough() {
    let with = |count: i64| {
        let mut cycle = base(Profile::Hardened, PlanRemote);
        // Braking from 10 m/s with 0.1 m/s^2 takes 100 s; s_stop = 531.5 m, less L is 527.5 m.
        cycle.parameters.a_b = 0.1;
        cycle.route = straight_route(-10.0, 600.0);
        cycle.tracks = tracks(vec![]);
        let points = (0..count).map(|i| {
            let x = f64::from(i32::try_from(i).expect("small")) * 2.2;
            at_time(i * 200_000_000, x, 0.0)
        });
        cycle.trajectory = Some(Trajectory { stamp_ns: NOW, points: points.collect() });
        rule(&cycle, Stage::Ii)
    };
    assert_eq!(with(251), None);
    assert_eq!(with(250), Some(Rule::EndsTooSoon));
}

/// H-04, H-12 (F-28): a zigzag across the road is no way along it.
#[test]
fn h_12_a_zigzag_is_no_way() {
    let with = |aside: f64, profile| {
        let mut cycle = base(profile, PlanRemote);
        let points =
            (0..20).map(|i| at_time(i * 100_000_000, 0.0, if i % 2 == 0 { 0.0 } else { aside }));
        cycle.trajectory = Some(Trajectory { stamp_ns: NOW, points: points.collect() });
        cycle.tracks = tracks(vec![track(1, 4.5, 0.0)]);
        cycle
    };
    // 10 t - 4 t^2 - 2 > 0 from t = 0.3 s on.
    let hardened = with(0.9, Profile::Hardened);
    assert_eq!(rule(&hardened, Stage::Ii), Some(Rule::ArcTooShort));
    assert_eq!(witness(&hardened, Stage::Ii).point, Some(3));
    assert_eq!(failed(&with(0.9, Profile::Paper)), None);
}
