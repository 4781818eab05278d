//! `rounding` for the proofs on compiled code of what only asks it: numbers of which nothing is known,
//! and any answer to every question, which is more than its contract allows. `scripts/prove-wasm`
//! alone sets `arbitrary = "rounding"`.

use core::ops::{Add, Mul, Neg, Sub};

/// Any number.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Real;

impl Real {
    pub(crate) const ZERO: Self = Self;
    pub(crate) const ONE: Self = Self;

    pub(crate) const fn new(_value: f64) -> Self {
        Self
    }

    pub(crate) fn difference(_a: f64, _b: f64) -> Self {
        Self
    }

    pub(crate) fn seconds(_time_ns: i64) -> Self {
        Self
    }

    pub(crate) fn integer(_value: i64) -> Self {
        Self
    }

    pub(crate) fn value(self) -> f64 {
        arbitrary::any_f64()
    }

    pub(crate) fn off(self) -> f64 {
        arbitrary::any_f64()
    }

    pub(crate) fn widened(self, _by: f64) -> Self {
        Self
    }

    pub(crate) fn either(self, _other: Self) -> Self {
        Self
    }

    pub(crate) fn squared(self) -> Self {
        Self
    }

    pub(crate) fn abs(self) -> Self {
        Self
    }

    pub(crate) fn max(self, _other: Self) -> Self {
        Self
    }

    pub(crate) fn min(self, _other: Self) -> Self {
        Self
    }

    pub(crate) fn over(self, _other: Self) -> Self {
        Self
    }

    pub(crate) fn sqrt(self) -> Self {
        Self
    }

    pub(crate) fn certainly_below(self, _other: Self) -> bool {
        any()
    }

    pub(crate) fn certainly_at_most(self, _other: Self) -> bool {
        any()
    }

    pub(crate) fn possibly_below(self, _other: Self) -> bool {
        any()
    }

    pub(crate) fn possibly_at_most(self, _other: Self) -> bool {
        any()
    }

    pub(crate) fn magnitude(self) -> f64 {
        arbitrary::any_f64()
    }
}

fn any() -> bool {
    arbitrary::any_below(2) == 1
}

impl Neg for Real {
    type Output = Self;

    fn neg(self) -> Self {
        Self
    }
}

impl Add for Real {
    type Output = Self;

    fn add(self, _other: Self) -> Self {
        Self
    }
}

impl Sub for Real {
    type Output = Self;

    fn sub(self, _other: Self) -> Self {
        Self
    }
}

impl Mul for Real {
    type Output = Self;

    fn mul(self, _other: Self) -> Self {
        Self
    }
}
