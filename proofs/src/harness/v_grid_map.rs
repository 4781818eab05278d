//! Grid cells and their borders in stage v (`spec/3-stages.md#stage-v-trajectory-with-grid-map`)
//! against integers.

use mufasa::cycle::check;
use mufasa::input::cycle::{Cycle, Ego, Grid, Route, Trajectory, TrajectoryPoint};
use mufasa::input::parameters::Parameters;
use mufasa::input::profile::Profile;
use mufasa::input::scratch::Scratch;
use mufasa::report::{Outcome, Report, Rule};
use mufasa::services::configuration::Configuration;

use super::any::below;
use super::bounds::{GRID, GRID_BYTES};
use super::scene::{CROSS_SECTIONS, EGO, NOW_NS, alone};
#[cfg(not(kani))]
use crate::kani;

/// Half cells a side.
const HALVES: i64 = 2 * GRID as i64;
/// L and W of a square with one disk, m: its radius squared is 2 m^2, in half cells 8.
const SIDE: f64 = 2.0;
const RADIUS_SQUARED: i64 = 8;
/// Lower border of the grid, m, so that every place is on the road.
const LOW: f64 = -2.0;

/// Paper: the stage fails exactly when the disk centre is in a cell, borders included, whose
/// centre is within r of the centre of the occupied one.
///
/// Domain: one occupied cell of 4 by 4, one disk, its centre on a half cell inside or up to half a
/// cell outside. Not covered: other places, other radii, turned grids.
pub fn verify_paper_cells_include_their_borders() {
    let (cell, place) = (cell(), place());
    let report = judged(Profile::PAPER, cell, place);
    let lies_in = |[i, k]: [i64; 2]| {
        let [x, y] = place;
        (2 * i..=2 * i + 2).contains(&x) && (2 * k..=2 * k + 2).contains(&y)
    };
    let is_near = |[i, k]: [i64; 2]| {
        let (di, dk) = (2 * (i - cell[0]), 2 * (k - cell[1]));
        di * di + dk * dk <= RADIUS_SQUARED
    };
    let mut expected = false;
    for i in 0..HALVES / 2 {
        for k in 0..HALVES / 2 {
            expected |= lies_in([i, k]) && is_near([i, k]);
        }
    }
    let failed = matches!(report.stages[4], Outcome::Failed(_));
    assert!(failed == expected);
    kani::cover!(failed && place[0] % 2 == 0, "fails on a border");
    kani::cover!(failed && place[0] % 2 == 1 && place[1] % 2 == 1, "fails inside a cell");
    kani::cover!(!failed, "passes");
    kani::cover!(place[0] < 0 || place[1] > HALVES, "outside the grid");
}

/// H-06: the stage fails exactly when the closed square of the occupied cell, or any place outside
/// the grid, is within r of the disk centre; the cell is named first.
///
/// Domain: one occupied cell of 4 by 4, one disk, its centre on a half cell inside or up to half a
/// cell outside. Not covered: other places, other radii, turned grids, unknown cells.
pub fn verify_hardened_cells_are_closed_squares() {
    let (cell, place) = (cell(), place());
    let report = judged(Profile::HARDENED, cell, place);
    let gap = |at: i64, from: i64, to: i64| (from - at).max(at - to).max(0);
    let [x, y] = place;
    let [dx, dy] = [(x, cell[0]), (y, cell[1])].map(|(at, i)| gap(at, 2 * i, 2 * i + 2));
    let touches = dx * dx + dy * dy <= RADIUS_SQUARED;
    let inside = x.min(HALVES - x).min(y).min(HALVES - y).max(0);
    let outside = inside * inside <= RADIUS_SQUARED;
    let rule = match report.stages[4] {
        Outcome::Failed(witness) => Some(witness.rule),
        Outcome::Passed
        | Outcome::Skipped(_)
        | Outcome::NotApplicable(_)
        | Outcome::NotScheduled => None,
    };
    let expected = if touches { Some(Rule::Occupied) } else { outside.then_some(Rule::Outside) };
    assert!(rule == expected);
    kani::cover!(rule == Some(Rule::Occupied), "occupied");
    kani::cover!(rule == Some(Rule::Outside), "outside");
    kani::cover!(rule.is_none(), "passes");
    kani::cover!(dx * dx + dy * dy == RADIUS_SQUARED, "exactly r away");
}

/// Column and row.
fn cell() -> [i64; 2] {
    let [column, row] = [below(GRID), below(GRID)];
    [column.into(), row.into()]
}

/// In half cells, from one before the grid to one behind it.
fn place() -> [i64; 2] {
    const PLACES: u8 = 2 * GRID + 3;
    [(); 2].map(|()| i64::from(below(PLACES)) - 1)
}

/// The verdict of stage v with this cell occupied and the CAV's disk at this place.
fn judged(profile: Profile, [column, row]: [i64; 2], [x, y]: [i64; 2]) -> Report {
    const CELLS: i64 = GRID as i64;
    let mut occupied = [0_u8; GRID_BYTES];
    for (byte, first) in occupied.iter_mut().zip([0, 8]) {
        let bit = row * CELLS + column - first;
        *byte = if (0..8).contains(&bit) { 1 << bit } else { 0 };
    }
    let metres = |halves: i64| f64::from(i32::try_from(halves).unwrap_or(0)) / 2.0;
    let (x, y) = (metres(x), metres(y) + LOW);
    let point = TrajectoryPoint { t_ns: NOW_NS, x, y, cos: 1.0, sin: 0.0 };
    // The CAV is where its trajectory starts: the place of H-14 that is examined, too, is the same.
    let ego = Ego { x, y, speed: 0.0, length: SIDE, width: SIDE, ..EGO };
    // At standstill and without a reaction the CAV has no other place.
    let parameters = Parameters {
        n: 1,
        tau: 0.0,
        start_tolerance: 1e3,
        theta_map: 1e3,
        ..Parameters::default()
    };
    let points = [point];
    let cycle = Cycle {
        configuration: Configuration::MotRemote,
        trajectory: Some(Trajectory { stamp_ns: NOW_NS, points: &points }),
        route: Route { closed: false, cross_sections: &CROSS_SECTIONS },
        grid: Some(Grid {
            stamp_ns: NOW_NS,
            x: 0.0,
            y: LOW,
            cos: 1.0,
            sin: 0.0,
            resolution: 1.0,
            width: CELLS,
            height: CELLS,
            occupied: &occupied,
            unknown: None,
        }),
        ..alone(profile, parameters, ego, NOW_NS)
    };
    let Ok(report) = check(&cycle, &mut Scratch::new(&mut [], &mut [])) else {
        unreachable!("the input is valid")
    };
    report
}
