//! Real numbers with a bound on their error
//! (`spec/4-arithmetic.md#conformance-of-an-implementation`).
//!
//! A `Real` stands for one unknown real number x and knows abs(x - (hi + lo)) <= err. The centre
//! is a double-double, so that bounds stay far below the least margin delta = 1e-8 m. Every
//! operation computes its rounding error, or a bound on it, from its own result; where nothing is
//! rounded the bound is 0, and an equality is decided as in the model. Each bound is argued beside
//! its operation and tested against rational numbers (`rounding/tests.rs`). Only + - * / and the
//! correctly rounded square root are used, never a fused operation. Comparisons answer "certainly"
//! or "possibly"; a NaN is never certain. Doubles are those of A-18.

mod error_free;

use core::ops::{Add, Mul, Neg, Sub};

use self::error_free::{two_product, two_sum};

/// Bound on the relative error of one rounding: 2^-53.
const ROUNDING: f64 = f64::from_bits((1023 - 53) << 52);
/// Bound on what one operation loses to underflow; each of at most ten partial results loses less
/// than 2^-1073.
const UNDERFLOW: f64 = f64::from_bits((1023 - 1000) << 52);
/// A product above this loses nothing to underflow.
const NO_UNDERFLOW: f64 = f64::from_bits((1023 - 900) << 52);
/// Bounds are sums and products of at most 16 non-negative doubles; this covers their rounding.
const BOUND_UP: f64 = 1.0 + f64::from_bits((1023 - 45) << 52);
/// `hi` times this is below the size of `hi + lo`, also after rounding.
const CENTRE_DOWN: f64 = 1.0 - f64::from_bits((1023 - 45) << 52);

/// A real number known up to a bound. Sums and differences of doubles are exact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Real {
    hi: f64,
    lo: f64,
    err: f64,
}

impl Real {
    pub(crate) const ZERO: Self = Self { hi: 0.0, lo: 0.0, err: 0.0 };
    pub(crate) const ONE: Self = Self { hi: 1.0, lo: 0.0, err: 0.0 };

    /// The number that the double denotes, exactly.
    pub(crate) const fn new(value: f64) -> Self {
        Self { hi: value, lo: 0.0, err: 0.0 }
    }

    /// a - b, exactly.
    pub(crate) fn difference(a: f64, b: f64) -> Self {
        let (hi, lo) = two_sum(a, -b);
        Self { hi, lo, err: 0.0 }
    }

    /// A time in ns as seconds; exact up to the division.
    pub(crate) fn seconds(time_ns: i64) -> Self {
        Self::integer(time_ns).over(Self::new(1e9))
    }

    /// An integer, exactly.
    pub(crate) fn integer(value: i64) -> Self {
        let high = i32::try_from(value >> 32).unwrap_or(i32::MAX);
        let low = u32::try_from(value & 0xffff_ffff).unwrap_or(u32::MAX);
        let (hi, lo) = two_sum(f64::from(high) * 4_294_967_296.0, f64::from(low));
        Self { hi, lo, err: 0.0 }
    }

    /// The nearest double of the centre.
    pub(crate) const fn value(self) -> f64 {
        self.hi
    }

    /// Upper bound on how far the number is from `value`.
    pub(crate) fn off(self) -> f64 {
        (abs(self.lo) + self.err) * BOUND_UP
    }

    /// The same centre, known only up to `by` more (by >= 0).
    pub(crate) fn widened(self, by: f64) -> Self {
        Self { err: (self.err + by) * BOUND_UP, ..self }
    }

    /// self * self.
    pub(crate) fn squared(self) -> Self {
        self * self
    }

    /// abs is 1-Lipschitz: the bound stays.
    pub(crate) fn abs(self) -> Self {
        if self.hi < 0.0 { -self } else { self }
    }

    /// max is 1-Lipschitz in the maximum norm: the larger bound holds.
    pub(crate) fn max(self, other: Self) -> Self {
        let err = if self.err > other.err { self.err } else { other.err };
        let larger = if (self - other).hi > 0.0 { self } else { other };
        Self { err, ..larger }
    }

    /// As `max`.
    pub(crate) fn min(self, other: Self) -> Self {
        -(-self).max(-other)
    }

    /// self / other. The bound comes from the quotient itself: abs(a/b - q) = abs(a - b q) / abs(b).
    /// A divisor that may be 0 gives an infinite bound.
    pub(crate) fn over(self, other: Self) -> Self {
        let first = self.hi / other.hi;
        let second = (self - other * Self::new(first)).hi / other.hi;
        let (hi, lo) = two_sum(first, second);
        let quotient = Self { hi, lo, err: 0.0 };
        let least = abs(other.hi) * CENTRE_DOWN - other.err * BOUND_UP;
        if least > 0.0 {
            let residue = (self - other * quotient).magnitude();
            Self { err: quotient_up(residue, least), ..quotient }
        } else {
            Self { hi: 0.0, lo: 0.0, err: f64::INFINITY }
        }
    }

