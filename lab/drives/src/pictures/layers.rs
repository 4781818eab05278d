//! What lies under the witness: route, grid, objects, trajectory.

use mufasa_model::input::cycle::{
    Cycle, Detection, Grid, Route, Track, TrackList, TrajectoryPoint,
};

use super::frame::{Frame, Rectangle};
use super::scene::Scene;
use crate::seconds;

/// A kind of thing in a picture, for the legend.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layer {
    /// Corridor and reference path.
    Route,
    /// Occupied cells.
    Occupied,
    /// Unknown cells.
    Unknown,
    /// Detections of the history.
    History,
    /// Detections.
    Detections,
    /// Tracks at their stamp.
    Tracks,
    /// Tracks at the times of the trajectory.
    Predictions,
    /// Trajectory and footprints.
    Trajectory,
    /// The CAV now.
    Ego,
}

/// Most predictions drawn per track.
const PREDICTIONS: usize = 8;
/// Most footprints drawn along the trajectory.
const FOOTPRINTS: usize = 14;

/// Draws all layers, lowest first; returns those that are there.
pub fn draw(scene: &mut Scene, cycle: &Cycle) -> Vec<Layer> {
    let mut drawn = vec![Layer::Route];
    route(scene, &cycle.route);
    if let Some(grid) = &cycle.grid {
        if let Some(unknown) = &grid.unknown
            && cells(scene, grid, unknown, "unknown")
        {
            drawn.push(Layer::Unknown);
        }
        if cells(scene, grid, &grid.occupied, "occupied") {
            drawn.push(Layer::Occupied);
        }
    }
    let points = cycle.trajectory.as_ref().map_or(&[][..], |it| &it.points);
    if let Some(tracks) = cycle.tracks.as_ref().filter(|it| !it.items.is_empty()) {
        drawn.push(Layer::Tracks);
        if predictions(scene, tracks, points) {
            drawn.push(Layer::Predictions);
        }
        for item in &tracks.items {
            scene.rectangle(&track(item, 0.0), "track");
        }
    }
    let past = || cycle.detection_history.iter().flat_map(|list| &list.items);
    if past().next().is_some() {
        drawn.push(Layer::History);
        for item in past() {
            scene.rectangle(&detection(item), "history");
        }
    }
    if let Some(detections) = cycle.detections.as_ref().filter(|it| !it.items.is_empty()) {
        drawn.push(Layer::Detections);
        for item in &detections.items {
            scene.rectangle(&detection(item), "detection");
        }
    }
    if !points.is_empty() {
        drawn.push(Layer::Trajectory);
        trajectory(scene, cycle, points);
    }
    drawn.push(Layer::Ego);
    let ego = &cycle.ego;
    scene.cav(&Rectangle::of_ego(ego, [ego.x, ego.y], [ego.cos, ego.sin]));
    drawn
}

/// A track's rectangle `seconds` after its stamp.
pub fn track(track: &Track, seconds: f64) -> Rectangle {
    Rectangle {
        centre: [track.x + track.vx * seconds, track.y + track.vy * seconds],
        direction: [track.cos, track.sin],
        size: [track.length, track.width],
    }
}

/// A detection's rectangle.
pub fn detection(item: &Detection) -> Rectangle {
    Rectangle {
        centre: [item.x, item.y],
        direction: [item.cos, item.sin],
        size: [item.length, item.width],
    }
}

/// The CAV's rectangle at a trajectory point.
pub fn footprint(cycle: &Cycle, point: &TrajectoryPoint) -> Rectangle {
    Rectangle::of_ego(&cycle.ego, [point.x, point.y], [point.cos, point.sin])
}

/// The square of a cell.
pub fn cell(grid: &Grid, (column, row): (i64, i64)) -> Rectangle {
    block(grid, [column, row], [1, 1])
}

/// At most `most` indices below `count`, evenly spread, the last one included.
pub fn spread(count: usize, most: usize) -> impl Iterator<Item = usize> {
    let step = count.div_ceil(most).max(1);
    (0..count).rev().step_by(step)
}

fn route(scene: &mut Scene, route: &Route) {
    let sections = &route.cross_sections;
    let mut pairs: Vec<_> = sections.windows(2).map(|pair| (&pair[0], &pair[1])).collect();
    if let (true, Some(first), Some(last)) = (route.closed, sections.first(), sections.last()) {
        pairs.push((last, first));
    }
    for (from, to) in &pairs {
        for corners in [[from.left, from.right, to.right], [from.left, to.right, to.left]] {
            scene.polygon(&corners, "corridor");
        }
    }
    for (from, to) in &pairs {
        scene.line(&[from.left, to.left], "boundary");
        scene.line(&[from.right, to.right], "boundary");
        scene.line(&[[from.x, from.y], [to.x, to.y]], "reference");
    }
}

