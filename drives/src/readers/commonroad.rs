//! Drives from `CommonRoad` files: a scenario with a solution, or with one of its own vehicles
//! as the CAV.

use std::path::Path;

use crate::drive::Drive;
use crate::geometry::{Point, distance};
use crate::options::Options;
use crate::readers::error::{ReadError, quoted};
use crate::readers::lanes::{Change, Network, Run};
use crate::readers::left_out::needed;
use crate::readers::route::route_along;
use crate::readers::scenario::Scenario;
use crate::readers::solution::Solution;
use crate::readers::source::stem;
use crate::recording::object::{Motion, Object, State};
use crate::recording::{self, Recording};

/// Kinds of recorded objects that can be the CAV.
const VEHICLES: [&str; 6] = ["car", "truck", "bus", "taxi", "priorityVehicle", "motorcycle"];
/// Share of its states that a vehicle must be on lanelets to be picked.
const ON_LANELETS: f64 = 0.95;

/// The drive of a solution in its scenario.
pub(crate) fn solved(
    scenario: &Scenario,
    solution: &Solution,
    files: [&Path; 2],
    options: &Options,
) -> Result<Drive, ReadError> {
    if solution.scenario != scenario.name {
        let message = format!(
            "a solution of {}, but the scenario before it is {}; name the solution's own",
            quoted(&solution.scenario),
            quoted(&scenario.name)
        );
        return Err(ReadError::file(files[1], message).at("CommonRoadSolution", "benchmark_id"));
    }
    let mut notes = scenario.notes.clone();
    let [length, width] = solution.size;
    notes.push(format!(
        "CAV: solution {}, {length} m by {width} m around the position of each state",
        solution.model
    ));
    let name = stem(files[1]);
    let source = format!("{} + {}", files[0].display(), files[1].display());
    let parts = Parts { name, source, ego: solution.states.clone(), size: solution.size };
    parts.drive(scenario, scenario.objects.clone(), notes, files[1], options)
}

/// The drive of a recorded vehicle of a scenario.
pub(crate) fn recorded(
    scenario: &Scenario,
    file: &Path,
    options: &Options,
) -> Result<Drive, ReadError> {
    let mut notes = scenario.notes.clone();
    let object = match options.ego {
        Some(id) => named(scenario, id, file)?,
        None => picked(scenario, file, options)?,
    };
    let Motion::Moving(states) = &object.motion else {
        return Err(no_vehicle(file, object.id, "has no recorded trajectory"));
    };
    let ego = centred(object, states);
    if let Some(i) = (1..ego.len()).find(|i| ego[*i].step != ego[i - 1].step + 1) {
        let message = "has a gap in its recording";
        return Err(no_vehicle(file, object.id, message).index(i));
    }
    let chosen = if options.ego.is_some() { "asked for" } else { "picked" };
    notes.push(format!(
        "CAV: recorded {} {} ({chosen}), {} states over {:.1} m",
        object.kind,
        object.id,
        ego.len(),
        travelled(states)
    ));
    let others = scenario.objects.iter().filter(|o| o.id != object.id).cloned().collect();
    let parts = Parts {
        name: stem(file),
        source: file.display().to_string(),
        ego,
        size: [object.footprint.length, object.footprint.width],
    };
    parts.drive(scenario, others, notes, file, options)
}

struct Parts {
    name: String,
    source: String,
    ego: Vec<State>,
    size: [f64; 2],
}

