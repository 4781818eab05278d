use super::{Real, unfiltered};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::cmp::Ordering;

fn number(value: f64) -> Real {
    Real::from_double(value)
}

fn draws(seed: u64) -> impl FnMut(u64) -> u64 {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    move |bound| random.random_range(0..bound)
}

#[test]
fn equal_sums_of_roots_are_equal() {
    let sum = number(2.0).sqrt() + number(8.0).sqrt() - number(18.0).sqrt();
    assert_eq!(sum, Real::zero());
    assert_eq!(number(0.25).sqrt() + number(0.5), number(1.0));
    assert_eq!(number(2.0).sqrt() * number(8.0).sqrt(), number(4.0));
}

#[test]
fn sums_of_roots_closer_than_doubles_are_ordered() {
    // sqrt(2) + sqrt(5) against sqrt(2 + tiny) + sqrt(5).
    let near = Real::from_double(2.0) + number(2f64.powi(-300));
    let (a, b) = (number(2.0).sqrt() + number(5.0).sqrt(), near.sqrt() + number(5.0).sqrt());
    assert_eq!(a.cmp(&b), Ordering::Less);
    assert_eq!(b.cmp(&a), Ordering::Greater);
}

#[test]
fn decimals_are_the_nearest_doubles() {
    assert_ne!(number(0.1) + number(0.2), number(0.3));
    assert_eq!((number(0.1) + number(0.2)).to_f64().to_bits(), (0.1f64 + 0.2).to_bits());
    assert_eq!(number(2.0).sqrt().to_f64().to_bits(), 2f64.sqrt().to_bits());
}

#[test]
fn floor_is_exact_at_integers() {
    let third = number(1.0) / number(3.0);
    assert_eq!((&third + &third + &third).floor(), 1);
    assert_eq!((&third + &third + &third - number(2f64.powi(-200))).floor(), 0);
    assert_eq!(number(-0.5).floor(), -1);
}

/// A random expression of a few operations on numbers that often coincide.
fn expression(draw: &mut impl FnMut(u64) -> u64, depth: u64) -> Real {
    #[expect(clippy::cast_precision_loss, reason = "small integers")]
    let leaf = |n: u64| number(n as f64 / 8.0);
    if depth == 0 {
        let n = draw(9);
        return if draw(2) == 0 { leaf(n).sqrt() } else { leaf(n) };
    }
    let (a, b) = (expression(draw, depth - 1), expression(draw, depth - 1));
    match draw(7) {
        0 => a + b,
        1 => a - b,
        2 => a * b,
        3 => a.max(b),
        4 => a.min(b),
        5 => (a - b).abs(),
        _ => a / (leaf(draw(9)) + number(1.0)),
    }
}

#[test]
fn filter_changes_no_comparison() {
    let mut draw = draws(7);
    let mut seen = [0; 3];
    for _ in 0..20_000 {
        let (seed, depth) = (draw(1 << 30), draw(3));
        let compare = || {
            let mut draw = draws(seed);
            expression(&mut draw, depth).cmp(&expression(&mut draw, depth))
        };
        let filtered = compare();
        assert_eq!(filtered, unfiltered(compare), "seed {seed}, depth {depth}");
        seen[(filtered as i8 + 1).unsigned_abs() as usize] += 1;
    }
    assert!(seen.iter().all(|&n| n > 400), "less, equal and greater all occur: {seen:?}");
}

#[test]
fn greater_less_and_absolute_values_are_those_that_comparisons_choose() {
    let mut draw = draws(8);
    let mut equal = 0;
    for _ in 0..2000 {
        let (a, b) = (expression(&mut draw, 1), expression(&mut draw, 1));
        let (less, greater) = if a <= b { (&a, &b) } else { (&b, &a) };
        assert_eq!(a.clone().max(b.clone()), *greater);
        assert_eq!(a.clone().min(b.clone()), *less);
        assert_eq!((&a - &b).abs(), greater - less);
        equal += i32::from(a == b);
    }
    assert!(equal > 20, "equal numbers occur: {equal}");
}
