//! Integers in two's complement, lowest limb first.

use core::cmp::Ordering;

pub(crate) fn sign<const N: usize>(limbs: &[u64; N]) -> Ordering {
    if limbs.last().is_some_and(|&top| top >> 63 == 1) {
        Ordering::Less
    } else if limbs.iter().any(|&limb| limb != 0) {
        Ordering::Greater
    } else {
        Ordering::Equal
    }
}

/// total += summand or total -= summand, in two's complement.
pub(crate) fn add<const N: usize>(total: &mut [u64; N], summand: &[u64; N], negative: bool) {
    let mut carry = u128::from(negative);
    for (digit, &part) in total.iter_mut().zip(summand) {
        let part = if negative { !part } else { part };
        let full = u128::from(*digit).wrapping_add(u128::from(part)).wrapping_add(carry);
        let high;
        (*digit, high) = halves(full);
        carry = u128::from(high);
    }
}

/// a b of integers without a sign; what is above `W` limbs is lost.
pub(crate) fn product<const N: usize, const W: usize>(a: &[u64; N], b: &[u64; N]) -> [u64; W] {
    let mut product = [0; W];
    for (offset, &x) in a.iter().enumerate().filter(|&(_, &x)| x != 0) {
        let mut carry = 0_u64;
        let factors = b.iter().chain(core::iter::repeat(&0));
        for (digit, &y) in product.iter_mut().skip(offset).zip(factors) {
            // x y + digit + carry <= (2^64 - 1)^2 + 2 (2^64 - 1) < 2^128
            let full = u128::from(x)
                .wrapping_mul(u128::from(y))
                .wrapping_add(u128::from(*digit))
                .wrapping_add(u128::from(carry));
            (*digit, carry) = halves(full);
        }
    }
    product
}

/// Low and high half.
#[allow(clippy::cast_possible_truncation, reason = "the halves are what is wanted")]
pub(crate) fn halves(full: u128) -> (u64, u64) {
    (full as u64, (full >> 64) as u64)
}
