//! Signs against exact rationals.

use core::cmp::Ordering;
use std::vec::Vec;

use super::{Product, Wide, compare, difference, orientation};
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