impl Parts {
    fn drive(
        self,
        scenario: &Scenario,
        objects: Vec<Object>,
        mut notes: Vec<String>,
        file: &Path,
        options: &Options,
    ) -> Result<Drive, ReadError> {
        let Self { name, source, ego, size } = self;
        let poses: Vec<(Point, f64)> = ego.iter().map(|s| (s.position, s.heading)).collect();
        let runs = scenario.network.follow(&poses);
        if let Some(error) = needed(&scenario.left_out, &scenario.network, &poses, &runs) {
            return Err(error);
        }
        notes.extend(route_notes(&runs));
        let places: Vec<(Point, f64)> = ego.iter().map(|s| (s.position, s.speed.abs())).collect();
        let route = route_along(&scenario.network, &runs, &places).ok_or_else(|| {
            let message = "no lanelet is near the CAV in its direction: there is no route";
            ReadError::file(file, message).at("commonRoad", "lanelet")
        })?;
        let dt_ns = scenario.dt_ns;
        let recording = Recording { name, source, dt_ns, ego, size, objects, route, notes };
        let drive = recording::drive(recording, options, 1);
        if drive.cycles.is_empty() {
            return Err(ReadError::no_cycle(file));
        }
        Ok(drive)
    }
}

fn route_notes(runs: &[Run]) -> Vec<String> {
    let ids: Vec<String> = runs
        .iter()
        .map(|run| {
            let ids: Vec<String> = run.lanelets.iter().map(i64::to_string).collect();
            let then = match run.change {
                Some(Change::Lane) => " | lane change |",
                Some(Change::Jump) => " | no connection |",
                None => "",
            };
            format!("{}{then}", ids.join(" "))
        })
        .collect();
    vec![format!("route along lanelets {}", ids.join(" "))]
}

/// States of the centre of the rectangle, turned with it.
fn centred(object: &Object, states: &[State]) -> Vec<State> {
    states
        .iter()
        .map(|s| {
            let rectangle = object.footprint.at(s.position, s.heading);
            State { position: rectangle.center, heading: rectangle.heading, ..*s }
        })
        .collect()
}

fn named<'a>(scenario: &'a Scenario, id: i64, file: &Path) -> Result<&'a Object, ReadError> {
    let object = scenario.objects.iter().find(|o| o.id == id);
    object.ok_or_else(|| no_vehicle(file, id, "is not in this scenario"))
}

/// Of the vehicles that stay on the lanelets the one that goes farthest in the cycles that its
/// recording gives, then the one with the longest recording, then the smallest id.
fn picked<'a>(
    scenario: &'a Scenario,
    file: &Path,
    options: &Options,
) -> Result<&'a Object, ReadError> {
    let mut best: Option<((f64, usize), &Object)> = None;
    for object in scenario.objects.iter().filter(|o| VEHICLES.contains(&o.kind.as_str())) {
        let Motion::Moving(states) = &object.motion else { continue };
        if states.len() < 2 || !on_lanelets(&scenario.network, states) {
            continue;
        }
        let cycles = recording::cycles(states, scenario.dt_ns, options);
        let key = (travelled(&states[..cycles]), states.len());
        let better = best.is_none_or(|((far, n), o)| {
            key.0.total_cmp(&far).then(key.1.cmp(&n)).then(o.id.cmp(&object.id)).is_gt()
        });
        if better {
            best = Some((key, object));
        }
    }
    best.map(|(_, object)| object).ok_or_else(|| {
        let is_set = |o: &Object| matches!(o.motion, Motion::Occupied { .. });
        let message = if scenario.objects.iter().any(is_set) {
            "the obstacles are sets of occupied places, and none is a vehicle with a trajectory \
             that could be the CAV; give a solution"
        } else {
            "no recorded vehicle stays on the lanelets; name one, or give a solution"
        };
        ReadError::file(file, message).at("commonRoad", "dynamicObstacle")
    })
}

fn on_lanelets(network: &Network, states: &[State]) -> bool {
    let on = states.iter().filter(|s| network.covers(s.position, s.heading)).count();
    #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^52 states")]
    let share = on as f64 / states.len() as f64;
    share >= ON_LANELETS
}

fn travelled(states: &[State]) -> f64 {
    states.windows(2).map(|w| distance(w[0].position, w[1].position)).sum()
}

fn no_vehicle(file: &Path, id: i64, problem: &str) -> ReadError {
    ReadError::file(file, format!("vehicle {id} {problem}; it cannot be the CAV"))
        .at(format!("commonRoad/dynamicObstacle[{id}]"), "id")
}
