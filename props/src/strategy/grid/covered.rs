//! Occupied cells that a detection touches, or just does not (H-06 of
//! `spec/3-stages.md#hardened-profile`).

use mufasa_model::input::cycle::{Cycle, Detection, DetectionList, Grid, TrackList};
use mufasa_model::services::configuration::Configuration::{AllRemote, MotRemote, PlanRemote};

use super::super::base::Frame;
use super::super::draw::Draw;
use super::super::end;
use super::{Plan, backwards, lay, mark, plan, put};

/// A cell that a disk reaches, and a detection beyond it that touches its square with a corner or a
/// side, or misses it by a little; the CAV's rectangle, too, or only the disk. At times stage iii
/// runs in the place of stage iv, and at times another cell is there, too.
pub fn cell(draw: &mut Draw<'_>, cycle: &mut Cycle) {
    // There no cell is left to stage iv.
    if cycle.configuration == MotRemote && !draw.one_in(4) {
        cycle.configuration = draw.pick(&[AllRemote, PlanRemote]);
    }
    let (grid, item) = match draw.below(2) {
        0 => at_a_disk(draw, cycle),
        _ => at_the_rectangle(draw, cycle),
    };
    let stamp_ns = cycle.now_ns - draw.pick(&[0, 20_000_000]);
    cycle.detections = Some(DetectionList { stamp_ns, items: vec![item] });
    if draw.one_in(6) {
        cycle.tracks = Some(TrackList { stamp_ns, items: Vec::new() });
    }
    cycle.grid = Some(grid);
}

/// Behind the CAV, where the rear disk reaches a little more than to the cell.
fn at_a_disk(draw: &mut Draw<'_>, cycle: &mut Cycle) -> (Grid, Detection) {
    let plan = plan(draw, cycle);
    let mut grid = lay(draw, cycle, &plan);
    let offset = backwards(draw, cycle, &grid);
    let axis =
        |within: f64, cells: i64| (cells as f64 - within).max(within - cells as f64 - 1.0).max(0.0);
    let away = axis(plan.within.0, offset.0).hypot(axis(plan.within.1, offset.1));
    let r = away * plan.resolution + draw.pick(&[0.02, 0.1, 0.3]);
    let share = cycle.ego.length / cycle.parameters.n as f64;
    cycle.ego.width = (4.0 * r * r - share * share).max(0.04).sqrt();
    put(draw, &mut grid, &plan, offset);
    if draw.one_in(4) {
        put(draw, &mut grid, &plan, (-offset.1, offset.0));
    }
    let gap = draw.near(0.0);
    let item = seen(draw, &grid, &plan, offset, (Side::of(offset), gap));
    (grid, item)
}

/// The CAV's rectangle touches the cell, or just does not: at the first point with its rear, its
/// side or a corner, or with its front at a place beyond the end of the trajectory.
fn at_the_rectangle(draw: &mut Draw<'_>, cycle: &mut Cycle) -> (Grid, Detection) {
    let side = Side::of(draw.pick(&[(1, 2), (2, 1), (-1, 2), (2, -1), (-2, -1), (-1, -2)]));
    let ahead = draw.one_in(4);
    let ego = &cycle.ego;
    let road = Frame { x: ego.x, y: ego.y, cos: ego.cos, sin: ego.sin };
    let (x, y) = road.at(ego.center_offset, 0.0);
    let mut place = Frame { x, y, ..road };
    if ahead {
        let missing = end::missing(draw, &cycle.ego);
        end::shorten(draw, cycle, missing);
        place = end::place(draw, cycle);
    }
    let plan = plan(draw, cycle);
    let mut grid = lay(draw, cycle, &plan);
    let (length, width) = (cycle.ego.length, cycle.ego.width);
    let gap = draw.near(0.0);
    let sideways = !ahead && draw.below(2) == 0;
    let size = if sideways { (width, length) } else { (length, width) };
    let mut cav = against(draw, 0.5 * plan.resolution, &side.opposite(), size, gap);
    if sideways {
        (cav.cos, cav.sin) = (-cav.sin, cav.cos);
    }
    // Away from the cell, unless it is in front.
    let (a, b) = side.normal;
    if (cav.cos * a + cav.sin * b > 0.0) != ahead {
        (cav.cos, cav.sin) = (-cav.cos, -cav.sin);
    }
    // The CAV's heading in the grid's frame is that of `cav`.
    (grid.cos, grid.sin) = unit(place.turn((cav.cos, -cav.sin)));
    let middle = |cell: usize| (cell as f64 + 0.5) * plan.resolution;
    let (x, y) = (middle(plan.cell.0) + cav.x, middle(plan.cell.1) + cav.y);
    let turned = Frame { cos: grid.cos, sin: grid.sin, ..place };
    (grid.x, grid.y) = turned.at(-x, -y);
    let index = |cell: usize| i64::try_from(cell).unwrap_or(0);
    mark(&mut grid.occupied, &plan, (index(plan.cell.0), index(plan.cell.1)));
    // Mostly the detection certainly touches the cell, so that the CAV decides.
    let gap = match draw.below(4) {
        0 => draw.near(0.0),
        _ => -0.1 * plan.resolution,
    };
    let item = seen(draw, &grid, &plan, (0, 0), (side, gap));
    (grid, item)
}

