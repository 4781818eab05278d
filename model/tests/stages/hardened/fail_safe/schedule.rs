//! When H-14 runs, what comes before it, and its work (`spec/7-fail-safe.md#motions`, `#meeting`).

use mufasa_model::cycle::check;
use mufasa_model::input::cycle::{Cycle, DetectionList, Lead, Profile};
use mufasa_model::report::{FailedStage, Input, Outcome, Reading, Reason, Rule, Stage, Witness};
use mufasa_model::services::configuration::Configuration::{
    self, AllRemote, Local, MotRemote, PlanRemote,
};

use super::found;
use crate::base::*;
use crate::near::*;

/// What stands 9 m ahead is beyond s_b(10) = 6.25 m and within s_stop = 7.65 m: H-14 alone fails.
fn standing(configuration: Configuration) -> Cycle {
    let mut cycle = base(Profile::HARDENED, configuration);
    cycle.tracks = tracks(vec![track(1, 11.5, 0.0)]);
    cycle.detections = detections(vec![detection(11.5, 0.0)]);
    // The point at 6 m is the last that the paper examines.
    cycle.parameters.safety_time = 0.6;
    cycle
}

/// In the place of stage iv, whether that runs or not; the paper profile does not ask, nor does Local.
#[test]
fn it_runs_in_every_configuration_but_local() {
    for configuration in [MotRemote, AllRemote, PlanRemote] {
        let mut cycle = standing(configuration);
        let witness = found(&cycle).expect("it stands in the way");
        assert_eq!(witness.track, Some(1), "{configuration:?}");
        assert_eq!(failed(&cycle), Some(FailedStage::Stage(Stage::Iv)));
        assert_eq!(outcome(&cycle, Stage::V), Outcome::Skipped(Reason::AfterFailure));
        cycle.profile = Profile::PAPER;
        assert_eq!(failed(&cycle), None, "{configuration:?}");
        (cycle.profile, cycle.configuration) = (Profile::HARDENED, Local);
        assert_eq!(failed(&cycle), None);
    }
}

/// Without a failure the outcome of stage iv stays as it was, and it is no obstacle check (H-05).
#[test]
fn without_a_failure_it_leaves_no_trace() {
    let iv = |cycle: &Cycle| outcome(cycle, Stage::Iv);
    let with = |configuration| base(Profile::HARDENED, configuration);
    assert_eq!(iv(&with(MotRemote)), Outcome::Passed);
    assert_eq!(iv(&with(PlanRemote)), Outcome::Skipped(Reason::OtherStageRan));
    assert_eq!(iv(&with(AllRemote)), Outcome::Skipped(Reason::OtherStageRan));
    let mut blind = with(MotRemote);
    (blind.detections, blind.grid) = (None, None);
    assert_eq!(iv(&blind), Outcome::Skipped(Reason::NoCurrent(Input::Detections)));
    assert_eq!(failed(&blind), Some(FailedStage::NoObstacleCheck));
}

/// A current trajectory, and one object in a current list.
#[test]
fn it_needs_a_trajectory_and_an_object() {
    let old = |stamp_ns: &mut i64| *stamp_ns -= 100_000_001;
    for configuration in [MotRemote, AllRemote, PlanRemote] {
        let mut cycle = standing(configuration);
        let detections = cycle.detections.take();
        assert!(found(&cycle).is_some(), "tracks alone, {configuration:?}");
        old(&mut cycle.tracks.as_mut().expect("set").stamp_ns);
        assert_eq!(found(&cycle), None, "{configuration:?}");
        (cycle.tracks, cycle.detections) = (None, detections);
        assert!(found(&cycle).is_some(), "detections alone, {configuration:?}");
        old(&mut cycle.detections.as_mut().expect("set").stamp_ns);
        assert_eq!(found(&cycle), None, "{configuration:?}");
        let mut cycle = standing(configuration);
        old(&mut cycle.trajectory.as_mut().expect("set").stamp_ns);
        assert_eq!(failed(&cycle), None, "{configuration:?}");
        cycle.trajectory = None;
        assert_eq!(failed(&cycle), None, "{configuration:?}");
        let mut empty = standing(configuration);
        (empty.tracks, empty.detections) = (tracks(vec![]), crate::base::detections(vec![]));
        empty.parameters.work_limit = 0;
        assert_eq!(safe(&empty), YES, "no work, {configuration:?}");
    }
}

