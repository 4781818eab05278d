//! Invalid input (`spec/3-stages.md#invalid-input`): one bad value in a valid cycle is always found
//! and never safe.

use mufasa::cycle::check;
use mufasa::input::cycle::{
    CrossSection, Cycle, Detection, DetectionList, Grid, Lead, Route, Track, TrackList, Trajectory,
    TrajectoryPoint,
};
use mufasa::input::scratch::{Column, Row, Scratch};
use mufasa::report::{FailedStage, Outcome, Reason};
use mufasa::services::configuration::Group;

use super::any::{below, configuration, profile};
use super::scene::{BESIDE, CROSS_SECTIONS, FREE, Given, NOW_NS, SEEN_BESIDE, STRAIGHT, cycle};
#[cfg(not(kani))]
use crate::kani;

/// A number that is NaN, infinite or outside every domain makes local input an error to the caller
/// and remote data an unsafe cycle in which no stage ran.
///
/// Domain: each of the 57 numbers of a valid cycle, 5 bad values, all configurations, both
/// profiles. Not covered: two bad values at once (`stages` has any).
pub fn verify_bad_number_is_never_safe() {
    const BAD: [f64; 5] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300];
    let mut lists = Lists::valid();
    let mut single = Single::valid();
    let place = below(NUMBERS);
    let (number, owner) = number(&mut lists, &mut single, place);
    *number = BAD[usize::from(below(5))];
    refused(&lists, &single, owner);
}

/// An integer outside its domain, a repeated id, a time that does not increase, two
/// equal reference points, a list that is too short or a bitmap of the wrong length makes local
/// input an error to the caller and remote data an unsafe cycle in which no stage ran.
///
/// Domain: 26 such defects, all configurations, both profiles. Not covered: two defects at once.
pub fn verify_bad_structure_is_never_safe() {
    let mut lists = Lists::valid();
    let mut single = Single::valid();
    let owner = spoil(&mut lists, &mut single, below(DEFECTS));
    refused(&lists, &single, owner);
}

/// Whose fault a value is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Owner {
    Vehicle,
    /// Whoever runs this group.
    Group(Group),
}

fn refused(lists: &Lists, single: &Single, owner: Owner) {
    let history = [DetectionList { stamp_ns: single.stamps_ns[2], items: &lists.seen_before }];
    let cycle = single.cycle(lists, &history);
    let (mut rows, mut columns) = ([Row::default(); 2], [Column::default(); 4]);
    let answer = check(&cycle, &mut Scratch::new(&mut rows, &mut columns));
    let remote = match owner {
        Owner::Vehicle => false,
        Owner::Group(group) => cycle.configuration.is_remote(group),
    };
    match answer {
        Err(_) => assert!(!remote),
        Ok(report) => {
            assert!(remote && report.input.is_some());
            assert!(report.failed_stage == Some(FailedStage::Input));
            let ran = |outcome: &Outcome| {
                !matches!(outcome, Outcome::Skipped(Reason::AfterFailure) | Outcome::NotScheduled)
            };
            assert!(!report.stages.iter().any(ran));
        }
    }
    kani::cover!(answer.is_err() && owner == Owner::Vehicle, "an error of the vehicle");
    kani::cover!(answer.is_err() && owner != Owner::Vehicle, "an error of a local service");
    kani::cover!(answer.is_ok() && owner == Owner::Group(Group::Mot), "unsafe by its tracks");
    kani::cover!(answer.is_ok() && owner == Owner::Group(Group::Plan), "unsafe by its trajectory");
}

/// The items of all lists.
struct Lists {
    points: [TrajectoryPoint; 4],
    tracks: [Track; 2],
    seen_before: [Detection; 1],
    detections: [Detection; 2],
    cross_sections: [CrossSection; 3],
}

impl Lists {
    fn valid() -> Self {
        let [track] = BESIDE;
        let other = Track { id: 2, x: 90.0, ..track };
        Self {
            points: STRAIGHT,
            tracks: [track, other],
            seen_before: [SEEN_BESIDE[0]],
            detections: SEEN_BESIDE,
            cross_sections: CROSS_SECTIONS,
        }
    }
}

/// Everything else.
struct Single {
    /// Without its lists.
    cycle: Cycle<'static>,
    lead: Lead,
    grid: Grid<'static>,
    /// Stamps of trajectory, tracks, the list of the history and detections.
    stamps_ns: [i64; 4],
    /// Points and cross sections that are given.
    counts: [usize; 2],
}

impl Single {
    fn valid() -> Self {
        let cycle = cycle(profile(), configuration(), [Given::Harmless; 5]);
        let (Some(lead), Some(grid)) = (cycle.lead, cycle.grid) else { unreachable!("all given") };
        let grid = Grid { unknown: Some(&FREE), ..grid };
        let stamps_ns = [NOW_NS, NOW_NS, NOW_NS - 1, NOW_NS];
        Self { cycle, lead, grid, stamps_ns, counts: [4, 3] }
    }

