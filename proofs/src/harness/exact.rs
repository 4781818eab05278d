//! The integers of the exact comparisons (`spec/4-arithmetic.md#strict-and-lax`), with fewer limbs.

use core::cmp::Ordering;

use mufasa::parts::sum_of_limbs;

#[cfg(not(kani))]
use crate::kani;

/// Sums and differences of integers of three limbs are those of two's complement, and the sign is that
/// of the result.
///
/// Domain: all integers of 192 bits. Not covered: the 36 limbs of `exact`, products.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(5))]
pub fn verify_limbs_add_like_integers() {
    let any = || [kani::any(), kani::any(), kani::any()];
    let (total, summand, negative) = (any(), any(), kani::any());
    let (carry, sign) = adds_like_integers(total, summand, negative);
    kani::cover!(negative && carry && sign == Ordering::Less, "a borrow");
    kani::cover!(!negative && carry && sign == Ordering::Greater, "a carry");
    kani::cover!(sign == Ordering::Equal, "zero");
}

/// The same of four limbs.
///
/// Domain: all integers of 256 bits. Not covered: the 36 limbs of `exact`, products.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(6))]
pub fn verify_four_limbs_add_like_integers() {
    let any = || [kani::any(), kani::any(), kani::any(), kani::any()];
    let (total, summand, negative) = (any(), any(), kani::any());
    let (carry, sign) = adds_like_integers(total, summand, negative);
    kani::cover!(negative && carry && sign == Ordering::Less, "a borrow");
    kani::cover!(!negative && carry && sign == Ordering::Greater, "a carry");
    kani::cover!(sign == Ordering::Equal, "zero");
}

/// Asserts it of three or four limbs, compared as two integers of 128 bits; whether the lower one had a
/// carry, and the sign.
fn adds_like_integers<const N: usize>(
    total: [u64; N],
    summand: [u64; N],
    negative: bool,
) -> (bool, Ordering) {
    let (found, sign) = sum_of_limbs(total, &summand, negative);
    let bits = 64 * (N - 2);
    let low = |limbs: [u64; N]| u128::from(limbs[0]) | u128::from(limbs[1]) << 64;
    // Of three limbs the last one stands twice, and what is above it does not count.
    let high = |limbs: [u64; N]| u128::from(limbs[2]) | u128::from(limbs[N - 1]) << 64;
    let above = 128 - bits;
    let (expected, carry) = if negative {
        low(total).overflowing_sub(low(summand))
    } else {
        low(total).overflowing_add(low(summand))
    };
    let top = if negative {
        high(total).wrapping_sub(high(summand)).wrapping_sub(u128::from(carry))
    } else {
        high(total).wrapping_add(high(summand)).wrapping_add(u128::from(carry))
    };
    assert!(low(found) == expected && high(found) << above == top << above);
    let is_zero = expected == 0 && top << above == 0;
    assert!((sign == Ordering::Less) == (top >> (bits - 1) & 1 == 1));
    assert!((sign == Ordering::Equal) == is_zero);
    (carry, sign)
}