    /// a / b of two doubles from 2^-400 to 2^400 in size, or a = 0. What a rounded quotient leaves of a is a double.
    pub(crate) fn quotient(a: f64, b: f64) -> Self {
        let hi = a / b;
        let (product, low) = two_product(hi, b);
        let lo = ((a - product) - low) / b;
        Self { hi, lo, err: abs(lo) * (ROUNDING * BOUND_UP) }
    }

    /// The square root of a number that is known to be >= 0. The bound comes from the root itself:
    /// abs(sqrt(a) - s) = abs(a - s^2) / (sqrt(a) + s), unless a may be almost 0.
    pub(crate) fn sqrt(self) -> Self {
        if self.hi <= 4.0 * self.err || self.hi <= UNDERFLOW {
            let top = if self.hi > 0.0 { self.hi } else { 0.0 };
            let root = libm::sqrt((top * BOUND_UP + self.err) * BOUND_UP);
            return Self { hi: 0.0, lo: 0.0, err: root * BOUND_UP };
        }
        // IMPL-06
        let first = libm::sqrt(self.hi);
        let second = (self - Self::new(first).squared()).hi / (2.0 * first);
        let (hi, lo) = two_sum(first, second);
        let root = Self { hi, lo, err: 0.0 };
        let residue = (self - root.squared()).magnitude();
        Self { err: quotient_up(residue, root.hi * CENTRE_DOWN), ..root }
    }

    /// self < other for every pair of numbers that the two may stand for.
    pub(crate) fn certainly_below(self, other: Self) -> bool {
        // IMPL-01, IMPL-02
        let gap = other - self;
        gap.hi * CENTRE_DOWN > gap.err
    }

    /// self <= other for every pair of numbers that the two may stand for.
    pub(crate) fn certainly_at_most(self, other: Self) -> bool {
        let gap = other - self;
        gap.hi * CENTRE_DOWN >= gap.err
    }

    /// self < other for some pair of numbers that the two may stand for.
    pub(crate) fn possibly_below(self, other: Self) -> bool {
        !other.certainly_at_most(self)
    }

    /// self <= other for some pair of numbers that the two may stand for.
    pub(crate) fn possibly_at_most(self, other: Self) -> bool {
        !other.certainly_below(self)
    }

    /// Bound on what the product, whose high part is given, loses to underflow; nothing when a
    /// factor is exactly 0, or both are doubles and the product is not tiny.
    fn underflow(self, other: Self, product: f64) -> f64 {
        let is_zero = |x: Self| abs(x.hi) + x.err <= 0.0;
        let is_double = |x: Self| abs(x.lo) <= 0.0;
        let is_exact = is_double(self) && is_double(other) && abs(product) > NO_UNDERFLOW;
        if is_zero(self) || is_zero(other) || is_exact && self.err + other.err <= 0.0 {
            0.0
        } else {
            UNDERFLOW
        }
    }

    /// Upper bound on the absolute value of the number.
    pub(crate) fn magnitude(self) -> f64 {
        (abs(self.hi) * BOUND_UP + self.err) * BOUND_UP
    }
}

impl Neg for Real {
    type Output = Self;

    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo, err: self.err }
    }
}

impl Add for Real {
    type Output = Self;

    /// What `rest` and `last` hold is exactly what is left out; sums do not underflow.
    fn add(self, other: Self) -> Self {
        let (sum, low) = two_sum(self.hi, other.hi);
        let (lows, last) = two_sum(self.lo, other.lo);
        let (low, rest) = two_sum(low, lows);
        let (sum, low) = two_sum(sum, low);
        let (low, lost) = two_sum(low, last);
        let (hi, lo) = two_sum(sum, low);
        let err = (self.err + other.err + (abs(rest) + abs(lost))) * BOUND_UP;
        Self { hi, lo, err }
    }
}

impl Sub for Real {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Real {
    type Output = Self;

    /// The product of the high parts is exact; the mixed products are rounded, that of the low
    /// parts is left out.
    fn mul(self, other: Self) -> Self {
        let (product, low) = two_product(self.hi, other.hi);
        let (one, two) = (self.hi * other.lo, self.lo * other.hi);
        let (mixed, lost) = two_sum(one, two);
        let (low, rest) = two_sum(low, mixed);
        let (hi, lo) = two_sum(product, low);
        let lost = abs(lost) + abs(rest) + (abs(one) + abs(two)) * ROUNDING;
        let lost = lost + abs(self.lo * other.lo) + self.underflow(other, product);
        let (a, b) = (abs(self.hi) * BOUND_UP, abs(other.hi) * BOUND_UP);
        let inherited = a * other.err + b * self.err + self.err * other.err;
        Self { hi, lo, err: (inherited + lost) * BOUND_UP }
    }
}

/// Upper bound on a quotient of bounds, 0 only for 0.
fn quotient_up(bound: f64, divisor: f64) -> f64 {
    if bound > 0.0 { (bound / divisor + UNDERFLOW) * BOUND_UP } else { bound }
}

fn abs(value: f64) -> f64 {
    if value < 0.0 { -value } else { value }
}

#[cfg(test)]
mod tests;
