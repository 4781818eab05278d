//! A cycle in which everything is in order, and how to check it.

use std::fmt::Debug;

use mufasa::cycle::steps::{Counts, Steps, most_steps};
use mufasa::cycle::{self, ValidCycle};
use mufasa::input::cycle::{
    CrossSection, Cycle, Detection, DetectionList, Ego, Grid, Route, Track, TrackList, Trajectory,
    TrajectoryPoint,
};
use mufasa::input::detection_index::{DetectionIndex, Slot};
use mufasa::input::indexes::Indexes;
use mufasa::input::parameters::Parameters;
use mufasa::input::profile::Profile;
use mufasa::input::scratch::{Column, Row, Scratch, Sizes};
use mufasa::report::{FailedStage, InvalidInput, Outcome, Report, Rule, Stage, Witness};
use mufasa::services::configuration::Configuration;

/// Now, ns.
pub const NOW_NS: i64 = 1_000_000_000_000;

/// The lists of a cycle, owned.
#[derive(Clone)]
pub struct Scene {
    pub profile: Profile,
    pub parameters: Parameters,
    pub configuration: Configuration,
    pub ego: Ego,
    pub points: Vec<TrajectoryPoint>,
    pub tracks: Option<Vec<Track>>,
    pub detections: Option<Vec<Detection>>,
    /// Earlier lists of detections: age in ns, and items.
    pub history: Vec<(i64, Vec<Detection>)>,
    /// By how much the track list is older than the detections, ns.
    pub track_age_ns: i64,
    pub cross_sections: Vec<CrossSection>,
    pub occupied: Option<Vec<u8>>,
    pub change: fn(&mut Cycle<'_>),
}

/// 5 m/s straight ahead from `origin` for 2.9 s in a corridor of 4 m; one track and its
/// detection 50 m beside the road; an empty grid of 1 m cells, 200 by 200, around the CAV.
pub fn scene(profile: Profile, configuration: Configuration, origin: [f64; 2]) -> Scene {
    let [x, y] = origin;
    let ego =
        Ego { x, y, cos: 1.0, sin: 0.0, speed: 5.0, length: 4.5, width: 1.9, center_offset: 1.4 };
    let point = |i: i32| TrajectoryPoint {
        t_ns: NOW_NS + i64::from(i) * 100_000_000,
        x: x + 0.5 * f64::from(i),
        y,
        cos: 1.0,
        sin: 0.0,
    };
    let cross_section = |i: i32| {
        let at = x + 20.0 * f64::from(i) - 40.0;
        CrossSection { x: at, y, left: [at, y + 2.0], right: [at, y - 2.0] }
    };
    Scene {
        profile,
        parameters: Parameters::default(),
        configuration,
        ego,
        points: (0..30).map(point).collect(),
        tracks: Some(vec![track(1, x + 3.0, y + 50.0)]),
        detections: Some(vec![detection(x + 3.0, y + 50.1)]),
        history: Vec::new(),
        track_age_ns: 0,
        cross_sections: (0..10).map(cross_section).collect(),
        occupied: Some(vec![0; 5000]),
        change: |_| (),
    }
}

/// A standing track.
pub fn track(id: i64, x: f64, y: f64) -> Track {
    Track { id, x, y, cos: 1.0, sin: 0.0, vx: 0.0, vy: 0.0, length: 4.0, width: 2.0 }
}

/// A detection.
pub fn detection(x: f64, y: f64) -> Detection {
    Detection { x, y, cos: 1.0, sin: 0.0, length: 4.0, width: 2.0 }
}

impl Scene {
    /// Checks the scene with scratch of exactly the size asked for, without indexes of the lists of
    /// detections and with them.
    #[expect(clippy::redundant_closure, reason = "the function alone has fewer lifetimes")]
    pub fn check(&self) -> Result<Report, InvalidInput> {
        self.both_ways(|cycle, indexes, scratch| cycle::check_with(cycle, indexes, scratch))
    }

    /// Why stage iv fails on its own, if it does.
    pub fn failure_of_iv(&self) -> Option<Witness> {
        self.failure_of(Stage::Iv)
    }

