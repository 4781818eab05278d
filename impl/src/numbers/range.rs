//! Ranges of plain doubles, and integers in them. Smaller and larger of two numbers, none of them
//! NaN, in one instruction each, where `f64::min` and `f64::max` take five.

/// Contains nothing.
pub(crate) const EMPTY: [f64; 2] = [f64::MAX, f64::MIN];

/// Extends the ranges by what reaches so far around a place.
pub(crate) fn extend(ranges: &mut [[f64; 2]; 2], place: [f64; 2], reach: [f64; 2]) {
    for ((range, at), reach) in ranges.iter_mut().zip(place).zip(reach) {
        let [least, most] = *range;
        *range = [smaller(least, at - reach), larger(most, at + reach)];
    }
}

/// Whether nothing is in the box.
pub(crate) fn is_empty(area: [[f64; 2]; 2]) -> bool {
    area.iter().any(|[least, greatest]| least > greatest)
}

pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

pub(crate) fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The nearest integer, for numbers from 0 to 2^51: 2^52 added leaves it in the lowest bits.
#[allow(clippy::cast_possible_wrap, reason = "below 2^52")]
pub(crate) fn integer(value: f64) -> i64 {
    const SHIFT: f64 = 4_503_599_627_370_496.0;
    (value + SHIFT).to_bits().wrapping_sub(SHIFT.to_bits()) as i64
}

/// A count or an index of cells, which are below 2^24.
pub(crate) fn float(count: i64) -> f64 {
    f64::from(i32::try_from(count).unwrap_or(i32::MAX))
}
