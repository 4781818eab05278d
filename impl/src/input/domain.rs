//! The border: which input is refused, and as whose fault (`spec/3-stages.md#invalid-input`,
//! `spec/4-arithmetic.md#domain`). Behind it every number is finite and within its domain.

mod lists;
mod own;
mod screen;

use core::cmp::Ordering;

use crate::input::cycle::{
    Cycle, Detection, DetectionList, Grid, Lead, Route, Track, TrackList, TrajectoryPoint,
};
use crate::input::domain::screen::Screen;
use crate::input::route_index::RouteIndex;
use crate::numbers::exact::{Product, compare};
use crate::numbers::plane::same_point;
use crate::report::{InvalidInput, Problem};
use crate::services::configuration::Configuration;

use self::lists::{
    Seen, cross_sections_are_fine, detections_are_fine, points_are_fine, tracks_are_fine,
};
use self::own::{check_ego, check_parameters};

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
/// goes before the first remote one. A route that is indexed has been checked before.
pub(crate) fn validate(cycle: &Cycle<'_>, index: Option<&RouteIndex<'_>>) -> Result<Usable, Fault> {
    let remote_tracks =
        matches!(cycle.configuration, Configuration::MotRemote | Configuration::AllRemote);
    let remote_trajectory =
        matches!(cycle.configuration, Configuration::AllRemote | Configuration::PlanRemote);
    let previous_tracks = local(cycle, remote_tracks, index.is_some()).map_err(Fault::Local)?;
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

/// `later - earlier` in ns; saturates only far beyond every limit that it is compared with.
pub(crate) fn elapsed_ns(earlier_ns: i64, later_ns: i64) -> i64 {
    later_ns.saturating_sub(earlier_ns)
}

type Check = Result<(), InvalidInput>;

/// 60 s, beyond which a stamp is out of the domain.
const HORIZON_NS: i64 = 60_000_000_000;

const POSITION: [f64; 2] = [-16_777_216.0, 16_777_216.0];
const SPEED: [f64; 2] = [0.0, 150.0];
const VELOCITY: [f64; 2] = [-150.0, 150.0];
const SIZE: [f64; 2] = [0.01, 100.0];
const ANY: [f64; 2] = [f64::MIN, f64::MAX];

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
    at.number("lead.gap", lead.gap, [0.0, 1e6])?;
    at.number("lead.speed", lead.speed, SPEED)
}

/// The rules for a route.
pub(crate) fn check_route(route: &Route<'_>) -> Check {
    Place { index: None }.size("route.stations", route.cross_sections.len(), [2, 8192])?;
    if cross_sections_are_fine(route.cross_sections) {
        return Ok(());
    }
    let mut before: Option<[f64; 2]> = None;
    for (index, cross_section) in route.cross_sections.iter().enumerate() {
        let at = Place { index: Some(index) };
        at.number("route.stations.x", cross_section.x, POSITION)?;
        at.number("route.stations.y", cross_section.y, POSITION)?;
        for value in cross_section.left {
            at.number("route.stations.left", value, POSITION)?;
        }
        for value in cross_section.right {
            at.number("route.stations.right", value, POSITION)?;
        }
        if before.is_some_and(|before| same_point(before, [cross_section.x, cross_section.y])) {
            return at.problem("route.stations.x", Problem::EqualPoints);
        }
        before = Some([cross_section.x, cross_section.y]);
    }
    Ok(())
}

