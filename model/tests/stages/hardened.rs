//! `spec/3-stages.md#hardened-profile`: each rule on both sides of its threshold, and the paper
//! profile beside it.

use mufasa_model::configuration::Configuration::{AllRemote, MotRemote, PlanRemote};
use mufasa_model::cycle::{Cycle, Profile, Route, Station, Track, TrackList, Trajectory};
use mufasa_model::verdict::{FailedStage, Input, Outcome, Reason, Rule, Stage};

use crate::base::*;

fn hardened_and_paper(change: impl Fn(&mut Cycle)) -> [Cycle; 2] {
    [Profile::Hardened, Profile::Paper].map(|profile| {
        let mut cycle = base(profile, PlanRemote);
        change(&mut cycle);
        cycle
    })
}

/// H-01 (F-01): every matched pair is closer than theta_track_max.
#[test]
fn h_01_a_ghost_does_not_hide_in_the_mean() {
    let with = |profile, distance: f64, miss_budget| {
        let mut cycle = base(profile, MotRemote);
        cycle.parameters.miss_budget = miss_budget;
        let x = |i: u8| 10.0 * f64::from(i);
        cycle.tracks = tracks((1..=6).map(|i| track(i.into(), x(i), 0.0)).collect());
        let mut items: Vec<_> = (1..=6).map(|i| detection(x(i), 0.0)).collect();
        items[4].y = distance;
        items.push(detection(100.0, 100.0));
        cycle.detections = detections(items);
        cycle
    };
    assert!(passes(&with(Profile::Paper, 1.0, 0), Stage::I), "mean 1/6 < 0.2");
    assert!(passes(&with(Profile::Hardened, 1.0f64.next_down(), 0), Stage::I));
    let found = witness(&with(Profile::Hardened, 1.0, 0), Stage::I);
    assert_eq!((found.rule, found.track), (Rule::NoAssignment, Some(5)));
    assert!(passes(&with(Profile::Hardened, 1.0, 1), Stage::I), "one may be missed");
    assert!(passes(&with(Profile::Hardened, 50.0, 1), Stage::I));
    assert!(!passes(&with(Profile::Paper, 50.0, 1), Stage::I), "more than the paper accepts");
}

/// H-01 (F-02): surplus tracks are not ignored; k' = 0 passes.
#[test]
fn h_01_more_tracks_than_detections_fail() {
    let with = |profile, miss_budget| {
        let mut cycle = base(profile, MotRemote);
        cycle.parameters.miss_budget = miss_budget;
        cycle.tracks = tracks(vec![track(1, 60.0, 0.0), track(2, 30.0, 0.0)]);
        cycle
    };
    assert!(passes(&with(Profile::Paper, 0), Stage::I));
    let found = witness(&with(Profile::Hardened, 0), Stage::I);
    assert_eq!((found.rule, found.track), (Rule::NoAssignment, Some(2)));
    assert!(passes(&with(Profile::Hardened, 1), Stage::I));
    assert!(passes(&with(Profile::Hardened, 64), Stage::I));
}

/// H-01: of all choices of k' tracks the cheapest counts.
#[test]
fn h_01_the_worst_tracks_may_be_missed() {
    let mut cycle = base(Profile::Hardened, MotRemote);
    cycle.parameters.miss_budget = 1;
    cycle.tracks = tracks(vec![track(1, 30.0, 0.5), track(2, 60.0, 0.0)]);
    cycle.detections = detections(vec![detection(30.0, 0.0), detection(60.0, 0.0)]);
    assert!(passes(&cycle, Stage::I), "the mean of both would be 0.25");
}

/// H-02 (F-18): a list that stage i could not check still fails the cycle.
#[test]
fn h_02_an_unchecked_list_can_fail_but_not_pass() {
    let mut cycle = base(Profile::Hardened, AllRemote);
    (cycle.detections, cycle.grid) = (None, None);
    assert_eq!(failed(&cycle), Some(FailedStage::NoObstacleCheck));
    assert!(passes(&cycle, Stage::Iii));
    cycle.tracks = tracks(vec![track(1, 10.0, 0.0)]);
    assert_eq!(failed(&cycle), Some(FailedStage::Stage(Stage::Iii)));
    // With detections the same list is checked, and no other check is needed.
    let mut cycle = base(Profile::Hardened, AllRemote);
    cycle.grid = None;
    assert_eq!(failed(&cycle), None);
}

