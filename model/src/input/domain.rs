//! Which values a cycle may hold, and the first that it may not
//! (`spec/3-stages.md#invalid-input`, `spec/4-arithmetic.md#domain`).

use std::collections::HashSet;
use std::fmt::Debug;
use std::ops::RangeInclusive;

use crate::input::cycle::{
    CrossSection, Cycle, DetectionList, Ego, Grid, Lead, Route, TrackList, Trajectory,
};
use crate::input::parameters::Parameters;
use crate::report::InvalidInput;
use crate::services::configuration::Configuration;

/// The first problem of a cycle.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Problem {
    /// In local input or parameters: an error to the caller.
    Local(InvalidInput),
    /// In remote data: the cycle is unsafe.
    Remote(InvalidInput),
}

/// m: UTM coordinates fit.
const POSITION: RangeInclusive<f64> = -16_777_216.0..=16_777_216.0;
const SPEED: RangeInclusive<f64> = 0.0..=150.0;
const VELOCITY: RangeInclusive<f64> = -150.0..=150.0;
const SIZE: RangeInclusive<f64> = 0.01..=100.0;
const CENTER_OFFSET: RangeInclusive<f64> = -100.0..=100.0;
const GAP: RangeInclusive<f64> = 0.0..=1e6;
const RESOLUTION: RangeInclusive<f64> = 0.01..=10.0;
const CELLS_A_SIDE: RangeInclusive<i64> = 1..=1 << 15;
const CELLS: i64 = 1 << 24;
/// ns
const NEAR_NOW: i128 = 60_000_000_000;
const TRACKS: usize = 1024;
const DETECTIONS: usize = 2048;
/// Lists of the history.
const HISTORY: usize = 4;
const POINTS: usize = 1024;
const CROSS_SECTIONS: usize = 8192;

/// The first local problem; without one the first in remote data.
pub fn first_problem(cycle: &Cycle) -> Option<Problem> {
    let now = cycle.now_ns;
    let (tracks_are_remote, trajectory_is_remote) = match cycle.configuration {
        Configuration::Local => (false, false),
        Configuration::MotRemote => (true, false),
        Configuration::AllRemote => (true, true),
        Configuration::PlanRemote => (false, true),
    };
    let tracks = || check_tracks(cycle.tracks.as_ref(), now, tracks_are_remote);
    let trajectory = || check_trajectory(cycle.trajectory.as_ref(), now, trajectory_is_remote);
    let local = || {
        check_parameters(&cycle.parameters)?;
        check_ego(&cycle.ego)?;
        check_lead(cycle.lead.as_ref(), now)?;
        check_route(&cycle.route)?;
        check_grid(cycle.grid.as_ref(), now)?;
        check_detections(cycle.detections.as_ref(), now)?;
        check_detection_history(&cycle.detection_history, now)?;
        if !tracks_are_remote {
            tracks()?;
        }
        if !trajectory_is_remote {
            trajectory()?;
        }
        Ok(())
    };
    let remote = || {
        if tracks_are_remote {
            tracks()?;
        }
        if trajectory_is_remote {
            trajectory()?;
        }
        Ok(())
    };
    local().err().map(Problem::Local).or_else(|| remote().err().map(Problem::Remote))
}

/// The numbers of a record.
trait Number: Copy + PartialOrd + Debug {
    const NAME: &str;
}

impl Number for f64 {
    const NAME: &str = "a number";
}

impl Number for i64 {
    const NAME: &str = "an integer";
}

/// Where a value stands: dotted path and innermost index.
#[derive(Clone, Copy)]
struct At<'a> {
    list: &'a str,
    index: Option<usize>,
}

fn at(list: &str, index: Option<usize>) -> At<'_> {
    At { list, index }
}

