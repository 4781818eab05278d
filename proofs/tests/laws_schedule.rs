//! The laws of a cycle's report over every configuration, both profiles, and every input missing,
//! too old, harmless or harmful (`spec/3-stages.md#schedule`); a wrong report refutes each.
//!
//! Domain: one scene, 8 x 5 x 4^4 cycles. Not covered: what the stages compare.

use std::collections::BTreeMap;

use mufasa::configuration::Configuration;
use mufasa::cycle::{
    Cycle, Detection, DetectionList, Ego, Grid, Lead, Profile, Route, Station, Track, TrackList,
    Trajectory, TrajectoryPoint,
};
use mufasa::parameters::Parameters;
use mufasa::schedule::check;
use mufasa::scratch::{Column, Row, Scratch};
use mufasa::verdict::{FailedStage, Outcome, Reason, Report, Stage};
use mufasa_proofs::law::schedule::{LAWS, hardened_accepts_nothing_that_paper_rejects};

const NOW_NS: i64 = 1_000_000_000;
const OLD_NS: i64 = 800_000_000;

/// How an input is: what a stage sees of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Given {
    Missing,
    Old,
    Harmless,
    Harmful,
}

const GIVEN: [Given; 4] = [Given::Missing, Given::Old, Given::Harmless, Given::Harmful];

const CONFIGURATIONS: [Configuration; 4] = [
    Configuration::Local,
    Configuration::MotRemote,
    Configuration::AllRemote,
    Configuration::PlanRemote,
];

const fn station(x: f64) -> Station {
    Station { x, y: 0.0, left: [x, 3.0], right: [x, -3.0] }
}

const fn point(t_ns: i64, x: f64, y: f64) -> TrajectoryPoint {
    TrajectoryPoint { t_ns, x, y, cos: 1.0, sin: 0.0 }
}

const fn track(id: i64, x: f64, y: f64) -> Track {
    Track { id, x, y, cos: 1.0, sin: 0.0, vx: 0.0, vy: 0.0, length: 4.0, width: 2.0 }
}

const fn detection(x: f64, y: f64) -> Detection {
    Detection { x, y, cos: 1.0, sin: 0.0, length: 4.0, width: 2.0 }
}

const STATIONS: [Station; 3] = [station(-40.0), station(0.0), station(80.0)];
const STRAIGHT: [TrajectoryPoint; 4] = [
    point(NOW_NS, 0.0, 0.0),
    point(NOW_NS + 200_000_000, 0.4, 0.0),
    point(NOW_NS + 400_000_000, 0.8, 0.0),
    point(NOW_NS + 600_000_000, 1.2, 0.0),
];
const OFF_ROAD: [TrajectoryPoint; 1] = [point(NOW_NS, 0.0, 9.0)];
/// A car beside the road; with the harmful lists one more, on the CAV or where nothing is seen.
const BESIDE: [Track; 1] = [track(1, 12.0, 20.0)];
const AHEAD: [Track; 2] = [track(1, 12.0, 20.0), track(2, 3.0, 0.0)];
const SEEN_BESIDE: [Detection; 2] = [detection(12.0, 20.0), detection(-30.0, -20.0)];
const SEEN_AHEAD: [Detection; 2] = [detection(12.0, 20.0), detection(3.0, 0.0)];
const FREE: [u8; 200] = [0; 200];
const FULL: [u8; 200] = [255; 200];

/// The cycle with these inputs: trajectory, tracks, detections, lead, grid.
fn cycle(profile: Profile, configuration: Configuration, given: [Given; 5]) -> Cycle<'static> {
    let stamp = |given| match given {
        Given::Missing => None,
        Given::Old => Some((OLD_NS, false)),
        Given::Harmless => Some((NOW_NS, false)),
        Given::Harmful => Some((NOW_NS, true)),
    };
    let [trajectory, tracks, detections, lead, grid] = given.map(stamp);
    let ego = Ego {
        x: 0.0,
        y: 0.0,
        cos: 1.0,
        sin: 0.0,
        speed: 2.0,
        length: 4.0,
        width: 2.0,
        center_offset: 0.0,
    };
    Cycle {
        profile,
        parameters: Parameters::default(),
        now_ns: NOW_NS,
        configuration,
        ego,
        trajectory: trajectory.map(|(stamp_ns, harmful)| {
            let points: &[TrajectoryPoint] = if harmful { &OFF_ROAD } else { &STRAIGHT };
            Trajectory { stamp_ns, points }
        }),
        tracks: tracks.map(|(stamp_ns, harmful)| {
            let items: &[Track] = if harmful { &AHEAD } else { &BESIDE };
            TrackList { stamp_ns, items }
        }),
        detections: detections.map(|(stamp_ns, harmful)| {
            let items = if harmful { &SEEN_AHEAD } else { &SEEN_BESIDE };
            DetectionList { stamp_ns, items }
        }),
        lead: lead.map(|(stamp_ns, harmful)| {
            let gap = if harmful { 1.0 } else { 100.0 };
            Lead { stamp_ns, gap, speed: 2.0 }
        }),
        route: Route { closed: false, stations: &STATIONS },
        grid: grid.map(|(stamp_ns, harmful)| Grid {
            stamp_ns,
            x: -20.0,
            y: -20.0,
            cos: 1.0,
            sin: 0.0,
            resolution: 1.0,
            width: 40,
            height: 40,
            occupied: if harmful { &FULL } else { &FREE },
            unknown: None,
        }),
        previous_tracks: None,
    }
}

