//! A cycle that is safe in every configuration of both profiles, for tests to change one thing.
#![expect(clippy::unnecessary_wraps, reason = "the fields of a cycle are optional")]

use mufasa_model::cycle::check;
use mufasa_model::input::cycle::{
    CrossSection, Cycle, Detection, DetectionList, Ego, Grid, Lead, Profile, Route, Track,
    TrackList, Trajectory, TrajectoryPoint,
};
use mufasa_model::input::parameters::Parameters;
use mufasa_model::report::{FailedStage, Outcome, Reading, Report, Rule, Stage};
use mufasa_model::services::configuration::Configuration;

pub const NOW: i64 = 1_000_000_000;
/// Speed of the CAV in the base cycle, m/s.
pub const V_NOW: f64 = 10.0;
pub const PROFILES: [Profile; 2] = [Profile::PAPER, Profile::HARDENED];
pub const REMOTE: [Configuration; 3] =
    [Configuration::MotRemote, Configuration::AllRemote, Configuration::PlanRemote];

/// Straight road along x, corridor 3 m to each side; CAV of 4 m by 2 m at the origin; 51 points
/// 0.1 s and 1 m apart; a car 60 m ahead, tracked and detected; an empty grid of 1 m cells.
pub fn base(profile: Profile, configuration: Configuration) -> Cycle {
    Cycle {
        profile,
        parameters: Parameters::default(),
        now_ns: NOW,
        configuration,
        ego: Ego {
            x: 0.0,
            y: 0.0,
            cos: 1.0,
            sin: 0.0,
            speed: V_NOW,
            length: 4.0,
            width: 2.0,
            center_offset: 0.0,
        },
        trajectory: Some(straight(51, 1.0)),
        tracks: Some(TrackList { stamp_ns: NOW, items: vec![track(1, 60.0, 0.0)] }),
        detections: Some(DetectionList { stamp_ns: NOW, items: vec![detection(60.0, 0.0)] }),
        lead: None,
        route: straight_route(-100.0, 200.0),
        grid: Some(free_grid()),
        detection_history: Vec::new(),
    }
}

/// Points along x from 0, `step` m and 0.1 s apart.
pub fn straight(count: u32, step: f64) -> Trajectory {
    let point = |i: u32| at_time(i64::from(i) * 100_000_000, f64::from(i) * step, 0.0);
    Trajectory { stamp_ns: NOW, points: (0..count).map(point).collect() }
}

/// A point that looks along x, `after_ns` after now.
pub fn at_time(after_ns: i64, x: f64, y: f64) -> TrajectoryPoint {
    TrajectoryPoint { t_ns: NOW + after_ns, x, y, cos: 1.0, sin: 0.0 }
}

pub fn straight_route(from: f64, to: f64) -> Route {
    let cross_section = |x: f64| CrossSection { x, y: 0.0, left: [x, 3.0], right: [x, -3.0] };
    Route { closed: false, cross_sections: vec![cross_section(from), cross_section(to)] }
}

/// A standing car of 4 m by 2 m that looks along x.
pub fn track(id: i64, x: f64, y: f64) -> Track {
    Track { id, x, y, cos: 1.0, sin: 0.0, vx: 0.0, vy: 0.0, length: 4.0, width: 2.0 }
}

pub fn detection(x: f64, y: f64) -> Detection {
    Detection { x, y, cos: 1.0, sin: 0.0, length: 4.0, width: 2.0 }
}

pub fn tracks(items: Vec<Track>) -> Option<TrackList> {
    Some(TrackList { stamp_ns: NOW, items })
}

pub fn detections(items: Vec<Detection>) -> Option<DetectionList> {
    Some(DetectionList { stamp_ns: NOW, items })
}

/// What the CAV saw 300, 500 and 800 ms ago of objects that are now at (x, y) and drive at (vx, vy).
pub fn history(objects: &[[f64; 4]]) -> Vec<DetectionList> {
    let list = |millis: i32| {
        let dt = f64::from(millis) / 1000.0;
        let then = |[x, y, vx, vy]: &[f64; 4]| detection(x - vx * dt, y - vy * dt);
        let stamp_ns = NOW - i64::from(millis) * 1_000_000;
        DetectionList { stamp_ns, items: objects.iter().map(then).collect() }
    };
    [300, 500, 800].map(list).into()
}

pub fn lead(gap: f64, speed: f64) -> Option<Lead> {
    Some(Lead { stamp_ns: NOW, gap, speed })
}

/// 200 x 100 cells of 1 m with the corner at (-50, -50), all free.
pub fn free_grid() -> Grid {
    Grid {
        stamp_ns: NOW,
        x: -50.0,
        y: -50.0,
        cos: 1.0,
        sin: 0.0,
        resolution: 1.0,
        width: 200,
        height: 100,
        occupied: vec![0; 200 * 100 / 8],
        unknown: None,
    }
}

/// Marks the cell of the free grid that holds the point.
pub fn mark(bitmap: &mut [u8], x: f64, y: f64) {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "small and positive"
    )]
    let bit = (y + 50.0).floor() as usize * 200 + (x + 50.0).floor() as usize;
    bitmap[bit / 8] |= 1 << (bit % 8);
}

pub fn report(cycle: &Cycle) -> Report {
    check(cycle, Reading::Exact).expect("local input is valid")
}

pub fn failed(cycle: &Cycle) -> Option<FailedStage> {
    report(cycle).failed_stage
}

pub fn outcome(cycle: &Cycle, stage: Stage) -> Outcome {
    report(cycle).stages[stage as usize].clone()
}

pub fn passes(cycle: &Cycle, stage: Stage) -> bool {
    outcome(cycle, stage) == Outcome::Passed
}

/// The rule by which a stage failed, if it did.
pub fn rule(cycle: &Cycle, stage: Stage) -> Option<Rule> {
    match outcome(cycle, stage) {
        Outcome::Failed(witness) => Some(witness.rule),
        _ => None,
    }
}

#[test]
fn base_cycle_is_safe_everywhere() {
    for profile in PROFILES {
        for configuration in REMOTE {
            assert_eq!(
                failed(&base(profile, configuration)),
                None,
                "{profile:?} {configuration:?}"
            );
        }
    }
}
