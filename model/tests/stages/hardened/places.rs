//! H-04, H-06, H-09 and H-10: where the CAV is examined, and against what.

use mufasa_model::hardened::h04_horizon::{e, s_stop_along};
use mufasa_model::input::cycle::{Cycle, Profile, Track, Trajectory};
use mufasa_model::input::scene::Scene;
use mufasa_model::numbers::real::Real;
use mufasa_model::report::{FailedStage, Outcome, Reading, Rule, Stage};
use mufasa_model::services::configuration::Configuration::{
    self, AllRemote, MotRemote, PlanRemote,
};
use mufasa_model::stages::horizon::places_examined;

use crate::base::*;
use crate::near::*;

const HARDENED: Profile = Profile::Hardened;

/// A car stands ahead, seen and tracked.
fn standing(cycle: &mut Cycle, x: f64) {
    cycle.tracks = tracks(vec![track(1, x, 0.0)]);
    cycle.detections = detections(vec![detection(x, 0.0)]);
}

const NEAR: &[Near] = &[
    ("way <= (1 + 1e-6) max(s, s_stop) + m", PlanRemote, HARDENED, |c, e| {
        // s_CAV = 18; the car is met at the point there, and at none before.
        points(c)[18].x = 18.000_018 - e;
        c.tracks = tracks(vec![track(1, 21.5, 0.0)]);
    }),
    ("the first with way > (1 + 1e-6) s_stop + m", PlanRemote, HARDENED, |c, e| {
        // s_stop = 7.645625; the car is met at the point after the one there, and at none before.
        c.parameters.safety_time = 0.0;
        points(c)[8].x = 7.645_632_645_625 - e;
        c.tracks = tracks(vec![track(1, 12.5, 0.0)]);
    }),
    ("half width of the CAV at a cell + m", PlanRemote, HARDENED, |c, e| {
        // The cell begins at y = 1, and disks reach it.
        mark(&mut c.grid.as_mut().expect("there is a grid").occupied, 3.5, 1.5);
        c.tracks = None;
        c.ego.width = 2.0 + 2.0 * e;
    }),
    ("(p - first point) . first heading > -m", MotRemote, HARDENED, |c, e| {
        // Ahead of the first point the CAV is 0.4 m from it: s_stop is 8.05 in place of 7.65.
        (c.ego.x, c.ego.y) = (e, 0.4);
        standing(c, 12.5);
    }),
    ("way of the last point < s_stop + m", MotRemote, HARDENED, |c, e| {
        // s_stop = 6.25: beyond the end the CAV is at 6.5, which the car reaches.
        (c.parameters.tau, c.parameters.lag_tolerance) = (0.0, 2.0);
        let place = |i: u32| at_time(i64::from(i) * 200_000_000, f64::from(i), 0.0);
        let mut points: Vec<_> = (0..=7).map(place).collect();
        points[7].x = 6.25 - e;
        c.trajectory = Some(Trajectory { stamp_ns: NOW, points });
        standing(c, 10.35);
    }),
];

#[test]
fn margins_move_the_horizon() {
    margins_move(NEAR);
}

#[test]
fn the_filter_changes_no_report_of_the_horizon() {
    the_filter_changes_nothing(NEAR);
}

fn scene(cycle: &Cycle) -> Scene {
    Scene::new(cycle, Reading::Exact)
}

/// e counts only where the CAV is ahead of the first point, across as well as along.
#[test]
fn e_counts_only_ahead_of_the_first_point() {
    let e_at = |x: f64, y: f64| {
        let mut cycle = base(HARDENED, PlanRemote);
        (cycle.ego.x, cycle.ego.y) = (x, y);
        let scene = scene(&cycle);
        e(&scene, scene.trajectory.as_ref().expect("it is current"))
    };
    assert_eq!(
        [e_at(3.0, 4.0), e_at(0.0, 4.0), e_at(-3.0, 4.0)],
        [5, 0, 0].map(Real::from_integer)
    );
    assert_eq!(e_at(2.0f64.powi(-20), 0.0), Real::from_double(2.0f64.powi(-20)));
}