fn report(cycle: &Cycle<'_>) -> Report {
    let (mut rows, mut columns) = ([Row::default(); 4], [Column::default(); 8]);
    check(cycle, &mut Scratch::new(&mut rows, &mut columns)).expect("the input is valid")
}

fn every_cycle(mut visit: impl FnMut(Configuration, [Given; 5])) {
    for configuration in CONFIGURATIONS {
        for code in 0..4_usize.pow(5) {
            let given = [0, 1, 2, 3, 4].map(|place| GIVEN[code / 4_usize.pow(place) % 4]);
            visit(configuration, given);
        }
    }
}

#[test]
fn every_law_holds_in_every_configuration_with_every_input() {
    let mut verdicts: BTreeMap<String, u32> = BTreeMap::new();
    every_cycle(|configuration, given| {
        let [paper, hardened] = [Profile::Paper, Profile::Hardened].map(|profile| {
            let cycle = cycle(profile, configuration, given);
            let report = report(&cycle);
            for (name, law) in LAWS {
                assert!(law(&cycle, &report), "{name} is broken: {cycle:#?} {report:#?}");
            }
            *verdicts.entry(format!("{:?}", report.failed_stage)).or_default() += 1;
            report
        });
        assert!(
            hardened_accepts_nothing_that_paper_rejects(&paper, &hardened),
            "{configuration:?} {given:?}: {paper:#?} {hardened:#?}"
        );
    });
    println!("{verdicts:?}");
    // Five stages, no obstacle check, safe.
    assert_eq!(verdicts.len(), 7, "a verdict never occurs: {verdicts:?}");
}

/// One wrong report for each law: what a schedule with one fault would have said.
#[test]
fn every_law_is_refuted_by_a_wrong_report() {
    type Fault = fn(&Cycle<'_>, &mut Report);
    let faults: [(&str, Fault); 6] = [
        ("no_stage_runs_in_local", |_, report| report.stages[1] = Outcome::Passed),
        ("only_scheduled_stages_run", |_, report| report.stages[2] = Outcome::NotScheduled),
        ("nothing_runs_after_a_failure", |_, report| {
            for outcome in &mut report.stages {
                if *outcome == Outcome::Skipped(Reason::AfterFailure) {
                    *outcome = Outcome::Passed;
                }
            }
        }),
        ("unsafe_exactly_when_something_failed", |_, report| report.failed_stage = None),
        ("nothing_runs_without_its_input", |_, report| {
            for outcome in &mut report.stages {
                if matches!(outcome, Outcome::NotApplicable(_)) {
                    *outcome = Outcome::Passed;
                }
            }
        }),
        ("no_trajectory_is_accepted_unexamined", |_, report| {
            if report.failed_stage == Some(FailedStage::NoObstacleCheck) {
                report.failed_stage = None;
            }
        }),
    ];
    for ((name, law), (of, fault)) in LAWS.into_iter().zip(faults) {
        assert_eq!(name, of, "the faults stand in the order of the laws");
        let mut refuted = 0;
        every_cycle(|configuration, given| {
            let cycle = cycle(Profile::Hardened, configuration, given);
            let mut wrong = report(&cycle);
            fault(&cycle, &mut wrong);
            refuted += u32::from(!law(&cycle, &wrong));
        });
        println!("{name}: refuted by {refuted} wrong reports");
        assert!(refuted > 0, "{name} cannot fail");
    }
    let safe = report(&cycle(Profile::Paper, Configuration::Local, [Given::Missing; 5]));
    let mut wrong = safe;
    wrong.failed_stage = Some(FailedStage::Stage(Stage::Ii));
    assert!(!hardened_accepts_nothing_that_paper_rejects(&wrong, &safe));
}
