//! Drives from `CommonRoad` files: a scenario with a solution, or with one of its own vehicles
//! as the CAV.

use std::path::Path;

use crate::drive::Stream;
use crate::geometry::Point;
use crate::options::Options;
use crate::readers::error::{ReadError, quoted};
use crate::readers::lanes::{Change, Run};
use crate::readers::left_out::needed;
use crate::readers::route::route_along;
use crate::readers::scenario::Scenario;
use crate::readers::solution::Solution;
use crate::readers::source::stem;
use crate::readers::vehicle::Vehicle;
use crate::recording::object::{Object, State};
use crate::recording::{self, Recording};

/// The drive of a solution in its scenario.
pub(crate) fn solved(
    scenario: &Scenario,
    solution: &Solution,
    files: [&Path; 2],
    options: &Options,
) -> Result<Stream, ReadError> {
    if solution.scenario != scenario.name {
        let message = format!(
            "a solution of {}, but the scenario before it is {}; name the solution's own",
            quoted(&solution.scenario),
            quoted(&scenario.name)
        );
        return Err(ReadError::file(files[1], message).at("CommonRoadSolution", "benchmark_id"));
    }
    let mut notes = scenario.notes.clone();
    if solution.version != scenario.version {
        notes.push(format!(
            "the solution is of version {}, the scenario of {}: it was planned for another edition \
             of this file, in which lanelets and obstacles may be others",
            quoted(&solution.version),
            quoted(&scenario.version)
        ));
    }
    notes.extend(solution.speed_notes(scenario.dt_ns));
    if let Some(ego) = options.ego {
        notes.push(format!("--ego {ego} is not used: the CAV is that of the solution"));
    }
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
) -> Result<Stream, ReadError> {
    let mut notes = scenario.notes.clone();
    let Vehicle { object, states, notes: of_vehicle } = Vehicle::of(scenario, file, options)?;
    notes.extend(of_vehicle);
    let ego = centred(object, states);
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
    ) -> Result<Stream, ReadError> {
        let Self { name, source, ego, size } = self;
        let poses: Vec<(Point, f64)> = ego.iter().map(|s| (s.position, s.heading)).collect();
        let runs = scenario.network.follow(&poses);
        if let Some(error) = needed(&scenario.left_out, &scenario.network, &poses, &runs) {
            return Err(error);
        }
        notes.extend(route_notes(&runs));
        let places: Vec<(Point, f64)> = ego.iter().map(|s| (s.position, s.speed.abs())).collect();
        let route = route_along(&scenario.network, &runs, &places).ok_or_else(|| {
            let message = "no lanelet is near the CAV in its direction, so that there is no route; are \
                           these the lanelets that it drives on?";
            ReadError::file(file, message).at("commonRoad", "lanelet")
        })?;
        let dt_ns = scenario.dt_ns;
        let recording = Recording { name, source, dt_ns, ego, size, objects, route, notes };
        let drive = recording::drive(recording, options, 1);
        if drive.count() == 0 {
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