/// What comes before it in the place of stage iv: the gap, as s_follow or s_react, and a collision.
#[test]
fn it_comes_after_gap_and_collision() {
    let witness = |cycle: &Cycle| -> Option<Witness> {
        match outcome(cycle, Stage::Iv) {
            Outcome::Failed(witness) => Some(witness),
            _ => None,
        }
    };
    for configuration in [MotRemote, AllRemote, PlanRemote] {
        let mut cycle = standing(configuration);
        cycle.lead = Some(Lead { stamp_ns: NOW, gap: 0.5, speed: V_NOW });
        let found = witness(&cycle).expect("no gap");
        assert_eq!((found.rule, found.compared[0]), (Rule::Gap, 0.5), "{configuration:?}");
        cycle.lead = None;
        cycle.tracks = None;
        cycle.detections = detections(vec![detection(9.0, 0.0)]);
        assert_eq!(witness(&cycle).map(|it| it.rule), Some(Rule::Collision), "{configuration:?}");
    }
    // An earlier failure stops it.
    let mut early = standing(PlanRemote);
    early.ego.y = 2.5;
    assert_eq!(outcome(&early, Stage::Iv), Outcome::Skipped(Reason::AfterFailure));
}

/// (places + points) times tracks, plus detections times items of the longest usable list (at least 1)
/// times (items of all usable lists + places + points), under work_limit in the strict reading.
#[test]
fn work_above_the_limit_fails_the_strict_reading() {
    let with = |configuration, lists: &[usize], tracked: bool, work_limit: i64| {
        let mut cycle = base(Profile::HARDENED, configuration);
        let items = vec![detection(60.0, 9.0), detection(60.0, -9.0)];
        cycle.detections = detections(items.clone());
        let list = |(i, count): (i64, &usize)| DetectionList {
            stamp_ns: NOW - (300 + 100 * i) * 1_000_000,
            items: vec![detection(-50.0, 30.0); *count],
        };
        cycle.detection_history = (0..).zip(lists).map(list).collect();
        cycle.tracks = tracks(if tracked { vec![track(1, 60.0, 9.0)] } else { vec![] });
        cycle.parameters.work_limit = work_limit;
        let strict = check(&cycle, Reading::Strict).expect("valid");
        let rule = match &strict.stages[Stage::Iv as usize] {
            Outcome::Failed(it) => Some((it.rule, it.compared)),
            _ => None,
        };
        let expected = if rule.is_some() { NEAR_SAFE } else { YES };
        assert_eq!(safe(&cycle), expected);
        rule
    };
    let refused = |work: u32| {
        let work = f64::from(work);
        Some((Rule::WorkLimit, [work, work - 1.0]))
    };
    // s_stop = 7.65: p, 30 places and the last one; 51 points.
    let along = 32 + 51;
    for (lists, tracked, work) in [
        (&[][..], true, along + 2 * along),
        (&[][..], false, 2 * along),
        (&[1, 3, 2], true, along + 2 * 3 * (6 + along)),
        (&[0], false, 2 * along),
    ] {
        let limit = i64::from(work);
        assert_eq!(with(PlanRemote, lists, tracked, limit), None, "{lists:?} {tracked}");
        let above = with(PlanRemote, lists, tracked, limit - 1);
        assert_eq!(above, refused(work), "{lists:?} {tracked}");
    }
    // Where stage iv runs, too.
    assert_eq!(with(MotRemote, &[], false, i64::from(2 * along - 1)), refused(2 * along));
}
