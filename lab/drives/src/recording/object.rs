//! Things on the road over time, and where they are at an instant.

use std::collections::BTreeMap;

use crate::geometry::{Point, Rectangle, add, direction, mix, mix_angle, scale};

/// A thing on the road.
#[derive(Clone, Debug)]
pub(crate) struct Object {
    pub id: i64,
    /// `car`, `truck`, `pedestrian`, as the source says it.
    pub kind: String,
    pub footprint: Footprint,
    pub motion: Motion,
}

/// A rectangle in the frame of an object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Footprint {
    pub length: f64,
    pub width: f64,
    pub center: Point,
    pub turn: f64,
}

impl Footprint {
    /// The rectangle on the road of an object at a pose.
    pub(crate) fn at(&self, position: Point, heading: f64) -> Rectangle {
        let [c, s] = direction(heading);
        let [x, y] = self.center;
        Rectangle {
            center: add(position, [x * c - y * s, x * s + y * c]),
            heading: heading + self.turn,
            length: self.length,
            width: self.width,
        }
    }
}

/// Pose and speed at a time step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct State {
    pub step: i64,
    pub position: Point,
    pub heading: f64,
    pub speed: f64,
    /// From the heading to the direction of motion.
    pub slip: f64,
}

/// Where an object is when.
#[derive(Clone, Debug)]
pub(crate) enum Motion {
    /// At one place, always.
    Standing(State),
    /// At the steps of these states, in their order.
    Moving(Vec<State>),
    /// At `initial`, then somewhere in the places of each step.
    Occupied { initial: State, places: BTreeMap<i64, Vec<Rectangle>> },
}

/// A thing at an instant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    pub id: i64,
    pub shape: Rectangle,
    pub velocity: Point,
}

/// Ids of the second and further places of a set are the id plus a multiple of this.
const PLACE: i64 = 1 << 40;

impl Object {
    /// What there is of the object at time step `step`, `back` steps (0 to 1) before it; before
    /// its first state it is extrapolated backwards, between two states interpolated.
    pub(crate) fn seen(&self, step: i64, back: f64, dt_s: f64) -> Vec<Seen> {
        match &self.motion {
            Motion::Standing(state) => vec![self.at_state(state, [0.0, 0.0])],
            Motion::Moving(states) => state_before(states, step, back, dt_s)
                .map_or_else(Vec::new, |s| {
                    vec![self.at_state(&s, scale(direction(s.heading + s.slip), s.speed))]
                }),
            Motion::Occupied { initial, .. } if initial.step == step => {
                let velocity = scale(direction(initial.heading + initial.slip), initial.speed);
                let mut seen = self.at_state(initial, velocity);
                seen.shape.center = add(seen.shape.center, scale(velocity, -back * dt_s));
                vec![seen]
            }
            Motion::Occupied { places, .. } => {
                let here = places.get(&step).map_or(&[][..], Vec::as_slice);
                let ids = (0..).map(|i: i64| self.id.wrapping_add(i.wrapping_mul(PLACE)));
                here.iter()
                    .zip(ids)
                    .map(|(shape, id)| Seen { id, shape: *shape, velocity: [0.0, 0.0] })
                    .collect()
            }
        }
    }

    fn at_state(&self, state: &State, velocity: Point) -> Seen {
        let shape = self.footprint.at(state.position, state.heading);
        Seen { id: self.id, shape, velocity }
    }
}

/// The state `back` steps before the one at `step`; `None` when there is no state at `step`.
pub(crate) fn state_before(states: &[State], step: i64, back: f64, dt_s: f64) -> Option<State> {
    let i = states.binary_search_by_key(&step, |s| s.step).ok()?;
    let now = states[i];
    let last = i.checked_sub(1).map(|j| states[j]).filter(|last| last.step == step - 1);
    let Some(last) = last else {
        let way = scale(direction(now.heading + now.slip), -now.speed * back * dt_s);
        return Some(State { position: add(now.position, way), ..now });
    };
    Some(State {
        step,
        position: mix(now.position, last.position, back),
        heading: mix_angle(now.heading, last.heading, back),
        speed: now.speed + back * (last.speed - now.speed),
        slip: now.slip,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::distance;

    fn state(step: i64, x: f64, speed: f64) -> State {
        State { step, position: [x, 0.0], heading: 0.0, speed, slip: 0.0 }
    }

    #[test]
    fn an_object_is_where_its_states_say_and_nowhere_else() {
        let footprint = Footprint { length: 4.0, width: 2.0, center: [1.0, 0.0], turn: 0.0 };
        let motion = Motion::Moving(vec![state(3, 0.0, 10.0), state(4, 1.0, 12.0)]);
        let object = Object { id: 5, kind: String::new(), footprint, motion };
        assert!(object.seen(2, 0.0, 0.1).is_empty() && object.seen(5, 0.0, 0.1).is_empty());
        let first = object.seen(3, 0.5, 0.1);
        assert!(distance(first[0].shape.center, [0.5, 0.0]) < 1e-12);
        let second = object.seen(4, 0.5, 0.1);
        assert!(distance(second[0].shape.center, [1.5, 0.0]) < 1e-12);
        assert!(distance(second[0].velocity, [11.0, 0.0]) < 1e-12);
    }
}
