//! The maps of the paper's institute (github.com/uulm-mrm/tpl, Apache-2.0), read from where they lie: the
//! junction of Ulm-Lehr with its six ways, and the scenarios on it.
//!
//! `maps/<set>/state.json` names the maps, `maps/<set>/extern/<uuid>.control_points.npy` holds rows of x, y
//! (UTM 32N), distance to the left and right boundary, speed limit and altitude.

use std::path::{Path as File, PathBuf};

use serde::Deserialize;

use crate::map::route::{Route, RouteKind};
use crate::map::{Lane, Town, conflicts, npy};
use crate::path::Path;
use crate::pose::Point;
use crate::scenario::{Scenario, Start};
use crate::traffic::idm::Idm;

/// Local origin, UTM 32N: the junction.
pub const ORIGIN: (f64, f64) = (571_650.0, 5_364_810.0);
/// Routes are cut where they are farther than this from the junction, m.
const RADIUS: f64 = 195.0;
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

/// Why a file gives no map or no scenario.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UlmError {
    /// The file.
    pub file: PathBuf,
    /// The field in it, empty for the whole file.
    pub field: String,
    /// What is wrong, or needed.
    pub message: String,
}

impl core::fmt::Display for UlmError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "{}: {}: {}", self.file.display(), self.field, self.message)
    }
}

impl std::error::Error for UlmError {}

/// The junction of Ulm-Lehr, with the names of its maps.
#[derive(Clone, Debug, PartialEq)]
pub struct Lehr {
    /// The six ways; the first two are those of the ego.
    pub town: Town,
    /// Identity of the map of each route.
    pub uuids: Vec<String>,
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

/// Reads the junction from the folder that holds `maps`.
///
/// # Errors
/// A file that is absent or not of its form, or a map that is not named.
pub fn lehr(folder: &File) -> Result<Lehr, UlmError> {
    let set = folder.join("maps/ulm");
    let file = set.join("state.json");
    let maps: serde_json::Map<String, serde_json::Value> = json(&file)?;
    let mut town =
        Town { lanes: Vec::new(), crossings: Vec::new(), routes: Vec::new(), signals: Vec::new() };
    let mut uuids = Vec::new();
    for (name, rank) in WAYS {
        let named = |value: &serde_json::Value| {
            MapState::deserialize(value).is_ok_and(|map| map.name.starts_with(name))
        };
        let Some((uuid, _)) = maps.iter().find(|(_, value)| named(value)) else {
            return Err(error(&file, "name", format!("no map is named {name}")));
        };
        let rows = set.join("extern").join(format!("{uuid}.control_points.npy"));
        let route = route(&rows, name, rank)?;
        town.lanes.push(Lane { path: route.path.clone(), width: route.left[0] + route.right[0] });
        town.routes.push(route);
        uuids.push(uuid.clone());
    }
    conflicts::compute(&mut town);
    for route in &mut town.routes[..2] {
        route.set_task(20.0, route.path.length() - 25.0);
    }
    Ok(Lehr { town, uuids })
}

impl Lehr {
    /// Reads a scenario file: cars on their maps, with their parameters, and the ego on the route of its
    /// that is nearest. Cars on maps that do not lead over the junction are left out.
    ///
    /// # Errors
    /// A file that is absent or not of its form, an ego that is not here, or a driver whose exponent is
    /// not 4.
    pub fn scenario(&self, file: &File) -> Result<Scenario, UlmError> {
        let state: SimState = json(file)?;
        let place = |x: f64, y: f64| Point::new(x - ORIGIN.0, y - ORIGIN.1);
        let at = |route: usize, place: Point| self.town.routes[route].path.project(place);
        let ego = place(state.ego.x, state.ego.y);
        let nearest = self.town.ego_routes().map(|route| (at(route, ego), route));
        let nearest = nearest.min_by(|a, b| a.0.left.abs().total_cmp(&b.0.left.abs()));
        let Some((seen, ego_route)) = nearest.filter(|(seen, _)| seen.left.abs() < 3.0) else {
            return Err(error(
                file,
                "ego",
                String::from("it is on no route over the junction of Lehr"),
            ));
        };
        let mut actors = Vec::new();
        for (index, car) in state.cars.iter().enumerate() {
            if car.params_idm.delta.to_bits() != 4.0_f64.to_bits() {
                let field = format!("cars[{index}].params_idm.delta");
                return Err(error(
                    file,
                    &field,
                    format!("{}: only 4 is known here", car.params_idm.delta),
                ));
            }
            let Some(route) = self.uuids.iter().position(|uuid| *uuid == car.map_uuid) else {
                continue;
            };
            let idm = &car.params_idm;
            let idm = Idm {
                v0: car.target_v,
                headway: idm.time_headway,
                s0: idm.gap_min,
                a: idm.a,
                b: idm.b,
            };
            let s = at(route, place(car.x, car.y)).s;
            let (length, width) = (car.length, car.width);
            actors.push(Start { route, s, speed: car.v, length, width, idm, halts: Vec::new() });
        }
        Ok(Scenario {
            ego_route,
            ego_s: seen.s,
            ego_speed: state.ego.v,
            actors,
            walkers: Vec::new(),
            signal_offset: 0.0,
            refill: false,
            time_limit: 120.0,
        })
    }
}

fn error(file: &File, field: &str, message: String) -> UlmError {
    UlmError { file: file.to_owned(), field: field.to_owned(), message }
}

fn json<T: for<'a> Deserialize<'a>>(file: &File) -> Result<T, UlmError> {
    let text = std::fs::read_to_string(file).map_err(|why| error(file, "", why.to_string()))?;
    // The message of serde names the field, the line and the column.
    serde_json::from_str(&text).map_err(|why| error(file, "", why.to_string()))
}

/// One way, cut to what is around the junction and resampled to about 1 m.
fn route(file: &File, name: &str, rank: u8) -> Result<Route, UlmError> {
    let bytes = std::fs::read(file).map_err(|why| error(file, "", why.to_string()))?;
    let rows =
        npy::table::<6>(&bytes).map_err(|broken| error(file, broken.field, broken.message))?;
    for (index, row) in rows.iter().enumerate() {
        let names = ["x", "y", "d_left", "d_right", "speed_limit"];
        if let Some((_, name)) = row.iter().zip(names).find(|(cell, _)| !cell.is_finite()) {
            return Err(error(file, &format!("{name}[{index}]"), String::from("not finite")));
        }
    }
    let local = |row: &[f64; 6]| Point::new(row[0] - ORIGIN.0, row[1] - ORIGIN.1);
    let near = |row: &&[f64; 6]| local(row).distance(Point::default()) < RADIUS;
    let rows: Vec<[f64; 6]> =
        rows.iter().skip_while(|row| !near(row)).take_while(near).copied().collect();
    let fine = Path::new(rows.iter().map(local).collect());
    let fine = fine.map_err(|why| error(file, "x", why.to_string()))?;
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
