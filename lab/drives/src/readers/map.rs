//! Drives from maps alone: control points of a reference path with the distances of its bounds.
//!
//! Rows are x, y (m), distance of the left and of the right bound (m), speed limit (m/s) and
//! altitude (not used), the form of the planner of the publication's authors. A map holds no
//! traffic, so the drive is made up: it follows the reference path at the speed limit, slower in
//! curves, on an empty road. It shows what stages ii and v say of the map.

use std::path::Path;

use mufasa_model::input::cycle::{CrossSection, Cycle, Route};

use crate::drive::{DriveCycle, Stream};
use crate::geometry::{Point, Polyline, add, distance, mix, mix_angle, norm, scale, sub, wrap};
use crate::options::{Options, Sensor};
use crate::readers::error::ReadError;
use crate::readers::npy;
use crate::recording::object::State;
use crate::recording::{self, Recording};

/// The columns of a map.
const COLUMNS: [&str; 6] = [
    "x (m)",
    "y (m)",
    "distance of the left bound (m)",
    "distance of the right bound (m)",
    "speed limit (m/s)",
    "altitude (m, not used)",
];
/// Length and width of the test vehicle in the scenarios that come with the maps, m.
const SIZE: [f64; 2] = [5.1, 1.89];
/// Control points nearer than this to the last cross section are passed over, m. Maps have one every
/// half metre, which changes the corridor by centimetres and costs the exact model a minute.
const SPACING: f64 = 2.0;
/// Cross sections of a route (`spec/4-arithmetic.md#domain`), m.
const STATIONS_MAX: usize = 8192;
/// A route whose ends are nearer than this, and go on in each other's direction within `TURN`
/// (rad), is closed; the maps of round courses leave up to a few car lengths between their ends.
const CLOSING: f64 = 15.0;
const TURN: f64 = 0.5;
/// Comfortable accelerations along and across, m/s^2.
const COMFORT: [f64; 2] = [1.5, 2.0];
/// Slowest and fastest speed of a made-up drive, m/s; some maps have a kink or no limit.
const SPEEDS: [f64; 2] = [2.0, 60.0];
/// Speed where the map says none (0), m/s: 50 km/h.
const UNLIMITED: f64 = 50.0 / 3.6;
/// Time step, ns and s; steps of a drive, and cycles made of it, at most.
const DT_NS: i64 = 100_000_000;
const DT_S: f64 = 0.1;
const STEPS_MAX: usize = 100_000;
const CYCLES_MAX: usize = 40;
/// An open route is cut for every cycle to this way behind and ahead of the CAV, m.
const WINDOW: [f64; 2] = [50.0, 250.0];
/// Where a drive begins on an open path, m: not on the very edge of the corridor.
const BEGIN: f64 = 1.0;

/// The drive along a map.
pub(crate) fn drive(file: &Path, bytes: &[u8], options: &Options) -> Result<Stream, ReadError> {
    let mut notes = Vec::new();
    let rows = npy::table(file, bytes, COLUMNS)?;
    checked(file, rows.clone())?;
    let (points, closed) = cross_sections(file, &rows.map(Control::new), &mut notes)?;
    let path = ReferencePath::new(&points, closed);
    let ego = path.states(&mut notes);
    let every = ego.len().div_ceil(CYCLES_MAX).max(1);
    notes.push(format!(
        "a made-up drive along the reference path on an empty road, a cycle every {:.1} s",
        f64::from(u32::try_from(every).unwrap_or(u32::MAX)) * DT_S
    ));
    let name = file.file_name().map_or_else(String::new, |n| n.to_string_lossy().into_owned());
    let recording = Recording {
        name: [".gz", ".npy", ".control_points"]
            .iter()
            .fold(&*name, |name, end| name.strip_suffix(end).unwrap_or(name))
            .to_owned(),
        source: file.display().to_string(),
        dt_ns: DT_NS,
        ego,
        size: SIZE,
        objects: Vec::new(),
        route: path.route(),
        notes,
    };
    // Clutter would be all there is to see.
    let sensor = Sensor { clutter: 0.0, ..options.sensor.clone() };
    let mut drive = recording::drive(recording, &Options { sensor, ..options.clone() }, every);
    if drive.count() == 0 {
        return Err(ReadError::no_cycle(file));
    }
    let count = drive.count();
    if !closed {
        let [behind, ahead] = WINDOW;
        drive.notes.push(format!(
            "the route of each cycle is the part from {behind} m behind to {ahead} m ahead"
        ));
        let Stream { name, source, lead_range_m, notes, .. } = drive.clone();
        let make = move |index| {
            let DriveCycle { id, mut cycle } = drive.cycle(index)?;
            window(&mut cycle);
            Ok(DriveCycle { id, cycle })
        };
        let mut cut = Stream::fallible(name, source, count, make);
        (cut.lead_range_m, cut.notes) = (lead_range_m, notes);
        return Ok(cut);
    }
    Ok(drive)
}

