//! What one would write without the implementation: plain floating-point loops and the first
//! assignment crate at hand. They decide without error bounds; near a threshold they may be wrong.

use mufasa::cycle::{Cycle, Detection, TrajectoryPoint};
use pathfinding::kuhn_munkres::kuhn_munkres_min;
use pathfinding::matrix::Matrix;

/// Stage i: mean cost in whole micrometres by `pathfinding::kuhn_munkres`. `true` passes.
pub fn stage_i(cycle: &Cycle<'_>) -> bool {
    let (Some(tracks), Some(detections)) = (cycle.tracks, cycle.detections) else { return true };
    let distance = |x: f64, y: f64, a: f64, b: f64| (x - a).hypot(y - b);
    let of_ego = |x: f64, y: f64| distance(x, y, cycle.ego.x, cycle.ego.y);
    let radius = detections.items.iter().map(|d| of_ego(d.x, d.y)).fold(0.0, f64::max);
    let gated: Vec<_> = tracks.items.iter().filter(|t| of_ego(t.x, t.y) <= radius).collect();
    let pairs = gated.len().min(detections.items.len());
    if pairs == 0 {
        return true;
    }
    let micrometres = |metres: f64| whole(metres * 1e6);
    let cost = |t: &mufasa::cycle::Track, d: &Detection| micrometres(distance(t.x, t.y, d.x, d.y));
    // The crate wants no more rows than columns.
    let rows: Vec<Vec<i64>> = if gated.len() <= detections.items.len() {
        gated.iter().map(|t| detections.items.iter().map(|d| cost(t, d)).collect()).collect()
    } else {
        detections.items.iter().map(|d| gated.iter().map(|t| cost(t, d)).collect()).collect()
    };
    let Ok(matrix) = Matrix::from_rows(rows) else { return false };
    let (sum, _) = kuhn_munkres_min(&matrix);
    i64::try_from(pairs).is_ok_and(|pairs| sum < pairs * micrometres(cycle.parameters.theta_tr))
}

/// Stage ii: every point against every segment and triangle. `true` passes.
pub fn stage_ii(cycle: &Cycle<'_>) -> bool {
    let Some(trajectory) = cycle.trajectory else { return true };
    trajectory.points.iter().all(|point| {
        let p = [point.x, point.y];
        let near = cycle.route.stations.windows(2).any(|pair| {
            to_segment(p, [pair[0].x, pair[0].y], [pair[1].x, pair[1].y])
                <= cycle.parameters.theta_map
        });
        near || cycle.route.stations.windows(2).any(|pair| {
            let [a, b] = [&pair[0], &pair[1]];
            in_triangle(p, a.left, a.right, b.right) || in_triangle(p, a.left, b.right, b.left)
        })
    })
}

/// Stage iii of the paper profile: separating axes for every track at every point. `true` passes.
pub fn stage_iii(cycle: &Cycle<'_>) -> bool {
    let (Some(trajectory), Some(tracks)) = (cycle.trajectory, cycle.tracks) else { return true };
    let horizon = cycle.parameters.safety_time * cycle.ego.speed;
    within(trajectory.points, horizon).all(|point| {
        let dt = seconds(point.t_ns - tracks.stamp_ns);
        tracks.items.iter().all(|track| {
            let (x, y) = (track.x + track.vx * dt, track.y + track.vy * dt);
            let &mufasa::cycle::Track { cos, sin, length, width, .. } = track;
            apart(cycle, point, &Detection { x, y, cos, sin, length, width })
        })
    })
}

/// Stage iv of the paper profile without a lead. `true` passes.
pub fn stage_iv(cycle: &Cycle<'_>) -> bool {
    let (Some(trajectory), Some(detections)) = (cycle.trajectory, cycle.detections) else {
        return true;
    };
    within(trajectory.points, braking(cycle))
        .all(|point| detections.items.iter().all(|detection| apart(cycle, point, detection)))
}

/// Stage v of the paper profile for a grid that is not turned: dilates the whole grid, then looks
/// the disks up. `true` passes.
pub fn stage_v(cycle: &Cycle<'_>) -> bool {
    let (Some(trajectory), Some(grid)) = (cycle.trajectory, cycle.grid) else { return true };
    let (width, height) = (grid.width, grid.height);
    let n = cycle.parameters.n;
    let share = cycle.ego.length / small(n);
    let r = 0.5 * share.hypot(cycle.ego.width);
    let reach = whole(r / grid.resolution);
    let mut marked = vec![false; usize::try_from(width * height).unwrap_or(0)];
    for bit in 0..marked.len() {
        if grid.occupied[bit / 8] >> (bit % 8) & 1 == 0 {
            continue;
        }
        let bit = i64::try_from(bit).unwrap_or(0);
        let (column, row) = (bit % width, bit / width);
        for k in (row - reach).max(0)..=(row + reach).min(height - 1) {
            for i in (column - reach).max(0)..=(column + reach).min(width - 1) {
                let distance = grid.resolution * small(i - column).hypot(small(k - row));
                if distance <= r {
                    marked[usize::try_from(k * width + i).unwrap_or(0)] = true;
                }
            }
        }
    }
    within(trajectory.points, braking(cycle)).all(|point| {
        (0..n).all(|i| {
            let along = cycle.ego.center_offset + share * (small(i) + 0.5) - 0.5 * cycle.ego.length;
            let (x, y) = (point.x + along * point.cos, point.y + along * point.sin);
            let column = whole(((x - grid.x) / grid.resolution).floor());
            let row = whole(((y - grid.y) / grid.resolution).floor());
            let inside = (0..width).contains(&column) && (0..height).contains(&row);
            !(inside && marked[usize::try_from(row * width + column).unwrap_or(0)])
        })
    })
}