/// H-03 (F-03): a long vehicle is examined although its centre is farther than theta_obj.
#[test]
fn h_03_long_vehicles_are_examined() {
    let with = |x: f64| {
        hardened_and_paper(|cycle| {
            cycle.tracks = tracks(vec![Track { length: 12.0, vx: 10.0, ..track(1, x, 0.0) }]);
        })
    };
    let [hardened, paper] = with(8.0);
    assert_eq!(witness(&hardened, Stage::Iii).compared[0].to_bits(), 8.0f64.to_bits());
    assert!(passes(&paper, Stage::Iii));
    let [hardened, _] = with(8.0f64.next_up());
    assert!(passes(&hardened, Stage::Iii));
}

/// H-04 (F-06): the horizon is never shorter than s_stop, and the next point counts.
#[test]
fn h_04_a_first_step_from_standstill_is_looked_at() {
    let with = |x: f64| {
        hardened_and_paper(|cycle| {
            cycle.ego.speed = 0.0;
            cycle.trajectory = Some(straight(3, 1.0));
            cycle.tracks = tracks(vec![track(1, x, 0.0)]);
        })
    };
    let [hardened, paper] = with(5.0);
    assert_eq!(witness(&hardened, Stage::Iii).point, Some(1));
    assert!(passes(&paper, Stage::Iii));
    let [hardened, _] = with(6.0);
    assert!(passes(&hardened, Stage::Iii), "touched at the second point after s_stop only");
}

/// H-04: one more point than the paper's where s_CAV is longer than s_stop.
#[test]
fn h_04_the_next_point_counts() {
    let with = |x: f64| hardened_and_paper(|cycle| cycle.tracks = tracks(vec![track(1, x, 0.0)]));
    let [hardened, paper] = with(23.0);
    assert_eq!(witness(&hardened, Stage::Iii).point, Some(19));
    assert!(passes(&paper, Stage::Iii));
    let [hardened, _] = with(24.0);
    assert!(passes(&hardened, Stage::Iii));
}

/// H-04 (F-04): at high speed s_stop is longer than s_CAV.
#[test]
fn h_04_the_horizon_is_at_least_s_stop() {
    // 40 m/s: s_CAV = 72 m, s_stop = 4.015 + 40.3^2 / 16 = 105.5 m.
    let with = |x: f64| {
        hardened_and_paper(|cycle| {
            cycle.ego.speed = 40.0;
            cycle.trajectory = Some(straight(51, 4.0));
            cycle.route = straight_route(-100.0, 300.0);
            cycle.tracks = tracks(vec![track(1, x, 0.0)]);
        })
    };
    let [hardened, paper] = with(112.0);
    assert_eq!(witness(&hardened, Stage::Iii).point, Some(27), "touched at 108 m");
    assert!(passes(&paper, Stage::Iii));
    let [hardened, _] = with(116.0);
    assert!(passes(&hardened, Stage::Iii));
}

/// H-04: the gap is compared although stage iv does not run, and that is no run of stage iv.
#[test]
fn h_04_the_gap_is_compared_without_detections() {
    // s_follow = s_CAV = 1.5 * 10 at equal speeds.
    let with = |profile, configuration, gap| {
        let mut cycle = base(profile, configuration);
        cycle.parameters.safety_time = 1.5;
        cycle.lead = lead(gap, V_NOW);
        cycle.detections = None;
        cycle
    };
    for configuration in REMOTE {
        let close = with(Profile::Hardened, configuration, 15.0);
        assert_eq!(rule(&close, Stage::Iv), Some(Rule::Gap));
        assert_eq!(failed(&with(Profile::Paper, configuration, 15.0)), None);
        let far = with(Profile::Hardened, configuration, 15.0f64.next_up());
        assert!(matches!(outcome(&far, Stage::Iv), Outcome::Skipped(_)));
        assert_eq!(failed(&far), None);
    }
    // Stage iii ran, with detections: still compared, still reported as skipped.
    let mut cycle = with(Profile::Hardened, PlanRemote, 15.0);
    cycle.detections = base(Profile::Hardened, PlanRemote).detections;
    assert_eq!(rule(&cycle, Stage::Iv), Some(Rule::Gap));
    cycle.lead = lead(16.0, V_NOW);
    assert_eq!(outcome(&cycle, Stage::Iv), Outcome::Skipped(Reason::OtherStageRan));
    // A larger gap is no obstacle check, and nothing without a trajectory.
    let mut cycle = with(Profile::Hardened, MotRemote, 16.0);
    cycle.grid = None;
    assert_eq!(failed(&cycle), Some(FailedStage::NoObstacleCheck));
    let mut cycle = with(Profile::Hardened, MotRemote, 1.0);
    cycle.trajectory = None;
    assert_eq!(outcome(&cycle, Stage::Iv), Outcome::Skipped(Reason::NoCurrent(Input::Trajectory)));
}

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
            for station in &mut cycle.route.stations {
                (station.left[1], station.right[1]) = (0.125, -0.125);
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
    let with = |cos: f64, sin: f64| hardened_and_paper(|cycle| heading(cycle, cos, sin));
    assert_eq!(rule(&with(0.0, 1.0)[0], Stage::Ii), None);
    assert_eq!(rule(&with(-f64::MIN_POSITIVE, 1.0)[0], Stage::Ii), Some(Rule::Direction));
    assert_eq!(rule(&with(-1.0, 0.0)[0], Stage::Ii), Some(Rule::Direction));
    assert!(passes(&with(-1.0, 0.0)[1], Stage::Ii));
}