/// Where something is as seen from a cell.
struct Side {
    /// 1 or -1 along either axis.
    corner: (f64, f64),
    /// Along the axis that is nearer.
    normal: (f64, f64),
}

impl Side {
    fn of(offset: (i64, i64)) -> Self {
        let sign = |cells: i64| if cells < 0 { -1.0 } else { 1.0 };
        let (a, b) = (sign(offset.0), sign(offset.1));
        let normal = if offset.0.abs() > offset.1.abs() { (a, 0.0) } else { (0.0, b) };
        Self { corner: (a, b), normal }
    }

    fn opposite(&self) -> Self {
        let turn = |(a, b): (f64, f64)| (-a, -b);
        Self { corner: turn(self.corner), normal: turn(self.normal) }
    }
}

/// A detection on that side of the cell, with a gap.
fn seen(
    draw: &mut Draw<'_>,
    grid: &Grid,
    plan: &Plan,
    offset: (i64, i64),
    (side, gap): (Side, f64),
) -> Detection {
    let (length, width) =
        draw.pick(&[(4.5, 1.8), (0.6, 0.4), (2.0, 2.0), (0.01, 0.01), (9.0, 2.5)]);
    let middle = |cell: usize, cells: i64| (cell as f64 + cells as f64 + 0.5) * plan.resolution;
    let frame = Frame { x: grid.x, y: grid.y, cos: grid.cos, sin: grid.sin };
    let (x, y) = frame.at(middle(plan.cell.0, offset.0), middle(plan.cell.1, offset.1));
    let cell = Frame { x, y, ..frame };
    let at = against(draw, 0.5 * plan.resolution, &side, (length, width), gap);
    let ((x, y), (cos, sin)) = (cell.at(at.x, at.y), unit(frame.turn((at.cos, at.sin))));
    Detection { x, y, cos, sin, length, width }
}

/// A rectangle on that side of a cell, with a gap, in the frame of the cell's centre.
fn against(
    draw: &mut Draw<'_>,
    half: f64,
    side: &Side,
    (length, width): (f64, f64),
    gap: f64,
) -> Frame {
    let ((a, b), normal) = (side.corner, side.normal);
    let (direction, (x, y)) = if draw.below(2) == 0 {
        // The cell's corner in the rectangle's side.
        let angle = draw.range(0.0, std::f64::consts::FRAC_PI_2);
        let direction = draw.pick(&[(a * angle.cos(), b * angle.sin()), (a, 0.0), (0.0, b)]);
        let (ahead, aside) = (0.5 * length + gap, draw.pick(&[0.0, 0.4, -0.4]) * width);
        let corner = Frame { x: a * half, y: b * half, cos: direction.0, sin: direction.1 };
        (direction, corner.at(ahead, aside))
    } else {
        // The rectangle's corner in the cell's side.
        let direction = draw.direction();
        let along = normal.0 * direction.0 + normal.1 * direction.1;
        let across = normal.1 * direction.0 - normal.0 * direction.1;
        let corner = (0.5 * length * along.signum(), 0.5 * width * across.signum());
        let (x, y) =
            Frame { x: 0.0, y: 0.0, cos: direction.0, sin: direction.1 }.at(corner.0, corner.1);
        let aside = draw.pick(&[0.0, 0.9, -0.9]) * half;
        let reach = half + gap;
        (
            direction,
            (normal.0 * reach - normal.1 * aside + x, normal.1 * reach + normal.0 * aside + y),
        )
    };
    Frame { x, y, cos: direction.0, sin: direction.1 }
}

/// Two directions that are not quite unit vectors multiply out of the domain.
fn unit((cos, sin): (f64, f64)) -> (f64, f64) {
    let norm = cos.hypot(sin);
    if (norm - 1.0).abs() > 4e-7 { (cos / norm, sin / norm) } else { (cos, sin) }
}
