//! The border: which input is refused, and as whose fault (`spec/3-stages.md#invalid-input`,
//! `spec/4-arithmetic.md#domain`). Behind it every number is finite and within its domain.

mod lists;
mod own;
mod place;
pub(crate) mod route;

use crate::input::cycle::{
    Cycle, Detection, DetectionList, Grid, Lead, Track, TrackList, TrajectoryPoint,
};
use crate::input::domain::lists::{Seen, detections_are_fine, points_are_fine, tracks_are_fine};
use crate::input::domain::own::{check_ego, check_parameters};
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

/// Which lists are young enough to be used at all; an older one counts as missing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Usable {
    pub(crate) trajectory: bool,
    pub(crate) previous_tracks: bool,
}

/// Checks everything in the order of `spec/3-stages.md#invalid-input`; the first local problem
/// goes before the first remote one. `route_is_valid`: the route has been checked before.
pub(crate) fn validate(cycle: &Cycle<'_>, route_is_valid: bool) -> Result<Usable, Fault> {
    let [remote_tracks, remote_trajectory] =
        Group::ALL.map(|group| cycle.configuration.is_remote(group));
    let previous_tracks = local(cycle, remote_tracks, route_is_valid).map_err(Fault::Local)?;
    let mut trajectory = true;
    if !remote_trajectory {
        trajectory = check_trajectory(cycle, false).map_err(Fault::Local)?;
    }
    if remote_tracks {
        check_tracks(cycle.tracks.as_ref(), TRACKS, cycle.now_ns, true).map_err(Fault::Remote)?;
    }
    if remote_trajectory {
        trajectory = check_trajectory(cycle, true).map_err(Fault::Remote)?;
    }
    Ok(Usable { trajectory, previous_tracks })
}

/// All local input but the trajectory; whether `previous_tracks` can be used.
fn local(
    cycle: &Cycle<'_>,
    remote_tracks: bool,
    route_is_valid: bool,
) -> Result<bool, InvalidInput> {
    check_parameters(&cycle.parameters)?;
    check_ego(&cycle.ego)?;
    if let Some(lead) = &cycle.lead {
        check_lead(lead, cycle.now_ns)?;
    }
    if !route_is_valid {
        check_route(&cycle.route)?;
    }
    if let Some(grid) = &cycle.grid {
        check_grid(grid, cycle.now_ns)?;
    }
    if let Some(list) = &cycle.detections {
        check_detections(list, cycle.now_ns)?;
    }
    let previous_tracks =
        check_tracks(cycle.previous_tracks.as_ref(), PREVIOUS, cycle.now_ns, false)?;
    if !remote_tracks {
        check_tracks(cycle.tracks.as_ref(), TRACKS, cycle.now_ns, false)?;
    }
    Ok(previous_tracks)
}

fn check_lead(lead: &Lead, now_ns: i64) -> Check {
    let at = Place { index: None };
    at.stamp("lead.stamp_ns", lead.stamp_ns, now_ns, false)?;
    at.f64("lead.gap", lead.gap, [0.0, 1e6])?;
    at.f64("lead.speed", lead.speed, SPEED)
}

