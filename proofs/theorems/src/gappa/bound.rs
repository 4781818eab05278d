//! What a bound claims, and of what.

use crate::numbers::real::Real;

/// A bound on a rounding error.
#[derive(Debug)]
pub struct Bound {
    /// Its name.
    pub id: &'static str,
    /// What is claimed.
    pub statement: &'static str,
    /// Of which numbers.
    pub domain: &'static str,
    /// Of `formula`, over the ranges of its inputs.
    pub(super) formula: fn() -> Real,
    pub(super) inputs: &'static [InputRange],
    /// Whether the limit is one of the relative error.
    pub(super) relative: bool,
    /// Values within the formula of which a bound is known from another line.
    pub(super) known: &'static [fn() -> Real],
    /// What is known of these.
    pub(super) lemma: Known,
    /// What is shown first of a value of which the maximum with 0 is taken, and used of that: the
    /// maximum makes no error larger.
    pub(super) of_max: Known,
    /// The limit claimed.
    pub(super) limit: &'static str,
    /// A smaller one, for which there must be no proof.
    pub(super) wrong: &'static str,
}

/// An input: name, least and largest value.
pub(super) type InputRange = (&'static str, &'static str, &'static str);

/// A value from 0 to `most` with an absolute error of at most `error`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Known {
    pub(super) most: &'static str,
    pub(super) error: &'static str,
}
