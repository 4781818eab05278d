//! `CommonRoad` solutions: the trajectory of the ego vehicle.
//!
//! The states of the kinematic single-track model move like a rear axle (their heading is their
//! direction of motion), but the benchmark's own solution checker puts the vehicle's rectangle
//! around the position of the state without a shift. The drives follow the checker: the position
//! of a state is the centre of the rectangle, hence `center_offset` is 0.

use std::path::Path;

use crate::geometry::distance;
use crate::readers::error::{ReadError, quoted};
use crate::readers::xml::{Document, Element};
use crate::recording::object::State;

/// A solution of one planning problem.
pub(crate) struct Solution {
    /// Name of the scenario in the benchmark id.
    pub scenario: String,
    /// Version of the scenario that it is for, the last part of the benchmark id.
    pub version: String,
    /// The part of the benchmark id before the scenario, such as `KS2:SM1`.
    pub model: String,
    /// Length and width of the vehicle, m.
    pub size: [f64; 2],
    /// One state for every time step.
    pub states: Vec<State>,
}

/// Lengths and widths of the `CommonRoad` vehicles 1 (Ford Escort), 2 (BMW 320i) and 3 (VW
/// Vanagon), m.
const VEHICLES: [(char, [f64; 2]); 3] =
    [('1', [4.298, 1.674]), ('2', [4.508, 1.610]), ('3', [4.569, 1.844])];

/// Of velocities along a shorter way nothing is said, m.
const LEAST_M: f64 = 5.0;

/// Reads a solution from the text of a file.
pub(crate) fn read(file: &Path, text: &str) -> Result<Solution, ReadError> {
    let document = Document::whole(file, text)?;
    let root = document.root();
    let id = root.attribute("benchmark_id")?;
    let parts: Vec<&str> = id.split(':').collect();
    let [model, cost, scenario, version] = parts[..] else {
        let message = format!("{} is not of the form model:cost:scenario:version", quoted(id));
        return Err(root.error("benchmark_id", message));
    };
    let size = size(model).ok_or_else(|| {
        let message = format!("{} names no KS, ST or MB model of vehicle 1, 2 or 3", quoted(model));
        root.error("benchmark_id", message)
    })?;
    let mut trajectories = root.children();
    let (Some(trajectory), None) = (trajectories.next(), trajectories.next()) else {
        return Err(root.error("", "exactly one trajectory is needed"));
    };
    Ok(Solution {
        scenario: scenario.to_owned(),
        version: version.to_owned(),
        model: format!("{model}:{cost}"),
        size,
        states: states(trajectory)?,
    })
}

impl Solution {
    /// What is odd about the velocities of the states, which are `dt_ns` apart.
    pub fn speed_notes(&self, dt_ns: i64) -> Vec<String> {
        let states = &self.states;
        let mut notes = Vec::new();
        let backwards = states.iter().filter(|state| state.speed < 0.0).count();
        if backwards > 0 {
            let count = states.len();
            notes.push(format!(
                "{backwards} of {count} velocities are below 0, which is backwards: cycles have their amounts"
            ));
        }
        #[expect(
            clippy::cast_precision_loss,
            reason = "a step of a scenario, and for people to read"
        )]
        let dt_s = dt_ns as f64 / 1e9;
        let way: f64 =
            states.windows(2).map(|pair| distance(pair[0].position, pair[1].position)).sum();
        let told: f64 = states.windows(2).map(|pair| pair[0].speed.abs() * dt_s).sum();
        if told.max(way) > LEAST_M && !(0.5..=2.0).contains(&(told / way)) {
            notes.push(format!(
                "its velocities make a way of {told:.1} m, its places one of {way:.1} m: velocities are in m/s"
            ));
        }
        notes
    }
}

fn size(model: &str) -> Option<[f64; 2]> {
    let vehicle = ["KS", "ST", "MB"].iter().find_map(|kind| model.strip_prefix(kind))?;
    VEHICLES.iter().find(|(name, _)| vehicle.chars().eq([*name])).map(|(_, size)| *size)
}

fn states(trajectory: Element<'_>) -> Result<Vec<State>, ReadError> {
    let name = match trajectory.name() {
        "ksTrajectory" => "ksState",
        "stTrajectory" => "stState",
        "mbTrajectory" => "mbState",
        other => {
            let message = format!("{} is not read; KS, ST and MB trajectories are", quoted(other));
            return Err(trajectory.error("", message));
        }
    };
    let mut states: Vec<State> = Vec::new();
    for (i, element) in trajectory.all(name).enumerate() {
        let step = element.get("time")?.step()?;
        let slip = element.find("slipAngle").map_or(Ok(0.0), Element::number)?;
        let state = State {
            step,
            position: element.point()?,
            heading: element.get("orientation")?.number()?,
            speed: element.velocity(element.get("velocity")?.number()?).map_err(|e| e.index(i))?,
            slip,
        };
        if states.last().is_some_and(|last| last.step + 1 != step) {
            let message = format!("time {step} is not the step after the last");
            return Err(element.error("time", message).index(i));
        }
        states.push(state);
    }
    if states.is_empty() {
        return Err(trajectory.error(name, "no state"));
    }
    Ok(states)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn odd_velocities_are_told() {
        let noted = |factor: f64| {
            let state = |step: i32| State {
                step: step.into(),
                position: [f64::from(step), 0.0],
                heading: 0.0,
                speed: 10.0 * factor,
                slip: 0.0,
            };
            let solution = Solution {
                scenario: String::new(),
                version: String::new(),
                model: String::new(),
                size: [4.0, 2.0],
                states: (0..20).map(state).collect(),
            };
            solution.speed_notes(100_000_000)
        };
        assert_eq!(noted(1.0), [""; 0]);
        let told =
            ["20 of 20 velocities are below 0, which is backwards: cycles have their amounts"];
        assert_eq!(noted(-1.0), told);
        let told = [
            "its velocities make a way of 68.4 m, its places one of 19.0 m: velocities are in m/s",
        ];
        assert_eq!(noted(3.6), told);
        assert_eq!(noted(0.2).len(), 1);
    }

    #[test]
    fn the_vehicle_is_named_by_the_model() {
        assert_eq!(size("KS2"), Some([4.508, 1.610]));
        assert_eq!(size("ST1"), Some([4.298, 1.674]));
        assert_eq!(size("MB3"), Some([4.569, 1.844]));
        assert!(
            ["PM1", "KS4", "KS", "[KS1,KS2]", "KST2", "ks2"].map(size).iter().all(Option::is_none)
        );
    }
}