fn check_grid(grid: &Grid<'_>, now_ns: i64) -> Check {
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

fn check_detections(list: &DetectionList<'_>, now_ns: i64) -> Check {
    let at = Place { index: None };
    at.stamp("detections.stamp_ns", list.stamp_ns, now_ns, false)?;
    at.size("detections.items", list.items.len(), [0, 2048])?;
    if detections_are_fine(list.items) {
        return Ok(());
    }
    for (index, item) in list.items.iter().enumerate() {
        let &Detection { x, y, cos, sin, length, width } = item;
        let at = Place { index: Some(index) };
        at.f64("detections.items.x", x, POSITION)?;
        at.f64("detections.items.y", y, POSITION)?;
        at.f64("detections.items.cos", cos, ANY)?;
        at.f64("detections.items.sin", sin, ANY)?;
        at.direction("detections.items.cos", cos, sin)?;
        at.f64("detections.items.length", length, SIZE)?;
        at.f64("detections.items.width", width, SIZE)?;
    }
    Ok(())
}

/// The dotted paths of a track list.
struct TrackFields {
    stamp_ns: &'static str,
    items: &'static str,
    id: &'static str,
    x: &'static str,
    y: &'static str,
    cos: &'static str,
    sin: &'static str,
    vx: &'static str,
    vy: &'static str,
    length: &'static str,
    width: &'static str,
}

const TRACKS: &TrackFields = &TrackFields {
    stamp_ns: "tracks.stamp_ns",
    items: "tracks.items",
    id: "tracks.items.id",
    x: "tracks.items.x",
    y: "tracks.items.y",
    cos: "tracks.items.cos",
    sin: "tracks.items.sin",
    vx: "tracks.items.vx",
    vy: "tracks.items.vy",
    length: "tracks.items.length",
    width: "tracks.items.width",
};

const PREVIOUS: &TrackFields = &TrackFields {
    stamp_ns: "previous_tracks.stamp_ns",
    items: "previous_tracks.items",
    id: "previous_tracks.items.id",
    x: "previous_tracks.items.x",
    y: "previous_tracks.items.y",
    cos: "previous_tracks.items.cos",
    sin: "previous_tracks.items.sin",
    vx: "previous_tracks.items.vx",
    vy: "previous_tracks.items.vy",
    length: "previous_tracks.items.length",
    width: "previous_tracks.items.width",
};

/// Whether the list is within 60 s of now; an error for a value that breaks the rules.
fn check_tracks(
    list: Option<&TrackList<'_>>,
    fields: &TrackFields,
    now_ns: i64,
    remote: bool,
) -> Result<bool, InvalidInput> {
    let Some(list) = list else { return Ok(false) };
    let at = Place { index: None };
    let usable = at.stamp(fields.stamp_ns, list.stamp_ns, now_ns, remote)?;
    at.size(fields.items, list.items.len(), [0, 1024])?;
    if tracks_are_fine(list.items) {
        return Ok(usable);
    }
    let mut seen = Seen::default();
    for (index, track) in list.items.iter().enumerate() {
        check_track(track, Place { index: Some(index) }, fields)?;
        let mut earlier = list.items.iter().take(index);
        if seen.perhaps(track.id) && earlier.any(|earlier| earlier.id == track.id) {
            Place { index: Some(index) }.problem(fields.id, Problem::DuplicateId)?;
        }
    }
    Ok(usable)
}

fn check_track(track: &Track, at: Place, fields: &TrackFields) -> Check {
    at.f64(fields.x, track.x, POSITION)?;
    at.f64(fields.y, track.y, POSITION)?;
    at.f64(fields.cos, track.cos, ANY)?;
    at.f64(fields.sin, track.sin, ANY)?;
    at.direction(fields.cos, track.cos, track.sin)?;
    at.f64(fields.vx, track.vx, VELOCITY)?;
    at.f64(fields.vy, track.vy, VELOCITY)?;
    at.f64(fields.length, track.length, SIZE)?;
    at.f64(fields.width, track.width, SIZE)
}

/// Whether the stamp is not more than 60 s before now, or there is no trajectory. The points of a
/// local trajectory that old may be as old.
fn check_trajectory(cycle: &Cycle<'_>, remote: bool) -> Result<bool, InvalidInput> {
    let Some(trajectory) = &cycle.trajectory else { return Ok(true) };
    let at = Place { index: None };
    let usable = at.stamp("trajectory.stamp_ns", trajectory.stamp_ns, cycle.now_ns, remote)?;
    at.size("trajectory.points", trajectory.points.len(), [1, 1024])?;
    if usable && points_are_fine(trajectory, cycle.now_ns) {
        return Ok(usable);
    }
    let mut before: Option<i64> = None;
    for (index, point) in trajectory.points.iter().enumerate() {
        let &TrajectoryPoint { t_ns, x, y, cos, sin } = point;
        let at = Place { index: Some(index) };
        at.stamp("trajectory.points.t_ns", t_ns, cycle.now_ns, usable)?;
        at.f64("trajectory.points.x", x, POSITION)?;
        at.f64("trajectory.points.y", y, POSITION)?;
        at.f64("trajectory.points.cos", cos, ANY)?;
        at.f64("trajectory.points.sin", sin, ANY)?;
        at.direction("trajectory.points.cos", cos, sin)?;
        if before.is_some_and(|before| before >= t_ns) {
            at.problem("trajectory.points.t_ns", Problem::TimeNotIncreasing)?;
        }
        before = Some(t_ns);
    }
    Ok(usable)
}
