//! The contracts of `two_sum` and `two_product`, on all numbers of small formats: the code of the
//! implementation, run on numbers of 4 to 7 bits that are rounded to nearest, ties to even. Powers of
//! two scale both, so that the exponent of one number may stay.

#![allow(clippy::float_cmp, reason = "equality is the claim")]

use super::{Floating, two_product_by, two_sum};

/// A number of `BITS` bits and any exponent, kept in a double, in which every single sum and product
/// here is exact before it is rounded.
#[derive(Clone, Copy, Debug)]
struct Small<const BITS: u32>(f64);

impl<const BITS: u32> Small<BITS> {
    fn rounded(exact: f64) -> Self {
        let dropped = 53 - BITS;
        let bits = exact.to_bits();
        let half = (1 << (dropped - 1)) - 1 + (bits >> dropped & 1);
        Self(f64::from_bits((bits + half) >> dropped << dropped))
    }

    /// All numbers from 2^exponent to 2^(exponent + 1), of both signs.
    fn of_exponent(exponent: i32) -> impl Iterator<Item = Self> {
        let unit = 2.0_f64.powi(exponent + 1) / f64::from(1 << BITS);
        (1_i32 << (BITS - 1)..1 << BITS)
            .flat_map(move |mantissa| [mantissa, -mantissa])
            .map(move |mantissa| Self(f64::from(mantissa) * unit))
    }
}

impl<const BITS: u32> Floating for Small<BITS> {
    fn plus(self, other: Self) -> Self {
        Self::rounded(self.0 + other.0)
    }

    fn minus(self, other: Self) -> Self {
        Self::rounded(self.0 - other.0)
    }

    fn times(self, other: Self) -> Self {
        Self::rounded(self.0 * other.0)
    }
}

/// a + b = sum + error, and the sum is the rounded one. Exponents further apart than the format is
/// wide, by 2, change nothing but how far apart they are.
fn sums<const BITS: u32>() -> u32 {
    let mut tried = 0;
    let apart = i32::try_from(BITS).expect("few") + 3;
    for exponent in -apart..=apart {
        for a in Small::<BITS>::of_exponent(0) {
            for b in Small::<BITS>::of_exponent(exponent).chain([Small(0.0)]) {
                let (sum, error) = two_sum(a, b);
                assert_eq!(sum.0, a.plus(b).0);
                assert_eq!(sum.0 + error.0, a.0 + b.0, "{a:?} + {b:?}");
                tried += u32::from(error.0 != 0.0);
            }
        }
    }
    tried
}

/// a * b = product + error, and the product is the rounded one.
fn products<const BITS: u32>() -> u32 {
    let splitter = Small::rounded(f64::from(1 + (1 << BITS.div_ceil(2))));
    let mut tried = 0;
    for a in Small::<BITS>::of_exponent(0) {
        for b in Small::<BITS>::of_exponent(0).chain([Small(0.0)]) {
            let (product, error) = two_product_by(splitter, a, b);
            assert_eq!(product.0, a.times(b).0);
            assert_eq!(product.0 + error.0, a.0 * b.0, "{a:?} * {b:?}");
            tried += u32::from(error.0 != 0.0);
        }
    }
    tried
}

#[test]
fn two_sum_has_no_error_in_small_formats() {
    let rounded = [sums::<4>(), sums::<5>(), sums::<6>(), sums::<7>()];
    assert!(rounded.iter().all(|&some| some > 500), "{rounded:?}");
}

#[test]
fn two_product_has_no_error_in_small_formats() {
    let rounded = [products::<4>(), products::<5>(), products::<6>(), products::<7>()];
    assert!(rounded.iter().all(|&some| some > 50), "{rounded:?}");
}