    fn cycle<'a>(&self, lists: &'a Lists, detection_history: &'a [DetectionList<'a>]) -> Cycle<'a> {
        let [trajectory, tracks, _, detections] = self.stamps_ns;
        let [points, cross_sections] = self.counts;
        Cycle {
            trajectory: Some(Trajectory { stamp_ns: trajectory, points: &lists.points[..points] }),
            tracks: Some(TrackList { stamp_ns: tracks, items: &lists.tracks }),
            detections: Some(DetectionList { stamp_ns: detections, items: &lists.detections }),
            lead: Some(self.lead),
            route: Route { closed: false, cross_sections: &lists.cross_sections[..cross_sections] },
            grid: Some(self.grid),
            detection_history,
            ..self.cycle
        }
    }
}

/// Places of `number`.
const NUMBERS: u8 = 57;

/// The number at a place, and whose it is.
fn number<'a>(lists: &'a mut Lists, single: &'a mut Single, place: u8) -> (&'a mut f64, Owner) {
    let Single { cycle: Cycle { parameters: p, ego, .. }, lead, grid, .. } = single;
    let [_, point, ..] = &mut lists.points;
    let [_, track] = &mut lists.tracks;
    let [before] = &mut lists.seen_before;
    let [_, detection] = &mut lists.detections;
    let [_, cross_section, _] = &mut lists.cross_sections;
    let value = match place {
        0 => &mut p.theta_tr,
        1 => &mut p.theta_map,
        2 => &mut p.theta_obj,
        3 => &mut p.a_b,
        4 => &mut p.safety_time,
        5 => &mut p.theta_track_max,
        6 => &mut p.tau,
        7 => &mut p.a_max,
        8 => &mut p.start_tolerance,
        9 => &mut p.v_max,
        10 => &mut p.theta_velocity,
        11 => &mut p.delta,
        12 => &mut ego.x,
        13 => &mut ego.y,
        14 => &mut ego.cos,
        15 => &mut ego.sin,
        16 => &mut ego.speed,
        17 => &mut ego.length,
        18 => &mut ego.width,
        19 => &mut ego.center_offset,
        20 => &mut lead.gap,
        21 => &mut lead.speed,
        22 => &mut cross_section.x,
        23 => &mut cross_section.y,
        24 => &mut cross_section.left[0],
        25 => &mut cross_section.right[1],
        26 => &mut grid.x,
        27 => &mut grid.y,
        28 => &mut grid.cos,
        29 => &mut grid.sin,
        30 => &mut grid.resolution,
        31 => &mut detection.x,
        32 => &mut detection.y,
        33 => &mut detection.cos,
        34 => &mut detection.sin,
        35 => &mut detection.length,
        36 => &mut detection.width,
        37 => &mut before.x,
        38 => &mut before.sin,
        39 => &mut before.width,
        40 => &mut track.x,
        41 => &mut track.y,
        42 => &mut track.cos,
        43 => &mut track.sin,
        44 => &mut track.vx,
        45 => &mut track.vy,
        46 => &mut track.length,
        47 => &mut track.width,
        48 => &mut point.x,
        49 => &mut point.y,
        50 => &mut point.cos,
        51 => &mut point.sin,
        52 => &mut before.cos,
        53 => &mut p.lateral_tolerance,
        54 => &mut p.v_object,
        55 => &mut p.t_yield,
        _ => &mut p.a_yield,
    };
    let owner = match place {
        40..=47 => Owner::Group(Group::Mot),
        48..=51 => Owner::Group(Group::Plan),
        _ => Owner::Vehicle,
    };
    (value, owner)
}

/// Places of `spoil`.
const DEFECTS: u8 = 26;

/// Makes one defect, and says whose it is.
fn spoil(lists: &mut Lists, single: &mut Single, place: u8) -> Owner {
    const LATER_NS: i64 = NOW_NS + 60_000_000_001;
    const OLDER_NS: i64 = NOW_NS - 60_000_000_001;
    let Single { cycle: Cycle { parameters, .. }, lead, grid, stamps_ns, counts } = single;
    match place {
        0 => parameters.max_age_ns = -1,
        1 => parameters.max_age_ns = i64::MAX,
        2 => parameters.n = 0,
        3 => parameters.n = 65,
        4 => parameters.miss_budget = -1,
        5 => parameters.miss_budget = 65,
        6 => parameters.step_max_ns = -1,
        7 => lead.stamp_ns = LATER_NS,
        8 => grid.stamp_ns = i64::MAX,
        9 => grid.width = 0,
        10 => grid.height = i64::MAX,
        11 => grid.width = 41,
        12 => grid.occupied = &[],
        13 => grid.unknown = Some(&[0]),
        14 => stamps_ns[2] = LATER_NS,
        15 => stamps_ns[3] = LATER_NS,
        16 => counts[1] = 1,
        17 => lists.cross_sections[1] = lists.cross_sections[0],
        18 => stamps_ns[1] = LATER_NS,
        19 => lists.tracks[1].id = lists.tracks[0].id,
        20 => stamps_ns[0] = LATER_NS,
        21 => counts[0] = 0,
        22 => lists.points[2].t_ns = lists.points[1].t_ns,
        23 => lists.points[3].t_ns = i64::MIN,
        24 => lists.points[3].t_ns = LATER_NS,
        _ => lists.points[0].t_ns = OLDER_NS,
    }
    match place {
        18 | 19 => Owner::Group(Group::Mot),
        20..DEFECTS => Owner::Group(Group::Plan),
        _ => Owner::Vehicle,
    }
}
