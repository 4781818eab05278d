//! `spec/3-stages.md#hardened-profile`: the rules of objects (H-01 to H-06, H-09, H-10) on both
//! sides of their thresholds, and the paper profile beside them.

use mufasa_model::input::cycle::{Cycle, Profile, Track, TrackList, Trajectory};
use mufasa_model::report::{FailedStage, Input, Outcome, Reason, Rule, Stage};
use mufasa_model::services::configuration::Configuration::{AllRemote, MotRemote, PlanRemote};

use crate::base::*;

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

/// H-04 (F-27): the horizon counts from the CAV, which is 3 m ahead of the first point.
#[test]
fn h_04_the_horizon_counts_from_the_cav() {
    // 20 m/s, safety_time 0: s_stop = 2.015 + 20.3^2 / 16 = 27.77 m.
    let with = |start: f64, x: f64| {
        hardened_and_paper(|cycle| {
            cycle.ego.speed = 20.0;
            cycle.parameters.safety_time = 0.0;
            cycle.parameters.start_tolerance = 5.0;
            let points = (0..30)
                .map(|i| at_time(i64::from(i) * 100_000_000, start + 2.0 * f64::from(i), 0.0));
            cycle.trajectory = Some(Trajectory { stamp_ns: NOW, points: points.collect() });
            cycle.tracks = tracks(vec![track(1, x, 0.0)]);
        })
    };
    // The place of the point after e + s_stop: 28 m from the CAV or 29 m.
    assert_eq!(witness(&with(0.0, 32.0)[0], Stage::Iii).point, Some(14));
    assert!(passes(&with(0.0, 32.5)[0], Stage::Iii));
    assert_eq!(witness(&with(-3.0, 33.0)[0], Stage::Iii).point, Some(16));
    assert!(passes(&with(-3.0, 33.5)[0], Stage::Iii));
    assert!(passes(&with(-3.0, 5.0)[1], Stage::Iii), "the paper's horizon is 0");
}

/// H-04 (F-26): beyond the end of a remote trajectory the CAV is examined every 1/4 m up to s_stop.
#[test]
fn h_04_places_beyond_the_end_are_examined() {
    // The trajectory ends at 5.25 m, s_stop = 7.65 m: the places are 0.25 to 2.5 m beyond the end.
    let places = || (0..20).map(|i| (f64::from(i) * 0.75).min(5.25));
    let with = |offset: f64, configuration, x: f64| {
        let mut cycle = base(Profile::Hardened, configuration);
        cycle.ego.center_offset = offset;
        let points = (0..).zip(places()).map(|(i, x)| at_time(i * 100_000_000, x, 0.0));
        cycle.trajectory = Some(Trajectory { stamp_ns: NOW, points: points.collect() });
        cycle.tracks = tracks(vec![track(1, x, 0.0)]);
        cycle.detections = detections(vec![detection(x, 0.0)]);
        cycle
    };
    let point = |cycle: &Cycle| witness(cycle, Stage::Iii).point;
    assert_eq!(point(&with(0.0, PlanRemote, 9.5)), Some(20), "0.25 m beyond");
    assert_eq!(point(&with(0.0, AllRemote, 11.75)), Some(29), "2.5 m beyond");
    assert_eq!(point(&with(0.0, PlanRemote, 11.75)), Some(29), "2.5 m beyond");
    assert!(passes(&with(0.0, PlanRemote, 11.8), Stage::Iii));
    // Multiples of 1/4 m above center_offset = 0.1 m: 0.25 to 2.5 m.
    assert_eq!(point(&with(0.1, PlanRemote, 11.75)), Some(29));
    assert!(passes(&with(0.1, PlanRemote, 11.8), Stage::Iii));
    // A local trajectory is driven as it is planned.
    assert_eq!(failed(&with(0.0, MotRemote, 11.75)), None);
    // Stage iv, and v on a cell from 9 to 10 m.
    let mut cycle = with(0.0, PlanRemote, 11.75);
    cycle.tracks = None;
    assert_eq!(witness(&cycle, Stage::Iv).point, Some(29));
    cycle.detections = None;
    assert_eq!(failed(&cycle), None, "an empty grid");
    mark(&mut cycle.grid.as_mut().expect("there is a grid").occupied, 9.5, 0.5);
    assert_eq!(witness(&cycle, Stage::V).point, Some(24), "1.25 m beyond");
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
