//! What is seen, what is not, and how wrong it is.

use core::f64::consts::{FRAC_PI_2, TAU};

use mufasa_sim::pose::{Point, Pose};
use mufasa_sim::services::detectors::scan::Sweep;
use mufasa_sim::services::detectors::seen::Seen;
use mufasa_sim::services::detectors::{Detector, Errors, Mount, Observer};

use super::scene::car;

const ORIGIN: Pose = Pose { at: Point { x: 0.0, y: 0.0 }, cos: 1.0, sin: 0.0 };

fn at(x: f64, y: f64) -> Pose {
    Pose::new(Point::new(x, y), 0.0)
}

/// Places that a lidar detects, without errors.
fn places(objects: &[Seen]) -> Vec<(f64, f64)> {
    let lidar = Detector {
        mount: Mount::Vehicle(0.0),
        sweep: Sweep::new(60.0, TAU, 720),
        errors: Errors::NONE,
    };
    let observer = Observer { seed: [1, 1], detectors: vec![lidar], merge_radius: 1.0 };
    let seen = observer.observe(objects, ORIGIN, 0);
    seen.detections.iter().map(|it| (it.x, it.y)).collect()
}

#[test]
fn an_object_behind_another_is_not_seen() {
    let (near, behind, beside) =
        (car(1, at(10.0, 0.0), 0.0), car(2, at(20.0, 0.0), 0.0), car(3, at(20.0, 5.0), 0.0));
    assert_eq!(places(&[near, behind, beside]), [(10.0, 0.0), (20.0, 5.0)]);
    assert_eq!(places(&[behind, beside]), [(20.0, 0.0), (20.0, 5.0)]);
}

#[test]
fn nothing_is_seen_beside_the_field_of_view() {
    let front = Detector {
        mount: Mount::Vehicle(0.0),
        sweep: Sweep::new(80.0, FRAC_PI_2, 180),
        errors: Errors::NONE,
    };
    let observer = Observer { seed: [1, 1], detectors: vec![front], merge_radius: 1.0 };
    let objects =
        [car(1, at(20.0, 10.0), 0.0), car(2, at(10.0, 20.0), 0.0), car(3, at(-10.0, 0.0), 0.0)];
    for angle in [0.0, 1.0, 3.0, -2.0] {
        // The same scene turned as a whole, so that the seam of the angles is somewhere else.
        let frame = Pose::new(Point::new(100.0, -50.0), angle);
        let turned = objects.map(|object| {
            let Point { x, y } = object.rectangle.pose.at;
            car(object.id, Pose::new(frame.ahead(x, y), angle), 0.0)
        });
        let seen = observer.observe(&turned, frame, 0);
        let seen: Vec<_> =
            seen.detections.iter().map(|it| frame.local(Point::new(it.x, it.y))).collect();
        assert_eq!(seen.len(), 1, "{angle}: {seen:?}");
        assert!((seen[0].0 - 20.0).abs() < 1e-9 && (seen[0].1 - 10.0).abs() < 1e-9);
    }
}

#[test]
fn errors_have_their_size_and_misses_their_rate() {
    let errors = Errors { missed: 0.2, ..Errors::default() };
    let lidar = Detector { mount: Mount::Vehicle(0.0), sweep: Sweep::new(60.0, TAU, 360), errors };
    let observer = Observer { seed: [7, 1], detectors: vec![lidar], merge_radius: 1.0 };
    let objects = [car(1, at(20.0, 3.0), 0.0)];
    let (mut count, mut squares) = (0.0, [0.0; 4]);
    for cycle in 0..4000 {
        let seen = observer.observe(&objects, ORIGIN, cycle);
        for it in seen.detections {
            count += 1.0;
            let off = [it.x - 20.0, it.y - 3.0, libm::atan2(it.sin, it.cos), it.length - 4.5];
            (0..4).for_each(|index| squares[index] += off[index] * off[index]);
        }
    }
    // 3200 expected; the standard deviation of the count is 25, that of each of the others 1.3 percent.
    assert!((3100.0..3300.0).contains(&count), "{count}");
    for (square, sigma) in squares.iter().zip([0.05, 0.05, 0.02, 0.05]) {
        let measured = (square / count).sqrt();
        assert!((measured / sigma - 1.0).abs() < 0.06, "{measured} for {sigma}");
    }
}
