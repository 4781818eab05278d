//! Outward-rounded intervals of doubles: the filter in front of the exact arithmetic.
//!
//! Each operation returns an interval that contains the exact result for all operands in the
//! given ones. An interval of one point is the exact value: a result is a point only where the
//! operation is known to be exact.

use std::cmp::Ordering;

/// lo <= value <= hi.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Interval {
    pub(super) lo: f64,
    pub(super) hi: f64,
}

impl Interval {
    pub(super) fn point(value: f64) -> Self {
        Self { lo: value, hi: value }
    }

    #[expect(clippy::float_cmp, reason = "a point is an interval of exactly one double")]
    pub(super) fn is_point(self) -> bool {
        self.lo == self.hi
    }

    /// The order of the values, where the intervals tell.
    pub(super) fn order(self, other: Self) -> Option<Ordering> {
        if self.is_point() && other.is_point() {
            return self.lo.partial_cmp(&other.lo);
        }
        if self.hi < other.lo {
            return Some(Ordering::Less);
        }
        (self.lo > other.hi).then_some(Ordering::Greater)
    }

    pub(super) fn plus(self, other: Self) -> Self {
        let (lo, hi) = (self.lo + other.lo, self.hi + other.hi);
        if self.is_point() && other.is_point() && sum_is_exact(self.lo, other.lo, lo) {
            return Self::point(lo);
        }
        outward(lo, hi)
    }

    pub(super) fn negated(self) -> Self {
        Self { lo: -self.hi, hi: -self.lo }
    }

    /// The greater of two values.
    pub(super) fn max(self, other: Self) -> Self {
        Self { lo: self.lo.max(other.lo), hi: self.hi.max(other.hi) }
    }

    pub(super) fn times(self, other: Self) -> Self {
        if self.is_point() && other.is_point() {
            let product = self.lo * other.lo;
            if product_is_exact(self.lo, other.lo) {
                return Self::point(product);
            }
            return outward(product, product);
        }
        let ends = [self.lo * other.lo, self.lo * other.hi, self.hi * other.lo, self.hi * other.hi];
        if ends.iter().any(|end| end.is_nan()) {
            return Self::whole();
        }
        outward(
            ends.iter().copied().fold(f64::INFINITY, f64::min),
            ends.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        )
    }

    pub(super) fn over(self, other: Self) -> Self {
        if other.lo <= 0.0 && other.hi >= 0.0 {
            return Self::whole();
        }
        let ends = [self.lo / other.lo, self.lo / other.hi, self.hi / other.lo, self.hi / other.hi];
        if ends.iter().any(|end| end.is_nan()) {
            return Self::whole();
        }
        outward(
            ends.iter().copied().fold(f64::INFINITY, f64::min),
            ends.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        )
    }

    /// The square; its interval does not reach below zero.
    pub(super) fn square(self) -> Self {
        let square = self.times(self);
        Self { lo: square.lo.max(0.0), hi: square.hi }
    }

    /// The root of what of the interval is not negative.
    #[expect(clippy::float_cmp, reason = "the product is exact, so is the question")]
    pub(super) fn sqrt(self) -> Self {
        let (lo, hi) = (self.lo.max(0.0).sqrt(), self.hi.max(0.0).sqrt());
        if self.is_point() && product_is_exact(lo, lo) && lo * lo == self.lo {
            return Self::point(lo);
        }
        let wide = outward(lo, hi);
        Self { lo: wide.lo.max(0.0), hi: wide.hi }
    }

    fn whole() -> Self {
        Self { lo: f64::NEG_INFINITY, hi: f64::INFINITY }
    }
}

/// IEEE 754 rounds to nearest, so the next doubles enclose the exact result; NaN (of infinite
/// operands) says nothing.
fn outward(lo: f64, hi: f64) -> Interval {
    if lo.is_nan() || hi.is_nan() {
        return Interval::whole();
    }
    Interval { lo: lo.next_down(), hi: hi.next_up() }
}

/// Knuth's two-sum: the rounding error of a sum is itself a double.
fn sum_is_exact(a: f64, b: f64, sum: f64) -> bool {
    let b_part = sum - a;
    let a_part = sum - b_part;
    sum.is_finite() && (a - a_part) + (b - b_part) == 0.0
}

/// A product of two numbers of 24 bits and of moderate size has 48 bits: exact. Zero times
/// anything is exact, too.
fn product_is_exact(a: f64, b: f64) -> bool {
    a == 0.0 && b.is_finite() || b == 0.0 && a.is_finite() || is_short(a) && is_short(b)
}

/// 24 bits hold the number, and its products neither overflow nor underflow.
#[expect(clippy::cast_possible_truncation, clippy::float_cmp, reason = "asks just that")]
fn is_short(x: f64) -> bool {
    f64::from(x as f32) == x && (x == 0.0 || x.abs() > 1e-30) && x.abs() < 1e30
}
