//! Comparisons that must not have any error: which side of a line a point is on, which of two
//! distances is larger, the norm of a direction, the end of a trajectory
//! (`spec/4-arithmetic.md#strict-and-lax`).
//!
//! First the error bounds of `rounding` are tried; only when they leave the sign open are the
//! doubles written out as fixed-point integers, of which every sum and product is exact.

use core::cmp::Ordering;

use self::limbs::{add, halves, product, sign};
use crate::numbers::rounding::Real;

pub(crate) mod limbs;

/// One summand (a - b) * (c - d) of doubles; differences stay below 2^40 in size.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Product(pub(crate) [f64; 2], pub(crate) [f64; 2]);

/// The sign of the sum of the first products minus the sum of the second ones, exactly.
pub(crate) fn compare(left: &[Product], right: &[Product]) -> Ordering {
    let gap = sum(left) - sum(right);
    if Real::ZERO.certainly_below(gap) {
        Ordering::Greater
    } else if gap.certainly_below(Real::ZERO) {
        Ordering::Less
    } else {
        let mut total = Wide::default();
        for &Product([a, b], [c, d]) in left {
            total.add_product(&difference(a, b), &difference(c, d), false);
        }
        for &Product([a, b], [c, d]) in right {
            total.add_product(&difference(a, b), &difference(c, d), true);
        }
        total.sign()
    }
}

/// On which side of the line from `a` to `b` the point `c` is: `Greater` is left.
pub(crate) fn orientation(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> Ordering {
    let area = certain_orientation(a, b, c);
    if area > 0.0 {
        return Ordering::Greater;
    }
    if area < 0.0 {
        return Ordering::Less;
    }
    let [ax, ay] = a;
    let [bx, by] = b;
    let [cx, cy] = c;
    compare(&[Product([bx, ax], [cy, ay])], &[Product([by, ay], [cx, ax])])
}

/// The same in plain doubles: a number of the sign of the area of the triangle, or 0 when rounding
/// leaves the sign open (Shewchuk 1997, bound A of "orient2d", which is 3.3e-16 of the sum).
pub(crate) fn certain_orientation(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    let ([ax, ay], [bx, by], [cx, cy]) = (a, b, c);
    let (one, other) = ((bx - ax) * (cy - ay), (by - ay) * (cx - ax));
    let area = one - other;
    // 1e-300 is more than products lose to underflow.
    let bound = (one.abs() + other.abs()) * 4e-16 + 1e-300;
    if area > bound || area < -bound { area } else { 0.0 }
}

/// Compares the distance from `p` to `a` with the distance from `p` to `b`.
pub(crate) fn compare_distances(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> Ordering {
    let [px, py] = p;
    let square = |[x, y]: [f64; 2]| [Product([x, px], [x, px]), Product([y, py], [y, py])];
    compare(&square(a), &square(b))
}

/// The same where `a` has moved for some time: a point, its velocity in m/s, and ns, below 2^38. In
/// units of 1e-9 m, so that times are integers.
pub(crate) fn compare_moved_distances(
    [px, py]: [f64; 2],
    ([ax, ay], [vx, vy], t_ns): ([f64; 2], [f64; 2], i64),
    [bx, by]: [f64; 2],
) -> Ordering {
    let mut total = Wide::default();
    for (moved, still) in [
        (combination([(ax, px, GIGA), (vx, 0.0, t_ns)]), combination([(bx, px, GIGA)])),
        (combination([(ay, py, GIGA), (vy, 0.0, t_ns)]), combination([(by, py, GIGA)])),
    ] {
        total.add_product(&moved, &moved, false);
        total.add_product(&still, &still, true);
    }
    total.sign()
}

const GIGA: i64 = 1_000_000_000;

fn sum(products: &[Product]) -> Real {
    let factor = |[a, b]: [f64; 2]| Real::difference(a, b);
    products.iter().fold(Real::ZERO, |total, &Product(x, y)| total + factor(x) * factor(y))
}

/// Limbs of a difference: 1074 bits after the point, 40 before it, rounded up.
const NARROW: usize = 18;
/// Limbs of a product: the point is after bit 2148; the sum of four stays below 2^84.
const WIDE: usize = 36;

/// A difference of two doubles in units of 2^-1074, as sign and size.
struct Narrow {
    negative: bool,
    limbs: [u64; NARROW],
}

/// A sum of products in units of 2^-2148, in two's complement, lowest limb first.
struct Wide([u64; WIDE]);

impl Default for Wide {
    fn default() -> Self {
        Self([0; WIDE])
    }
}

impl Wide {
    /// Adds a * b, or subtracts it.
    fn add_product(&mut self, a: &Narrow, b: &Narrow, subtract: bool) {
        let negative = (a.negative != b.negative) != subtract;
        let product: [u64; WIDE] = product(&a.limbs, &b.limbs);
        add(&mut self.0, &product, negative);
    }

    fn sign(&self) -> Ordering {
        sign(&self.0)
    }
}

/// a - b in fixed point.
fn difference(a: f64, b: f64) -> Narrow {
    let mut limbs = [0; NARROW];
    let (size_a, size_b) = (fixed(a), fixed(b));
    add(&mut limbs, &size_a, a < 0.0);
    add(&mut limbs, &size_b, b > 0.0);
    Narrow::of(limbs)
}

/// The sum of (a - b) times an integer for each of the terms; below 2^77 in size.
fn combination<const N: usize>(terms: [(f64, f64, i64); N]) -> Narrow {
    let mut total = [0; NARROW];
    for (a, b, factor) in terms {
        let Narrow { negative, limbs } = difference(a, b);
        let mut carry = 0_u64;
        let product = limbs.map(|limb| {
            // x y + carry <= (2^64 - 1)^2 + 2^64 - 1 < 2^128
            let full = u128::from(limb).wrapping_mul(u128::from(factor.unsigned_abs()));
            let low;
            (low, carry) = halves(full.wrapping_add(u128::from(carry)));
            low
        });
        add(&mut total, &product, negative != (factor < 0));
    }
    Narrow::of(total)
}

impl Narrow {
    /// From two's complement.
    fn of(mut limbs: [u64; NARROW]) -> Self {
        let negative = limbs.last().is_some_and(|&top| top >> 63 == 1);
        if negative {
            let complement = limbs;
            limbs = [0; NARROW];
            add(&mut limbs, &complement, true);
        }
        Self { negative, limbs }
    }
}

/// The size of a double below 2^40 in units of 2^-1074.
fn fixed(value: f64) -> [u64; NARROW] {
    let bits = value.to_bits();
    let biased = (bits >> 52) & 0x7ff;
    let fraction = bits & 0x000f_ffff_ffff_ffff;
    let (mantissa, shift) =
        if biased == 0 { (fraction, 0) } else { (fraction | 1 << 52, biased.wrapping_sub(1)) };
    let first = usize::try_from(shift >> 6).unwrap_or(NARROW);
    let (low, high) = halves(u128::from(mantissa) << (shift & 63));
    let mut limbs = [0; NARROW];
    for (limb, part) in limbs.iter_mut().skip(first).zip([low, high]) {
        *limb = part;
    }
    limbs
}

#[cfg(test)]
mod tests;
