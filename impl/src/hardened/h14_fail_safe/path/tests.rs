//! How many places there are at most, by the places that there are.

use std::vec::Vec;

use crate::hardened::h14_fail_safe::nodes::Nodes;
use crate::hardened::h14_fail_safe::path::{Path, greatest, steps};
use crate::hardened::h14_fail_safe::spot::tests::standing;
use crate::input::cycle::TrajectoryPoint;
use crate::input::parameters::Parameters;
use crate::random::Random;

/// Pieces of whole numbers of places and others, and a node beside `s_stop` as near as that.
#[test]
fn there_are_no_more_places_than_are_counted_and_not_many_fewer() {
    let mut random = Random::new(36);
    let mut straight = 0;
    for _ in 0..20_000 {
        let speed = [0.0, 1.0, 5.0, 30.0][random.below(4) as usize] + random.number(0.5).abs();
        let mut cycle = standing(speed, Parameters::default());
        cycle.ego.length = [4.8, 4.8, 0.25, 0.1, 0.01][random.below(5) as usize];
        let s_stop = Path::new(Nodes::new(&cycle, &[])).times.s_stop.value();
        let is_straight = random.below(2) == 0;
        let (mut x, mut y) = (0.0, 0.0);
        let points: Vec<_> = (0..random.below(20))
            .map(|t_ns| {
                x = match random.below(6) {
                    0 => s_stop + random.number(1e-9),
                    1 | 2 => x + 0.25 * (1 + random.below(20)) as f64,
                    _ => x + random.number(3.0).abs(),
                };
                let [cos, sin] = if is_straight { [1.0, 0.0] } else { random.direction() };
                if !is_straight {
                    y += random.number(2.0);
                }
                TrajectoryPoint { t_ns: t_ns as i64, x, y, cos, sin }
            })
            .collect();
        let nodes = Nodes::new(&cycle, &points);
        let most = nodes.most_places();
        let places: i64 = Path::new(nodes).pieces().map(|piece| piece.count()).sum();
        assert!(places as f64 <= most, "{places}, {most}: {cycle:?}, {points:?}");
        let pieces = nodes.lines().count() as f64;
        straight += u32::from(is_straight && places as f64 + 20.0 + 6.0 * pieces > most);
    }
    assert!(straight > 2_000, "{straight}");
}

/// H-14.3, of ways between any two doubles, against integers: all are multiples of 2^-70.
#[test]
fn steps_are_exact_beside_each_multiple() {
    let units = |it: f64| (it * libm::exp2(70.0)) as i128;
    let (mut random, mut more) = (Random::new(37), [0; 2]);
    for _ in 0..20_000 {
        let d = [0.25, 0.1, 0.01, 0.1 + random.number(0.05)][random.below(4) as usize];
        let size = [1.0, 100.0, 16_777_000.0][random.below(3) as usize];
        let near = |it: f64| (it * 1024.0).floor() / 1024.0;
        let from = [0.0, near(random.number(size)), near(random.number(size)) + d]
            [random.below(3) as usize];
        let multiple = from + (1 + random.below(3000)) as f64 * d;
        for to in [multiple.next_down(), multiple, multiple.next_up(), -multiple] {
            let (way, d_units) = ((units(to) - units(from)).abs(), units(d));
            let expected = way / d_units + i128::from(way % d_units > 0);
            let [there, back] = [[from, to], [to, from]].map(|[a, b]| {
                let found = [[[0.0, a], [0.0, b]], [[a, 0.0], [b, 0.0]]];
                found.map(|[a, b]| i128::from(steps(greatest(a, b), d)))
            });
            assert_eq!([there, back], [[expected; 2]; 2], "{from}, {to}, {d}");
            more[usize::from(way % d_units > 0)] += 1;
        }
    }
    assert!(more.iter().all(|&it| it > 5000), "{more:?}");
}

/// MARGIN-18, MARGIN-19: where the path leads aside at `s_stop`, it is open where it ends, except on a micrometre.
#[test]
fn an_end_is_certain_where_it_is_known_to_a_micrometre() {
    let parameters = Parameters { tau: 0.25, a_max: 2.0, ..Parameters::default() };
    let cycle = standing(8.0, parameters);
    let certain = |places: &[[f64; 2]]| {
        let point = |&[x, y]: &[f64; 2]| TrajectoryPoint { t_ns: 0, x, y, cos: 1.0, sin: 0.0 };
        let points: Vec<_> = places.iter().map(point).collect();
        let pieces = Path::new(Nodes::new(&cycle, &points)).pieces();
        pieces.map(|it| it.has_certain_end()).collect::<Vec<_>>()
    };
    let s_stop = 6.578_125;
    assert_eq!(certain(&[[6.0, 0.0], [7.0, 0.0]]), [true; 2]);
    assert_eq!(certain(&[[s_stop, 0.0], [s_stop, 0.75], [9.0, 0.75]]), [true, false, true]);
    assert_eq!(certain(&[[s_stop, 0.0], [s_stop, 1e-7], [9.0, 1e-7]]), [true; 3]);
    // The last place of these is by its distance: of several places, and of one.
    assert_eq!(certain(&[[s_stop, 0.0], [s_stop, 9.0]]), [true, false]);
    assert_eq!(certain(&[[s_stop, 0.0], [s_stop, 3.875], [s_stop, 4.0]]), [true, false, true]);
}
