//! H-13 (c): farther on, stage iv examines as moving what the CAV may not wait for.

use crate::hardened::h04_horizon::Places;
use crate::hardened::h13_moving::seen_twice::{Pair, object_at};
use crate::input::scene::{Detections, Point, Scene};
use crate::numbers::real::Real;
use crate::numbers::rectangle::{Rectangle, is_swept_over};
use crate::report::{Rule, Witness};
use crate::stages::llcc::{centre, first_collision};

/// The first collision at the points behind the `places`, with the pairs that are examined there: one
/// point after the other, as long as the CAV may not wait at the point before; and none where it may
/// not wait at the first point either.
pub fn collision_beyond<'a>(
    scene: &Scene,
    trajectory: &[Point],
    detections: &Detections,
    places: &Places,
    pairs: &[Pair<'a>],
) -> Option<(Pair<'a>, Witness)> {
    let count = places.count_points();
    let mut examined: Vec<Pair> = pairs.to_vec();
    examined.retain(|pair| may_wait(scene, detections, pair, &trajectory[0], Margin::First));
    (count..trajectory.len()).find_map(|i| {
        let before = &trajectory[i - 1];
        examined.retain(|pair| !may_wait(scene, detections, pair, before, Margin::Later));
        let point = std::iter::once(trajectory[i].clone());
        let object = |point: &Point, pair: &Pair| object_at(detections, pair, point);
        let (j, witness) = first_collision(scene, Rule::CollisionMoving, point, &examined, object)?;
        Some((examined[j], witness.at_point(i)))
    })
}

/// Which way the margin moves the CAV's rectangle: what may not wait at the first point is examined
/// less, what may not wait at a later one more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Margin {
    /// At the first point: - m.
    First,
    /// At a later point: + m.
    Later,
}

/// The CAV may wait at a point: its rectangle there and that of the object share no point at any
/// time from then on.
pub fn may_wait(
    scene: &Scene,
    detections: &Detections,
    pair: &Pair,
    point: &Point,
    margin: Margin,
) -> bool {
    let half = |half: &Real| match margin {
        Margin::First => scene.reads.lowered(half),
        Margin::Later => scene.reads.raised(half),
    };
    let cav = Rectangle::new(centre(scene, point), &scene.ego.length, &scene.ego.width);
    let w = pair.velocity(&detections.items[pair.detection]);
    !is_swept_over(&cav.with_halves(half), &object_at(detections, pair, point).rectangle(), &w)
}
