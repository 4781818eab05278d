//! The check of the input (`spec/3-stages.md#invalid-input`) as one writes it without a second
//! thought: every number is compared with its domain. No library does it.

use std::collections::HashSet;
use std::ops::RangeInclusive;

use mufasa::input::cycle::{Cycle, Detection, Ego, Grid, Track, TrajectoryPoint};

const POSITION: RangeInclusive<f64> = -16_777_216.0..=16_777_216.0;
const VELOCITY: RangeInclusive<f64> = -150.0..=150.0;
const SIZE: RangeInclusive<f64> = 0.01..=100.0;
const HORIZON_NS: i64 = 60_000_000_000;

/// Whether everything but the route, which is checked when it is indexed, and the parameters is
/// within its domain. NaN is in no range.
pub fn plain_loop(cycle: &Cycle<'_>) -> bool {
    let tracks = cycle.tracks.map_or(&[][..], |list| list.items);
    let detections = cycle.detections.map_or(&[][..], |list| list.items);
    let points = cycle.trajectory.map_or(&[][..], |list| list.points);
    let sizes = tracks.len() <= 1024 && detections.len() <= 2048 && points.len() <= 1024;
    let stamps = [
        cycle.tracks.map(|list| list.stamp_ns),
        cycle.detections.map(|list| list.stamp_ns),
        cycle.trajectory.map(|list| list.stamp_ns),
        cycle.grid.map(|grid| grid.stamp_ns),
    ];
    let recent = |t_ns: i64| (cycle.now_ns - t_ns).abs() <= HORIZON_NS;
    sizes
        && stamps.into_iter().flatten().all(recent)
        && ego(&cycle.ego)
        && cycle.grid.is_none_or(|it| grid(&it))
        && detections.iter().all(detection)
        && tracks.iter().all(track)
        && distinct(tracks)
        && points.iter().all(|it| point(it) && recent(it.t_ns))
        && points.is_sorted_by(|a, b| a.t_ns < b.t_ns)
}

fn ego(ego: &Ego) -> bool {
    place(ego.x, ego.y)
        && direction(ego.cos, ego.sin)
        && (0.0..=150.0).contains(&ego.speed)
        && SIZE.contains(&ego.length)
        && SIZE.contains(&ego.width)
        && (-100.0..=100.0).contains(&ego.center_offset)
}

fn grid(grid: &Grid<'_>) -> bool {
    let cells = grid.width * grid.height;
    place(grid.x, grid.y)
        && direction(grid.cos, grid.sin)
        && (0.01..=10.0).contains(&grid.resolution)
        && (1..=1 << 15).contains(&grid.width)
        && (1..=1 << 15).contains(&grid.height)
        && cells <= 1 << 24
        && i64::try_from(grid.occupied.len()) == Ok((cells + 7) / 8)
}

fn detection(it: &Detection) -> bool {
    place(it.x, it.y)
        && direction(it.cos, it.sin)
        && SIZE.contains(&it.length)
        && SIZE.contains(&it.width)
}

fn track(it: &Track) -> bool {
    place(it.x, it.y)
        && direction(it.cos, it.sin)
        && VELOCITY.contains(&it.vx)
        && VELOCITY.contains(&it.vy)
        && SIZE.contains(&it.length)
        && SIZE.contains(&it.width)
}

fn point(it: &TrajectoryPoint) -> bool {
    place(it.x, it.y) && direction(it.cos, it.sin)
}

/// Ids that increase are distinct; only others are put into a set.
fn distinct(tracks: &[Track]) -> bool {
    tracks.is_sorted_by(|a, b| a.id < b.id) || {
        let mut seen = HashSet::new();
        tracks.iter().all(|track| seen.insert(track.id))
    }
}

fn place(x: f64, y: f64) -> bool {
    POSITION.contains(&x) && POSITION.contains(&y)
}

fn direction(cos: f64, sin: f64) -> bool {
    (cos * cos + sin * sin - 1.0).abs() <= 1e-6
}

#[cfg(test)]
mod tests {
    use mufasa::input::cycle::TrackList;
    use mufasa::input::profile::Profile;
    use mufasa::services::configuration::Configuration;

    use super::plain_loop;
    use crate::workload::{SIZES, Variant, Workload};

    /// The workload with its first track twice, and with its first x no number.
    #[test]
    fn a_wrong_value_is_seen() {
        let workload = Workload::new(&SIZES[0], Variant::Pass);
        let cycle = workload.cycle(Profile::PAPER, Configuration::AllRemote);
        assert!(plain_loop(&cycle));
        let list = cycle.tracks.expect("a workload with tracks");
        let refused = |items: &[super::Track]| {
            let tracks = Some(TrackList { items, ..list });
            !plain_loop(&super::Cycle { tracks, ..cycle })
        };
        let mut items = list.items.to_vec();
        items.push(items[0]);
        assert!(refused(&items));
        items.pop();
        assert!(!refused(&items));
        items[0].x = f64::NAN;
        assert!(refused(&items));
    }
}
