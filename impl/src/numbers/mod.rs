//! Numbers with error bounds, and comparisons without any error.

pub(crate) mod exact;
pub(crate) mod plane;
pub(crate) mod range;
pub(crate) mod rectangle;
pub(crate) mod rounding;
pub(crate) mod time;