/// The points with arc length at most `horizon`.
fn within(points: &[TrajectoryPoint], horizon: f64) -> impl Iterator<Item = &TrajectoryPoint> {
    let mut arc = 0.0;
    let mut before: Option<&TrajectoryPoint> = None;
    points.iter().take_while(move |point| {
        if let Some(before) = before {
            arc += (point.x - before.x).hypot(point.y - before.y);
        }
        before = Some(point);
        arc <= horizon
    })
}

fn braking(cycle: &Cycle<'_>) -> f64 {
    cycle.ego.speed * cycle.ego.speed / (2.0 * cycle.parameters.a_b)
}

/// Whether the CAV at a point and an object do not touch, by `theta_obj` and separating axes.
fn apart(cycle: &Cycle<'_>, point: &TrajectoryPoint, object: &Detection) -> bool {
    let ego = &cycle.ego;
    let x = point.x + ego.center_offset * point.cos;
    let y = point.y + ego.center_offset * point.sin;
    let (dx, dy) = (object.x - x, object.y - y);
    if dx.hypot(dy) >= cycle.parameters.theta_obj {
        return true;
    }
    let cos = (point.cos * object.cos + point.sin * object.sin).abs();
    let sin = (point.cos * object.sin - point.sin * object.cos).abs();
    let (l, w) = (0.5 * ego.length, 0.5 * ego.width);
    let (a, b) = (0.5 * object.length, 0.5 * object.width);
    (dx * point.cos + dy * point.sin).abs() > l + a * cos + b * sin
        || (dy * point.cos - dx * point.sin).abs() > w + a * sin + b * cos
        || (dx * object.cos + dy * object.sin).abs() > a + l * cos + w * sin
        || (dy * object.cos - dx * object.sin).abs() > b + l * sin + w * cos
}

/// Distance of a point to a segment, m.
fn to_segment(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let part = ((u[0] * v[0] + u[1] * v[1]) / (u[0] * u[0] + u[1] * u[1])).clamp(0.0, 1.0);
    (v[0] - part * u[0]).hypot(v[1] - part * u[1])
}

fn in_triangle(p: [f64; 2], a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> bool {
    let side =
        |a: [f64; 2], b: [f64; 2]| (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
    let sides = [side(a, b), side(b, c), side(c, a)];
    sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0)
}

/// Seconds of a time in ns.
#[expect(clippy::cast_precision_loss, reason = "a plain program would round")]
fn seconds(ns: i64) -> f64 {
    ns as f64 / 1e9
}

#[expect(clippy::cast_precision_loss, reason = "counts of cells and disks are small")]
fn small(count: i64) -> f64 {
    count as f64
}

#[expect(clippy::cast_possible_truncation, reason = "a plain program would truncate")]
fn whole(value: f64) -> i64 {
    value as i64
}

#[cfg(test)]
mod tests {
    use mufasa::cycle::Profile;
    use mufasa::verdict::{FailedStage, Stage};

    use super::*;
    use crate::workload::{Inputs, Memory, SIZES, Workload};

    /// A race between programs that answer differently is worth nothing.
    #[test]
    fn alternatives_and_implementation_agree_on_the_workloads() {
        type Alternative = fn(&Cycle<'_>) -> bool;
        let stages: [(Inputs, Alternative); 5] = [
            (Inputs::StageI, stage_i),
            (Inputs::StageIi, stage_ii),
            (Inputs::StageIii, stage_iii),
            (Inputs::StageIv, stage_iv),
            (Inputs::StageV, stage_v),
        ];
        for size in &SIZES[..2] {
            let workload = Workload::new(*size);
            for (of, alternative) in stages {
                let cycle = workload.cycle(Profile::Paper, of);
                let report = Memory::for_cycle(&cycle).check(&cycle);
                assert_eq!(report.failed_stage, None, "{} {of:?} {report:?}", size.name);
                assert!(alternative(&cycle), "{} {of:?}", size.name);
            }
            let ghost = workload.with_ghosts();
            let cycle = ghost.cycle(Profile::Paper, Inputs::StageI);
            let report = Memory::for_cycle(&cycle).check(&cycle);
            assert_eq!(report.failed_stage, Some(FailedStage::Stage(Stage::I)));
            assert!(!stage_i(&cycle));
        }
    }

    #[test]
    fn whole_cycles_pass_in_both_profiles() {
        for size in SIZES {
            let workload = Workload::new(size);
            for profile in [Profile::Paper, Profile::Hardened] {
                let cycle = workload.cycle(profile, Inputs::Whole);
                let report = Memory::for_cycle(&cycle).check(&cycle);
                assert_eq!(report.failed_stage, None, "{} {report:?}", size.name);
            }
        }
    }
}
