//! Numbers with error bounds, and comparisons without any error.

#[cfg(not(arbitrary = "exact"))]
pub(crate) mod exact;
#[cfg(arbitrary = "exact")]
#[path = "exact/any_answer.rs"]
pub(crate) mod exact;
pub(crate) mod plane;
pub(crate) mod range;
pub(crate) mod rectangle;
pub(crate) mod rounding;
pub(crate) mod time;