/// The places beyond the end: each quarter of a metre above center_offset, for a CAV shorter than that
/// each multiple of its length.
#[test]
fn places_beyond_the_end_are_quarters_of_a_metre() {
    let beyond = |length: f64, center_offset: f64, end: f64| -> Vec<f64> {
        let mut cycle = base(HARDENED, MotRemote);
        (cycle.ego.speed, cycle.parameters.tau) = (4.0, 0.0);
        (cycle.ego.length, cycle.ego.center_offset) = (length, center_offset);
        cycle.trajectory = Some(Trajectory {
            stamp_ns: NOW,
            points: vec![at_time(0, 0.0, 0.0), at_time(1, end, 0.0)],
        });
        let scene = scene(&cycle);
        let trajectory = scene.trajectory.as_ref().expect("it is current");
        assert_eq!(s_stop_along(&scene, trajectory), Real::from_integer(1));
        let places = places_examined(&scene, trajectory, &Real::zero());
        let centres: Vec<f64> = places
            .iter()
            .skip(2)
            .map(|it| it.pose.origin.x.to_f64() + center_offset - end)
            .collect();
        assert_eq!(places.count(), 2 + i128::try_from(centres.len()).expect("few"));
        centres
    };
    assert_eq!(beyond(4.0, 0.0, 0.5), [0.25, 0.5]);
    assert_eq!(beyond(4.0, 0.0, 0.25), [0.25, 0.5, 0.75]);
    assert_eq!(beyond(4.0, 0.125, 0.5), [0.25, 0.5, 0.75]);
    assert_eq!(beyond(4.0, -0.25, 0.5), [0.0, 0.25]);
    assert_eq!(beyond(4.0, 0.0, 1.0), [] as [f64; 0]);
    assert_eq!(beyond(0.125, 0.0, 0.75), [0.125, 0.25]);
    assert_eq!(beyond(0.25, 0.0, 0.75), [0.25]);
}

/// A trajectory that ends before s_stop is examined beyond its end in every configuration.
#[test]
fn every_configuration_looks_beyond_the_end() {
    for configuration in [MotRemote, AllRemote, PlanRemote] {
        let mut cycle = base(HARDENED, configuration);
        cycle.trajectory = Some(straight(14, 0.5));
        cycle.parameters.lag_tolerance = 2.0;
        standing(&mut cycle, 11.6);
        assert!(failed(&cycle).is_some(), "{configuration:?}");
        standing(&mut cycle, 11.8);
        assert_eq!(failed(&cycle), None, "{configuration:?}: 7.75 m and 4 m");
    }
}

/// H-09: in AllRemote a track that is not backed may as well stand at its place.
#[test]
fn an_unbacked_track_may_stand() {
    let with = |configuration: Configuration, backed: bool, age_ns: i64| {
        let mut cycle = base(HARDENED, configuration);
        // Drives away at 20 m/s, and is met when it stands: 10 m ahead of the CAV when it detects.
        let away = |x: f64| Track { vx: 20.0, ..track(1, x, 0.0) };
        #[expect(clippy::cast_precision_loss, reason = "small")]
        let x = 12.0 - 20.0 * age_ns as f64 / 1e9;
        cycle.tracks = tracks(vec![away(x)]);
        cycle.tracks.as_mut().expect("set").stamp_ns -= age_ns;
        cycle.detections = detections(vec![detection(12.0, 0.0)]);
        cycle.parameters.safety_time = 0.5;
        // Stage iv has its own opinion of what stands there: it is not asked for.
        cycle.detection_history =
            if backed { history(&[[12.0, 0.0, 20.0, 0.0]]) } else { Vec::new() };
        outcome(&cycle, Stage::Iii)
    };
    let standing = |outcome: &Outcome| match outcome {
        Outcome::Failed(witness) => Some((witness.rule, witness.track)),
        _ => None,
    };
    let expected = Some((Rule::CollisionStanding, Some(1)));
    assert_eq!(standing(&with(AllRemote, false, 0)), expected);
    assert_eq!(with(AllRemote, true, 0), Outcome::Passed);
    assert_eq!(with(PlanRemote, false, 0), Outcome::Passed);
    // 100 ms ago it was 2 m nearer: it stands at its place, not at p.
    assert_eq!(standing(&with(AllRemote, false, 100_000_000)), expected);
}

