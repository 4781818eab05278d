//! Distances to a polyline (`spec/3-stages.md#stage-ii-trajectory-to-map`).

use crate::numbers::real::Real;
use crate::numbers::vector::Vector;

/// A closed segment from a to b.
pub type Segment = [Vector; 2];

/// Where a point lies beside a polyline.
#[derive(Debug)]
pub struct Beside {
    /// Distance to the polyline, m.
    pub distance: Real,
    /// The first segment at that distance.
    pub nearest: usize,
    /// Distance to each segment, m.
    pub distances: Vec<Real>,
}

/// Where a point lies beside a polyline of at least one segment.
///
/// # Panics
/// If there is no segment.
pub fn beside(point: &Vector, segments: &[Segment]) -> Beside {
    let distances: Vec<Real> =
        segments.iter().map(|segment| distance_to_segment(point, segment)).collect();
    let nearest = distances.iter().enumerate().min_by(|(_, a), (_, b)| a.cmp(b));
    let (nearest, distance) = nearest.expect("a polyline has a segment");
    Beside { distance: distance.clone(), nearest, distances }
}

/// The point of a closed segment that is nearest to a point.
pub fn nearest_point(point: &Vector, [a, b]: &Segment) -> Vector {
    let segment = b - a;
    let (along, squared) = (segment.dot(&(point - a)), segment.squared());
    if along <= Real::zero() {
        a.clone()
    } else if along >= squared {
        b.clone()
    } else {
        a + &segment.scaled(&(along / squared))
    }
}

/// Distance of a point to a closed segment, m.
fn distance_to_segment(point: &Vector, [a, b]: &Segment) -> Real {
    let (segment, offset) = (b - a, point - a);
    let along = segment.dot(&offset);
    let squared = segment.squared();
    if along <= Real::zero() {
        offset.length()
    } else if along >= squared {
        (point - b).length()
    } else {
        (segment.cross(&offset).square() / squared).sqrt()
    }
}
