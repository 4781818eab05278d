//! `exact` for the proofs on compiled code of what only asks it: any answer to every question, which
//! is more than its contract allows. `scripts/prove-wasm` alone sets `arbitrary = "exact"`.

use core::cmp::Ordering;

pub(crate) mod limbs;

#[derive(Clone, Copy, Debug)]
pub(crate) struct Product(pub(crate) [f64; 2], pub(crate) [f64; 2]);

pub(crate) fn compare(_left: &[Product], _right: &[Product]) -> Ordering {
    any()
}

pub(crate) fn orientation(_a: [f64; 2], _b: [f64; 2], _c: [f64; 2]) -> Ordering {
    any()
}

pub(crate) fn certain_orientation(_a: [f64; 2], _b: [f64; 2], _c: [f64; 2]) -> f64 {
    arbitrary::any_f64()
}

pub(crate) fn compare_distances(_p: [f64; 2], _a: [f64; 2], _b: [f64; 2]) -> Ordering {
    any()
}

pub(crate) fn compare_moved_distances(
    _p: [f64; 2],
    _moved: ([f64; 2], [f64; 2], i64),
    _still: [f64; 2],
) -> Ordering {
    any()
}

fn any() -> Ordering {
    match arbitrary::any_below(3) {
        0 => Ordering::Less,
        1 => Ordering::Equal,
        _ => Ordering::Greater,
    }
}
