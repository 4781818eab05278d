//! The cycle record (`spec/5-interfaces.md#cycle`).

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use mufasa_model::input::cycle::{
    CrossSection, Cycle, Detection, DetectionList, Ego, Grid, Lead, Profile, Route, Track,
    TrackList, Trajectory, TrajectoryPoint,
};
use mufasa_model::report::InvalidInput;
use mufasa_model::services::configuration::Configuration;

use crate::walk::Value;
use crate::{names, parameters};

const PROFILES: [Profile; 2] = [Profile::Paper, Profile::Hardened];

const CONFIGURATIONS: [Configuration; 4] = [
    Configuration::Local,
    Configuration::MotRemote,
    Configuration::AllRemote,
    Configuration::PlanRemote,
];

/// The domain of a grid (`spec/4-arithmetic.md#domain`): outside of it the model says what is
/// wrong, and the length of the bitmap says nothing.
const GRID_SIDE: std::ops::RangeInclusive<i64> = 1..=1 << 15;
const GRID_CELLS: i64 = 1 << 24;

/// Reads a cycle; `record` is an object with `kind` cycle.
pub fn cycle(record: Value<'_, '_>) -> Result<Cycle, InvalidInput> {
    let [
        _,
        _,
        profile,
        parameters,
        now_ns,
        configuration,
        ego,
        trajectory,
        tracks,
        detections,
        lead,
        route,
        grid,
        previous,
    ] = record.object([
        "kind",
        "id",
        "profile",
        "parameters",
        "now_ns",
        "configuration",
        "ego",
        "trajectory",
        "tracks",
        "detections",
        "lead",
        "route",
        "grid",
        "previous_tracks",
    ])?;
    Ok(Cycle {
        profile: self::profile(profile)?,
        parameters: parameters::of_cycle(parameters)?,
        now_ns: now_ns.integer()?,
        configuration: configuration.choice(&CONFIGURATIONS, names::configuration)?,
        ego: self::ego(ego)?,
        trajectory: trajectory.given().map(self::trajectory).transpose()?,
        tracks: tracks.given().map(track_list).transpose()?,
        detections: detections.given().map(detection_list).transpose()?,
        lead: lead.given().map(self::lead).transpose()?,
        route: self::route(route)?,
        grid: grid.given().map(self::grid).transpose()?,
        previous_tracks: previous.given().map(track_list).transpose()?,
    })
}

/// Reads a profile; hardened when it is absent.
pub fn profile(value: Value<'_, '_>) -> Result<Profile, InvalidInput> {
    value.present().map_or(Ok(Profile::Hardened), |value| value.choice(&PROFILES, names::profile))
}

fn ego(value: Value<'_, '_>) -> Result<Ego, InvalidInput> {
    let [x, y, cos, sin, speed, length, width, center_offset] =
        value.object(["x", "y", "cos", "sin", "speed", "length", "width", "center_offset"])?;
    Ok(Ego {
        x: x.float()?,
        y: y.float()?,
        cos: cos.float()?,
        sin: sin.float()?,
        speed: speed.float()?,
        length: length.float()?,
        width: width.float()?,
        center_offset: center_offset.float()?,
    })
}

fn trajectory(value: Value<'_, '_>) -> Result<Trajectory, InvalidInput> {
    let [stamp_ns, points] = value.object(["stamp_ns", "points"])?;
    Ok(Trajectory { stamp_ns: stamp_ns.integer()?, points: points.list(trajectory_point)? })
}

fn trajectory_point(value: Value<'_, '_>) -> Result<TrajectoryPoint, InvalidInput> {
    let [t_ns, x, y, cos, sin] = value.object(["t_ns", "x", "y", "cos", "sin"])?;
    Ok(TrajectoryPoint {
        t_ns: t_ns.integer()?,
        x: x.float()?,
        y: y.float()?,
        cos: cos.float()?,
        sin: sin.float()?,
    })
}

fn track_list(value: Value<'_, '_>) -> Result<TrackList, InvalidInput> {
    let [stamp_ns, items] = value.object(["stamp_ns", "items"])?;
    Ok(TrackList { stamp_ns: stamp_ns.integer()?, items: items.list(track)? })
}

