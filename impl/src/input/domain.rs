//! The border: which input is refused, and as whose fault (`spec/3-stages.md#invalid-input`,
//! `spec/4-arithmetic.md#domain`). Behind it every number is finite and within its domain.

mod lists;
mod own;
mod place;
pub(crate) mod route;

use crate::input::cycle::{
    Cycle, Detection, DetectionList, Grid, Lead, Track, TrackList, Trajectory, TrajectoryPoint,
};
use crate::input::domain::lists::{Seen, detections_are_fine, points_are_fine, tracks_are_fine};
use crate::input::domain::own::check_ego;
pub(crate) use crate::input::domain::own::check_parameters;
use crate::input::domain::place::{ANY, Check, POSITION, Place, SIZE, SPEED, VELOCITY};
use crate::input::domain::route::check_route;
use crate::report::{InvalidInput, Problem};
use crate::services::configuration::Group;

/// Whose data are invalid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Fault {
    /// Local input or parameters: an error to the caller.
    Local(InvalidInput),
    /// Remote data: the cycle is unsafe.
    Remote(InvalidInput),
}

/// Whether the trajectory is young enough to be used at all; an older one counts as missing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Usable {
    pub(crate) trajectory: bool,
}

/// What has been checked before.
pub(crate) struct CheckedBefore<'f> {
    pub(crate) route: bool,
    /// Whether these detections have been.
    pub(crate) detections: &'f dyn Fn(&[Detection]) -> bool,
}

/// Checks everything in the order of `spec/3-stages.md#invalid-input`; the first local problem
/// goes before the first remote one.
pub(crate) fn validate(cycle: &Cycle<'_>, before: &CheckedBefore<'_>) -> Result<Usable, Fault> {
    let [remote_tracks, remote_trajectory] =
        Group::ALL.map(|group| cycle.configuration.is_remote(group));
    // INPUT-02, INPUT-03, INPUT-05
    local(cycle, remote_tracks, before).map_err(Fault::Local)?;
    let mut trajectory = true;
    if !remote_trajectory {
        trajectory = check_trajectory(cycle.trajectory.as_ref(), cycle.now_ns, false)
            .map_err(Fault::Local)?;
    }
    if remote_tracks {
        // INPUT-06
        check_tracks(cycle.tracks.as_ref(), cycle.now_ns, true).map_err(Fault::Remote)?;
    }
    if remote_trajectory {
        trajectory = check_trajectory(cycle.trajectory.as_ref(), cycle.now_ns, true)
            .map_err(Fault::Remote)?;
    }
    Ok(Usable { trajectory })
}

/// All local input but the trajectory.
fn local(cycle: &Cycle<'_>, remote_tracks: bool, before: &CheckedBefore<'_>) -> Check {
    // INPUT-02
    check_parameters(&cycle.parameters)?;
    check_ego(&cycle.ego)?;
    if let Some(lead) = &cycle.lead {
        check_lead(lead, cycle.now_ns)?;
    }
    if !before.route {
        check_route(&cycle.route)?;
    }
    if let Some(grid) = &cycle.grid {
        check_grid(grid, cycle.now_ns)?;
    }
    if let Some(list) = &cycle.detections {
        check_detections(list, cycle.now_ns, before)?;
    }
    check_detection_history(cycle.detection_history, cycle.now_ns, before)?;
    if !remote_tracks {
        check_tracks(cycle.tracks.as_ref(), cycle.now_ns, false)?;
    }
    Ok(())
}

pub(crate) fn check_lead(lead: &Lead, now_ns: i64) -> Check {
    let at = Place { index: None };
    at.stamp("lead.stamp_ns", lead.stamp_ns, now_ns, false)?;
    at.f64("lead.gap", lead.gap, [0.0, 1e6])?;
    // DIST-02
    at.f64("lead.speed", lead.speed, SPEED)
}

pub(crate) fn check_grid(grid: &Grid<'_>, now_ns: i64) -> Check {
    let at = Place { index: None };
    at.stamp("grid.stamp_ns", grid.stamp_ns, now_ns, false)?;
    at.f64("grid.x", grid.x, POSITION)?;
    at.f64("grid.y", grid.y, POSITION)?;
    at.f64("grid.cos", grid.cos, ANY)?;
    at.f64("grid.sin", grid.sin, ANY)?;
    at.direction("grid.cos", grid.cos, grid.sin)?;
    at.f64("grid.resolution", grid.resolution, [0.01, 10.0])?;
    at.i64("grid.width", grid.width, [1, 1 << 15])?;
    at.i64("grid.height", grid.height, [1, 1 << 15])?;
    let cells = grid.width.saturating_mul(grid.height);
    at.i64("grid.height", cells, [1, 1 << 24])?;
    let bytes = usize::try_from(cells.saturating_add(7) >> 3).ok();
    if Some(grid.occupied.len()) != bytes {
        return at.problem("grid.occupied", Problem::BitmapLength);
    }
    if grid.unknown.is_some_and(|unknown| Some(unknown.len()) != bytes) {
        return at.problem("grid.unknown", Problem::BitmapLength);
    }
    Ok(())
}

pub(crate) fn check_detections(
    list: &DetectionList<'_>,
    now_ns: i64,
    before: &CheckedBefore<'_>,
) -> Check {
    let at = Place { index: None };
    at.stamp("detections.stamp_ns", list.stamp_ns, now_ns, false)?;
    if (before.detections)(list.items) {
        return Ok(());
    }
    check_items(list.items, at, &DETECTIONS)
}

/// Size and items of a list that is to be indexed.
pub(crate) fn check_detection_items(items: &[Detection]) -> Check {
    check_items(items, Place { index: None }, &DETECTIONS)
}

