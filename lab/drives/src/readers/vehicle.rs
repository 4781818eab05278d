//! Which recorded vehicle is the CAV: the one asked for, or one that is picked.

use std::path::Path;

use crate::counted;
use crate::geometry::distance;
use crate::options::{Options, Tail};
use crate::readers::error::ReadError;
use crate::readers::lanes::Network;
use crate::readers::scenario::Scenario;
use crate::recording;
use crate::recording::object::{Motion, Object, State};

/// The kind of recorded objects that is the CAV by itself, and those that are where there is none.
const CAR: &str = "car";
const OTHERS: [&str; 5] = ["truck", "bus", "taxi", "priorityVehicle", "motorcycle"];
/// Share of its states that a vehicle must be on lanelets to be picked.
const ON_LANELETS: f64 = 0.95;
/// No car drives faster than this, m/s: more way between two states is an error of the recording.
const SPEED_MAX: f64 = 100.0;

/// A vehicle of a scenario with its states, one for every step.
pub(crate) struct Vehicle<'a> {
    pub object: &'a Object,
    pub states: &'a [State],
    pub notes: Vec<String>,
}

impl<'a> Vehicle<'a> {
    /// The vehicle that is asked for, or one that is picked.
    pub(crate) fn of(
        scenario: &'a Scenario,
        file: &Path,
        options: &Options,
    ) -> Result<Self, ReadError> {
        match options.ego {
            Some(id) => named(scenario, id, file),
            None => picked(scenario, options).ok_or_else(|| none(scenario, file)),
        }
    }

    fn new(object: &'a Object, states: &'a [State], chosen: &str) -> Self {
        let note = format!(
            "CAV: recorded {} {} ({chosen}), {} over {:.1} m",
            object.kind,
            object.id,
            counted(states.len(), "state"),
            travelled(states)
        );
        Self { object, states, notes: vec![note] }
    }
}

fn named<'a>(scenario: &'a Scenario, id: i64, file: &Path) -> Result<Vehicle<'a>, ReadError> {
    let refused = |problem: &str| {
        let message = format!(
            "vehicle {id} {problem}; it cannot be the CAV: name another with --ego ID, or none to \
             have one picked"
        );
        ReadError::file(file, message).at(format!("commonRoad/dynamicObstacle[{id}]"), "id")
    };
    let object = scenario.objects.iter().find(|o| o.id == id);
    let object = object.ok_or_else(|| refused("is not in this scenario"))?;
    let Motion::Moving(states) = &object.motion else {
        return Err(refused("has no recorded trajectory"));
    };
    if let Some(i) = gap(states) {
        return Err(refused("has a gap in its recording").index(i));
    }
    let mut vehicle = Vehicle::new(object, states, "asked for");
    if jumps(states, scenario.dt_ns) {
        vehicle.notes.push(format!("its recording jumps, by more than {SPEED_MAX} m/s"));
    }
    Ok(vehicle)
}

/// Of the cars that stay on the lanelets the one that goes farthest in the cycles that its
/// recording gives without its tail, then the one with the longest recording, then the smallest id.
/// Another vehicle only where there is no such car; one whose recording jumps or has a gap never.
fn picked<'a>(scenario: &'a Scenario, options: &Options) -> Option<Vehicle<'a>> {
    // What is picked is not to depend on whether the tail is kept.
    let options = Options { tail: Tail::Stop, ..options.clone() };
    let mut candidates = Vec::new();
    let mut passed_over = Vec::new();
    for (object, states) in recorded(scenario) {
        if states.len() < 2 || !on_lanelets(&scenario.network, states) {
            continue;
        }
        if jumps(states, scenario.dt_ns) || gap(states).is_some() {
            passed_over.push(object.id.to_string());
            continue;
        }
        let cycles = recording::cycles(states, scenario.dt_ns, &options);
        candidates.push((object, states, travelled(&states[..cycles])));
    }
    let (object, states, _) =
        candidates.into_iter().max_by(|(a, of_a, far), (b, of_b, farther)| {
            let kind = (a.kind == CAR).cmp(&(b.kind == CAR));
            let way = kind.then(far.total_cmp(farther));
            way.then(of_a.len().cmp(&of_b.len())).then(b.id.cmp(&a.id))
        })?;
    let mut vehicle = Vehicle::new(object, states, "picked");
    if object.kind != CAR {
        let note = format!("no car could be picked, so that the CAV is a {}", object.kind);
        vehicle.notes.push(note);
    }
    if !passed_over.is_empty() {
        vehicle.notes.push(format!(
            "vehicles passed over, whose recordings have a gap or jump by more than {SPEED_MAX} \
             m/s: {}",
            passed_over.join(" ")
        ));
    }
    Some(vehicle)
}

/// Vehicles with a trajectory.
fn recorded(scenario: &Scenario) -> impl Iterator<Item = (&Object, &[State])> {
    scenario.objects.iter().filter_map(|object| match &object.motion {
        Motion::Moving(states) if is_vehicle(&object.kind) => Some((object, states.as_slice())),
        Motion::Moving(_) | Motion::Standing(_) | Motion::Occupied { .. } => None,
    })
}

fn is_vehicle(kind: &str) -> bool {
    kind == CAR || OTHERS.contains(&kind)
}

/// The refusal of a scenario in which none can be picked.
fn none(scenario: &Scenario, file: &Path) -> ReadError {
    let is_set = |o: &Object| matches!(o.motion, Motion::Occupied { .. });
    let message = if scenario.objects.iter().any(is_set) {
        "the obstacles are sets of occupied places, and none is a vehicle with a trajectory \
         that could be the CAV; give a solution"
    } else if recorded(scenario).next().is_none() {
        "no vehicle with a recorded trajectory is in it that could be the CAV; give a solution"
    } else {
        "no recorded vehicle stays on the lanelets, without a gap or a jump in its recording; name \
         one with --ego ID, or give a solution"
    };
    ReadError::file(file, message).at("commonRoad", "dynamicObstacle")
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

/// The state behind the first missing step.
fn gap(states: &[State]) -> Option<usize> {
    (1..states.len()).find(|i| states[*i].step != states[i - 1].step + 1)
}

/// Whether two states that follow each other are too far apart.
fn jumps(states: &[State], dt_ns: i64) -> bool {
    #[expect(clippy::cast_precision_loss, reason = "at most 10 s, and 10^6 steps")]
    let way = |pair: &[State]| {
        let steps = (pair[1].step - pair[0].step) as f64;
        SPEED_MAX * steps * (dt_ns as f64 / 1e9)
    };
    states.windows(2).any(|pair| distance(pair[0].position, pair[1].position) > way(pair))
}