/// Cuts the route of a cycle to the neighbourhood of the CAV.
fn window(cycle: &mut Cycle) {
    let cross_sections = &mut cycle.route.cross_sections;
    let path = Polyline::new(cross_sections.iter().map(|s| [s.x, s.y]).collect());
    let Some(here) = path.project([cycle.ego.x, cycle.ego.y]) else { return };
    let (first, _) = path.locate(here.s - WINDOW[0]);
    let (last, _) = path.locate(here.s + WINDOW[1]);
    cross_sections.truncate(last + 2);
    cross_sections.drain(..first);
}

/// A control point.
#[derive(Clone, Copy)]
struct Control {
    at: Point,
    left: f64,
    right: f64,
    limit: f64,
}

impl Control {
    fn new([x, y, left, right, limit, _]: [f64; 6]) -> Self {
        Self { at: [x, y], left, right, limit }
    }
}

fn checked(file: &Path, rows: impl Iterator<Item = [f64; 6]>) -> Result<(), ReadError> {
    const NAMES: [(&str, f64); 5] = [
        ("x", 16_777_216.0),
        ("y", 16_777_216.0),
        ("d_left", 100.0),
        ("d_right", 100.0),
        ("speed_limit", 1000.0),
    ];
    for (i, row) in rows.enumerate() {
        for ((name, limit), value) in NAMES.iter().zip(&row) {
            if value.is_nan() || value.abs() > *limit {
                let error = ReadError::file(file, format!("{value} is not within +-{limit}"));
                return Err(error.at("control point", *name).index(i));
            }
        }
    }
    Ok(())
}

/// The control points that become cross sections, and whether they close.
fn cross_sections(
    file: &Path,
    rows: &(impl ExactSizeIterator<Item = Control> + Clone),
    notes: &mut Vec<String>,
) -> Result<(Vec<Control>, bool), ReadError> {
    let thin = |spacing: f64| {
        let mut kept: Vec<Control> = Vec::new();
        for (i, row) in rows.clone().enumerate() {
            let far = kept.last().map_or(f64::INFINITY, |last| distance(last.at, row.at));
            // The last point stays, unless it is the one before it once more.
            if far >= spacing || (i + 1 == rows.len() && far > 0.0) {
                kept.push(row);
            }
        }
        kept
    };
    let mut spacing = SPACING;
    let mut kept = thin(spacing);
    while kept.len() > STATIONS_MAX {
        spacing *= 2.0;
        kept = thin(spacing);
    }
    if kept.len() < 2 {
        let message = "two different control points are needed";
        return Err(ReadError::file(file, message).at("control point", "x"));
    }
    notes.push(format!(
        "{} of {} control points, at least {spacing} m apart, are stations",
        kept.len(),
        rows.len()
    ));
    let (first, last) = (kept[0].at, kept[kept.len() - 1].at);
    let gap = distance(first, last);
    let angle = |u: Point| u[1].atan2(u[0]);
    let [out, inn] = [sub(last, kept[kept.len() - 2].at), sub(kept[1].at, first)].map(angle);
    let ahead = if gap > 0.0 { angle(sub(first, last)) } else { out };
    let closed = kept.len() > 10
        && gap <= CLOSING
        && wrap(ahead - out).abs() < TURN
        && wrap(inn - ahead).abs() < TURN;
    if closed {
        notes.push(format!("closed over {gap:.1} m between its ends"));
        if gap == 0.0 {
            kept.pop();
        }
    }
    let negative = kept.iter().filter(|c| c.left < 0.0 || c.right < 0.0).count();
    if negative > 0 {
        notes.push(format!("{negative} stations have a bound on the other side of the path"));
    }
    let unlimited = kept.iter().filter(|c| c.limit <= 0.0).count();
    if unlimited > 0 {
        notes.push(format!("{unlimited} stations have no speed limit; 50 km/h is taken"));
    }
    Ok((kept, closed))
}