/// Draws marked cells of the window as runs along the rows; tells whether there were any.
fn cells(scene: &mut Scene, grid: &Grid, bitmap: &[u8], class: &str) -> bool {
    let Some([columns, rows]) = visible(&scene.frame, grid) else { return false };
    // Rows thinner than 1.5 px are drawn several at a time.
    let rows_at_once = whole(1.5 / (grid.resolution * scene.frame.scale)).max(1);
    let mut any = false;
    let mut row = rows[0];
    while row < rows[1] {
        let end = (row + rows_at_once).min(rows[1]);
        let marked = |column| (row..end).any(|row| bit(grid, bitmap, column, row));
        let mut column = columns[0];
        while column < columns[1] {
            let start = column;
            while column < columns[1] && marked(column) {
                column += 1;
            }
            if column > start {
                any = true;
                let run = block(grid, [start, row], [column - start, end - row]);
                scene.rectangle(&run, class);
            }
            column += 1;
        }
        row = end;
    }
    any
}

/// Ranges of columns and rows that the window can show.
fn visible(frame: &Frame, grid: &Grid) -> Option<[[i64; 2]; 2]> {
    let norm = grid.cos * grid.cos + grid.sin * grid.sin;
    let cells = frame.window().map(|[x, y]| {
        let [x, y] = [x - grid.x, y - grid.y];
        let size = norm * grid.resolution;
        [(x * grid.cos + y * grid.sin) / size, (y * grid.cos - x * grid.sin) / size]
    });
    let range = |axis: usize, count: i64| {
        let low = cells.iter().map(|cell| cell[axis]).fold(f64::INFINITY, f64::min);
        let high = cells.iter().map(|cell| cell[axis]).fold(f64::NEG_INFINITY, f64::max);
        [whole(low.floor()).clamp(0, count), whole(high.ceil()).clamp(0, count)]
    };
    let sane = grid.width > 0 && grid.height > 0 && cells.iter().flatten().all(|v| v.is_finite());
    sane.then(|| [range(0, grid.width), range(1, grid.height)])
}

fn bit(grid: &Grid, bitmap: &[u8], column: i64, row: i64) -> bool {
    let index = i128::from(row) * i128::from(grid.width) + i128::from(column);
    usize::try_from(index / 8)
        .ok()
        .and_then(|byte| bitmap.get(byte))
        .is_some_and(|byte| byte >> (index % 8) & 1 == 1)
}

#[expect(clippy::cast_precision_loss)] // of a picture
fn block(grid: &Grid, [column, row]: [i64; 2], [columns, rows]: [i64; 2]) -> Rectangle {
    let size = [columns, rows].map(|n| n as f64 * grid.resolution);
    let low = [column, row].map(|n| n as f64 * grid.resolution);
    let origin =
        Rectangle { centre: [grid.x, grid.y], direction: [grid.cos, grid.sin], size: [0.0; 2] };
    let centre = origin.point([low[0] + size[0] / 2.0, low[1] + size[1] / 2.0]);
    Rectangle { centre, direction: origin.direction, size }
}

#[expect(clippy::cast_possible_truncation)] // `as` saturates, and NaN becomes 0
fn whole(number: f64) -> i64 {
    number as i64
}

/// Draws the tracks at some of the trajectory's times; tells whether there were any.
fn predictions(scene: &mut Scene, tracks: &TrackList, points: &[TrajectoryPoint]) -> bool {
    let moving = |item: &&Track| item.vx.hypot(item.vy) > 0.3;
    let mut any = false;
    for item in tracks.items.iter().filter(moving) {
        for index in spread(points.len(), PREDICTIONS) {
            let later = seconds(tracks.stamp_ns, points[index].t_ns);
            scene.rectangle(&track(item, later), "prediction");
            any = true;
        }
    }
    any
}

/// Draws the ids of the tracks, above everything else.
pub fn ids(scene: &mut Scene, cycle: &Cycle) {
    for item in cycle.tracks.iter().flat_map(|list| &list.items) {
        id(scene, item);
    }
}

/// The id of a track, where the window can show all of it.
fn id(scene: &mut Scene, item: &Track) {
    let frame = &scene.frame;
    let Some([x, y]) = frame.seen([item.x, item.y]) else { return };
    let room = frame.place[0] + 12.0..frame.place[0] + frame.size[0] - 12.0;
    if room.contains(&x) && y > frame.place[1] + 8.0 {
        scene.canvas.text(Some([x, y + 4.0]), "id", &item.id.to_string());
    }
}

fn trajectory(scene: &mut Scene, cycle: &Cycle, points: &[TrajectoryPoint]) {
    for index in spread(points.len(), FOOTPRINTS) {
        scene.rectangle(&footprint(cycle, &points[index]), "footprint");
    }
    let line: Vec<_> = points.iter().map(|point| [point.x, point.y]).collect();
    scene.line(&line, "trajectory");
    for at in line {
        scene.dot(at, 2.0, "point");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spread_keeps_the_last_and_stays_below_the_limit() {
        assert_eq!(spread(0, 3).count(), 0);
        assert_eq!(spread(3, 5).collect::<Vec<_>>(), [2, 1, 0]);
        assert_eq!(spread(10, 4).collect::<Vec<_>>(), [9, 6, 3, 0]);
    }
}