/// H-07: of several nearest segments one that goes forward is enough; a closing segment of length
/// 0 is none.
#[test]
fn h_07_one_of_the_nearest_segments_is_enough() {
    let station = |x: f64, y: f64| Station { x, y, left: [x, y + 50.0], right: [x, y - 50.0] };
    let with = |closed: bool, last: Station| {
        let mut cycle = base(Profile::Hardened, PlanRemote);
        // A hairpin at the CAV: towards it along +x, away from it along -x.
        let stations = vec![station(-20.0, 0.0), station(0.0, 0.0), last];
        cycle.route = Route { closed, stations };
        cycle.ego.speed = 0.0;
        let points = vec![at_time(0, 0.0, 0.0)];
        cycle.trajectory = Some(Trajectory { stamp_ns: NOW, points });
        cycle
    };
    let mut hairpin = with(false, station(-20.0, 1.0));
    assert_eq!(rule(&hairpin, Stage::Ii), None);
    heading(&mut hairpin, -1.0, 0.0);
    assert_eq!(rule(&hairpin, Stage::Ii), None);
    // A point that only one of them is nearest to.
    let point = &mut hairpin.trajectory.as_mut().expect("there is one").points[0];
    (point.x, point.y) = (-1.0, -0.5);
    assert_eq!(rule(&hairpin, Stage::Ii), Some(Rule::Direction));

    // First and last station equal, the CAV there and turned round: the segments that meet there
    // both go forward, and between them there is one of length 0.
    let mut cycle = base(Profile::Hardened, PlanRemote);
    let wide = |x: f64, y: f64| Station { x, y, left: [x, 50.0], right: [x, -50.0] };
    let stations = vec![
        wide(0.0, 0.0),
        wide(30.0, 0.0),
        wide(30.0, 20.0),
        wide(-30.0, 20.0),
        wide(-30.0, 0.0),
        wide(0.0, 0.0),
    ];
    cycle.route = Route { closed: true, stations };
    cycle.ego.speed = 0.0;
    cycle.trajectory = Some(Trajectory { stamp_ns: NOW, points: vec![at_time(0, 0.0, 0.0)] });
    assert_eq!(rule(&cycle, Stage::Ii), None);
    heading(&mut cycle, -1.0, 0.0);
    assert_eq!(rule(&cycle, Stage::Ii), Some(Rule::Direction));
}

/// A cycle whose previous list is `dt_ns` older and had track 1 at x.
fn with_previous(dt_ns: i64, x: f64) -> Cycle {
    let mut cycle = base(Profile::Hardened, MotRemote);
    let items = vec![track(1, x, 0.0)];
    cycle.previous_tracks = Some(TrackList { stamp_ns: NOW - dt_ns, items });
    cycle
}

/// H-09 (F-13): abs(p - p_prev - v dt) <= theta_velocity dt for ids that are held.
#[test]
fn h_09_velocities_fit_the_previous_list() {
    let half_second = 500_000_000;
    // The track is at 60 m and stands; theta_velocity dt = 1 m.
    assert_eq!(rule(&with_previous(half_second, 59.0), Stage::I), None);
    let below = with_previous(half_second, 59.0f64.next_down());
    assert_eq!(rule(&below, Stage::I), Some(Rule::Velocity));
    assert_eq!(witness(&below, Stage::I).track, Some(1));
    let mut other_id = below.clone();
    other_id.previous_tracks.as_mut().expect("there is one").items[0].id = 2;
    assert_eq!(rule(&other_id, Stage::I), None);
    let mut paper = below;
    paper.profile = Profile::Paper;
    assert_eq!(rule(&paper, Stage::I), None);
}

/// H-09: the previous list is used for 0 < dt <= 1 s.
#[test]
fn h_09_the_previous_list_is_used_up_to_a_second() {
    for (dt_ns, expected) in [
        (0, None),
        (1, Some(Rule::Velocity)),
        (1_000_000_000, Some(Rule::Velocity)),
        (1_000_000_001, None),
        (-1, None),
    ] {
        assert_eq!(rule(&with_previous(dt_ns, 0.0), Stage::I), expected, "{dt_ns}");
    }
}

