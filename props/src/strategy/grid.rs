//! Stage v at its thresholds: disks and cells, borders of cells and of the grid, horizons
//! (`spec/3-stages.md#stage-v-trajectory-with-grid-map`, H-06).

use mufasa_model::input::cycle::{Cycle, Grid};
use mufasa_model::input::profile::{HardenedRule, Profile};
use mufasa_model::services::configuration::Configuration;

use super::base::{self, Frame};
use super::draw::Draw;
use super::end;
use super::obstacle;

mod rectangle;

/// A grid as it is being made: where a disk centre lies in it.
struct Plan {
    /// Column and row of the cell of the disk centre.
    cell: (usize, usize),
    /// Columns and rows.
    size: (usize, usize),
    /// From the corner of that cell to the disk centre, in cells.
    within: (f64, f64),
    /// Side of a cell, m.
    resolution: f64,
}

/// A cycle that stage v decides; tracks and detections are harmless, if there are any.
pub fn cycle(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    if profile == Profile::HARDENED && draw.one_in(4) {
        return beside_iv(draw, profile);
    }
    let mut cycle = without_grid(draw, profile);
    match draw.below(8) {
        0..=2 => cell_at_radius(draw, &mut cycle),
        3 | 4 => border(draw, &mut cycle),
        5 | 6 if end::is_examined(&cycle) => beyond(draw, &mut cycle),
        5 | 6 => horizon(draw, &mut cycle),
        _ => scattered(draw, &mut cycle),
    }
    cycle
}

/// A cycle that the CAV's rectangle decides at an occupied cell, mostly.
pub fn beside_iv(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    let mut cycle = without_grid(draw, profile);
    rectangle::cell(draw, &mut cycle);
    cycle
}

/// A cycle with a trajectory and nothing around it.
fn without_grid(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    let frame = base::frame(draw);
    let configurations = [
        Configuration::MotRemote,
        Configuration::AllRemote,
        // Only the hardened profile has a stage v here (H-05).
        Configuration::PlanRemote,
    ];
    let configurations =
        if profile.has(HardenedRule::H05) { &configurations[..] } else { &configurations[..2] };
    let configuration = draw.pick(configurations);
    let mut cycle = base::cycle(draw, frame, profile, configuration);
    obstacle::widen(&mut cycle, frame);
    (cycle.ego.length, cycle.ego.width) = draw.pick(&[(2.0, 1.0), (1.2, 0.8), (4.0, 2.0)]);
    cycle.parameters.n = draw.pick(&[4, 1, 2, 3]);
    cycle.ego.speed = draw.pick(&[0.0, 1.0, 2.0]);
    let ego = cycle.ego.clone();
    cycle.trajectory = Some(base::straight(&ego, frame, cycle.now_ns, &cycle.parameters));
    cycle
}

/// The rearmost disk of the first point, m.
fn rear_disk(cycle: &Cycle) -> (f64, f64) {
    let ego = &cycle.ego;
    let road = Frame { x: ego.x, y: ego.y, cos: ego.cos, sin: ego.sin };
    let n = cycle.parameters.n as f64;
    road.at(ego.center_offset + ego.length / (2.0 * n) - 0.5 * ego.length, 0.0)
}

/// r of the disks, rounded, m.
fn radius(cycle: &Cycle) -> f64 {
    0.5 * (cycle.ego.length / cycle.parameters.n as f64).hypot(cycle.ego.width)
}

/// A grid large enough for the whole CAV and the way it brakes, around the rear disk.
fn plan(draw: &mut Draw<'_>, cycle: &Cycle) -> Plan {
    let resolution = draw.pick(&[0.5, 0.25, 1.0, 0.2, 2.0]);
    let reach = cycle.ego.length + cycle.ego.width + 2.0;
    let half = base::count(reach / resolution).clamp(3, 32);
    let within = draw.pick(&[(0.5, 0.5), (0.25, 0.75), (0.0, 0.5), (0.0, 0.0), (0.1, 0.9)]);
    Plan { cell: (half, half), size: (2 * half, 2 * half + 1), within, resolution }
}

/// The grid of a plan, empty, in a direction of its own.
fn lay(draw: &mut Draw<'_>, cycle: &Cycle, plan: &Plan) -> Grid {
    let turned = draw.direction();
    let ego = &cycle.ego;
    let road = Frame { x: 0.0, y: 0.0, cos: ego.cos, sin: ego.sin };
    let (cos, sin) = if draw.below(2) == 0 { road.turn((1.0, 0.0)) } else { turned };
    let disk = rear_disk(cycle);
    let a = (plan.cell.0 as f64 + plan.within.0) * plan.resolution;
    let b = (plan.cell.1 as f64 + plan.within.1) * plan.resolution;
    let (x, y) = Frame { x: disk.0, y: disk.1, cos, sin }.at(-a, -b);
    let bytes = (plan.size.0 * plan.size.1).div_ceil(8);
    let unknown = if draw.one_in(4) { Some(vec![0; bytes]) } else { None };
    Grid {
        stamp_ns: cycle.now_ns,
        x,
        y,
        cos,
        sin,
        resolution: plan.resolution,
        width: i64::try_from(plan.size.0).unwrap_or(1),
        height: i64::try_from(plan.size.1).unwrap_or(1),
        occupied: vec![0; bytes],
        unknown,
    }
}

