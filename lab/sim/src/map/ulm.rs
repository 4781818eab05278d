//! The maps of the paper's institute (github.com/uulm-mrm/tpl, Apache-2.0), read from where they lie: the
//! junction of Ulm-Lehr with its six ways, and the scenario on it.
//!
//! `maps/<set>/state.json` names the maps, `maps/<set>/extern/<uuid>.control_points.npy` holds rows of x, y
//! (UTM 32N), distance to the left and right boundary, speed limit and altitude. A scenario's `state.json` holds
//! the ego and cars, each on its map, with the parameters of its driver.

use std::path::{Path as File, PathBuf};

use mufasa_drives::readers::npy;
use serde::Deserialize;
use thiserror::Error;

use crate::map::given::{Given, GivenStart};
use crate::map::id::{MapId, Sum};
use crate::map::route::{Route, RouteKind};
use crate::map::{Lane, Town, conflicts};
use crate::path::Path;
use crate::pose::Point;
use crate::traffic::idm::Idm;
use crate::traffic::start::Start;

/// Local origin, UTM 32N: the junction.
pub const ORIGIN: (f64, f64) = (571_650.0, 5_364_810.0);
/// Routes are cut where they are farther than this from the junction, m.
const RADIUS: f64 = 195.0;
/// The ego starts so far from the beginning of its route, and arrives so far before its end, m.
const TASK: (f64, f64) = (20.0, 25.0);
/// A way of less than this around the junction leads nowhere, m.
const SHORTEST: f64 = 100.0;
/// The ego of a scenario is so near to the middle of its way, m.
const ON_WAY: f64 = 3.0;
/// The columns of a map.
const COLUMNS: [&str; 6] = ["x", "y", "d_left", "d_right", "speed_limit", "altitude"];
/// The maps.
const SET: &str = "maps/ulm";
/// The scenario on this junction whose vehicles have drivers. (In the other one, `iv_2023`, the ego begins within
/// the junction.)
const SCENARIO: &str = "scenarios/test/intersection_lehr/state.json";
/// The ways over the junction, and the ranks of the roads that they come from: the one from the north ends
/// here and gives way.
const WAYS: [(&str, u8); 6] = [
    ("lehr_crossing_west_to_east", 0),
    ("lehr_crossing_west_to_north", 0),
    ("lehr_crossing_east_to_west", 0),
    ("lehr_crossing_east_to_north", 0),
    ("lehr_crossing_north_to_east", 1),
    ("lehr_crossing_north_to_west", 1),
];
/// Those of the ego: the two that have to find a gap in oncoming or crossing traffic and turn left.
const EGO_WAYS: [usize; 2] = [1, 4];

/// Why a file gives no map or no scenario.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{}{}{field}: {message}", .file.display(), if .field.is_empty() { "" } else { ": " })]
pub struct UlmError {
    /// The file.
    pub file: PathBuf,
    /// The field in it, empty for the whole file.
    pub field: String,
    /// What is wrong, or needed.
    pub message: String,
}

#[derive(Deserialize)]
struct MapState {
    name: String,
}

#[derive(Deserialize)]
struct SimState {
    ego: SimBody,
    cars: Vec<SimCar>,
}

#[derive(Deserialize)]
struct SimBody {
    x: f64,
    y: f64,
    v: f64,
}

#[derive(Deserialize)]
struct SimCar {
    map_uuid: String,
    x: f64,
    y: f64,
    v: f64,
    target_v: f64,
    length: f64,
    width: f64,
    params_idm: SimIdm,
}

#[derive(Deserialize)]
struct SimIdm {
    time_headway: f64,
    gap_min: f64,
    a: f64,
    b: f64,
    delta: f64,
}

/// Reads the junction, its drivers and its start from the folder that holds `maps` and `scenarios`.
///
/// # Errors
/// A file that is absent or not of its form, a map that is not named, an ego that is on no way of its, a car that
/// cannot be, a driver whose exponent is not 4.
pub fn lehr(folder: &File) -> Result<Town, UlmError> {
    if !folder.is_dir() {
        let message = format!("no such folder; it has `{SET}` and `scenarios`");
        return Err(error(folder, "", message));
    }
    let set = folder.join(SET);
    let file = set.join("state.json");
    let maps: serde_json::Map<String, serde_json::Value> = json(&file, &read(&file)?)?;
    let (mut town, mut uuids, mut sum) = (Town::default(), Vec::new(), Sum::START);
    for (name, rank) in WAYS {
        let named = |value: &serde_json::Value| {
            MapState::deserialize(value).is_ok_and(|map| map.name.starts_with(name))
        };
        let Some((uuid, _)) = maps.iter().find(|(_, value)| named(value)) else {
            return Err(error(&file, "name", format!("no map is named {name}")));
        };
        let rows = set.join("extern").join(format!("{uuid}.control_points.npy"));
        let bytes = read(&rows)?;
        let route = route(&rows, &bytes, name, rank)?;
        town.lanes.push(Lane { path: route.path.clone(), width: route.left[0] + route.right[0] });
        town.routes.push(route);
        uuids.push(uuid.clone());
        sum = sum.with(&bytes);
    }
    conflicts::compute(&mut town);
    for way in EGO_WAYS {
        let route = &mut town.routes[way];
        route.set_task(TASK.0, route.path.length() - TASK.1);
    }
    let file = folder.join(SCENARIO);
    let bytes = read(&file)?;
    town.given = given(&town, &uuids, &file, &bytes)?;
    town.id = MapId::Lehr(sum.with(&bytes).value());
    Ok(town)
}

