//! Whatever plain doubles call apart is apart by the error bounds of `rectangle`.

use std::vec::Vec;

use super::{MovingRectangle, Sweep};
use crate::input::cycle::{Ego, TrajectoryPoint};
use crate::numbers::plane::Vector;
use crate::numbers::rectangle::{Rectangle, possibly_touch};
use crate::numbers::rounding::Real;
use crate::random::Random;

fn rectangle(moving: &MovingRectangle, t_ns: i64) -> Rectangle {
    let vector = |[x, y]: [f64; 2]| Vector::new(x, y);
    let moved = vector(moving.velocity).times(Real::seconds(t_ns));
    let [length, width] = moving.size;
    let direction = vector(moving.direction);
    Rectangle { centre: vector(moving.centre) + moved, direction, length, width }
}

fn object(random: &mut Random, far: f64) -> MovingRectangle {
    MovingRectangle {
        centre: [random.number(12.0) + far, random.number(12.0) - far],
        direction: random.direction(),
        velocity: [random.number(20.0), random.number(20.0)],
        size: [3.0 + random.number(2.9), 2.0 + random.number(1.9)],
    }
}

#[test]
fn what_is_certainly_apart_does_not_touch() {
    let mut random = Random::new(11);
    let (mut apart, mut missed, mut touching) = (0, 0, 0);
    for round in 0..20_000 {
        let far = [0.0, 1e7][round % 2];
        let ego = Ego {
            x: far,
            y: -far,
            cos: 1.0,
            sin: 0.0,
            speed: 5.0,
            length: 4.8,
            width: 1.9,
            center_offset: random.number(2.0),
        };
        let (sin, cos) = random.number(3.2).sin_cos();
        let points: Vec<TrajectoryPoint> = (0..4_i64)
            .map(|i| {
                let turn = random.number(0.3);
                let [x, y] = [far + cos * i as f64, -far + sin * i as f64];
                let (sin, cos) = (sin + turn, cos - turn);
                let norm = sin.hypot(cos);
                TrajectoryPoint { t_ns: i * 100_000_000, x, y, cos: cos / norm, sin: sin / norm }
            })
            .collect();
        let object = object(&mut random, far);
        let sweep = Sweep::new(&ego, &points, [0.0, 0.3]);
        let misses = sweep.misses(&object);
        missed += u32::from(misses);
        for point in &points {
            let cav = MovingRectangle::footprint(&ego, point);
            let exact = rectangle(&object, point.t_ns);
            let touches = possibly_touch(&rectangle(&cav, 0), &exact);
            let seconds = point.t_ns as f64 / 1e9;
            let certain = cav.certainly_apart(&object, seconds);
            assert!(!(touches && (misses || certain)), "{object:?} {point:?}");
            // The centre of the CAV's rectangle rounds at far places; the object's is given.
            let far = cav.certainly_far(&object, seconds, 5.0);
            let centres = (exact.centre - rectangle(&cav, 0).centre).norm();
            assert!(!far || !centres.possibly_at_most(Real::new(5.0)));
            apart += u32::from(certain);
            touching += u32::from(touches);
        }
    }
    assert!(apart > 10_000 && missed > 2_000 && touching > 4_000, "{apart} {missed} {touching}");
}

#[test]
fn what_is_certainly_contained_is_inside() {
    let mut random = Random::new(12);
    let (mut inside, mut off) = (0, 0);
    for round in 0..20_000 {
        let far = [0.0, 1e7][round % 2];
        let it = object(&mut random, far);
        let point = [it.centre[0] + random.number(2.0), it.centre[1] + random.number(2.0)];
        let at = Vector::between(it.centre, point);
        let direction = Vector::new(it.direction[0], it.direction[1]);
        let norm_squared = direction.dot(direction);
        let parts = [at.dot(direction), direction.cross(at)].map(Real::abs).into_iter();
        let is_within = |(part, size): (Real, f64)| {
            part.over(norm_squared).certainly_at_most(Real::new(0.5 * size))
        };
        let is_inside = parts.zip(it.size).all(is_within);
        let certain = it.certainly_contains(point);
        assert!(is_inside || !certain, "{it:?} {point:?}");
        // Few are within a margin of a side.
        inside += u32::from(certain);
        off += u32::from(is_inside && !certain);
    }
    assert!(inside > 2_000 && off < 5, "{inside} {off}");
    // At a side: a direction that is shorter than 1 makes the rectangle smaller.
    let it = MovingRectangle { direction: [1.0 - 4e-7, 0.0], ..object(&mut random, 0.0) };
    let it = MovingRectangle { centre: [0.0; 2], size: [100.0, 100.0], ..it };
    assert!(it.certainly_contains([49.999, 49.999]) && !it.certainly_contains([49.999_99, 0.0]));
}