/// Marks a cell; nothing when it is outside.
fn mark(bitmap: &mut [u8], plan: &Plan, cell: (i64, i64)) {
    let (Ok(column), Ok(row)) = (usize::try_from(cell.0), usize::try_from(cell.1)) else { return };
    if column < plan.size.0 && row < plan.size.1 {
        let bit = row * plan.size.0 + column;
        bitmap[bit / 8] |= 1 << (bit % 8);
    }
}

/// Puts the cell at an offset from the disk's cell into the grid, as occupied or as unknown.
fn put(draw: &mut Draw<'_>, grid: &mut Grid, plan: &Plan, offset: (i64, i64)) {
    let base = |index: usize| i64::try_from(index).unwrap_or(0);
    let cell = (base(plan.cell.0) + offset.0, base(plan.cell.1) + offset.1);
    match &mut grid.unknown {
        Some(unknown) if draw.below(2) == 0 => mark(unknown, plan, cell),
        Some(_) | None => mark(&mut grid.occupied, plan, cell),
    }
}

/// An offset in cells that points backwards, so that no other disk comes nearer.
fn backwards(draw: &mut Draw<'_>, cycle: &Cycle, grid: &Grid) -> (i64, i64) {
    let offset = draw.pick(&[(3, 4), (-2, 1), (4, 0), (0, 2), (-1, -1), (1, 3), (5, 0), (2, -2)]);
    let (a, b) = (f64::from(offset.0), f64::from(offset.1));
    let x = a * grid.cos - b * grid.sin;
    let y = a * grid.sin + b * grid.cos;
    let ahead = x * cycle.ego.cos + y * cycle.ego.sin > 0.0;
    let (i, k) = (i64::from(offset.0), i64::from(offset.1));
    if ahead { (-i, -k) } else { (i, k) }
}

/// The CAV's width such that r is near the distance of a cell: between centres (paper), from the
/// disk centre to the square (hardened).
fn cell_at_radius(draw: &mut Draw<'_>, cycle: &mut Cycle) {
    let plan = plan(draw, cycle);
    let mut grid = lay(draw, cycle, &plan);
    let offset = backwards(draw, cycle, &grid);
    let distance = if cycle.profile.has(HardenedRule::H06) {
        let axis = |within: f64, cells: i64| {
            (cells as f64 - within).max(within - cells as f64 - 1.0).max(0.0)
        };
        axis(plan.within.0, offset.0).hypot(axis(plan.within.1, offset.1))
    } else {
        (offset.0 as f64).hypot(offset.1 as f64)
    };
    let r = draw.near(distance * plan.resolution);
    let share = cycle.ego.length / cycle.parameters.n as f64;
    let square = 4.0 * r * r - share * share;
    if square > 1e-4 {
        cycle.ego.width = square.sqrt().min(100.0);
    } else {
        // The disks are wider apart than that: make the CAV shorter instead.
        cycle.ego.width = r.clamp(0.01, 100.0);
        let share = (4.0 * r * r - cycle.ego.width * cycle.ego.width).max(1e-4).sqrt();
        cycle.ego.length = (share * cycle.parameters.n as f64).clamp(0.01, 100.0);
        // The rear disk moves with the length: move the grid along.
        let moved = lay(draw, cycle, &plan);
        (grid.x, grid.y) = rebased(cycle, &plan, &grid);
        grid.unknown = grid.unknown.or(moved.unknown);
    }
    put(draw, &mut grid, &plan, offset);
    cycle.grid = Some(grid);
}

/// The origin that puts the rear disk where the plan has it.
fn rebased(cycle: &Cycle, plan: &Plan, grid: &Grid) -> (f64, f64) {
    let disk = rear_disk(cycle);
    let a = (plan.cell.0 as f64 + plan.within.0) * plan.resolution;
    let b = (plan.cell.1 as f64 + plan.within.1) * plan.resolution;
    Frame { x: disk.0, y: disk.1, cos: grid.cos, sin: grid.sin }.at(-a, -b)
}

