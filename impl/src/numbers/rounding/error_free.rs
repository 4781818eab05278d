//! Sums and products of which nothing is lost.

/// Numbers of a format of floating point; each result is rounded.
pub(super) trait Floating: Copy {
    fn plus(self, other: Self) -> Self;
    fn minus(self, other: Self) -> Self;
    fn times(self, other: Self) -> Self;
}

impl Floating for f64 {
    #[inline]
    fn plus(self, other: Self) -> Self {
        self + other
    }

    #[inline]
    fn minus(self, other: Self) -> Self {
        self - other
    }

    #[inline]
    fn times(self, other: Self) -> Self {
        self * other
    }
}

/// The rounded sum and its error, exactly (Knuth). In every format of floating point; the tests run
/// all numbers of small ones.
pub(super) fn two_sum<N: Floating>(a: N, b: N) -> (N, N) {
    let sum = a.plus(b);
    let part = sum.minus(a);
    // (a - (sum - part)) + (b - part)
    (sum, a.minus(sum.minus(part)).plus(b.minus(part)))
}

/// The rounded product and its error, exactly unless it underflows (Dekker). The factors stay far
/// below 2^996, where the splitting would overflow.
pub(super) fn two_product(a: f64, b: f64) -> (f64, f64) {
    two_product_by(SPLITTER, a, b)
}

/// 2^27 + 1: half of 53 bits, rounded up.
const SPLITTER: f64 = 134_217_729.0;

/// The same in every format of floating point with its own splitter.
pub(super) fn two_product_by<N: Floating>(splitter: N, a: N, b: N) -> (N, N) {
    let product = a.times(b);
    let (a1, a2) = split(splitter, a);
    let (b1, b2) = split(splitter, b);
    // ((a1 b1 - product) + a1 b2 + a2 b1) + a2 b2
    let lost = a1.times(b1).minus(product).plus(a1.times(b2)).plus(a2.times(b1));
    (product, lost.plus(a2.times(b2)))
}

/// Two halves of at most 26 bits each that add up to `a` (Veltkamp).
fn split<N: Floating>(splitter: N, a: N) -> (N, N) {
    let shifted = splitter.times(a);
    let high = shifted.minus(shifted.minus(a));
    (high, a.minus(high))
}

#[cfg(test)]
mod small_formats;
