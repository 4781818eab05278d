//! Places that are found in the corridor are in it; those in the middle of it are found.

use crate::hardened::h14_fail_safe::road::road_failure;
use crate::hardened::h14_fail_safe::spot::tests::standing;
use crate::input::cycle::{CrossSection, Cycle, Route, TrajectoryPoint};
use crate::input::parameters::Parameters;
use crate::random::Random;
use crate::report::Rule;
use crate::stages::ii_trajectory_to_map::indexed_route::IndexedRoute;

/// Small whole numbers, so that corners meet, turn either way round and lie on one line.
fn small(random: &mut Random, below: u64) -> f64 {
    random.below(below) as f64
}

#[test]
fn what_is_found_is_in_the_corridor() {
    let mut random = Random::new(58);
    let (mut found, mut across, mut folded) = (0, 0, 0);
    for _ in 0..100_000 {
        let closed = random.below(4) == 0;
        let cross_sections: [CrossSection; 4] = core::array::from_fn(|i| {
            let x = 2.0 * i as f64;
            let left = [x + small(&mut random, 3), 2.0 + small(&mut random, 3)];
            let right = [x + small(&mut random, 3), small(&mut random, 3)];
            CrossSection { x, y: 2.0, left, right }
        });
        let route = Route { closed, cross_sections: &cross_sections };
        let route = IndexedRoute::new(&route, None);
        let q = [small(&mut random, 40) / 4.0, small(&mut random, 24) / 4.0];
        let is_inside = route.in_corridor(q, &mut 0);
        let is_found = route.between(q).is_some();
        let plainly = route.plainly_between([q; 2], 0);
        assert!(is_inside || !is_found, "{q:?} {cross_sections:?}");
        assert!(is_found || plainly.is_none(), "{q:?} {cross_sections:?}");
        found += u32::from(is_found);
        across += u32::from(is_found && plainly.is_none());
        folded += u32::from(is_inside && !is_found);
    }
    assert!(found > 19_000 && across > 2_000 && folded > 20, "{found} {across} {folded}");
}

/// On the line through the boundaries of a cross section, and on a diagonal: on no boundary of the corridor.
#[test]
fn what_is_on_a_side_of_two_triangles_is_found() {
    let cross_sections: [CrossSection; 3] = core::array::from_fn(|i| {
        let x = 4.0 * i as f64;
        CrossSection { x, y: 0.0, left: [x, 2.0], right: [x, -2.0] }
    });
    let route = Route { closed: false, cross_sections: &cross_sections };
    let route = IndexedRoute::new(&route, None);
    for inside in [[4.0, 1.0], [4.0, -1.75], [2.0, 0.0], [6.0, 0.0], [1.0, 1.0]] {
        assert!(route.between(inside).is_some(), "{inside:?}");
    }
    for outside in
        [[2.0, 2.0_f64.next_up()], [2.0, 2.0 - 1e-7], [-0.25, 0.0], [8.25, 0.0], [4.0, 2.25]]
    {
        assert!(route.between(outside).is_none(), "{outside:?}");
    }
}

/// H-14.58: a path that leads aside at `s_stop`, where it is open at which of its places it ends.
#[test]
fn a_place_outside_is_found_where_the_end_is_open() {
    let s_stop = 6.578_125;
    let sections: [CrossSection; 2] =
        [-100.0, 100.0].map(|x: f64| CrossSection { x, y: 0.0, left: [x, 2.0], right: [x, -2.0] });
    let parameters = Parameters { tau: 0.25, a_max: 2.0, ..Parameters::default() };
    let route = Route { closed: false, cross_sections: &sections };
    let cycle = Cycle { route, ..standing(8.0, parameters) };
    let point = |[x, y]: [f64; 2]| TrajectoryPoint { t_ns: 0, x, y, cos: 1.0, sin: 0.0 };
    for (left, outside) in [(1.75, None), (2.5, Some(Rule::Corridor))] {
        let points = [[s_stop, 0.0], [s_stop, left]].map(point);
        let found = road_failure(&cycle, IndexedRoute::new(&route, None), &points);
        assert_eq!(found.map(|it| it.rule), outside, "{left}");
    }
}
