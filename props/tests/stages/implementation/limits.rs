//! The largest input that the domain allows, a small stack, and memory that is too small.

use std::thread;

use mufasa::input::scratch::{Column, Row, Scratch, Sizes};
use mufasa::report::{InvalidInput, Outcome, Problem, Rule};
use mufasa_model::input::cycle::{
    CrossSection, Cycle, Detection, DetectionList, Ego, Grid, Lead, Profile, Route, Track,
    TrackList, Trajectory, TrajectoryPoint,
};
use mufasa_model::services::configuration::Configuration::{
    self, AllRemote, MotRemote, PlanRemote,
};
use mufasa_props::bridge::{Owned, to_impl};

/// Bytes of stack: less than what small cycles need (up to 34 KiB, most of it H-14's) and 16 for each of
/// 1,024 points or tracks.
const STACK: usize = 40 << 10;

/// How many of each there are: track i stands where detection i is, beside the road.
#[derive(Clone, Copy)]
struct Counts {
    tracks: u16,
    detections: u16,
    points: u16,
    cross_sections: u16,
    columns: i64,
    rows: i64,
}

const SMALL: Counts =
    Counts { tracks: 2, detections: 3, points: 90, cross_sections: 3, columns: 64, rows: 64 };
const LARGE: Counts = Counts {
    tracks: 1024,
    detections: 2048,
    points: 1024,
    cross_sections: 8192,
    columns: 1 << 15,
    rows: 1 << 9,
};

/// A safe cycle at 5 m/s along the x axis.
fn cycle(counts: Counts, profile: Profile, configuration: Configuration) -> Cycle {
    let place = |i: u16| (3.0 * f64::from(i % 64), 60.0 + 3.0 * f64::from(i / 64));
    let items: Vec<Track> = (0..counts.tracks)
        .map(|i| {
            let ((x, y), id) = (place(i), i64::from(i));
            Track { id, x, y, cos: 1.0, sin: 0.0, vx: 0.0, vy: 0.0, length: 2.0, width: 1.0 }
        })
        .collect();
    let detections = (0..counts.detections).map(|i| {
        let (x, y) = place(i);
        Detection { x, y, cos: 1.0, sin: 0.0, length: 2.0, width: 1.0 }
    });
    let points = (0..counts.points).map(|i| {
        let t_ns = i64::from(i) * 10_000_000;
        TrajectoryPoint { t_ns, x: 0.05 * f64::from(i), y: 0.0, cos: 1.0, sin: 0.0 }
    });
    let step = 200.0 / f64::from(counts.cross_sections - 1);
    let cross_sections = (0..counts.cross_sections).map(|i| {
        let x = step * f64::from(i) - 50.0;
        CrossSection { x, y: 0.0, left: [x, 4.0], right: [x, -4.0] }
    });
    let cells = usize::try_from(counts.columns * counts.rows).expect("positive");
    let grid = Grid {
        stamp_ns: 0,
        x: -50.0,
        y: -50.0,
        cos: 1.0,
        sin: 0.0,
        resolution: 2.0,
        width: counts.columns,
        height: counts.rows,
        occupied: vec![0; cells.div_ceil(8)],
        unknown: None,
    };
    let length = 4.0;
    Cycle {
        profile,
        parameters: mufasa_model::input::parameters::Parameters {
            n: 64,
            work_limit: i64::MAX,
            ..Default::default()
        },
        now_ns: 0,
        configuration,
        ego: Ego {
            x: 0.0,
            y: 0.0,
            cos: 1.0,
            sin: 0.0,
            speed: 5.0,
            length,
            width: 2.0,
            center_offset: 1.5,
        },
        trajectory: Some(Trajectory { stamp_ns: 0, points: points.collect() }),
        tracks: Some(TrackList { stamp_ns: 0, items }),
        detections: Some(DetectionList { stamp_ns: 0, items: detections.collect() }),
        lead: Some(Lead { stamp_ns: 0, gap: 500.0, speed: 5.0 }),
        route: Route { closed: false, cross_sections: cross_sections.collect() },
        grid: Some(grid),
        detection_history: Vec::new(),
    }
}

