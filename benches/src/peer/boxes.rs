//! Stages iii and iv: oriented boxes by `parry2d-f64`, after a test of the centres' distance.

use mufasa::input::cycle::{Cycle, TrajectoryPoint};
use mufasa::report::Stage;
use parry2d_f64::math::{Pose, Rotation, Vector};
use parry2d_f64::query::details::intersection_test_cuboid_cuboid;
use parry2d_f64::shape::Cuboid;

use super::{Peer, braking, within};

/// One way for each of the two stages.
pub fn peers<'a>(cycle: &'a Cycle<'a>) -> Vec<Peer<'a>> {
    let peer = |stage, decide: fn(&Cycle<'_>) -> bool| Peer {
        name: "parry2d after centres",
        stage,
        decide: Box::new(move || decide(std::hint::black_box(cycle))),
    };
    vec![peer(Stage::Iii, tracks), peer(Stage::Iv, detections)]
}

/// An object as the library wants it, with its velocity.
struct Object {
    centre: Vector,
    rotation: Rotation,
    cuboid: Cuboid,
    velocity: Vector,
}

fn tracks(cycle: &Cycle<'_>) -> bool {
    let (Some(trajectory), Some(list)) = (cycle.trajectory, cycle.tracks) else { return true };
    let objects: Vec<Object> = list
        .items
        .iter()
        .map(|track| Object {
            centre: Vector::new(track.x, track.y),
            rotation: rotation(track.cos, track.sin),
            cuboid: cuboid(track.length, track.width),
            velocity: Vector::new(track.vx, track.vy),
        })
        .collect();
    let horizon = cycle.parameters.safety_time * cycle.ego.speed;
    let points = within(trajectory.points, horizon);
    free(cycle, points, &objects, |point| seconds(point.t_ns - list.stamp_ns))
}

fn detections(cycle: &Cycle<'_>) -> bool {
    let (Some(trajectory), Some(list)) = (cycle.trajectory, cycle.detections) else {
        return true;
    };
    let objects: Vec<Object> = list
        .items
        .iter()
        .map(|detection| Object {
            centre: Vector::new(detection.x, detection.y),
            rotation: rotation(detection.cos, detection.sin),
            cuboid: cuboid(detection.length, detection.width),
            velocity: Vector::ZERO,
        })
        .collect();
    free(cycle, within(trajectory.points, braking(cycle)), &objects, |_| 0.0)
}

fn free(
    cycle: &Cycle<'_>,
    points: &[TrajectoryPoint],
    objects: &[Object],
    dt: impl Fn(&TrajectoryPoint) -> f64,
) -> bool {
    let ego = cuboid(cycle.ego.length, cycle.ego.width);
    let theta_squared = cycle.parameters.theta_obj * cycle.parameters.theta_obj;
    points.iter().all(|point| {
        let shift = Vector::new(point.cos, point.sin) * cycle.ego.center_offset;
        let centre = Vector::new(point.x, point.y) + shift;
        let cav = Pose::from_parts(centre, rotation(point.cos, point.sin));
        let dt = dt(point);
        objects.iter().all(|object| {
            let moved = object.centre + object.velocity * dt;
            if (moved - centre).length_squared() >= theta_squared {
                return true;
            }
            let relative = cav.inv_mul(&Pose::from_parts(moved, object.rotation));
            !intersection_test_cuboid_cuboid(&relative, &ego, &object.cuboid)
        })
    })
}

fn rotation(cos: f64, sin: f64) -> Rotation {
    Rotation::from_cos_sin_unchecked(cos, sin)
}

fn cuboid(length: f64, width: f64) -> Cuboid {
    Cuboid::new(Vector::new(0.5 * length, 0.5 * width))
}

#[expect(clippy::cast_precision_loss, reason = "times of a few seconds")]
fn seconds(ns: i64) -> f64 {
    ns as f64 / 1e9
}
