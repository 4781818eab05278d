//! What passes by touches the CAV at no point, and what touches it comes from where it is looked for.

use std::vec::Vec;

use super::Pursuit;
use crate::input::cycle::{Ego, TrajectoryPoint};
use crate::numbers::rectangle::possibly_touch;
use crate::random::Random;
use crate::stages::llcc::Moving;
use crate::stages::llcc::sweep::MovingRectangle;

/// The CAV at 12 m/s, along a line or a bow, or where it jumps farther than anything drives.
fn points(random: &mut Random, far: f64, first_ns: i64) -> Vec<TrajectoryPoint> {
    let ([cos, sin], bow) = (random.direction(), random.number(0.3));
    let step = [1.2, 0.0, 1.2, 500.0][usize::try_from(random.below(4)).unwrap_or(0)];
    let place = |i: i64| {
        let (along, aside) = (step * i as f64, bow * (i * i) as f64);
        let [x, y] = [far + along * cos - aside * sin, -far + along * sin + aside * cos];
        TrajectoryPoint { t_ns: first_ns + i * 100_000_000, x, y, cos, sin }
    };
    (0..6).map(place).collect()
}

#[test]
fn what_misses_the_pursuit_does_not_touch() {
    let mut random = Random::new(5);
    let (mut missed, mut touching) = (0, 0);
    for round in 0..40_000 {
        let far = [0.0, 1e7][round % 2];
        let center_offset = random.number(2.0);
        let (x, y, cos, sin, speed) = (far, -far, 1.0, 0.0, 5.0);
        let ego = Ego { x, y, cos, sin, speed, length: 4.8, width: 1.9, center_offset };
        let first_ns = [0, -50_000_000, 300_000_000][round % 3];
        let points = points(&mut random, far, first_ns);
        let object = MovingRectangle {
            centre: [random.number(15.0) + far, random.number(15.0) - far],
            direction: random.direction(),
            velocity: [random.number(30.0), random.number(30.0)],
            size: [3.0 + random.number(2.9), 2.0 + random.number(1.9)],
        };
        let seconds = |point: &TrajectoryPoint| point.t_ns as f64 * 1e-9;
        let pursuit = Pursuit::new(points.iter().map(|point| (ego, point, seconds(point))));
        let passing = pursuit.passing(&object);
        let misses = passing.misses(object.velocity);
        missed += u32::from(misses);
        let [from, to] = passing.window(object.velocity);
        let age = 0.5;
        let box_of_items = pursuit.comes_from(&object, 43.0, age);
        for point in &points {
            let cav = MovingRectangle::footprint(&ego, point);
            if possibly_touch(&cav.exactly(0), &object.exactly(point.t_ns)) {
                touching += 1;
                assert!(!misses, "{object:?} {point:?}");
                assert!(from <= seconds(point) && seconds(point) <= to, "{object:?} {point:?}");
                let [x, y] = object.centre;
                let [vx, vy] = object.velocity;
                let before = [x - vx * age, y - vy * age];
                for ([least, greatest], before) in box_of_items.into_iter().zip(before) {
                    assert!(least <= before && before <= greatest, "{object:?} {point:?}");
                }
            }
        }
    }
    assert!(missed > 5_000 && touching > 4_000, "{missed} {touching}");
}