/// Of the tracks the first comes from behind, beside the path, and would meet straight on, at this drift to the right,
/// m/s, the CAV where it stops: at 1/10 of its way it keeps beside, which is the deepest that H-14 goes.
fn with_passer(counts: Counts, drift: f64) -> Cycle {
    let mut cycle = cycle(counts, Profile::HARDENED, PlanRemote);
    (cycle.parameters.theta_obj, cycle.parameters.safety_time) = (1e-3, 0.0);
    let passer = &mut cycle.tracks.as_mut().expect("set").items[0];
    (passer.x, passer.y, passer.vx, passer.vy) = (-14.0, 3.5, 7.0, -drift);
    cycle
}

/// One cycle for every configuration and profile, and those that stage iv lacks its input in.
fn cycles(counts: Counts) -> Vec<Owned> {
    let mut cycles = Vec::new();
    for profile in [Profile::PAPER, Profile::HARDENED] {
        for configuration in [AllRemote, MotRemote, PlanRemote] {
            cycles.push(cycle(counts, profile, configuration));
        }
        let mut without_tracks = cycle(counts, profile, AllRemote);
        without_tracks.tracks = None;
        cycles.push(without_tracks.clone());
        without_tracks.detections = None;
        cycles.push(without_tracks);
    }
    cycles.push(with_passer(counts, 0.69));
    cycles.iter().map(to_impl).collect()
}

/// How often each stage passed in these cycles, all safe, on a small stack.
fn passed(cycles: &[Owned]) -> [u32; 5] {
    let Sizes { rows, columns } = Sizes::MAX;
    let mut rows = vec![Row::default(); rows];
    let mut columns = vec![Column::default(); columns];
    let reports: Vec<_> = on_small_stack(|| {
        let check = |cycle: &Owned| {
            let mut scratch = Scratch::new(&mut rows, &mut columns);
            mufasa::cycle::check(&cycle.borrow(&cycle.history()), &mut scratch)
        };
        cycles.iter().map(check).collect()
    });
    let mut passed = [0; 5];
    for report in reports {
        let report = report.expect("valid");
        assert_eq!(report.failed_stage, None, "{report:?}");
        for (count, outcome) in passed.iter_mut().zip(report.stages) {
            *count += u32::from(outcome == Outcome::Passed);
        }
    }
    passed
}

/// Runs what neither panics nor calls anything deep but the implementation.
fn on_small_stack<T: Send>(run: impl FnOnce() -> T + Send) -> T {
    thread::scope(|scope| {
        let thread = thread::Builder::new().stack_size(STACK).spawn_scoped(scope, run);
        thread.expect("a thread").join().expect("no panic")
    })
}

/// IMPL-07: the largest cycles are decided on
/// the stack that small ones need; recursion that grows with the input would overflow it.
#[test]
fn the_largest_cycles_need_no_more_stack_than_small_ones() {
    let stages = passed(&cycles(SMALL));
    assert!(stages.iter().all(|count| *count > 0), "{stages:?}");
    assert_eq!(passed(&cycles(LARGE)), stages);
}

#[test]
fn the_passer_meets_the_cav_unless_it_keeps_beside() {
    let cycle = to_impl(&with_passer(SMALL, 0.71));
    let Sizes { rows, columns } = Sizes::MAX;
    let (mut rows, mut columns) = (vec![Row::default(); rows], vec![Column::default(); columns]);
    let mut scratch = Scratch::new(&mut rows, &mut columns);
    let report = mufasa::cycle::check(&cycle.borrow(&cycle.history()), &mut scratch);
    let Outcome::Failed(witness) = report.expect("valid").stages[3] else { panic!("it passes") };
    assert_eq!((witness.rule, witness.track), (Rule::FailSafe, Some(0)));
}

/// IMPL-08, IMPL-09: scratch that is one element too small
/// is invalid input, whatever the rest; a truncated check would pass.
#[test]
fn scratch_that_is_one_too_small_is_invalid_input() {
    for cycle in cycles(SMALL) {
        let history = cycle.history();
        let cycle = cycle.borrow(&history);
        let Sizes { rows, columns } = Sizes::for_cycle(&cycle);
        let check = |rows: usize, columns: usize| {
            let (mut rows, mut columns) =
                (vec![Row::default(); rows], vec![Column::default(); columns]);
            mufasa::cycle::check(&cycle, &mut Scratch::new(&mut rows, &mut columns))
        };
        assert!(check(rows, columns).is_ok());
        let problem = Problem::ScratchTooSmall;
        let refused = Err(InvalidInput { field: "scratch", index: None, problem });
        if rows > 0 {
            assert_eq!(check(rows - 1, columns), refused);
        }
        if columns > 0 {
            assert_eq!(check(rows, columns - 1), refused);
        }
    }
}