/// A disk centre near the border of two cells of which one is marked; hardened: the border of the
/// grid near r from the disk centre.
fn border(draw: &mut Draw<'_>, cycle: &mut Cycle) {
    let mut plan = plan(draw, cycle);
    let r = radius(cycle);
    if cycle.profile == Profile::HARDENED {
        // The first column at r from the disk centre.
        let columns = draw.near(r / plan.resolution);
        plan.cell.0 = base::count(columns.floor());
        plan.within.0 = columns - plan.cell.0 as f64;
        let grid = lay(draw, cycle, &plan);
        cycle.grid = Some(grid);
        return;
    }
    let nudge = draw.near(0.0) / plan.resolution;
    let on_row = draw.below(2) == 0;
    plan.within = if on_row { (0.5, nudge) } else { (nudge, 0.5) };
    let mut grid = lay(draw, cycle, &plan);
    // The farthest cell whose disk still reaches the one before the border.
    let cells = i64::try_from(base::count((r / plan.resolution).floor())).unwrap_or(0);
    let offset = if on_row { (0, -1 - cells) } else { (-1 - cells, 0) };
    put(draw, &mut grid, &plan, offset);
    cycle.grid = Some(grid);
}

/// An occupied cell that only one trajectory point at the horizon reaches, in a grid that holds
/// the whole way, as outside counts as occupied in the hardened profile.
fn horizon(draw: &mut Draw<'_>, cycle: &mut Cycle) {
    const SIDE: f64 = 0.5;
    cycle.ego.speed = draw.pick(&[5.0, 8.0, 3.0]);
    let horizon = obstacle::horizon_of_grid(cycle);
    let reach = horizon.metres;
    let found = obstacle::at_horizon(draw, cycle, horizon);
    let (ego, r) = (&cycle.ego, radius(cycle));
    let Some(points) = cycle.trajectory.as_ref().map(|list| &list.points) else { return };
    let (hit, before) = (&points[found.point], &points[found.point - 1]);
    let advance = (hit.x - before.x).hypot(hit.y - before.y);
    let n = cycle.parameters.n as f64;
    let front = ego.center_offset + 0.5 * ego.length - ego.length / (2.0 * n);
    // Half a step behind the front disk at the hit begins what that disk must not touch: the
    // first marked column (paper), what is within r of the occupied cell (hardened).
    let to_cell = if cycle.profile.has(HardenedRule::H06) { r } else { SIDE * (r / SIDE).floor() };
    let road = Frame { x: hit.x, y: hit.y, cos: ego.cos, sin: ego.sin };
    let ahead = front - 0.5 * advance + to_cell;
    cycle.grid = Some(wall(draw, cycle, road, ahead, reach));
}

/// An occupied cell that the front disk touches, or just does not, at some place beyond the end of
/// a trajectory (H-04).
fn beyond(draw: &mut Draw<'_>, cycle: &mut Cycle) {
    cycle.ego.speed = draw.pick(&[5.0, 8.0, 0.0]);
    let missing = end::missing(draw, &cycle.ego);
    end::shorten(draw, cycle, missing);
    let place = end::place(cycle);
    let n = cycle.parameters.n as f64;
    let front = 0.5 * cycle.ego.length - cycle.ego.length / (2.0 * n);
    let ahead = front + draw.near(radius(cycle));
    let reach = obstacle::horizon_of_grid(cycle).metres + 2.0;
    cycle.grid = Some(wall(draw, cycle, place, ahead, reach));
}

/// A grid with one occupied cell, which begins `ahead` of a place, and holds what is `reach`
/// behind it.
fn wall(draw: &mut Draw<'_>, cycle: &Cycle, road: Frame, ahead: f64, reach: f64) -> Grid {
    const SIDE: f64 = 0.5;
    let (ego, r) = (&cycle.ego, radius(cycle));
    let columns = base::count((reach + ego.length + r + 4.0) / SIDE);
    let rows = 2 * base::count((r + 0.5) / SIDE) + 1;
    let plan = Plan {
        cell: (columns, rows / 2),
        size: (columns + 30, rows),
        within: (0.0, 0.5),
        resolution: SIDE,
    };
    let (x, y) = road.at(ahead - columns as f64 * SIDE, -0.5 * rows as f64 * SIDE);
    let mut grid = Grid { x, y, cos: ego.cos, sin: ego.sin, ..lay(draw, cycle, &plan) };
    put(draw, &mut grid, &plan, (0, 0));
    grid
}

/// Any bits, few or many.
fn scattered(draw: &mut Draw<'_>, cycle: &mut Cycle) {
    let plan = plan(draw, cycle);
    let mut grid = lay(draw, cycle, &plan);
    for _ in 0..draw.between(1, 6) {
        let offset = (draw.below(13), draw.below(13));
        let signed = |index: usize| i64::try_from(index).unwrap_or(0) - 6;
        put(draw, &mut grid, &plan, (signed(offset.0), signed(offset.1)));
    }
    if draw.one_in(4) {
        grid.stamp_ns -= draw.near_ns(cycle.parameters.max_age_ns);
    }
    cycle.grid = Some(grid);
}