/// H-09 at its place, and at p without current detections.
#[test]
fn a_track_stands_at_its_place() {
    let with = |x: f64, blind: bool| {
        let mut cycle = base(HARDENED, AllRemote);
        cycle.ego.speed = 0.0;
        cycle.trajectory = Some(straight(1, 0.0));
        let oncoming = Track { vx: -20.0, ..track(1, x, 0.0) };
        cycle.tracks = tracks(vec![oncoming]);
        cycle.tracks.as_mut().expect("set").stamp_ns -= 50_000_000;
        cycle.detections = if blind { None } else { detections(vec![detection(x - 1.0, 0.0)]) };
        rule(&cycle, Stage::Iii)
    };
    // Predicted to now it is at x - 1 in both; standing at x without detections.
    assert_eq!(with(5.5, false), None);
    assert_eq!(with(4.9, false), Some(Rule::Collision));
    assert_eq!(with(4.9, true), Some(Rule::Collision));
    let mut away = base(HARDENED, AllRemote);
    away.ego.speed = 0.0;
    away.trajectory = Some(straight(1, 0.0));
    away.tracks = tracks(vec![Track { vx: 20.0, ..track(1, 3.9, 0.0) }]);
    away.tracks.as_mut().expect("set").stamp_ns -= 50_000_000;
    away.detections = detections(vec![detection(4.9, 0.0)]);
    assert_eq!(rule(&away, Stage::Iii), None, "its place is 4.9");
    away.detections = None;
    assert_eq!(rule(&away, Stage::Iii), Some(Rule::CollisionStanding), "p is 3.9");
}

/// H-10, F-34: iv runs on current detections in AllRemote, and v on a current grid in AllRemote and
/// PlanRemote, whatever else ran.
#[test]
fn nothing_that_ran_calls_off_detections_or_grid() {
    let ran = |profile: Profile, configuration: Configuration| {
        let cycle = base(profile, configuration);
        [Stage::Iii, Stage::Iv, Stage::V].map(|stage| passes(&cycle, stage))
    };
    assert_eq!(ran(HARDENED, AllRemote), [true, true, true]);
    assert_eq!(ran(HARDENED, PlanRemote), [true, false, true]);
    assert_eq!(ran(HARDENED, MotRemote), [false, true, true]);
    assert_eq!(ran(Profile::Paper, AllRemote), [true, false, false]);
    assert_eq!(ran(Profile::Paper, PlanRemote), [true, false, false]);
    for configuration in [AllRemote, PlanRemote] {
        let mut blind = base(HARDENED, configuration);
        (blind.tracks, blind.detections) = (tracks(vec![]), detections(vec![]));
        assert_eq!(failed(&blind), None);
        let grid = blind.grid.as_mut().expect("there is a grid");
        mark(&mut grid.occupied, 8.5, 0.5);
        assert_eq!(failed(&blind), Some(FailedStage::Stage(Stage::V)), "{configuration:?}");
        blind.profile = Profile::Paper;
        assert_eq!(failed(&blind), None);
    }
}

/// H-10: beside stage iii an explained detection counts as standing up to s_stop alone, which is 7.65 m: the
/// last point examined is 8 m along. s_valid behind a leading vehicle is 18 m and more.
#[test]
fn an_explained_detection_stands_only_within_s_stop_beside_stage_iii() {
    let with = |configuration: Configuration, x: f64, explained: bool| {
        let mut cycle = base(HARDENED, configuration);
        cycle.lead = lead(90.0, V_NOW);
        // It drives away at 12 m/s and is never met; when it stands it is.
        cycle.tracks = tracks(vec![Track { vx: 12.0, ..track(1, x, 0.0) }]);
        cycle.detections = detections(vec![detection(x, 0.0)]);
        cycle.detection_history = history(&[[x, 0.0, 12.0, 0.0]]);
        if !explained {
            // Backed, but its detection looks across the road.
            let across = &mut cycle.detections.as_mut().expect("set").items[0];
            (across.cos, across.sin) = (0.0, 1.0);
        }
        rule(&cycle, Stage::Iv)
    };
    assert_eq!(with(AllRemote, 12.5, true), None);
    assert_eq!(
        with(AllRemote, 12.0, true),
        Some(Rule::Collision),
        "the front is at 10 m, its rear too"
    );
    assert_eq!(with(AllRemote, 12.5, false), Some(Rule::Collision));
    assert_eq!(with(MotRemote, 12.5, true), Some(Rule::Collision), "stage iii does not run");
}
