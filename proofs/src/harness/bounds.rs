//! The bounds of all harnesses, each with its reason. A proof holds within them and says nothing
//! beyond.

/// Places of a requester's table. One for the station in use and one for another: no law speaks
/// of more than two stations at once.
pub const CROSS_SECTIONS: usize = 2;

/// Tracks: two are the fewest that can share an id, compete for a detection, and be one backed and
/// one not.
pub const TRACKS: usize = 2;

/// Detections, where numbers are arbitrary: as many as tracks, so that neither side is always the
/// smaller one, because fewer of either are drawn too.
pub const DETECTIONS: usize = 2;

/// Trajectory points: with three, a step has one before it or after it.
pub const POINTS: usize = 3;

/// Stations of a route: with three, a segment has one before it or after it, and a closed route
/// encloses an area.
pub const ROUTE: usize = 3;

/// Cells a side of a grid: with four there are cells on the border and cells inside.
pub const GRID: u8 = 4;

/// Bytes of such a grid's bitmap.
pub const GRID_BYTES: usize = 2;

/// Positions on a line in the assignment: with tracks and detections on 0 to 3 every order of up
/// to five points occurs, with ties.
pub const PLACES: u8 = 4;

/// Detections in the assignment: one more than tracks, so that some stays without a track.
pub const COLUMNS: usize = 3;

/// Items of an earlier list of detections: as many as tracks, so that each may have its own origin,
/// or both the same one.
pub const ITEMS: usize = 2;

/// Largest number of disks: two have different centres; more change nothing but their places.
pub const DISKS: i64 = 2;
