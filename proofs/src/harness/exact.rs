//! The integers of the exact comparisons (`spec/4-arithmetic.md#strict-and-lax`), with fewer limbs.

use core::cmp::Ordering;

use mufasa::parts::{product_of_limbs, sum_of_limbs};

use super::any::below;
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
    adds_like_integers(any(), any(), kani::any());
}

/// The same of four limbs.
///
/// Domain: all integers of 256 bits. Not covered: the 36 limbs of `exact`, products.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(6))]
pub fn verify_four_limbs_add_like_integers() {
    let any = || [kani::any(), kani::any(), kani::any(), kani::any()];
    adds_like_integers(any(), any(), kani::any());
}

/// The product of a power of two and an integer of two limbs is the integer so many bits higher: each limb
/// comes to its place, and carries go up.
///
/// Domain: all powers of two below 2^128, all integers of 128 bits. Not covered: products of two arbitrary
/// integers, the 18 limbs of `exact`.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(6))]
pub fn verify_limbs_multiply_by_powers_of_two() {
    let number: [u64; 2] = [kani::any(), kani::any()];
    let (at, is_high) = (below(64), kani::any());
    let bit = 1_u64 << at;
    let power = if is_high { [0, bit] } else { [bit, 0] };
    let found = product_of_limbs(&power, &number);
    // Shifted by less than 64 bits, of which none is lost in three limbs.
    let low = u128::from(number[0]) << at;
    let high = (u128::from(number[1]) << at) + (low >> 64);
    #[allow(clippy::cast_possible_truncation, reason = "the lower half is what is wanted")]
    let [a, b, c] = [low, high, high >> 64].map(|part| (part & u128::from(u64::MAX)) as u64);
    // Limb by limb: a comparison of arrays is a loop over bytes.
    let [d, e, f, g] = found;
    assert!(if is_high {
        d == 0 && e == a && f == b && g == c
    } else {
        d == a && e == b && f == c && g == 0
    });
    kani::cover!(is_high && c != 0, "into the highest limb");
    kani::cover!(!is_high && b != 0 && number[1] == 0, "into the next limb");
}

/// Asserts it of three or four limbs, compared as two integers of 128 bits.
fn adds_like_integers<const N: usize>(total: [u64; N], summand: [u64; N], negative: bool) {
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
    kani::cover!(negative && carry && sign == Ordering::Less, "a borrow");
    kani::cover!(!negative && carry && sign == Ordering::Greater, "a carry");
    kani::cover!(sign == Ordering::Equal, "zero");
}
