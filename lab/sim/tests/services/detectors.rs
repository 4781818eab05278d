//! What is seen, what is not, and how wrong it is.

use core::f64::consts::{FRAC_PI_2, TAU};

use mufasa_sim::pose::{Point, Pose, Rectangle};
use mufasa_sim::services::detectors::lead::{Front, measured_lead};
use mufasa_sim::services::detectors::random::Draws;
use mufasa_sim::services::detectors::scan::{Met, Sweep};
use mufasa_sim::services::detectors::scene::{Scene, Seen};
use mufasa_sim::services::detectors::{Detector, Errors, Mount, Observer};

use super::scene::{car, straight, vehicle};

const ORIGIN: Pose = Pose { at: Point { x: 0.0, y: 0.0 }, cos: 1.0, sin: 0.0 };

fn at(x: f64, y: f64) -> Pose {
    Pose::new(Point::new(x, y), 0.0)
}

/// Places that a lidar detects, without errors.
fn places(objects: &[Seen], walls: &[Rectangle]) -> Vec<(f64, f64)> {
    let lidar = Detector {
        mount: Mount::Vehicle(0.0),
        sweep: Sweep::new(60.0, TAU, 720),
        errors: Errors::NONE,
    };
    let observer = Observer { seed: [1, 1], detectors: vec![lidar], merge_radius: 1.0 };
    let seen = observer.observe(&Scene { objects, walls }, ORIGIN, None, 0);
    seen.detections.iter().map(|it| (it.x, it.y)).collect()
}

#[test]
fn an_object_behind_another_is_not_seen() {
    let (near, behind, beside) =
        (car(1, at(10.0, 0.0), 0.0), car(2, at(20.0, 0.0), 0.0), car(3, at(20.0, 5.0), 0.0));
    assert_eq!(places(&[near, behind, beside], &[]), [(10.0, 0.0), (20.0, 5.0)]);
    assert_eq!(places(&[behind, beside], &[]), [(20.0, 0.0), (20.0, 5.0)]);
}

#[test]
fn a_wall_hides_and_is_no_detection() {
    let wall = Rectangle { pose: at(10.0, 0.0), length: 1.0, width: 10.0 };
    let (behind, before) = (car(1, at(20.0, 0.0), 0.0), car(2, at(5.0, 0.0), 0.0));
    assert_eq!(places(&[behind, before], &[wall]), [(5.0, 0.0)]);
}

#[test]
fn nothing_is_seen_beyond_the_range() {
    let (in_range, out) = (car(1, at(60.0, 0.0), 0.0), car(2, at(-63.0, 0.0), 0.0));
    assert_eq!(places(&[in_range, out], &[]), [(60.0, 0.0)]);
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
        let seen = observer.observe(&Scene { objects: &turned, walls: &[] }, frame, None, 0);
        let seen: Vec<_> =
            seen.detections.iter().map(|it| frame.local(Point::new(it.x, it.y))).collect();
        assert_eq!(seen.len(), 1, "{angle}: {seen:?}");
        assert!((seen[0].0 - 20.0).abs() < 1e-9 && (seen[0].1 - 10.0).abs() < 1e-9);
    }
}

#[test]
fn rays_say_the_distance_to_the_visible_edge() {
    let objects = [car(1, at(20.0, 0.0), 0.0)];
    let scan =
        Sweep::new(60.0, TAU, 360).scan(&Scene { objects: &objects, walls: &[] }, ORIGIN, None);
    let met: Vec<_> = scan.rays.iter().filter(|ray| ray.met != Met::Nothing).collect();
    // 1.8 m at 17.75 m are 5.8 degrees.
    assert!((5..=7).contains(&met.len()), "{}", met.len());
    for ray in met {
        assert!((ray.distance * ray.cos - 17.75).abs() < 1e-9);
    }
    assert!(scan.rays.iter().all(|ray| ray.met != Met::Nothing || ray.distance == 60.0));
}