fn check_detection_history(
    history: &[DetectionList<'_>],
    now_ns: i64,
    before: &CheckedBefore<'_>,
) -> Check {
    Place { index: None }.size("detection_history", history.len(), [0, 4])?;
    let mut younger: Option<i64> = None;
    for (index, list) in history.iter().enumerate() {
        let at = Place { index: Some(index) };
        at.stamp("detection_history.stamp_ns", list.stamp_ns, now_ns, false)?;
        // INPUT-04
        if younger.is_some_and(|younger| younger <= list.stamp_ns) {
            at.problem("detection_history.stamp_ns", Problem::StampNotDecreasing)?;
        }
        younger = Some(list.stamp_ns);
        if !(before.detections)(list.items) {
            check_items(list.items, at, &HISTORY)?;
        }
    }
    Ok(())
}

/// The dotted paths of a list of detections: itself, and x, y, cos, sin, length and width of its
/// items.
struct Paths {
    items: &'static str,
    numbers: [&'static str; 6],
}

const DETECTIONS: Paths = Paths {
    items: "detections.items",
    numbers: [
        "detections.items.x",
        "detections.items.y",
        "detections.items.cos",
        "detections.items.sin",
        "detections.items.length",
        "detections.items.width",
    ],
};

const HISTORY: Paths = Paths {
    items: "detection_history.items",
    numbers: [
        "detection_history.items.x",
        "detection_history.items.y",
        "detection_history.items.cos",
        "detection_history.items.sin",
        "detection_history.items.length",
        "detection_history.items.width",
    ],
};

fn check_items(items: &[Detection], at: Place, paths: &Paths) -> Check {
    at.size(paths.items, items.len(), [0, 2048])?;
    if detections_are_fine(items) {
        return Ok(());
    }
    let [path_x, path_y, path_cos, path_sin, path_length, path_width] = paths.numbers;
    for (index, item) in items.iter().enumerate() {
        let &Detection { x, y, cos, sin, length, width } = item;
        let at = Place { index: Some(index) };
        at.f64(path_x, x, POSITION)?;
        at.f64(path_y, y, POSITION)?;
        at.f64(path_cos, cos, ANY)?;
        at.f64(path_sin, sin, ANY)?;
        at.direction(path_cos, cos, sin)?;
        at.f64(path_length, length, SIZE)?;
        at.f64(path_width, width, SIZE)?;
    }
    Ok(())
}

pub(crate) fn check_tracks(list: Option<&TrackList<'_>>, now_ns: i64, remote: bool) -> Check {
    let Some(list) = list else { return Ok(()) };
    let at = Place { index: None };
    at.stamp("tracks.stamp_ns", list.stamp_ns, now_ns, remote)?;
    at.size("tracks.items", list.items.len(), [0, 1024])?;
    if tracks_are_fine(list.items) {
        return Ok(());
    }
    let mut seen = Seen::default();
    for (index, track) in list.items.iter().enumerate() {
        check_track(track, Place { index: Some(index) })?;
        let mut earlier = list.items.iter().take(index);
        // INPUT-04
        if seen.perhaps(track.id) && earlier.any(|earlier| earlier.id == track.id) {
            Place { index: Some(index) }.problem("tracks.items.id", Problem::DuplicateId)?;
        }
    }
    Ok(())
}

fn check_track(track: &Track, at: Place) -> Check {
    at.f64("tracks.items.x", track.x, POSITION)?;
    at.f64("tracks.items.y", track.y, POSITION)?;
    at.f64("tracks.items.cos", track.cos, ANY)?;
    at.f64("tracks.items.sin", track.sin, ANY)?;
    at.direction("tracks.items.cos", track.cos, track.sin)?;
    at.f64("tracks.items.vx", track.vx, VELOCITY)?;
    at.f64("tracks.items.vy", track.vy, VELOCITY)?;
    at.f64("tracks.items.length", track.length, SIZE)?;
    at.f64("tracks.items.width", track.width, SIZE)
}

/// Whether the stamp is not more than 60 s before now, or there is no trajectory. The points of a
/// local trajectory that old may be as old.
pub(crate) fn check_trajectory(
    trajectory: Option<&Trajectory<'_>>,
    now_ns: i64,
    remote: bool,
) -> Result<bool, InvalidInput> {
    let Some(trajectory) = trajectory else { return Ok(true) };
    let at = Place { index: None };
    let usable = at.stamp("trajectory.stamp_ns", trajectory.stamp_ns, now_ns, remote)?;
    at.size("trajectory.points", trajectory.points.len(), [1, 1024])?;
    if usable && points_are_fine(trajectory, now_ns) {
        return Ok(usable);
    }
    let mut before: Option<i64> = None;
    for (index, point) in trajectory.points.iter().enumerate() {
        let &TrajectoryPoint { t_ns, x, y, cos, sin } = point;
        let at = Place { index: Some(index) };
        at.stamp("trajectory.points.t_ns", t_ns, now_ns, usable)?;
        at.f64("trajectory.points.x", x, POSITION)?;
        at.f64("trajectory.points.y", y, POSITION)?;
        at.f64("trajectory.points.cos", cos, ANY)?;
        at.f64("trajectory.points.sin", sin, ANY)?;
        at.direction("trajectory.points.cos", cos, sin)?;
        // INPUT-04
        if before.is_some_and(|before| before >= t_ns) {
            at.problem("trajectory.points.t_ns", Problem::TimeNotIncreasing)?;
        }
        before = Some(t_ns);
    }
    Ok(usable)
}
