//! The leading vehicle, as the CAV's own sensors report it.

use std::f64::consts::FRAC_PI_4;

use mufasa_model::input::cycle::{Lead, Route};

use crate::geometry::{Polyline, direction, dot, norm, wrap};
use crate::recording::object::Seen;

/// Slower than this an object stands, m/s.
const STANDING: f64 = 0.5;

/// What of the CAV a lead is measured from.
pub(crate) struct Cav {
    pub position: [f64; 2],
    pub length: f64,
    pub width: f64,
}

/// The leading vehicle on a route: the nearest object ahead, within `range_m`, whose rectangle
/// reaches into the band of the CAV's width around the reference path, and which drives along
/// the path (within 45 degrees) or stands. Crossing and oncoming traffic is no lead; it is for
/// stages iii to v. The gap is the free distance along the path, bumper to bumper.
pub(crate) fn leading_vehicle(
    route: &Route,
    stamp_ns: i64,
    cav: &Cav,
    objects: &[Seen],
    range_m: f64,
) -> Option<Lead> {
    let mut points: Vec<_> = route.cross_sections.iter().map(|s| [s.x, s.y]).collect();
    if route.closed {
        points.extend(points.first().copied());
    }
    let path = Polyline::new(points);
    let own = path.project(cav.position)?;
    let mut best: Option<Lead> = None;
    for object in objects {
        let Some(place) = path.project(object.shape.center) else { continue };
        let ahead = along(&path, route.closed, own.s, place.s);
        if ahead <= 0.0 || ahead > range_m {
            continue;
        }
        let speed = norm(object.velocity);
        let course = place.tangent[1].atan2(place.tangent[0]);
        if speed >= STANDING && wrap(object.shape.heading - course).abs() > FRAC_PI_4 {
            continue;
        }
        let corners = object.shape.corners();
        let feet: Vec<_> = corners.iter().filter_map(|c| path.project(*c)).collect();
        let low = feet.iter().map(|f| f.lateral).fold(f64::INFINITY, f64::min);
        let high = feet.iter().map(|f| f.lateral).fold(f64::NEG_INFINITY, f64::max);
        if low >= cav.width / 2.0 || high <= -cav.width / 2.0 {
            continue;
        }
        let rear = feet.iter().map(|f| along(&path, route.closed, own.s, f.s));
        let gap = (rear.fold(f64::INFINITY, f64::min) - cav.length / 2.0).max(0.0);
        if best.as_ref().is_none_or(|b| gap < b.gap) {
            let forward = dot(object.velocity, direction(course)).max(0.0);
            best = Some(Lead { stamp_ns, gap, speed: forward });
        }
    }
    best
}

/// How far `s` is ahead of `from` along the path, by the shorter way of a closed one.
fn along(path: &Polyline, closed: bool, from: f64, s: f64) -> f64 {
    let ahead = s - from;
    let round = path.length();
    if closed && ahead < -round / 2.0 {
        ahead + round
    } else if closed && ahead > round / 2.0 {
        ahead - round
    } else {
        ahead
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Rectangle;
    use mufasa_model::input::cycle::CrossSection;

    fn road(closed: bool) -> Route {
        let cross_section = |x: f64| CrossSection { x, y: 0.0, left: [x, 2.0], right: [x, -2.0] };
        Route { closed, cross_sections: vec![cross_section(0.0), cross_section(100.0)] }
    }

    fn object(x: f64, y: f64, heading: f64, speed: f64) -> Seen {
        let shape = Rectangle { center: [x, y], heading, length: 4.0, width: 2.0 };
        let [c, s] = direction(heading);
        Seen { id: 1, shape, velocity: [speed * c, speed * s] }
    }

    #[test]
    fn the_nearest_object_ahead_on_the_path_leads() {
        let cav = Cav { position: [10.0, 0.0], length: 4.0, width: 2.0 };
        let find = |objects: &[Seen]| leading_vehicle(&road(false), 7, &cav, objects, 80.0);
        let cars = [object(60.0, 0.0, 0.0, 9.0), object(30.0, 0.5, 0.0, 5.0)];
        let found = find(&cars).unwrap();
        assert!((found.gap - 16.0).abs() < 1e-9, "{found:?}");
        assert_eq!((found.stamp_ns, found.speed.to_bits()), (7, 5.0_f64.to_bits()));
        // Behind, beside, oncoming, crossing, out of range: none of them leads.
        assert_eq!(find(&[object(2.0, 0.0, 0.0, 5.0)]), None);
        assert_eq!(find(&[object(30.0, 2.1, 0.0, 5.0)]), None);
        assert_eq!(find(&[object(30.0, 0.0, 3.1, 5.0)]), None);
        assert_eq!(find(&[object(30.0, 0.0, 1.5, 5.0)]), None);
        assert_eq!(find(&[object(95.0, 0.0, 0.0, 5.0)]), None);
        // What stands on the path leads whatever its direction.
        assert_eq!(find(&[object(30.0, 0.0, 3.1, 0.0)]).map(|l| l.speed), Some(0.0));
    }
}
