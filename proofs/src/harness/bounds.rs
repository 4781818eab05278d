//! The bounds of all harnesses, each with its reason. A proof holds within them and says nothing
//! beyond.

/// Places of a requester's table. One for the station in use and one for another: no law speaks
/// of more than two stations at once.
pub const CROSS_SECTIONS: usize = 2;

/// Tracks: two are the fewest that can share an id and of which one alone can be gated.
pub const TRACKS: usize = 2;

/// Detections: as many as tracks.
pub const DETECTIONS: usize = 2;

/// Trajectory points: with three, a step has one before it or after it.
pub const POINTS: usize = 3;

/// Cells a side of a grid: with four there are cells on the border and cells inside.
pub const GRID: u8 = 4;

/// Bytes of such a grid's bitmap.
pub const GRID_BYTES: usize = 2;
