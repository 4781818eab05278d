//! Mutants of the monitor: it gets other events, or has other settings.

use mufasa_conform::vectors::flag::{self, decisions};
use mufasa_model::monitor::messages::EventKind;
use mufasa_model::report::Reading;
use mufasa_records::Sequence;

/// A monitor that sees another sequence.
type Eye = fn(&mut Sequence);

/// A monitor to which events of a kind say something else.
macro_rules! hears {
    ($name:literal, $pattern:pat => $change:expr) => {
        ($name, |sequence| {
            for event in &mut sequence.events {
                if let $pattern = &mut event.kind {
                    $change;
                }
            }
        })
    };
}

const EYES: &[(&str, Eye)] = &[
    ("the other profile of the monitor", |it| it.profile = flag::other(it.profile)),
    ("max_age 1 ns longer", |it| it.parameters.max_age_ns += 1),
    ("max_age 1 ns shorter", |it| it.parameters.max_age_ns -= 1),
    ("tau 0.3 s", |it| it.parameters.tau = 0.3),
    ("t_wait of the monitor 1 s", |it| it.parameters.t_wait_ns = 1_000_000_000),
    ("l_max of the monitor 1 ns longer", |it| it.parameters.l_max_ns += 1),
    ("l_max of the monitor 1 ns shorter", |it| it.parameters.l_max_ns -= 1),
    ("dt_max of the monitor 1 ns longer", |it| it.parameters.dt_max_ns += 1),
    ("dt_max of the monitor 1 ns shorter", |it| it.parameters.dt_max_ns -= 1),
    ("a period of 120 ms", |it| it.period_ns = 120_000_000),
    ("settings of another vehicle", |it| {
        it.period_ns = 100_000_000;
        it.parameters.tau = 0.2;
        it.parameters.l_max_ns = 50_000_000;
        it.parameters.step_max_ns = 200_000_000;
        it.parameters.request_timeout_ns = 500_000_000;
        it.parameters.t_wait_ns = 10_000_000_000;
        it.parameters.dt_max_ns = 200_000_000;
        it.parameters.max_age_ns = 100_000_000;
    }),
    ("sessions numbered from 0", |it| it.last_session = 0),
    ("own services never supervised", |it| it.supervise_local = false),
    ("own services always supervised", |it| it.supervise_local = true),
    ("PLAN never given back", |it| it.stall = None),
    ("a way of 1 mm", |it| {
        if let Some(stall) = &mut it.stall {
            stall.way = 0.001;
        }
    }),
    ("two detections fit", |it| it.memory.detections = 2),
    ("1024 tracks fit", |it| it.memory.tracks = 1024),
    ("no track fits", |it| it.memory.tracks = 0),
    ("a thousand cross sections fit", |it| it.memory.cross_sections = 1000),
    ("the first event unheard", |it| drop(it.events.drain(..it.events.len().min(1)))),
    ("the last but one unheard", |it| {
        let at = it.events.len().saturating_sub(2);
        drop(it.events.drain(at..it.events.len().min(at + 1)));
    }),
    hears!("tracks always in time", EventKind::Tracks { generated_ns, tracks, .. } => *generated_ns = tracks.stamp_ns),
    hears!("trajectories always in time", EventKind::Trajectory { generated_ns, trajectory, .. } => *generated_ns = trajectory.stamp_ns),
    hears!("data are of session 1", EventKind::Trajectory { session, .. } => *session = 1),
    hears!("detections never seen", EventKind::Cycle { measured } => measured.detections = None),
    hears!("own tracks never seen", EventKind::Cycle { measured } => measured.tracks = None),
    hears!("own trajectories never seen", EventKind::Cycle { measured } => measured.trajectory = None),
    hears!("the CAV always at the origin", EventKind::Cycle { measured } => measured.ego.x = 0.0),
    hears!("the CAV always at 10 m/s", EventKind::Cycle { measured } => measured.ego.speed = 10.0),
];

/// Their names.
pub fn names() -> impl Iterator<Item = &'static str> {
    EYES.iter().map(|(name, _)| *name)
}

/// The mutants that a sequence tells apart.
pub fn of_sequence(sequence: &Sequence) -> Vec<&'static str> {
    let right = decisions(sequence, Reading::Exact);
    let is_told = |(_, eye): &&(&str, Eye)| {
        let mut other = sequence.clone();
        eye(&mut other);
        decisions(&other, Reading::Exact) != right
    };
    EYES.iter().filter(is_told).map(|(name, _)| *name).collect()
}