fn check_grid(grid: &Grid<'_>, now_ns: i64) -> Check {
    let at = Place { index: None };
    at.stamp("grid.stamp_ns", grid.stamp_ns, now_ns, false)?;
    at.number("grid.x", grid.x, POSITION)?;
    at.number("grid.y", grid.y, POSITION)?;
    at.number("grid.cos", grid.cos, ANY)?;
    at.number("grid.sin", grid.sin, ANY)?;
    at.direction("grid.cos", grid.cos, grid.sin)?;
    at.number("grid.resolution", grid.resolution, [0.01, 10.0])?;
    at.integer("grid.width", grid.width, [1, 1 << 15])?;
    at.integer("grid.height", grid.height, [1, 1 << 15])?;
    let cells = grid.width.saturating_mul(grid.height);
    at.integer("grid.height", cells, [1, 1 << 24])?;
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
        at.number("detections.items.x", x, POSITION)?;
        at.number("detections.items.y", y, POSITION)?;
        at.number("detections.items.cos", cos, ANY)?;
        at.number("detections.items.sin", sin, ANY)?;
        at.direction("detections.items.cos", cos, sin)?;
        at.number("detections.items.length", length, SIZE)?;
        at.number("detections.items.width", width, SIZE)?;
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
    at.number(fields.x, track.x, POSITION)?;
    at.number(fields.y, track.y, POSITION)?;
    at.number(fields.cos, track.cos, ANY)?;
    at.number(fields.sin, track.sin, ANY)?;
    at.direction(fields.cos, track.cos, track.sin)?;
    at.number(fields.vx, track.vx, VELOCITY)?;
    at.number(fields.vy, track.vy, VELOCITY)?;
    at.number(fields.length, track.length, SIZE)?;
    at.number(fields.width, track.width, SIZE)
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
        at.number("trajectory.points.x", x, POSITION)?;
        at.number("trajectory.points.y", y, POSITION)?;
        at.number("trajectory.points.cos", cos, ANY)?;
        at.number("trajectory.points.sin", sin, ANY)?;
        at.direction("trajectory.points.cos", cos, sin)?;
        if before.is_some_and(|before| before >= t_ns) {
            at.problem("trajectory.points.t_ns", Problem::TimeNotIncreasing)?;
        }
        before = Some(t_ns);
    }
    Ok(usable)
}

/// Where in a list a value stands.
#[derive(Clone, Copy)]
struct Place {
    index: Option<usize>,
}

impl Place {
    fn problem(self, field: &'static str, problem: Problem) -> Check {
        Err(InvalidInput { field, index: self.index, problem })
    }

    /// NaN is not finite; every other value is compared with both ends of its domain.
    fn number(self, field: &'static str, value: f64, [least, most]: [f64; 2]) -> Check {
        if !value.is_finite() {
            return self.problem(field, Problem::NotFinite);
        }
        if least <= value && value <= most {
            return Ok(());
        }
        self.problem(field, Problem::OutOfDomain)
    }

    fn integer(self, field: &'static str, value: i64, [least, most]: [i64; 2]) -> Check {
        if least <= value && value <= most {
            return Ok(());
        }
        self.problem(field, Problem::OutOfDomain)
    }

    fn size(self, field: &'static str, items: usize, [least, most]: [usize; 2]) -> Check {
        if items < least {
            return self.problem(field, Problem::TooFew);
        }
        if items > most {
            return self.problem(field, Problem::TooMany);
        }
        Ok(())
    }

    /// Whether the time is not older than 60 s; older remote times and later ones are refused.
    fn stamp(
        self,
        field: &'static str,
        stamp_ns: i64,
        now_ns: i64,
        remote: bool,
    ) -> Result<bool, InvalidInput> {
        let age_ns = elapsed_ns(stamp_ns, now_ns);
        if age_ns < -HORIZON_NS || (remote && age_ns > HORIZON_NS) {
            self.problem(field, Problem::TimeOutOfRange)?;
        }
        Ok(age_ns <= HORIZON_NS)
    }

    /// The norm check is exact: abs(cos^2 + sin^2 - 1) <= 1e-6 in real numbers.
    fn direction(self, field: &'static str, cos: f64, sin: f64) -> Check {
        let mut screen = Screen::default();
        screen.direction([cos, sin]);
        if screen.passes() {
            return Ok(());
        }
        let near = |value: f64| (-2.0..=2.0).contains(&value);
        let square = [Product([cos, 0.0], [cos, 0.0]), Product([sin, 0.0], [sin, 0.0])];
        let one = Product([1.0, 0.0], [1.0, 0.0]);
        let most = [one, Product([1e-6, 0.0], [1.0, 0.0])];
        let least = [one, Product([-1e-6, 0.0], [1.0, 0.0])];
        let within = near(cos)
            && near(sin)
            && compare(&square, &most) != Ordering::Greater
            && compare(&square, &least) != Ordering::Less;
        if within { Ok(()) } else { self.problem(field, Problem::NotADirection) }
    }
}
