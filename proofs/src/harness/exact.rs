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
    let (total, summand, negative) = (limbs(), limbs(), kani::any());
    let (found, sign) = sum_of_limbs(total, &summand, negative);
    let low = |[low, middle, _]: [u64; 3]| u128::from(low) | u128::from(middle) << 64;
    let (expected, carry) = if negative {
        low(total).overflowing_sub(low(summand))
    } else {
        low(total).overflowing_add(low(summand))
    };
    let top = if negative {
        total[2].wrapping_sub(summand[2]).wrapping_sub(u64::from(carry))
    } else {
        total[2].wrapping_add(summand[2]).wrapping_add(u64::from(carry))
    };
    assert!(low(found) == expected && found[2] == top);
    let is_zero = expected == 0 && top == 0;
    assert!((sign == Ordering::Less) == (top >> 63 == 1));
    assert!((sign == Ordering::Equal) == is_zero);
    kani::cover!(negative && carry && sign == Ordering::Less, "a borrow");
    kani::cover!(!negative && carry && sign == Ordering::Greater, "a carry");
    kani::cover!(is_zero, "zero");
}

/// The same of four limbs.
///
/// Domain: all integers of 256 bits. Not covered: the 36 limbs of `exact`, products.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(6))]
pub fn verify_four_limbs_add_like_integers() {
    let [total, summand] = [four_limbs(), four_limbs()];
    let negative = kani::any();
    let (found, sign) = sum_of_limbs(total, &summand, negative);
    let low = |[low, high, ..]: [u64; 4]| u128::from(low) | u128::from(high) << 64;
    let high = |[_, _, low, high]: [u64; 4]| u128::from(low) | u128::from(high) << 64;
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
    assert!(low(found) == expected && high(found) == top);
    let is_zero = expected == 0 && top == 0;
    assert!((sign == Ordering::Less) == (top >> 127 == 1));
    assert!((sign == Ordering::Equal) == is_zero);
    kani::cover!(negative && carry && sign == Ordering::Less, "a borrow");
    kani::cover!(!negative && carry && sign == Ordering::Greater, "a carry");
    kani::cover!(is_zero, "zero");
}

fn limbs() -> [u64; 3] {
    [kani::any(), kani::any(), kani::any()]
}

fn four_limbs() -> [u64; 4] {
    [kani::any(), kani::any(), kani::any(), kani::any()]
}
