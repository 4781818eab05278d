//! What there is to be seen.

use crate::pose::{Point, Rectangle};

/// An object as it really is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// Who it is; no detector tells.
    pub id: u32,
    /// Where it is.
    pub rectangle: Rectangle,
    /// Velocity over ground, m/s.
    pub velocity: Point,
}
