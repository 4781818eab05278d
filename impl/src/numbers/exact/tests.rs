//! Signs against exact rationals.

use core::cmp::Ordering;
use std::vec::Vec;

use super::{Product, Wide, compare, compare_moved_distances, difference, orientation};
use crate::random::Random;
use dashu_ratio::RBig;

fn exact(value: f64) -> RBig {
    RBig::try_from(value).expect("a finite number")
}

fn total(products: &[Product]) -> RBig {
    let factor = |[a, b]: [f64; 2]| exact(a) - exact(b);
    products.iter().fold(RBig::ZERO, |sum, &Product(x, y)| sum + factor(x) * factor(y))
}

fn products(values: &[f64]) -> Vec<Product> {
    values.chunks(4).map(|v| Product([v[0], v[1]], [v[2], v[3]])).collect()
}

/// The sign from fixed point alone, without the filter.
fn fixed_point(left: &[Product], right: &[Product]) -> Ordering {
    let mut total = Wide::default();
    for (products, subtract) in [(left, false), (right, true)] {
        for &Product([a, b], [c, d]) in products {
            total.add_product(&difference(a, b), &difference(c, d), subtract);
        }
    }
    total.sign()
}

#[test]
fn signs_are_exact() {
    let mut random = Random::new(4);
    let mut seen = [0; 3];
    for _ in 0..20_000 {
        let values = random.related(16);
        let (left, mut right) = (products(&values[..8]), products(&values[8..]));
        if random.below(8) == 0 {
            right = left.iter().rev().map(|&Product(x, y)| Product(y, x)).collect();
        }
        let expected = total(&left).cmp(&total(&right));
        assert_eq!(compare(&left, &right), expected, "{values:?}");
        assert_eq!(fixed_point(&left, &right), expected, "{values:?}");
        seen[(expected as i8 + 1) as usize] += 1;
    }
    assert!(seen.iter().all(|&count| count > 100), "{seen:?}");
}

/// Places that have moved on circles about p, in binary fractions so that many are exactly as far.
#[test]
fn distances_of_what_has_moved_are_exact() {
    let mut random = Random::new(6);
    let mut seen = [0; 3];
    for case in 0..20_000 {
        let mut number = |range: u64| (random.below(range) as f64 - range as f64 / 2.0) / 4.0;
        let [p, a, v] = [16, 16, 8].map(|range| [number(range), number(range)]);
        let t_ns = [0, 250_000_000, -500_000_000, 7, -59_999_999_999][case % 5];
        let t = RBig::from(t_ns) / RBig::from(1_000_000_000_i64);
        let moved = |axis: usize| exact(a[axis]) + exact(v[axis]) * t.clone() - exact(p[axis]);
        // As far, turned by a right angle, when the doubles hold it.
        let turned = [
            p[0] - (a[1] + v[1] * t_ns as f64 * 1e-9 - p[1]),
            p[1] + (a[0] + v[0] * t_ns as f64 * 1e-9 - p[0]),
        ];
        let bit = random.below(3);
        let b = turned.map(|value| f64::from_bits(value.to_bits() ^ bit));
        let still = |axis: usize| exact(b[axis]) - exact(p[axis]);
        let squared = |of: &dyn Fn(usize) -> RBig| of(0) * of(0) + of(1) * of(1);
        let expected = squared(&moved).cmp(&squared(&still));
        assert_eq!(
            compare_moved_distances(p, (a, v, t_ns), b),
            expected,
            "{p:?} {a:?} {v:?} {b:?}"
        );
        seen[(expected as i8 + 1) as usize] += 1;
    }
    assert!(seen.iter().all(|&count| count > 1_000), "{seen:?}");
}

#[test]
fn orientation_next_to_a_line_is_exact() {
    let mut random = Random::new(5);
    for _ in 0..20_000 {
        let v = random.related(4);
        let (a, b) = ([v[0], v[1]], [v[2], v[3]]);
        let middle = [0.5 * v[0] + 0.5 * v[2], 0.5 * v[1] + 0.5 * v[3]];
        let near = middle.map(|value| f64::from_bits(value.to_bits() ^ random.below(2)));
        let side = (exact(b[0]) - exact(a[0])) * (exact(near[1]) - exact(a[1]))
            - (exact(b[1]) - exact(a[1])) * (exact(near[0]) - exact(a[0]));
        assert_eq!(orientation(a, b, near), side.cmp(&exact(0.0)), "{a:?} {b:?} {near:?}");
    }
}

#[test]
fn the_least_products_count() {
    let tiny = f64::from_bits(1);
    let square = [Product([tiny, 0.0], [tiny, 0.0])];
    assert_eq!(compare(&square, &[]), Ordering::Greater);
    assert_eq!(compare(&[], &square), Ordering::Less);
    assert_eq!(compare(&square, &square), Ordering::Equal);
    let far = [Product([1.0, -tiny], [1.0, tiny])];
    assert_eq!(compare(&far, &[Product([1.0, 0.0], [1.0, 0.0])]), Ordering::Less);
}