impl At<'_> {
    fn problem(self, name: &str, message: String) -> InvalidInput {
        let field =
            if name.is_empty() { self.list.into() } else { format!("{}.{name}", self.list) };
        InvalidInput { field, index: self.index, message }
    }

    fn number<N: Number>(
        self,
        name: &str,
        value: N,
        domain: &RangeInclusive<N>,
    ) -> Result<(), InvalidInput> {
        // NaN is in no range.
        if domain.contains(&value) {
            return Ok(());
        }
        let (least, most) = (domain.start(), domain.end());
        let message = format!("{value:?} is not {} from {least:?} to {most:?}", N::NAME);
        Err(self.problem(name, message))
    }

    fn position(self, x: f64, y: f64) -> Result<(), InvalidInput> {
        self.number("x", x, &POSITION)?;
        self.number("y", y, &POSITION)
    }

    /// abs(cos^2 + sin^2 - 1) <= 1e-6, decided exactly.
    fn direction(self, cos: f64, sin: f64) -> Result<(), InvalidInput> {
        use crate::numbers::real::Real;
        // The domain is one of the pair: a single number can only fail to be finite.
        let finite = f64::MIN..=f64::MAX;
        self.number("cos", cos, &finite)?;
        self.number("sin", sin, &finite)?;
        let norm = Real::from_double(cos).square() + Real::from_double(sin).square();
        let (one, tolerance) = (Real::from_integer(1), Real::from_double(1e-6));
        if (&one - &tolerance..=&one + &tolerance).contains(&norm) {
            return Ok(());
        }
        // Beyond the bound by less than doubles tell apart, or beyond all doubles, it is not printed.
        let by = match (norm - one).abs().to_f64() {
            excess if excess > 1e-6 && excess.is_finite() => format!("{excess:?}, more than 1e-6"),
            _ => "more than 1e-6".into(),
        };
        let message = format!("cos^2 + sin^2 of ({cos:?}, {sin:?}) differs from 1 by {by}");
        Err(self.problem("cos", message))
    }

    fn stamp(self, name: &str, t: i64, now: i64, is_remote: bool) -> Result<(), InvalidInput> {
        let age = i128::from(now) - i128::from(t);
        // An old local list counts as missing, see `scene`.
        if age < -NEAR_NOW || is_remote && age > NEAR_NOW {
            return Err(self.problem(name, format!("{t} is not within 60 s of now ({now})")));
        }
        Ok(())
    }

    fn size(self, count: usize, least: usize, most: usize) -> Result<(), InvalidInput> {
        if (least..=most).contains(&count) {
            return Ok(());
        }
        Err(self.problem("", format!("{count} items, where {least} to {most} are allowed")))
    }
}