/// The start of a scenario file, and its drivers: cars on their maps, with their parameters, and the ego on that
/// of its routes that is nearest. A car is where its way is nearest to the place in the file, which may be beside it.
/// Cars on maps that do not lead over the junction are left out.
fn given(town: &Town, uuids: &[String], file: &File, bytes: &[u8]) -> Result<Given, UlmError> {
    let state: SimState = json(file, bytes)?;
    let at = |route: usize, x: f64, y: f64| {
        town.routes[route].path.project(Point::new(x - ORIGIN.0, y - ORIGIN.1))
    };
    let SimBody { x, y, v } = state.ego;
    let nearest = town.ego_routes().map(|route| (at(route, x, y), route));
    let nearest = nearest.min_by(|a, b| a.0.left.abs().total_cmp(&b.0.left.abs()));
    let Some((seen, ego_route)) = nearest.filter(|(seen, _)| seen.left.abs() < ON_WAY) else {
        return Err(error(
            file,
            "ego",
            String::from("it is on no way of the ego over the junction"),
        ));
    };
    if v < 0.0 {
        return Err(error(file, "ego.v", format!("{v}: it drives backwards")));
    }
    let mut given = Given { lets_ego_go: true, ..Given::default() };
    let mut actors = Vec::new();
    for (index, car) in state.cars.iter().enumerate() {
        let broken = |field: &str, message: String| {
            Err(error(file, &format!("cars[{index}].{field}"), message))
        };
        let Some(route) = uuids.iter().position(|uuid| *uuid == car.map_uuid) else { continue };
        let SimIdm { time_headway, gap_min, a, b, delta } = car.params_idm;
        if delta.to_bits() != 4.0_f64.to_bits() {
            return broken("params_idm.delta", format!("{delta}: only 4 is known here"));
        }
        let positive = [
            ("length", car.length),
            ("width", car.width),
            ("target_v", car.target_v),
            ("params_idm.a", a),
            ("params_idm.b", b),
        ];
        if let Some((field, value)) = positive.into_iter().find(|(_, value)| *value <= 0.0) {
            return broken(field, format!("{value}: it has to be above zero"));
        }
        let others = [
            ("v", car.v),
            ("params_idm.time_headway", time_headway),
            ("params_idm.gap_min", gap_min),
        ];
        if let Some((field, value)) = others.into_iter().find(|(_, value)| *value < 0.0) {
            return broken(field, format!("{value}: it is below zero"));
        }
        let idm = Idm { v0: car.target_v, headway: time_headway, s0: gap_min, a, b };
        let (speed, length, width, halts) = (car.v, car.length, car.width, Vec::new());
        let s = at(route, car.x, car.y).s;
        actors.push(Start { route, s, speed, length, width, idm, halts });
        given.drivers.push(idm);
    }
    given.starts.push(GivenStart { ego_route, ego_s: seen.s, ego_speed: v, actors });
    Ok(given)
}

fn error(file: &File, field: &str, message: String) -> UlmError {
    UlmError { file: file.to_owned(), field: field.to_owned(), message }
}

fn read(file: &File) -> Result<Vec<u8>, UlmError> {
    std::fs::read(file).map_err(|why| error(file, "", why.to_string()))
}

/// The message of serde names the field, the line and the column.
fn json<T: for<'a> Deserialize<'a>>(file: &File, bytes: &[u8]) -> Result<T, UlmError> {
    serde_json::from_slice(bytes).map_err(|why| error(file, "", why.to_string()))
}

/// One way, cut to what is around the junction and resampled to about 1 m.
fn route(file: &File, bytes: &[u8], name: &str, rank: u8) -> Result<Route, UlmError> {
    let table = npy::table(file, bytes, COLUMNS);
    let rows: Vec<[f64; 6]> =
        table.map_err(|broken| error(file, &broken.field, broken.message))?.collect();
    for (index, row) in rows.iter().enumerate() {
        let named = COLUMNS[..5].iter().zip(row);
        for (column, (name, cell)) in named.enumerate() {
            let message = match cell {
                cell if !cell.is_finite() => "not finite",
                // A lane without a width, or on which nobody may drive.
                cell if column > 1 && *cell <= 0.0 => "it has to be above zero",
                _ => continue,
            };
            return Err(error(file, &format!("{name}[{index}]"), String::from(message)));
        }
    }
    let local = |row: &[f64; 6]| Point::new(row[0] - ORIGIN.0, row[1] - ORIGIN.1);
    let near = |row: &&[f64; 6]| local(row).distance(Point::default()) < RADIUS;
    let rows: Vec<[f64; 6]> =
        rows.iter().skip_while(|row| !near(row)).take_while(near).copied().collect();
    let fine = Path::new(rows.iter().map(local).collect());
    let fine = fine.map_err(|why| error(file, "x", why.to_string()))?;
    if fine.length() < SHORTEST {
        let message = format!("{:.0} m of this way are near the junction", fine.length());
        return Err(error(file, "x", message));
    }
    let path = fine.resampled(1.0).map_err(|why| error(file, "x", why.to_string()))?;
    let length = path.length();
    let mut route = Route::new(name, RouteKind::Road, path, 0.0, 0.0);
    for (index, &s) in route.path.arc_lengths().iter().enumerate() {
        let row = &rows[fine.locate(s / length * fine.length()).0];
        (route.left[index], route.right[index], route.limits[index]) = (row[2], row[3], row[4]);
        route.rank[index] = rank;
    }
    route.set_pace();
    Ok(route)
}
