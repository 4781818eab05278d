//! `spec/4-arithmetic.md#conformance-of-an-implementation`: a cycle that needs more than 10^10
//! comparisons is an error. `#strict-and-lax`: more than 1024 close calls fail the strict reading.

use mufasa_model::cycle::{check, readings};
use mufasa_model::input::cycle::{Cycle, DetectionList, Profile, Track};
use mufasa_model::numbers::real::Real;
use mufasa_model::report::{FailedStage, InvalidInput, Outcome, Reading, Rule, Stage, Witness};
use mufasa_model::services::configuration::Configuration::{MotRemote, PlanRemote};

use crate::base::*;
use crate::near::{NEAR_SAFE, NEAR_UNSAFE, YES, points, safe};

/// 2000 detections, as many in the reference list and `others` in another one: H-14 needs 2000 * 2000
/// (2000 + others + 32 places + 51 points) comparisons and (32 + 2 * 2000 * 2000) * 2 with the route, the rest
/// of the cycle 51 * 2 + 32 + 51 * 2000.
/// The strict reading makes none of H-14, whose work is above work_limit.
fn crowded(others: usize) -> Cycle {
    let mut cycle = base(Profile::HARDENED, PlanRemote);
    (cycle.tracks, cycle.parameters.work_limit) = (None, 0);
    cycle.detections = detections(vec![detection(60.0, 0.0); 2000]);
    let list = |ms: i64, count: usize| DetectionList {
        stamp_ns: NOW - ms * 1_000_000,
        items: vec![detection(60.0, 0.0); count],
    };
    cycle.detection_history = vec![list(300, others), list(500, 2000)];
    cycle
}

/// MARGIN-09.
#[test]
fn more_than_ten_to_the_ten_comparisons_are_an_error() {
    let strict = check(&crowded(412), Reading::Strict).expect("not too much work");
    assert!(matches!(&strict.stages[3], Outcome::Failed(it) if it.rule == Rule::WorkLimit));
    for reading in [Reading::Strict, Reading::Exact] {
        let error = check(&crowded(413), reading).expect_err("too much work");
        let InvalidInput { field, index, message } = error;
        assert_eq!((field.as_str(), index), ("work", None));
        assert!(message.contains("10000102198 comparisons"), "{message}");
    }
    assert!(check(&crowded(414), Reading::Lax).is_err(), "one place less");
    assert!(readings(&crowded(413)).is_err());
}

/// Work that no stage comes to is not counted.
#[test]
fn only_what_a_stage_is_about_to_do_counts() {
    let mut cycle = crowded(413);
    cycle.ego.y = 2.5;
    assert_eq!(rule(&cycle, Stage::Ii), Some(Rule::StartPosition));
    let mut paper = crowded(413);
    paper.profile = Profile::PAPER;
    assert!(passes(&paper, Stage::Iv));
    // The gap fails stage iv before H-14 is come to.
    let mut near = crowded(413);
    near.lead = lead(0.0, 0.0);
    assert_eq!(rule(&near, Stage::Iv), Some(Rule::Gap));
}

/// A standing CAV at so many points, in the paper profile, and so many cars whose centres are `x` m ahead of its own
/// and `y` m aside: tracks in stage iii, detections in stage iv.
fn parked(stage: Stage, count: [u32; 2], [x, y]: [f64; 2]) -> Cycle {
    let configuration = if stage == Stage::Iii { PlanRemote } else { MotRemote };
    let mut cycle = base(Profile::PAPER, configuration);
    (cycle.ego.speed, cycle.trajectory) = (0.0, Some(straight(count[0], 0.0)));
    let items: Vec<Track> = (0..count[1]).map(|id| track(id.into(), x, y)).collect();
    let seen = vec![detection(x, y); items.len()];
    (cycle.tracks, cycle.detections) =
        if stage == Stage::Iii { (tracks(items), None) } else { (None, detections(seen)) };
    cycle
}

/// What the strict reading says of a stage that fails.
fn strict_witness(cycle: &Cycle, stage: Stage) -> Option<Witness> {
    let report = check(cycle, Reading::Strict).expect("valid");
    report.witness().cloned().filter(|_| report.failed_stage == Some(FailedStage::Stage(stage)))
}

/// 1025 close calls fail the stage in the strict reading, and nothing else is named.
fn too_many_close(cycle: &Cycle, stage: Stage) {
    assert_eq!(safe(cycle), NEAR_SAFE, "{stage:?}");
    let [count, most] = [1025, 1024].map(Real::from_integer);
    let expected = Witness::new(Rule::WorkLimit, &count, &most);
    assert_eq!(strict_witness(cycle, stage), Some(expected));
}

