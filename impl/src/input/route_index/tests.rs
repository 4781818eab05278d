//! What the index leaves out is far off, on open and closed routes of every length.

use std::vec::Vec;

use super::{Block, RouteIndex, candidates};
use crate::input::cycle::{CrossSection, Route};
use crate::random::Random;
use crate::report::Problem;

fn cross_sections(random: &mut Random, count: usize) -> Vec<CrossSection> {
    let mut near = |value: f64| value + random.below(1000) as f64 / 300.0;
    (0..count)
        .map(|i| {
            let (x, y) = (near(i as f64 * 2.0), near(0.0));
            CrossSection { x, y, left: [near(x), near(y + 2.0)], right: [near(x), near(y - 2.0)] }
        })
        .collect()
}

#[test]
fn no_segment_that_is_near_is_left_out() {
    let mut random = Random::new(3);
    let mut left_out = 0;
    for count in (2..70).chain([255, 256, 257, 271, 272, 273, 600]) {
        let cross_sections = cross_sections(&mut random, count);
        for closed in [false, true] {
            let route = Route { closed, cross_sections: &cross_sections };
            let mut memory = std::vec![Block::default(); Block::needed(count)];
            let index = RouteIndex::new(route, &mut memory).expect("a valid route");
            assert!(index.is_of(&route));
            let segments = count - usize::from(!closed);
            for _ in 0..10 {
                let point = [random.below(1300) as f64, random.below(9) as f64 - 4.0];
                let reach = random.below(5) as f64;
                let found: Vec<usize> = candidates(Some(&index), segments, point, reach).collect();
                let near = |at: usize| {
                    let ends = [&cross_sections[at], &cross_sections[(at + 1) % count]];
                    let axis = |value: fn([f64; 2]) -> f64| {
                        let of = |s: &CrossSection| [[s.x, s.y], s.left, s.right].map(value);
                        let values = ends.iter().flat_map(|s| of(s)).collect::<Vec<_>>();
                        let least = values.iter().copied().fold(f64::MAX, f64::min);
                        let most = values.iter().copied().fold(f64::MIN, f64::max);
                        (least - value(point)).max(value(point) - most) <= reach
                    };
                    axis(|[x, _]| x) && axis(|[_, y]| y)
                };
                for at in 0..segments {
                    assert!(!near(at) || found.contains(&at), "{count} {closed} {at}");
                }
                assert!(found.is_sorted_by(|a, b| a < b) && found.iter().all(|&it| it < segments));
                assert_eq!(candidates(None, segments, point, reach).count(), segments);
                left_out += segments - found.len();
            }
        }
    }
    assert!(left_out > 10_000, "{left_out}");
}

#[test]
fn another_route_has_another_index() {
    let cross_sections = cross_sections(&mut Random::new(5), 40);
    let route = Route { closed: false, cross_sections: &cross_sections };
    let mut memory = std::vec![Block::default(); Block::needed(40)];
    let index = RouteIndex::new(route, &mut memory).expect("a valid route");
    let copy = cross_sections.clone();
    assert!(!index.is_of(&Route { closed: false, cross_sections: &copy }));
    assert!(!index.is_of(&Route { closed: true, ..route }));
    assert!(!index.is_of(&Route { cross_sections: &cross_sections[..39], ..route }));
}

#[test]
fn invalid_routes_and_too_little_memory_are_refused() {
    let cross_sections = cross_sections(&mut Random::new(5), 40);
    let route = Route { closed: false, cross_sections: &cross_sections };
    let mut memory = std::vec![Block::default(); Block::needed(40) - 1];
    let refused = RouteIndex::new(route, &mut memory).map(|_| ()).map_err(|error| error.problem);
    assert_eq!(refused, Err(Problem::ScratchTooSmall));
    let mut broken = cross_sections.clone();
    broken[7].left[1] = f64::NAN;
    let route = Route { closed: false, cross_sections: &broken };
    let mut memory = std::vec![Block::default(); Block::needed(40)];
    let error = RouteIndex::new(route, &mut memory).map(|_| ()).expect_err("not finite");
    assert_eq!((error.field, error.index), ("route.stations.left", Some(7)));
}