macro_rules! parameters_in_domain {
    ($($(#[$doc:meta])* $name:ident: $number:ident = $default:literal in $domain:expr;)*) => {
        /// Every parameter is in its domain. `spec/4-arithmetic.md#domain`.
        pub fn check_parameters(parameters: &Parameters) -> Result<(), InvalidInput> {
            let p = at("parameters", None);
            $(p.number(stringify!($name), parameters.$name, &($domain))?;)*
            Ok(())
        }
    };
}

crate::parameters!(parameters_in_domain);

fn check_ego(ego: &Ego) -> Result<(), InvalidInput> {
    let e = at("ego", None);
    e.position(ego.x, ego.y)?;
    e.direction(ego.cos, ego.sin)?;
    e.number("speed", ego.speed, &SPEED)?;
    e.number("length", ego.length, &SIZE)?;
    e.number("width", ego.width, &SIZE)?;
    e.number("center_offset", ego.center_offset, &CENTER_OFFSET)
}

fn check_lead(lead: Option<&Lead>, now: i64) -> Result<(), InvalidInput> {
    let Some(lead) = lead else { return Ok(()) };
    let l = at("lead", None);
    l.stamp("stamp_ns", lead.stamp_ns, now, false)?;
    l.number("gap", lead.gap, &GAP)?;
    l.number("speed", lead.speed, &SPEED)
}

/// The first field of a route that is invalid.
pub fn check_route(route: &Route) -> Result<(), InvalidInput> {
    let list = "route.stations";
    at(list, None).size(route.cross_sections.len(), 2, CROSS_SECTIONS)?;
    let mut previous: Option<&CrossSection> = None;
    for (i, cross_section) in route.cross_sections.iter().enumerate() {
        let s = at(list, Some(i));
        s.position(cross_section.x, cross_section.y)?;
        for (name, bound) in [("left", cross_section.left), ("right", cross_section.right)] {
            s.number(name, bound[0], &POSITION)?;
            s.number(name, bound[1], &POSITION)?;
        }
        #[expect(clippy::float_cmp, reason = "the rule asks for equal points")]
        if previous.is_some_and(|before| before.x == cross_section.x && before.y == cross_section.y)
        {
            return Err(s.problem("x", "the reference point equals the one before".into()));
        }
        previous = Some(cross_section);
    }
    Ok(())
}

fn check_grid(grid: Option<&Grid>, now: i64) -> Result<(), InvalidInput> {
    let Some(grid) = grid else { return Ok(()) };
    let g = at("grid", None);
    g.stamp("stamp_ns", grid.stamp_ns, now, false)?;
    g.position(grid.x, grid.y)?;
    g.direction(grid.cos, grid.sin)?;
    g.number("resolution", grid.resolution, &RESOLUTION)?;
    g.number("width", grid.width, &CELLS_A_SIDE)?;
    g.number("height", grid.height, &CELLS_A_SIDE)?;
    let cells = grid.width * grid.height;
    if cells > CELLS {
        return Err(g.problem("height", format!("{cells} cells, where {CELLS} are allowed")));
    }
    let bytes = usize::try_from((cells + 7) / 8).unwrap_or(usize::MAX);
    let bitmaps = [("occupied", Some(&grid.occupied)), ("unknown", grid.unknown.as_ref())];
    for (name, bitmap) in bitmaps {
        if let Some(wrong) = bitmap.map(Vec::len).filter(|&length| length != bytes) {
            return Err(g.problem(name, format!("{wrong} bytes, where {bytes} are needed")));
        }
    }
    Ok(())
}

fn check_detections(list: Option<&DetectionList>, now: i64) -> Result<(), InvalidInput> {
    let Some(list) = list else { return Ok(()) };
    at("detections", None).stamp("stamp_ns", list.stamp_ns, now, false)?;
    check_items("detections.items", None, list)
}

fn check_detection_history(history: &[DetectionList], now: i64) -> Result<(), InvalidInput> {
    const NAME: &str = "detection_history";
    at(NAME, None).size(history.len(), 0, HISTORY)?;
    let mut younger: Option<i64> = None;
    for (k, list) in history.iter().enumerate() {
        let it = at(NAME, Some(k));
        it.stamp("stamp_ns", list.stamp_ns, now, false)?;
        if let Some(before) = younger.filter(|&before| before <= list.stamp_ns) {
            let message = format!("{} is not earlier than the {before} before it", list.stamp_ns);
            return Err(it.problem("stamp_ns", message));
        }
        younger = Some(list.stamp_ns);
        check_items("detection_history.items", Some(k), list)?;
    }
    Ok(())
}

/// The items of a list of detections; `index`: of the list, if it is one of several.
fn check_items(name: &str, index: Option<usize>, list: &DetectionList) -> Result<(), InvalidInput> {
    at(name, index).size(list.items.len(), 0, DETECTIONS)?;
    for (i, detection) in list.items.iter().enumerate() {
        let d = at(name, Some(i));
        d.position(detection.x, detection.y)?;
        d.direction(detection.cos, detection.sin)?;
        d.number("length", detection.length, &SIZE)?;
        d.number("width", detection.width, &SIZE)?;
    }
    Ok(())
}

fn check_tracks(list: Option<&TrackList>, now: i64, is_remote: bool) -> Result<(), InvalidInput> {
    const ITEMS: &str = "tracks.items";
    let Some(list) = list else { return Ok(()) };
    at("tracks", None).stamp("stamp_ns", list.stamp_ns, now, is_remote)?;
    at(ITEMS, None).size(list.items.len(), 0, TRACKS)?;
    let mut ids = HashSet::new();
    for (i, track) in list.items.iter().enumerate() {
        let t = at(ITEMS, Some(i));
        t.position(track.x, track.y)?;
        t.direction(track.cos, track.sin)?;
        t.number("vx", track.vx, &VELOCITY)?;
        t.number("vy", track.vy, &VELOCITY)?;
        t.number("length", track.length, &SIZE)?;
        t.number("width", track.width, &SIZE)?;
        if !ids.insert(track.id) {
            return Err(t.problem("id", format!("{} is the id of an earlier track", track.id)));
        }
    }
    Ok(())
}

fn check_trajectory(
    trajectory: Option<&Trajectory>,
    now: i64,
    is_remote: bool,
) -> Result<(), InvalidInput> {
    let Some(trajectory) = trajectory else { return Ok(()) };
    at("trajectory", None).stamp("stamp_ns", trajectory.stamp_ns, now, is_remote)?;
    // The points of a local trajectory that counts as missing for its age may be as old.
    let is_used = i128::from(now) - i128::from(trajectory.stamp_ns) <= NEAR_NOW;
    at("trajectory.points", None).size(trajectory.points.len(), 1, POINTS)?;
    let mut previous: Option<i64> = None;
    for (i, point) in trajectory.points.iter().enumerate() {
        let p = at("trajectory.points", Some(i));
        p.stamp("t_ns", point.t_ns, now, is_used)?;
        p.position(point.x, point.y)?;
        p.direction(point.cos, point.sin)?;
        if let Some(before) = previous.filter(|&before| before >= point.t_ns) {
            let message = format!("{} is not later than the {before} before it", point.t_ns);
            return Err(p.problem("t_ns", message));
        }
        previous = Some(point.t_ns);
    }
    Ok(())
}
