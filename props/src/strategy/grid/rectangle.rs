//! Occupied cells that the CAV's rectangle touches, or just does not, while a disk reaches them, and
//! that a detection covers, or just does not (H-06 of `spec/hardened/H-06.md`).

use mufasa_model::input::cycle::{Cycle, Detection, DetectionList, Grid, Track, TrackList};
use mufasa_model::services::configuration::Configuration::{AllRemote, MotRemote, PlanRemote};

use super::super::base::{Frame, seconds};
use super::super::draw::Draw;
use super::super::{end, track_validation};
use super::{Plan, lay, mark, plan};

/// The CAV's rectangle touches a cell with a corner or a side, or misses it by a little: at the
/// first point with its rear, its side or a corner, or with its front at a place beyond the end of
/// the trajectory. At times stage iv does not run, at times another cell is there, too, and half of the
/// time something is detected behind the cell, which it covers or just does not.
pub fn cell(draw: &mut Draw<'_>, cycle: &mut Cycle) {
    // There the rectangle counts at the places alone.
    if cycle.configuration == MotRemote && !draw.one_in(3) {
        cycle.configuration = draw.pick(&[AllRemote, PlanRemote]);
    }
    let ego = &cycle.ego;
    let road = Frame { x: ego.x, y: ego.y, cos: ego.cos, sin: ego.sin };
    let (x, y) = road.at(ego.center_offset, 0.0);
    let mut place = Frame { x, y, ..road };
    let ahead = draw.one_in(if cycle.configuration == MotRemote { 2 } else { 4 });
    if ahead {
        let missing = end::missing(draw, &cycle.ego);
        end::shorten(draw, cycle, missing);
        place = end::place(cycle);
    }
    let plan = plan(draw, cycle);
    let side = Side::draw(draw);
    let cav = beside_cell(draw, cycle, &plan, (&side, ahead));
    let mut grid = laid_under(draw, cycle, &plan, (place, cav));
    let index = |cell: usize| i64::try_from(cell).unwrap_or(0);
    let (column, row) = (index(plan.cell.0), index(plan.cell.1));
    mark(&mut grid.occupied, &plan, (column, row));
    if draw.one_in(4) {
        let (i, k) = draw.pick(&[(1, 0), (-1, 0), (0, 1), (0, -1), (2, 1), (-1, 2)]);
        mark(&mut grid.occupied, &plan, (column + i, row + k));
    }
    let drives = draw.one_in(3);
    let detection = if drives || draw.one_in(2) {
        behind_cell(draw, &plan, &grid, &side.opposite())
    } else {
        track_validation::detection(road, (-20.0, 30.0))
    };
    cycle.grid = Some(grid);
    run_iv_or_not(draw, cycle, detection);
    if drives {
        drive(draw, cycle, road);
    }
}

/// What was put beside the cell drives along the road or away from the CAV: it is there at the time of the grid. It covers
/// what is beside where it was detected, so that a program that moves it on differs. At times a list misses it, or shows
/// another thing beside it; a second track has the same detection, or none has.
fn drive(draw: &mut Draw<'_>, cycle: &mut Cycle, road: Frame) {
    let detected = cycle.detections.as_ref().map(|list| list.items.clone());
    let (Some([item]), Some(grid)) = (detected.as_deref(), &mut cycle.grid) else { return };
    let [older, newer] = [0, draw.odd_ns(40_000_000)].map(|ago_ns| cycle.now_ns - ago_ns);
    let (t_d, t_g) = if draw.one_in(3) { (older, newer) } else { (newer, older) };
    grid.stamp_ns = t_g;
    let speed = draw.pick(&[8.0, -8.0, 20.0, 3.0]);
    let away = unit((item.x - cycle.ego.x, item.y - cycle.ego.y));
    // What is long drives along its direction.
    let along = match draw.below(3) {
        _ if item.length > 1.0 => (item.cos, item.sin),
        0 => (road.cos, road.sin),
        _ => away,
    };
    let (vx, vy) = (speed * along.0, speed * along.1);
    let at = |t_ns: i64| {
        let t = seconds(t_ns - t_g);
        Detection { x: item.x + vx * t, y: item.y + vy * t, ..item.clone() }
    };
    let list = |stamp_ns: i64| DetectionList { stamp_ns, items: vec![at(stamp_ns)] };
    let ages: &[i64] = draw.pick(&[&[300, 500], &[300, 500, 800], &[300, 800], &[500]]);
    cycle.detection_history = ages.iter().map(|ms| list(t_d - ms * 1_000_000)).collect();
    let [missed, beside] = [0, 1].map(|_| draw.below(3 * ages.len()));
    if let Some(list) = cycle.detection_history.get_mut(missed) {
        list.items.clear();
    }
    if let Some(list) = cycle.detection_history.get_mut(beside) {
        let (x, y) = road.at(0.7, 0.7);
        let (x, y) = (x - road.x, y - road.y);
        let items =
            list.items.iter().map(|it| Detection { x: it.x + x, y: it.y + y, ..it.clone() });
        list.items = items.chain(list.items.iter().cloned()).collect();
    }
    cycle.detections = Some(list(t_d));
    let Detection { x, y, cos, sin, length, width } = at(t_d);
    // Its track may say another speed.
    let stated = draw.pick(&[1.0, 0.9, 1.1]);
    let (vx, vy) = (stated * vx, stated * vy);
    let track = Track { id: 7, x, y, cos, sin, vx, vy, length, width };
    let items = match draw.below(8) {
        0 => Vec::new(),
        1 => vec![track.clone(), Track { id: 8, ..track }],
        _ => vec![track],
    };
    cycle.tracks = Some(TrackList { stamp_ns: t_d, items });
}