/// A reference path with its directions.
struct ReferencePath<'a> {
    points: &'a [Control],
    headings: Vec<f64>,
    closed: bool,
}

impl<'a> ReferencePath<'a> {
    fn new(points: &'a [Control], closed: bool) -> Self {
        let n = points.len();
        let heading = |i: usize| {
            let before = if i > 0 {
                i - 1
            } else if closed {
                n - 1
            } else {
                0
            };
            let after = if i + 1 < n {
                i + 1
            } else if closed {
                0
            } else {
                n - 1
            };
            let around = sub(points[after].at, points[before].at);
            // At the tip of a needle the mean direction is none; the way on is.
            let way =
                if norm(around) > 1e-9 { around } else { sub(points[after].at, points[i].at) };
            way[1].atan2(way[0])
        };
        let headings = (0..n).map(heading).collect();
        Self { points, headings, closed }
    }

    fn route(&self) -> Route {
        let cross_section = |(c, heading): (&Control, &f64)| {
            let normal = [-heading.sin(), heading.cos()];
            let [x, y] = c.at;
            let left = add(c.at, scale(normal, c.left));
            let right = add(c.at, scale(normal, -c.right));
            CrossSection { x, y, left, right }
        };
        let cross_sections = self.points.iter().zip(&self.headings).map(cross_section).collect();
        Route { closed: self.closed, cross_sections }
    }

    /// States along the path, once round a closed one and on to where it began.
    fn states(&self, notes: &mut Vec<String>) -> Vec<State> {
        // Once more round gives the last cycles a plan across the seam.
        let rounds = if self.closed { 2 } else { 1 };
        let order: Vec<usize> = (0..rounds).flat_map(|_| 0..self.points.len()).collect();
        let line = Polyline::new(order.iter().map(|i| self.points[*i].at).collect());
        let speeds = self.speeds(&order, &line);
        let once = line.arc.get(self.points.len()).copied().filter(|_| self.closed);
        let end = once.map_or(line.length(), |s| (s + 100.0).min(line.length()));
        let mut states = Vec::new();
        let mut s = if self.closed { 0.0 } else { BEGIN.min(line.length() / 2.0) };
        while s < end && states.len() < STEPS_MAX {
            let (i, w) = line.locate(s);
            let heading = mix_angle(self.headings[order[i]], self.headings[order[i + 1]], w);
            let speed = speeds[i] + w * (speeds[i + 1] - speeds[i]);
            let position = mix(line.points[i], line.points[i + 1], w);
            let step = i64::try_from(states.len()).unwrap_or(i64::MAX);
            states.push(State { step, position, heading, speed, slip: 0.0 });
            s += speed * DT_S;
        }
        if s < end {
            notes.push(format!("the drive ends after {STEPS_MAX} steps, {:.0} m early", end - s));
        }
        states
    }

    /// Speeds at the points in their order: the limit, less in curves and near slower places.
    fn speeds(&self, order: &[usize], line: &Polyline) -> Vec<f64> {
        let mut speeds: Vec<f64> = Vec::with_capacity(order.len());
        for (k, i) in order.iter().enumerate() {
            let limit = self.points[*i].limit;
            let limit = if limit > 0.0 { limit } else { UNLIMITED };
            let around = [k.saturating_sub(1), (k + 1).min(order.len() - 1)];
            let turn =
                wrap(self.headings[order[around[1]]] - self.headings[order[around[0]]]).abs();
            let length = line.arc[around[1]] - line.arc[around[0]];
            let curve = if turn > 0.0 { (COMFORT[1] * length / turn).sqrt() } else { limit };
            speeds.push(limit.min(curve).clamp(SPEEDS[0], SPEEDS[1]));
        }
        let reach = |from: f64, k: usize| {
            let length = line.arc[k + 1] - line.arc[k];
            (from * from + 2.0 * COMFORT[0] * length).sqrt()
        };
        for k in 0..speeds.len() - 1 {
            speeds[k + 1] = speeds[k + 1].min(reach(speeds[k], k));
        }
        for k in (0..speeds.len() - 1).rev() {
            speeds[k] = speeds[k].min(reach(speeds[k + 1], k));
        }
        speeds
    }
}
