//! H-10: beside stage iii an explained detection counts as standing within s_stop only: what it is seen
//! to do is examined by H-13.

use crate::hardened::detection_history::confirmed;
use crate::hardened::h04_horizon::{Places, places_to_s_stop};
use crate::input::scene::{Detections, Object, Point, Scene};
use crate::numbers::real::Real;
use crate::report::{Rule, Witness};
use crate::stages::llcc::first_collision;

/// The first collision with a detection as standing: with any within s_stop, with those that are not
/// explained at `places`.
pub fn collision(
    scene: &Scene,
    trajectory: &[Point],
    detections: &Detections,
    places: &Places,
) -> Option<Witness> {
    let confirmed = confirmed(scene);
    let is_explained = |d: &usize| confirmed.iter().any(|(_, seen)| seen.detection == Some(*d));
    let (explained, others): (Vec<usize>, Vec<usize>) =
        (0..detections.items.len()).partition(is_explained);
    let to_s_stop = places_to_s_stop(scene, trajectory, &Real::zero());
    let first = |places: &Places, indices: &[usize]| {
        let object = |_: &Point, d: &usize| -> Object { detections.items[*d].clone() };
        let (j, witness) = first_collision(scene, Rule::Collision, places.iter(), indices, object)?;
        Some(Witness { detection: Some(indices[j]), ..witness })
    };
    let found = [first(&to_s_stop, &explained), first(places, &others)];
    found.into_iter().flatten().min_by_key(|witness| (witness.point, witness.detection))
}