/// A detection on a side of the cell, about 1/4 m away from it.
fn behind_cell(draw: &mut Draw<'_>, plan: &Plan, grid: &Grid, side: &Side) -> Detection {
    let (length, width) = draw.pick(&[(4.5, 1.75), (0.5, 0.5), (12.0, 2.5), (0.01, 0.01)]);
    let gap = draw.near(0.0);
    let it = against(draw, 0.5 * plan.resolution, side, (length + 0.5, width + 0.5), gap);
    let &Grid { x, y, cos, sin, .. } = grid;
    let middle = |cell: usize| (cell as f64 + 0.5) * plan.resolution;
    let (x, y) =
        Frame { x, y, cos, sin }.at(middle(plan.cell.0) + it.x, middle(plan.cell.1) + it.y);
    let (cos, sin) = unit(Frame { x, y, cos, sin }.turn((it.cos, it.sin)));
    Detection { x, y, cos, sin, length, width }
}

/// Mostly stage iv runs and finds nothing.
fn run_iv_or_not(draw: &mut Draw<'_>, cycle: &mut Cycle, detection: Detection) {
    let age = draw.pick(&[0, 20_000_000]);
    let stamp_ns = cycle.now_ns - draw.odd_ns(age);
    // Without a detection the disks alone count.
    let items = match draw.below(16) {
        0 => Vec::new(),
        _ => vec![detection],
    };
    cycle.detections = Some(DetectionList { stamp_ns, items });
    match draw.below(8) {
        0 => cycle.detections = None,
        // Stage iii runs: in `PlanRemote` in the place of stage iv.
        1 => cycle.tracks = Some(TrackList { stamp_ns, items: Vec::new() }),
        _ => (),
    }
}

/// The CAV's rectangle in the frame of the cell's centre.
fn beside_cell(
    draw: &mut Draw<'_>,
    cycle: &Cycle,
    plan: &Plan,
    (side, ahead): (&Side, bool),
) -> Frame {
    let (length, width) = (cycle.ego.length, cycle.ego.width);
    let gap = draw.near(0.0);
    let sideways = !ahead && draw.below(2) == 0;
    let size = if sideways { (width, length) } else { (length, width) };
    let mut cav = against(draw, 0.5 * plan.resolution, side, size, gap);
    if sideways {
        (cav.cos, cav.sin) = (-cav.sin, cav.cos);
    }
    // Away from the cell, unless that is in front.
    let leaves = cav.cos * side.normal.0 + cav.sin * side.normal.1 > 0.0;
    if leaves == ahead {
        (cav.cos, cav.sin) = (-cav.cos, -cav.sin);
    }
    cav
}

/// The grid of a plan, empty, with the CAV of a place where `cav` says.
fn laid_under(
    draw: &mut Draw<'_>,
    cycle: &Cycle,
    plan: &Plan,
    (place, cav): (Frame, Frame),
) -> Grid {
    let (cos, sin) = unit(place.turn((cav.cos, -cav.sin)));
    let middle = |cell: usize| (cell as f64 + 0.5) * plan.resolution;
    let (x, y) = (middle(plan.cell.0) + cav.x, middle(plan.cell.1) + cav.y);
    let (x, y) = Frame { cos, sin, ..place }.at(-x, -y);
    Grid { x, y, cos, sin, ..lay(draw, cycle, plan) }
}

/// A side of a cell.
struct Side {
    /// 1 or -1 along either axis: one of its corners.
    corner: (f64, f64),
    /// Its outward normal.
    normal: (f64, f64),
}

impl Side {
    fn draw(draw: &mut Draw<'_>) -> Self {
        const DIAGONAL: [f64; 2] = [1.0, -1.0];
        let corner = (draw.pick(&DIAGONAL), draw.pick(&DIAGONAL));
        Self { corner, normal: draw.pick(&[(corner.0, 0.0), (0.0, corner.1)]) }
    }

    fn opposite(&self) -> Self {
        let turned = |(x, y): (f64, f64)| (-x, -y);
        Self { corner: turned(self.corner), normal: turned(self.normal) }
    }
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
