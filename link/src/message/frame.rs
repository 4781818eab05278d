//! Where the frame of the map lies on the earth (`spec/6-link.md#frame`).

/// The reference position: a point of the map's frame, and where it is on the earth. The map's x points
/// east and its y north. Vehicle and station have the same one. Source: `spec/6-link.md#frame`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Latitude of the reference position in WGS84, 0.1 microdegree, north positive, within +-80 degrees.
    pub latitude: i32,
    /// Longitude of the reference position in WGS84, 0.1 microdegree, east positive.
    pub longitude: i32,
    /// Its x in the frame of the map, m.
    pub x: f64,
    /// Its y in the frame of the map, m.
    pub y: f64,
}