/// H-09: every received track is compared, the ones beyond the field of view too.
#[test]
fn h_09_tracks_out_of_view_are_compared() {
    let mut cycle = with_previous(500_000_000, 60.0);
    cycle.tracks.as_mut().expect("there are").items.push(track(2, 90.0, 0.0));
    assert_eq!(rule(&cycle, Stage::I), None);
    cycle.previous_tracks.as_mut().expect("there is one").items.push(track(2, 80.0, 0.0));
    assert_eq!(witness(&cycle, Stage::I).track, Some(2));
}

/// H-09: in AllRemote a track whose id is not held is examined standing still, too.
#[test]
fn h_09_new_tracks_are_examined_standing_too() {
    let car = Track { vx: 30.0, ..track(1, 15.0, 0.0) };
    let mut cycle = base(Profile::Hardened, AllRemote);
    cycle.tracks = tracks(vec![car.clone()]);
    cycle.detections = detections(vec![detection(15.0, 0.0)]);
    assert_eq!(rule(&cycle, Stage::Iii), Some(Rule::CollisionStanding));
    assert_eq!(witness(&cycle, Stage::Iii).point, Some(11));
    let before = vec![track(1, 12.0, 0.0)];
    cycle.previous_tracks = Some(TrackList { stamp_ns: NOW - 100_000_000, items: before });
    assert_eq!(failed(&cycle), None, "held: examined as predicted only");
    // Stage i does not run: no id is held.
    cycle.detections = None;
    assert_eq!(rule(&cycle, Stage::Iii), Some(Rule::CollisionStanding));
    // Tracks of the local MOT are not doubted.
    let mut local = base(Profile::Hardened, PlanRemote);
    local.tracks = tracks(vec![car]);
    assert_eq!(failed(&local), None);
}

/// H-10 (F-14, F-15): in AllRemote the detections and the grid are asked although iii passed.
#[test]
fn h_10_an_empty_list_does_not_switch_off_iv_and_v() {
    let mut cycle = base(Profile::Hardened, AllRemote);
    cycle.tracks = tracks(vec![]);
    cycle.detections = detections(vec![detection(8.0, 0.0)]);
    assert_eq!(failed(&cycle), Some(FailedStage::Stage(Stage::Iv)));
    cycle.detections = None;
    mark(&mut cycle.grid.as_mut().expect("there is a grid").occupied, 5.5, 0.5);
    assert_eq!(failed(&cycle), Some(FailedStage::Stage(Stage::V)));
    cycle.profile = Profile::Paper;
    assert_eq!(failed(&cycle), None);
}

/// Two points, the second `after_ns` later at (x, y) with the direction (cos, sin); the CAV stands
/// and may be anywhere, so that only H-11 speaks.
fn step(after_ns: i64, [x, y]: [f64; 2], [cos, sin]: [f64; 2]) -> Cycle {
    let mut cycle = base(Profile::Hardened, PlanRemote);
    cycle.ego.speed = 0.0;
    cycle.parameters.start_tolerance = 100.0;
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
    assert_eq!(ii([0.5, 0.1], turned), None);
    // Sideways along the second heading only: u x heading = 2.2 * 0.4358.. < 1 < 2.4 * 0.4358..
    assert_eq!(ii([2.2, 0.0], turned), None);
    assert_eq!(ii([2.4, 0.0], turned), Some(Rule::StepLateral));
}

/// H-11, I-12: dot product of the headings >= the double nearest to 0.866.
#[test]
fn h_11_headings_turn_by_thirty_degrees_at_most() {
    let ii = |cos: f64| {
        let sin = (1.0 - cos * cos).sqrt();
        rule(&step(100_000_000, [0.5, 0.0], [cos, sin]), Stage::Ii)
    };
    assert_eq!(ii(0.866), None);
    assert_eq!(ii(0.866f64.next_down()), Some(Rule::StepTurn));
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

/// H-12: 50 s are always enough.
#[test]
fn h_12_fifty_seconds_are_enough() {
    let with = |count: i64| {
        let mut cycle = base(Profile::Hardened, PlanRemote);
        // Braking from 10 m/s with 0.1 m/s^2 takes 100 s.
        cycle.parameters.a_b = 0.1;
        cycle.route = straight_route(-10.0, 600.0);
        cycle.tracks = tracks(vec![]);
        let points = (0..count).map(|i| {
            let x = f64::from(i32::try_from(i).expect("small")) * 2.0;
            at_time(i * 200_000_000, x, 0.0)
        });
        cycle.trajectory = Some(Trajectory { stamp_ns: NOW, points: points.collect() });
        rule(&cycle, Stage::Ii)
    };
    assert_eq!(with(251), None);
    assert_eq!(with(250), Some(Rule::EndsTooSoon));
}
