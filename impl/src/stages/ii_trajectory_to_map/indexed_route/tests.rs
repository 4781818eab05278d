//! Borders and shared edges of the corridor, and the reference path.

use super::{IndexedRoute, Segment};
use crate::input::cycle::{CrossSection, Route};

fn cross_section(x: f64, y: f64) -> CrossSection {
    CrossSection { x, y, left: [x, y + 2.0], right: [x, y - 2.0] }
}

fn in_corridor(route: &Route<'_>, q: [f64; 2]) -> bool {
    // Whatever the hint, the answer is the same.
    let answers =
        [0, 1, 7].map(|mut hint| IndexedRoute::new(route, None).in_corridor(q, &mut hint));
    assert!(answers.iter().all(|&answer| answer == answers[0]));
    answers[0]
}

fn about(route: &Route<'_>, q: [f64; 2], hint: usize) -> (f64, usize) {
    IndexedRoute::new(route, None).about(q, hint)
}

fn segments<'a>(route: &'a Route<'_>) -> impl Iterator<Item = Segment> + 'a {
    (0..route.cross_sections.len())
        .filter_map(|index| IndexedRoute::new(route, None).segment(index))
}

#[test]
fn the_corridor_is_closed() {
    let cross_sections =
        [cross_section(0.0, 0.0), cross_section(3.0, 0.0), cross_section(7.0, 1.0)];
    let route = Route { closed: false, cross_sections: &cross_sections };
    let above = f64::from_bits(2.0_f64.to_bits() + 1);
    for inside in [[0.0, 2.0], [3.0, -2.0], [3.0, 0.0], [1.5, 0.0], [1.5, 2.0], [7.0, 3.0]] {
        assert!(in_corridor(&route, inside), "{inside:?}");
    }
    for outside in [[1.5, above], [-5e-324, 0.0], [7.0, 3.0 + 1e-15], [8.0, 1.0]] {
        assert!(!in_corridor(&route, outside), "{outside:?}");
    }
}

#[test]
fn points_next_to_a_shared_edge_are_inside() {
    let (a, b) = (cross_section(1.1, 0.3), cross_section(4.7, 1.9));
    let cross_sections = [a, b];
    let route = Route { closed: false, cross_sections: &cross_sections };
    // Along the diagonal from left_i to right_i+1, where no double is exactly on the edge.
    for step in 1..1000_u32 {
        let t = f64::from(step) / 1000.0;
        let x = a.left[0] + t * (b.right[0] - a.left[0]);
        let y = a.left[1] + t * (b.right[1] - a.left[1]);
        for (dx, dy) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let q = [f64::from_bits(x.to_bits() + dx), f64::from_bits(y.to_bits() + dy)];
            assert!(in_corridor(&route, q), "{q:?}");
        }
    }
}

#[test]
fn a_triangle_without_area_is_its_segment() {
    let (mut a, b) = (cross_section(0.0, 0.0), cross_section(4.0, 0.0));
    (a.left, a.right) = ([0.0, 0.0], [0.0, 0.0]);
    let flat = CrossSection { left: [4.0, 0.0], right: [4.0, 0.0], ..b };
    let cross_sections = [a, flat];
    let route = Route { closed: false, cross_sections: &cross_sections };
    assert!(in_corridor(&route, [1.0, 0.0]) && in_corridor(&route, [4.0, 0.0]));
    assert!(!in_corridor(&route, [5.0, 0.0]) && !in_corridor(&route, [1.0, 5e-324]));
}

#[test]
fn a_closed_route_has_a_last_segment_unless_it_is_a_point() {
    let open = [cross_section(0.0, 0.0), cross_section(4.0, 0.0), cross_section(4.0, 3.0)];
    let route = Route { closed: true, cross_sections: &open };
    assert_eq!(segments(&route).map(|segment| segment.index).max(), Some(2));
    assert!(about(&route, [2.0, 1.5], 0).0 < 1e-15);
    let shut = [open[0], open[1], open[2], open[0]];
    let route = Route { closed: true, cross_sections: &shut };
    assert_eq!(segments(&route).count(), 3);
}

#[test]
fn the_hint_does_not_change_the_distance() {
    let cross_sections: [CrossSection; 20] =
        core::array::from_fn(|i| cross_section(i as f64, (i * i) as f64 / 7.0));
    let route = Route { closed: false, cross_sections: &cross_sections };
    for q in [[3.3, 1.0], [19.0, 60.0], [-4.0, 2.0], [9.5, 30.0]] {
        let (first, _) = about(&route, q, 0);
        for hint in 0..19 {
            let (distance, at) = about(&route, q, hint);
            assert!((distance - first).abs() < 1e-12 && at < 19, "{q:?} {hint}");
        }
    }
}
