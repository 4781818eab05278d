//! The bounds of all harnesses, each with its reason. A proof holds within them and says nothing
//! beyond.

/// Places of a requester's table. One for the station in use and one for another: no law speaks
/// of more than two stations at once.
pub const CROSS_SECTIONS: usize = 2;

/// Cells a side of a grid: with four there are cells on the border and cells inside.
pub const GRID: u8 = 4;

/// Bytes of such a grid's bitmap.
pub const GRID_BYTES: usize = 2;
