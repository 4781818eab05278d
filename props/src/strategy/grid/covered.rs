//! Occupied cells that a detection touches, or just does not (H-06 of
//! `spec/3-stages.md#hardened-profile`).

use mufasa_model::input::cycle::{Cycle, Detection, DetectionList, Grid, TrackList};

use super::super::base::Frame;
use super::super::draw::Draw;
use super::{Plan, backwards, lay, plan, put};

/// A cell behind the CAV that the rear disk reaches, and a detection beyond it that touches its
/// square with a corner or a side, or misses it by a little. At times stage iii runs in the place
/// of stage iv, and at times another cell is there, too.
pub fn cell(draw: &mut Draw<'_>, cycle: &mut Cycle) {
    let plan = plan(draw, cycle);
    let mut grid = lay(draw, cycle, &plan);
    let offset = backwards(draw, cycle, &grid);
    let axis =
        |within: f64, cells: i64| (cells as f64 - within).max(within - cells as f64 - 1.0).max(0.0);
    let away = axis(plan.within.0, offset.0).hypot(axis(plan.within.1, offset.1));
    // The disk reaches a little more than to the cell.
    let r = away * plan.resolution + draw.pick(&[0.02, 0.1, 0.3]);
    let share = cycle.ego.length / cycle.parameters.n as f64;
    cycle.ego.width = (4.0 * r * r - share * share).max(0.04).sqrt();
    put(draw, &mut grid, &plan, offset);
    if draw.one_in(4) {
        put(draw, &mut grid, &plan, (-offset.1, offset.0));
    }
    let items = vec![beyond(draw, &grid, &plan, offset)];
    let stamp_ns = cycle.now_ns - draw.pick(&[0, 20_000_000]);
    cycle.detections = Some(DetectionList { stamp_ns, items });
    if draw.one_in(6) {
        cycle.tracks = Some(TrackList { stamp_ns, items: Vec::new() });
    }
    cycle.grid = Some(grid);
}

/// A detection at the cell, on the side that is turned away from the disk.
fn beyond(draw: &mut Draw<'_>, grid: &Grid, plan: &Plan, offset: (i64, i64)) -> Detection {
    let (length, width) =
        draw.pick(&[(4.5, 1.8), (0.6, 0.4), (2.0, 2.0), (0.01, 0.01), (9.0, 2.5)]);
    let half = 0.5 * plan.resolution;
    let middle = |cell: usize, cells: i64| (cell as f64 + cells as f64 + 0.5) * plan.resolution;
    let frame = Frame { x: grid.x, y: grid.y, cos: grid.cos, sin: grid.sin };
    let (x, y) = frame.at(middle(plan.cell.0, offset.0), middle(plan.cell.1, offset.1));
    let cell = Frame { x, y, ..frame };
    let sign = |cells: i64| if cells < 0 { -1.0 } else { 1.0 };
    let (a, b) = (sign(offset.0), sign(offset.1));
    let gap = draw.near(0.0);
    let (direction, at) = if draw.below(2) == 0 {
        // The cell's corner in the detection's side.
        let angle = draw.range(0.0, std::f64::consts::FRAC_PI_2);
        let direction = draw.pick(&[(a * angle.cos(), b * angle.sin()), (a, 0.0), (0.0, b)]);
        let (ahead, aside) = (0.5 * length + gap, draw.pick(&[0.0, 0.4, -0.4]) * width);
        let corner = Frame { x: a * half, y: b * half, cos: direction.0, sin: direction.1 };
        (direction, corner.at(ahead, aside))
    } else {
        // The detection's corner in the cell's side.
        let direction = draw.direction();
        let normal = if offset.0.abs() > offset.1.abs() { (a, 0.0) } else { (0.0, b) };
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
    let ((x, y), (cos, sin)) = (cell.at(at.0, at.1), frame.turn(direction));
    let norm = cos.hypot(sin);
    // Two directions that are not quite unit vectors multiply out of the domain.
    let (cos, sin) = if (norm - 1.0).abs() > 4e-7 { (cos / norm, sin / norm) } else { (cos, sin) };
    Detection { x, y, cos, sin, length, width }
}
