//! Ranges of plain doubles. Smaller and larger of two numbers, none of them NaN, in one
//! instruction each, where `f64::min` and `f64::max` take five.

/// Contains nothing.
pub(crate) const EMPTY: [f64; 2] = [f64::MAX, f64::MIN];

/// Extends the ranges by what reaches so far around a place.
pub(crate) fn extend(ranges: &mut [[f64; 2]; 2], place: [f64; 2], reach: [f64; 2]) {
    for ((range, at), reach) in ranges.iter_mut().zip(place).zip(reach) {
        let [least, most] = *range;
        *range = [smaller(least, at - reach), larger(most, at + reach)];
    }
}

pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

pub(crate) fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}
