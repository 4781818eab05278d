//! The road: no place is outside the corridor (`spec/hardened/H-14.md#requirements-the-road`).

use crate::hardened::h14_fail_safe::path::places;
use crate::input::scene::Scene;
use crate::numbers::polyline::beside;
use crate::numbers::real::Real;
use crate::report::{Rule, Witness};
use crate::stages::ii_trajectory_to_map::OnMap;

/// A place other than p is not inside the corridor.
pub fn failure(scene: &Scene, map: &OnMap) -> Option<Witness> {
    let mut places =
        places(scene, map.trajectory).map(|place| place.pose.origin).enumerate().skip(1);
    let (k, place) = places.find(|(_, place)| !map.holds_place(scene, place))?;
    let beside = beside(&place, &map.path);
    let witness = Witness::new(Rule::Corridor, &beside.distance, &Real::zero());
    Some(Witness { segment: Some(beside.nearest), ..witness.at_point(map.trajectory.len() + k) })
}