#[test]
fn errors_have_their_size_and_misses_their_rate() {
    let errors = Errors { missed: 0.2, ..Errors::default() };
    let lidar = Detector { mount: Mount::Vehicle(0.0), sweep: Sweep::new(60.0, TAU, 360), errors };
    let observer = Observer { seed: [7, 1], detectors: vec![lidar], merge_radius: 1.0 };
    let objects = [car(1, at(20.0, 3.0), 0.0)];
    let (mut count, mut squares) = (0.0, [0.0; 4]);
    for cycle in 0..4000 {
        let seen = observer.observe(&Scene { objects: &objects, walls: &[] }, ORIGIN, None, cycle);
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

#[test]
fn nobody_detects_those_that_all_are_blind_for_and_rays_meet_them() {
    let errors = Errors { missed: 0.0, blind: 0.25, ..Errors::default() };
    let seen = |who: u64, id: u32, cycle: u64, errors: Errors| {
        let lidar =
            Detector { mount: Mount::Vehicle(0.0), sweep: Sweep::new(60.0, TAU, 360), errors };
        let observer = Observer { seed: [7, who], detectors: vec![lidar], merge_radius: 1.0 };
        let objects = [car(id, at(20.0, 3.0), 0.0)];
        let scene = Scene { objects: &objects, walls: &[] };
        let observation = observer.observe(&scene, ORIGIN, None, cycle);
        assert!(observation.scans[0].rays.iter().any(|ray| ray.met != Met::Nothing));
        !observation.detections.is_empty()
    };
    let mut blind = 0;
    for id in 0..400 {
        let first = seen(1, id, 0, errors);
        assert!([(1, 5), (3, 0), (3, 9)].iter().all(|it| seen(it.0, id, it.1, errors) == first));
        assert!(seen(1, id, 0, Errors { blind: 0.0, ..errors }));
        blind += i32::from(!first);
    }
    // 100 expected; the standard deviation is 9.
    assert!((60..140).contains(&blind), "{blind}");
}

#[test]
fn clutter_has_its_rate_and_stays_within_the_range() {
    let errors = Errors { clutter: 0.5, ..Errors::default() };
    let lidar = Detector { mount: Mount::Vehicle(0.0), sweep: Sweep::new(60.0, TAU, 90), errors };
    let observer = Observer { seed: [8, 1], detectors: vec![lidar], merge_radius: 1.0 };
    let (mut count, mut inner) = (0, 0);
    for cycle in 0..4000 {
        for it in
            observer.observe(&Scene { objects: &[], walls: &[] }, ORIGIN, None, cycle).detections
        {
            let distance = Point::default().distance(Point::new(it.x, it.y));
            assert!(distance < 60.5, "{distance}");
            count += 1;
            inner += i32::from(distance < 30.0);
        }
    }
    assert!((1850..2150).contains(&count), "{count}");
    // A quarter of the area.
    assert!((430..570).contains(&inner), "{inner} of {count}");
}

#[test]
fn draws_about_an_object_do_not_depend_on_others() {
    let observer = vehicle(3, Errors::default());
    let (first, second) = (car(1, at(20.0, 3.0), 0.0), car(2, at(-20.0, 3.0), 0.0));
    let seen = |objects: &[Seen], cycle| {
        observer.observe(&Scene { objects, walls: &[] }, ORIGIN, None, cycle).detections
    };
    let both = seen(&[first, second], 5);
    assert_eq!(both.len(), 2);
    assert!(both.contains(&seen(&[first], 5)[0]) && both.contains(&seen(&[second], 5)[0]));
    assert_ne!(seen(&[first], 5), seen(&[first], 6));
}

#[test]
fn detections_of_two_detectors_become_one_and_nobody_reports_the_one_who_asks() {
    let mut observer = vehicle(3, Errors { missed: 0.0, ..Errors::default() });
    let (own, other) = (car(0, ORIGIN, 0.0), car(1, at(20.0, 1.0), 0.0));
    let camera = Detector {
        mount: Mount::Fixed(Pose::new(Point::new(10.0, 20.0), -FRAC_PI_2)),
        sweep: Sweep::new(50.0, 2.5, 300),
        errors: Errors { missed: 0.0, ..Errors::default() },
    };
    observer.detectors.push(camera);
    let objects = [own, other];
    let scene = Scene { objects: &objects, walls: &[] };
    let mut square = 0.0;
    for cycle in 0..500 {
        let seen = observer.observe(&scene, ORIGIN, Some(0), cycle);
        assert_eq!(seen.detections.len(), 1);
        assert_eq!(seen.scans.len(), 3);
        square += (seen.detections[0].x - 20.0) * (seen.detections[0].x - 20.0);
    }
    // The mean of three: 0.05 m by the root of three.
    let sigma = (square / 500.0).sqrt();
    assert!((0.025..0.033).contains(&sigma), "{sigma}");
    assert_eq!(observer.observe(&scene, ORIGIN, None, 1).detections.len(), 2);
}

#[test]
fn the_lead_is_the_nearest_vehicle_in_the_lane_bumper_to_bumper() {
    let path = straight();
    let front = Front { s: 0.0, ahead: 3.8, half_width: 1.25 };
    let lead = |objects: &[Seen]| {
        let scene = Scene { objects, walls: &[] };
        let scan = Sweep::new(90.0, 0.7, 140).scan(&scene, at(3.8, 0.0), None);
        let mut draws = Draws::new([0; 4]);
        measured_lead(&scene, &scan, &path, front, 0.0, &mut draws)
    };
    let crossing = car(4, Pose::new(Point::new(20.0, 0.0), FRAC_PI_2), 8.0);
    let (beside, near, far) =
        (car(1, at(15.0, 3.0), 9.0), car(2, at(30.0, 0.3), 7.0), car(3, at(45.0, 0.0), 0.0));
    let found = lead(&[beside, near, far]).expect("a lead");
    assert!((found.gap - (30.0 - 2.25 - 3.8)).abs() < 1e-9, "{found:?}");
    assert!((found.speed - 7.0).abs() < 1e-9);
    // One that crosses leads nobody, and one that comes closer than the front has no gap below 0.
    assert_eq!(lead(&[beside, crossing]), None);
    assert_eq!(lead(&[beside]), None);
    assert_eq!(lead(&[car(5, at(5.0, 0.0), 0.0)]).map(|lead| lead.gap), Some(0.0));
}

#[test]
fn what_lies_across_the_seam_of_the_angles_is_met_from_both_ends() {
    let met = |x: f64| {
        let objects = [car(1, at(x, 0.0), 0.0)];
        let scene = Scene { objects: &objects, walls: &[] };
        let scan = Sweep::new(60.0, TAU, 720).scan(&scene, ORIGIN, None);
        scan.rays.iter().filter(|ray| ray.met != Met::Nothing).count()
    };
    assert!(met(20.0) > 8);
    assert_eq!(met(20.0), met(-20.0));
}
