//! What a step costs on a processor (`spec/4-arithmetic.md#steps`). Two kinds of work are timed: H-14 beside tracks that touch the
//! CAV's way, in numbers with error bounds, and an assignment, in 64-bit integers. Which of them takes longer for its
//! instructions depends on the processor; of all inputs of `scripts/steps` each takes the most on one of `docs/embedded.md`.

use core::array::from_fn;
use core::hint::black_box;

use crate::cycle::ValidCycle;
use crate::input::cycle::{
    CrossSection, Cycle, Detection, DetectionList, Ego, Route, Track, TrackList, Trajectory,
    TrajectoryPoint,
};
use crate::input::parameters::Parameters;
use crate::input::profile::Profile;
use crate::input::scratch::{Column, Row, Scratch};
use crate::report::{Outcome, Stage};
use crate::services::configuration::Configuration;

const TRACKS: usize = 26;
const DETECTIONS: usize = 42;
const POINTS: usize = 10;

/// A kind of work that is timed. Source: `spec/4-arithmetic.md#steps`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Calibration {
    /// H-14: numbers with error bounds.
    Motions,
    /// Stage i: 64-bit integers.
    Assignment,
}

impl Calibration {
    /// All kinds. Source: `spec/4-arithmetic.md#steps`.
    pub const ALL: [Self; 2] = [Self::Motions, Self::Assignment];

    /// What `run` counts as: it takes at least 10 instructions of x86-64 for each, as many as a step may take (IMPL-10).
    /// Source: `spec/4-arithmetic.md#steps`.
    pub const STEPS: u64 = 100_000;

    /// Does the work; what the stage says. Source: `spec/4-arithmetic.md#steps`.
    pub fn run(self) -> Outcome {
        match self {
            Self::Motions => motions(),
            Self::Assignment => assignment(),
        }
    }
}

/// What a step costs by this clock, ps, rounded up: of the slower kind of work.
pub(super) fn step_ps(mut now_ns: impl FnMut() -> u64) -> u64 {
    let mut slowest = 0;
    for work in Calibration::ALL {
        let began = now_ns();
        black_box(black_box(work).run());
        slowest = now_ns().saturating_sub(began).max(slowest);
    }
    slowest.saturating_mul(1000).div_ceil(Calibration::STEPS)
}

/// Tracks that stand 6 nm beside all places of the CAV, so that each place is asked about.
fn motions() -> Outcome {
    let tracks = from_fn::<_, TRACKS, _>(|at| track(at, 4.0, 1.95 + 6e-9));
    let points = from_fn::<_, POINTS, _>(|at| TrajectoryPoint {
        t_ns: nanoseconds(at),
        x: number(at),
        y: 0.0,
        cos: 1.0,
        sin: 0.0,
    });
    let trajectory = Trajectory { stamp_ns: 0, points: &points };
    outcome(Stage::Iv, &Cycle { trajectory: Some(trajectory), ..with(&tracks, &[]) })
}

/// Tracks a millimetre apart, and detections in a row across.
fn assignment() -> Outcome {
    let tracks = from_fn::<_, TRACKS, _>(|at| track(at, -1.0, 1e-3 * number(at)));
    let detections = from_fn::<_, DETECTIONS, _>(|at| {
        let Track { x, y, cos, sin, length, width, .. } = track(at, number(at), 0.0);
        Detection { x, y, cos, sin, length, width }
    });
    outcome(Stage::I, &Cycle { profile: Profile::PAPER, ..with(&tracks, &detections) })
}

fn outcome(stage: Stage, cycle: &Cycle<'_>) -> Outcome {
    let (mut rows, mut columns) = ([Row::EMPTY; TRACKS], [Column::EMPTY; TRACKS + DETECTIONS]);
    let mut scratch = Scratch::new(&mut rows, &mut columns);
    let valid = ValidCycle::new(black_box(cycle), None, &scratch);
    valid.map_or(Outcome::NotScheduled, |valid| valid.stage(stage, &mut scratch))
}

fn with<'a>(tracks: &'a [Track], detections: &'a [Detection]) -> Cycle<'a> {
    const END: CrossSection =
        CrossSection { x: -100.0, y: 0.0, left: [-100.0, 4.0], right: [-100.0, -4.0] };
    const ROAD: [CrossSection; 2] =
        [END, CrossSection { x: 100.0, y: 0.0, left: [100.0, 4.0], right: [100.0, -4.0] }];
    Cycle {
        profile: Profile::HARDENED,
        parameters: Parameters { work_limit: i64::MAX, ..Parameters::default() },
        now_ns: 0,
        configuration: Configuration::AllRemote,
        ego: Ego {
            x: 0.0,
            y: 0.0,
            cos: 1.0,
            sin: 0.0,
            speed: 5.0,
            length: 4.8,
            width: 1.9,
            center_offset: 1.4,
        },
        trajectory: None,
        tracks: Some(TrackList { stamp_ns: 0, items: tracks }),
        detections: Some(DetectionList { stamp_ns: 0, items: detections }),
        lead: None,
        route: Route { closed: false, cross_sections: &ROAD },
        grid: None,
        detection_history: &[],
    }
}

fn track(at: usize, x: f64, y: f64) -> Track {
    let id = nanoseconds(at);
    Track { id, x, y, cos: 1.0, sin: 0.0, vx: 0.0, vy: 0.0, length: 4.5, width: 2.0 }
}

fn nanoseconds(at: usize) -> i64 {
    i64::try_from(at).unwrap_or(0)
}

fn number(at: usize) -> f64 {
    f64::from(u8::try_from(at).unwrap_or(0))
}

#[cfg(test)]
mod tests {
    use super::{Calibration, step_ps};
    use crate::report::{Outcome, Rule};

    /// A clock that goes on by so many nanoseconds from asked to asked.
    fn by(steps: [u64; 4]) -> u64 {
        let (mut steps, mut now) = (steps.into_iter(), u64::MAX - 1_000_000);
        step_ps(|| {
            now += steps.next().unwrap_or(0);
            now
        })
    }

    #[test]
    fn the_slower_kind_counts_and_is_rounded_up() {
        assert_eq!([by([0, 75_000, 0, 40_000]), by([5, 40_000, 5, 75_001])], [750, 751]);
        assert_eq!(step_ps(|| 7), 0, "a clock that stands: no `step_ps` of a monitor");
    }

    /// Each kind comes to the end of what it is for.
    #[test]
    fn the_work_is_done() {
        assert_eq!(Calibration::Motions.run(), Outcome::Passed);
        let Outcome::Failed(witness) = Calibration::Assignment.run() else {
            panic!("no assignment")
        };
        assert_eq!(witness.rule, Rule::MeanCost);
        assert!((12.0..14.0).contains(&witness.compared[0]), "{witness:?}");
    }
}