/// MARGIN-14.
#[test]
fn more_than_1024_close_objects_fail_the_strict_reading() {
    for stage in [Stage::Iii, Stage::Iv] {
        assert_eq!(safe(&parked(stage, [32, 32], [4.005, 0.0])), YES);
        too_many_close(&parked(stage, [25, 41], [4.005, 0.0]), stage);
        // A point beyond the horizon of a standing CAV is not examined.
        let mut behind = parked(stage, [25, 41], [4.005, 0.0]);
        points(&mut behind)[24].x = -0.001;
        assert_eq!(safe(&behind), YES);
        // A collision at the last point decides, where the sides of the CAV are longer by 8e-7 m.
        let mut collision = parked(stage, [25, 42], [4.005, 0.0]);
        collision.tracks.iter_mut().for_each(|list| list.items[41].x = 4.000_001_5);
        collision.detections.iter_mut().for_each(|list| list.items[41].x = 4.000_001_5);
        points(&mut collision)[24].cos = 1.000_000_4;
        let witness = strict_witness(&collision, stage).expect("a failure");
        assert_eq!((witness.rule, witness.point), (Rule::Collision, Some(24)));
    }
}

/// 4.01 is the last double that is at most 4 + 0.01, 0.01 being a double, and 5.01 that below 5 + 0.01.
/// LLCC-03.
#[test]
fn close_is_within_1_cm_of_a_collision() {
    let stage = Stage::Iii;
    let with = |x: f64, y: f64, theta_obj: f64, delta: f64| {
        let mut cycle = parked(stage, [25, 41], [x, y]);
        (cycle.parameters.theta_obj, cycle.parameters.delta) = (theta_obj, delta);
        cycle
    };
    too_many_close(&with(4.01, 0.0, 5.0, 1e-6), stage);
    assert_eq!(safe(&with(4.01_f64.next_up(), 0.0, 5.0, 1e-6)), YES, "half length");
    too_many_close(&with(0.0, -2.01, 5.0, 1e-6), stage);
    assert_eq!(safe(&with(0.0, -2.01_f64.next_up(), 5.0, 1e-6)), YES, "half width");
    // They overlap at this distance.
    too_many_close(&with(3.0, 0.0, 2.991, 1e-6), stage);
    assert_eq!(safe(&with(3.0, 0.0, 2.989, 1e-6)), YES, "theta_obj");
    // With the greatest margin every close pair is a strict collision.
    let equal = with(4.01, 0.0, 5.0, 1e-2);
    assert_eq!(strict_witness(&equal, stage).map(|it| it.rule), Some(Rule::Collision));
}

/// Tracks beside the path in `MotRemote`, of 100 m by 2 m, so that each is beside the CAV at all places: 32 at 10 m/s,
/// 41 at 11.5 m/s, 22 at 8 m/s. Stages iii and iv do not run.
fn beside(speed: f64, count: u32, y: f64, vx: f64) -> Cycle {
    let mut cycle = base(Profile::HARDENED, MotRemote);
    let long = |id: u32| Track { length: 100.0, vx, ..track(id.into(), 30.0, y) };
    (cycle.tracks, cycle.detections) = (tracks((0..count).map(long).collect()), None);
    cycle.ego.speed = speed;
    cycle
}

/// Standing tracks are examined, those that go on keep beside the path.
/// MARGIN-15.
#[test]
fn more_than_1024_close_motions_fail_the_strict_reading() {
    for vx in [0.0, 8.0] {
        assert_eq!(safe(&beside(10.0, 32, 2.005, vx)), YES, "{vx}");
        too_many_close(&beside(11.5, 25, 2.005, vx), Stage::Iv);
        assert_eq!(safe(&beside(11.5, 25, 2.011, vx)), YES, "{vx}");
        let mut meeting = beside(11.5, 25, 2.005, vx);
        // What the CAV meets at the last place decides, 9.8675 m ahead; the lax model has none there.
        meeting.tracks.as_mut().expect("a list").items.push(track(25, 13.8, 0.0));
        assert_eq!(safe(&meeting), NEAR_UNSAFE);
        let witness = strict_witness(&meeting, Stage::Iv).expect("a failure");
        assert_eq!((witness.rule, witness.point), (Rule::FailSafe, Some(51 + 40)));
    }
}

/// 25 fast followers, which are not examined, run over the CAV at all 41 places: by more than 1 cm, by less.
/// H-14.54.
#[test]
fn who_surely_sweeps_over_the_cav_is_not_close() {
    let with = |y: f64| {
        let mut cycle = beside(11.5, 25, y, 30.0);
        cycle.tracks.iter_mut().flat_map(|list| &mut list.items).for_each(|it| it.x = -52.5);
        cycle
    };
    assert_eq!(safe(&with(0.0)), YES);
    assert_eq!(safe(&with(1.989)), YES);
    too_many_close(&with(1.991), Stage::Iv);
}

/// At 8 m/s the CAV may stand from s_b = 4 m on, 1/1 s after now: strictly and exactly its window 1/4 m before ends
/// when a follower comes that is not yet there when the lax one ends.
/// H-14.54.
#[test]
fn who_comes_between_the_windows_is_close() {
    let with = |followers: u32| {
        let mut cycle = beside(8.0, 46, 2.005, 8.0);
        let follower = |id: u32| Track { vx: 10.0, ..track(46 + i64::from(id), -10.95, 0.0) };
        cycle.tracks.as_mut().expect("a list").items.extend((0..followers).map(follower));
        cycle
    };
    assert_eq!(safe(&with(12)), YES);
    too_many_close(&with(13), Stage::Iv);
}
