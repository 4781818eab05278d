//! Paths: arc length, poses, projections and curvature against closed forms.
#![allow(clippy::float_cmp, reason = "ends are held exactly")]

use mufasa_sim::path::{Path, PathError};
use mufasa_sim::pose::Point;

/// A circle of this radius around the origin, counterclockwise, in pieces of one degree.
fn circle(radius: f64, degrees: i32) -> Vec<Point> {
    (0..degrees)
        .map(|degree| {
            let (sin, cos) = libm::sincos(f64::from(degree).to_radians());
            Point::new(radius * cos, radius * sin)
        })
        .collect()
}

#[test]
fn a_circle_has_its_length_and_its_curvature() {
    let path = Path::new(circle(20.0, 361)).unwrap();
    assert!((path.length() - 40.0 * core::f64::consts::PI).abs() < 0.01);
    for s in [2.0, 30.0, 120.0] {
        assert!((path.curvature_at(s) - 0.05).abs() < 1e-4, "{s}");
        let ahead = path.pose_at(s);
        assert!((ahead.at.distance(Point::default()) - 20.0).abs() < 0.01);
        // The tangent of a circle stands across the way to its middle.
        assert!((ahead.at.x * ahead.cos + ahead.at.y * ahead.sin).abs() < 0.01);
    }
}

#[test]
fn a_projection_returns_the_place_it_was_made_from() {
    let path = Path::new(circle(50.0, 180)).unwrap();
    for step in 0..100 {
        let s = path.length() * f64::from(step) / 100.0;
        for left in [-3.0, -0.5, 0.0, 2.0] {
            let place = path.pose_at(s).ahead(0.0, left);
            let seen = path.project(place);
            assert!(
                (seen.s - s).abs() < 0.05 && (seen.left - left).abs() < 0.01,
                "{s} {left} {seen:?}"
            );
            let near = path.project_within(place, s - 5.0, s + 5.0);
            assert_eq!(near, seen);
        }
    }
}

#[test]
fn a_window_keeps_apart_what_crosses() {
    // Out along x, round, and back across itself.
    let corners = [(0.0, 0.0), (100.0, 0.0), (100.0, 50.0), (50.0, 50.0), (50.0, -50.0)];
    let path = Path::new(corners.map(|(x, y)| Point::new(x, y)).to_vec()).unwrap();
    let place = Point::new(50.5, 0.2);
    assert!((path.project(place).s - 50.5).abs() < 1e-9);
    let late = path.project_within(place, 220.0, 280.0);
    assert!(
        (late.s - (100.0 + 50.0 + 50.0 + 49.8)).abs() < 1e-9 && (late.left - 0.5).abs() < 1e-9,
        "{late:?}"
    );
}

#[test]
fn an_open_path_is_held_at_its_ends() {
    let path = Path::new(vec![Point::new(0.0, 0.0), Point::new(10.0, 0.0)]).unwrap();
    assert_eq!(path.pose_at(-5.0).at, Point::new(0.0, 0.0));
    assert_eq!(path.pose_at(15.0).at, Point::new(10.0, 0.0));
    let behind = path.project(Point::new(14.0, 2.0));
    assert_eq!((behind.s, behind.left), (10.0, 2.0));
}

#[test]
fn points_that_are_no_path_are_named() {
    let point = Point::new(1.0, 1.0);
    assert_eq!(Path::new(vec![point]), Err(PathError::TooFew(1)));
    assert_eq!(Path::new(vec![Point::default(), point, point]), Err(PathError::Repeated(2)));
    assert_eq!(Path::new(vec![point, Point::new(f64::NAN, 0.0)]), Err(PathError::NotFinite(1)));
}

#[test]
fn a_place_outside_of_a_corner_is_as_far_as_the_corner() {
    let path =
        Path::new(vec![Point::default(), Point::new(10.0, 0.0), Point::new(10.0, 10.0)]).unwrap();
    let seen = path.project(Point::new(13.0, -4.0));
    assert_eq!((seen.s, seen.left), (10.0, -5.0));
}

/// The nearest of all pieces, each looked at: slow and plain.
fn nearest(path: &Path, place: Point) -> f64 {
    let points = path.points();
    let distance = |from: Point, to: Point| {
        let (dx, dy) = (to.x - from.x, to.y - from.y);
        let share = ((place.x - from.x) * dx + (place.y - from.y) * dy) / (dx * dx + dy * dy);
        let share = share.clamp(0.0, 1.0);
        place.distance(Point::new(from.x + share * dx, from.y + share * dy))
    };
    points.windows(2).map(|it| distance(it[0], it[1])).fold(f64::INFINITY, f64::min)
}

#[test]
fn what_is_skipped_was_not_the_nearest() {
    // A rose: it winds, and crosses itself.
    let rose: Vec<Point> = (0..700)
        .map(|i| {
            let angle = f64::from(i) * 0.009 + 1e-4;
            let reach = 40.0 * libm::cos(3.0 * angle) + 3.0 * libm::sin(17.0 * angle);
            Point::new(reach * libm::cos(angle), reach * libm::sin(angle))
        })
        .collect();
    let path = Path::new(rose).unwrap();
    for step in 0..2000 {
        let place = Point::new(
            f64::from(step * 37 % 1001) * 0.1 - 50.0,
            f64::from(step * 91 % 997) * 0.1 - 50.0,
        );
        let least = nearest(&path, place);
        let seen = path.project(place);
        let found = path.pose_at(seen.s).at.distance(place);
        assert!((found - least).abs() < 1e-6, "{place:?} {found} {least}");
        let near = path.project_near(place, 0.0, path.length(), 5.0);
        assert_eq!(near, (least < 5.0).then_some(seen), "{place:?} {least}");
    }
}