    /// Why a stage fails on its own, if it does.
    pub fn failure_of(&self, stage: Stage) -> Option<Witness> {
        let outcome = self.both_ways(|cycle, indexes, scratch| {
            let valid = ValidCycle::with(cycle, *indexes, scratch).expect("a valid scene");
            valid.stage(stage, scratch)
        });
        match outcome {
            Outcome::Failed(witness) => Some(witness),
            outcome => {
                assert_eq!(outcome, Outcome::Passed);
                None
            }
        }
    }

    /// The most steps that it takes.
    pub fn steps(&self) -> Steps {
        self.both_ways(|cycle, _, _| most_steps(&Counts::of(cycle), &cycle.parameters))
    }

    fn both_ways<R: PartialEq + Debug>(
        &self,
        run: impl Fn(&Cycle<'_>, &Indexes<'_, '_>, &mut Scratch<'_>) -> R,
    ) -> R {
        let stamp_ns = NOW_NS - 10_000_000;
        let list = |items| TrackList { stamp_ns: stamp_ns - self.track_age_ns, items };
        let earlier = self.history.iter();
        let history: Vec<_> = earlier
            .map(|(age_ns, items)| DetectionList { stamp_ns: stamp_ns - age_ns, items })
            .collect();
        let mut cycle = Cycle {
            profile: self.profile,
            parameters: self.parameters,
            now_ns: NOW_NS,
            configuration: self.configuration,
            ego: self.ego,
            trajectory: Some(Trajectory { stamp_ns, points: &self.points }),
            tracks: self.tracks.as_deref().map(list),
            detections: self.detections.as_deref().map(|items| DetectionList { stamp_ns, items }),
            lead: None,
            route: Route { closed: false, cross_sections: &self.cross_sections },
            grid: self.occupied.as_deref().map(|occupied| Grid {
                stamp_ns,
                x: self.ego.x - 100.0,
                y: self.ego.y - 100.0,
                cos: 1.0,
                sin: 0.0,
                resolution: 1.0,
                width: 200,
                height: 200,
                occupied,
                unknown: None,
            }),
            detection_history: &history,
        };
        (self.change)(&mut cycle);
        let sizes = Sizes::for_cycle(&cycle);
        let mut rows = vec![Row::default(); sizes.rows];
        let mut columns = vec![Column::default(); sizes.columns];
        let mut scratch = Scratch::new(&mut rows, &mut columns);
        let report = run(&cycle, &Indexes::default(), &mut scratch);
        let lists = || cycle.detections.iter().chain(cycle.detection_history);
        let mut memory: Vec<_> =
            lists().map(|list| vec![Slot::default(); list.items.len()]).collect();
        let indexes: Vec<_> = lists()
            .zip(&mut memory)
            .filter_map(|(list, memory)| DetectionIndex::new(list, memory).ok())
            .collect();
        let indexes = Indexes { route: None, detections: &indexes };
        assert_eq!(run(&cycle, &indexes, &mut scratch), report);
        report
    }

    /// The report of a valid scene.
    pub fn report(&self) -> Report {
        self.check().expect("a valid scene")
    }

    /// Stage and rule of the failure, if the scene is unsafe by a stage.
    pub fn failure(&self) -> Option<(Stage, Witness)> {
        let report = self.report();
        let Some(FailedStage::Stage(stage)) = report.failed_stage else {
            assert_eq!(report.failed_stage, None);
            return None;
        };
        report.stages.iter().find_map(|outcome| match outcome {
            Outcome::Failed(witness) => Some((stage, *witness)),
            _ => None,
        })
    }

    /// The rule that failed, if any.
    pub fn rule(&self) -> Option<Rule> {
        self.failure().map(|(_, witness)| witness.rule)
    }

    /// Whether it fails by this rule; it must not by another one.
    pub fn fails_by(&self, rule: Rule) -> bool {
        let found = self.rule();
        assert!(found.is_none_or(|found| found == rule), "{found:?}");
        found.is_some()
    }
}