fn track(value: Value<'_, '_>) -> Result<Track, InvalidInput> {
    let [id, x, y, cos, sin, vx, vy, length, width] =
        value.object(["id", "x", "y", "cos", "sin", "vx", "vy", "length", "width"])?;
    Ok(Track {
        id: id.integer()?,
        x: x.float()?,
        y: y.float()?,
        cos: cos.float()?,
        sin: sin.float()?,
        vx: vx.float()?,
        vy: vy.float()?,
        length: length.float()?,
        width: width.float()?,
    })
}

fn detection_list(value: Value<'_, '_>) -> Result<DetectionList, InvalidInput> {
    let [stamp_ns, items] = value.object(["stamp_ns", "items"])?;
    Ok(DetectionList { stamp_ns: stamp_ns.integer()?, items: items.list(detection)? })
}

fn detection(value: Value<'_, '_>) -> Result<Detection, InvalidInput> {
    let [x, y, cos, sin, length, width] =
        value.object(["x", "y", "cos", "sin", "length", "width"])?;
    Ok(Detection {
        x: x.float()?,
        y: y.float()?,
        cos: cos.float()?,
        sin: sin.float()?,
        length: length.float()?,
        width: width.float()?,
    })
}

fn lead(value: Value<'_, '_>) -> Result<Lead, InvalidInput> {
    let [stamp_ns, gap, speed] = value.object(["stamp_ns", "gap", "speed"])?;
    Ok(Lead { stamp_ns: stamp_ns.integer()?, gap: gap.float()?, speed: speed.float()? })
}

fn route(value: Value<'_, '_>) -> Result<Route, InvalidInput> {
    let [closed, stations] = value.object(["closed", "stations"])?;
    Ok(Route { closed: closed.boolean()?, cross_sections: stations.list(station)? })
}

fn station(value: Value<'_, '_>) -> Result<CrossSection, InvalidInput> {
    let [x, y, left, right] = value.object(["x", "y", "left", "right"])?;
    Ok(CrossSection { x: x.float()?, y: y.float()?, left: pair(left)?, right: pair(right)? })
}

/// A point; its errors have the index of the station, as those of the model.
fn pair(value: Value<'_, '_>) -> Result<[f64; 2], InvalidInput> {
    let wrong = || value.problem("must be a list of two numbers");
    let numbers = value.list(|number| number.float().map_err(|_| wrong()))?;
    <[f64; 2]>::try_from(numbers).map_err(|_| wrong())
}

fn grid(value: Value<'_, '_>) -> Result<Grid, InvalidInput> {
    let [stamp_ns, x, y, cos, sin, resolution, width, height, occupied, unknown] =
        value.object([
            "stamp_ns",
            "x",
            "y",
            "cos",
            "sin",
            "resolution",
            "width",
            "height",
            "occupied",
            "unknown",
        ])?;
    let (columns, rows) = (width.integer()?, height.integer()?);
    Ok(Grid {
        stamp_ns: stamp_ns.integer()?,
        x: x.float()?,
        y: y.float()?,
        cos: cos.float()?,
        sin: sin.float()?,
        resolution: resolution.float()?,
        width: columns,
        height: rows,
        occupied: bitmap(occupied, columns, rows)?,
        unknown: unknown.given().map(|value| bitmap(value, columns, rows)).transpose()?,
    })
}

fn bitmap(value: Value<'_, '_>, columns: i64, rows: i64) -> Result<Vec<u8>, InvalidInput> {
    let bytes = STANDARD.decode(value.string()?).map_err(|error| {
        value.problem(format_args!("must be RFC 4648 base64 with padding: {error}"))
    })?;
    if GRID_SIDE.contains(&columns) && GRID_SIDE.contains(&rows) && columns * rows <= GRID_CELLS {
        let wanted = (columns * rows + 7) / 8;
        if usize::try_from(wanted) != Ok(bytes.len()) {
            return Err(value.problem(format_args!(
                "must hold {wanted} bytes for {columns} * {rows} cells, not {}",
                bytes.len()
            )));
        }
    }
    Ok(bytes)
}
