//! The record of one cycle: what the CAV knows when it decides (`spec/5-interfaces.md#cycle`).
//!
//! Field names are those of the JSON record. Numbers are the doubles as they came, NaN and
//! infinities included; `input` turns them into exact numbers or says what is wrong with them.

pub use crate::input::profile::Profile;

use crate::input::parameters::Parameters;
use crate::services::configuration::Configuration;

/// One cycle. Positions in m, speeds in m/s, times in ns, directions as (cos, sin).
#[derive(Clone, Debug, PartialEq)]
pub struct Cycle {
    /// Profile in force.
    pub profile: Profile,
    /// Parameters in force.
    pub parameters: Parameters,
    /// Time of the decision on the CAV's monotonic clock.
    pub now_ns: i64,
    /// Which groups are remote.
    pub configuration: Configuration,
    /// The CAV itself.
    pub ego: Ego,
    /// The planned trajectory; `None` is a missing input, here and below.
    pub trajectory: Option<Trajectory>,
    /// The track list.
    pub tracks: Option<TrackList>,
    /// The detections of all local detectors.
    pub detections: Option<DetectionList>,
    /// The leading vehicle.
    pub lead: Option<Lead>,
    /// The route.
    pub route: Route,
    /// The occupancy grid map.
    pub grid: Option<Grid>,
    /// Earlier lists of the CAV's own detections, the youngest first: at most 4
    /// (`spec/hardened/what-the-cav-saw.md`).
    pub detection_history: Vec<DetectionList>,
}

/// Pose, speed and size of the CAV.
#[derive(Clone, Debug, PartialEq)]
pub struct Ego {
    /// Position, m.
    pub x: f64,
    /// Position, m.
    pub y: f64,
    /// Direction.
    pub cos: f64,
    /// Direction.
    pub sin: f64,
    /// v_now, m/s.
    pub speed: f64,
    /// Length L, m.
    pub length: f64,
    /// Width W, m.
    pub width: f64,
    /// From the position forward to the centre of the rectangle, m.
    pub center_offset: f64,
}

/// A trajectory with the time at which it was made.
#[derive(Clone, Debug, PartialEq)]
pub struct Trajectory {
    /// Time of generation.
    pub stamp_ns: i64,
    /// Points in order of time.
    pub points: Vec<TrajectoryPoint>,
}

/// One pose of a trajectory.
#[derive(Clone, Debug, PartialEq)]
pub struct TrajectoryPoint {
    /// When the CAV is to be there.
    pub t_ns: i64,
    /// Position, m.
    pub x: f64,
    /// Position, m.
    pub y: f64,
    /// Direction.
    pub cos: f64,
    /// Direction.
    pub sin: f64,
}

/// A list of tracks.
#[derive(Clone, Debug, PartialEq)]
pub struct TrackList {
    /// Time that the positions are valid for.
    pub stamp_ns: i64,
    /// Tracks in list order.
    pub items: Vec<Track>,
}

/// A tracked object.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// Identity over time.
    pub id: i64,
    /// Centre, m.
    pub x: f64,
    /// Centre, m.
    pub y: f64,
    /// Direction.
    pub cos: f64,
    /// Direction.
    pub sin: f64,
    /// Velocity, m/s.
    pub vx: f64,
    /// Velocity, m/s.
    pub vy: f64,
    /// Length, m.
    pub length: f64,
    /// Width, m.
    pub width: f64,
}

/// The detections of all local detectors.
#[derive(Clone, Debug, PartialEq)]
pub struct DetectionList {
    /// Time of measurement.
    pub stamp_ns: i64,
    /// Detections in list order.
    pub items: Vec<Detection>,
}

/// A detected object.
#[derive(Clone, Debug, PartialEq)]
pub struct Detection {
    /// Centre, m.
    pub x: f64,
    /// Centre, m.
    pub y: f64,
    /// Direction.
    pub cos: f64,
    /// Direction.
    pub sin: f64,
    /// Length, m.
    pub length: f64,
    /// Width, m.
    pub width: f64,
}

/// The leading vehicle.
#[derive(Clone, Debug, PartialEq)]
pub struct Lead {
    /// Time of measurement.
    pub stamp_ns: i64,
    /// Free distance bumper to bumper, m.
    pub gap: f64,
    /// v_lead, m/s.
    pub speed: f64,
}

/// A route: reference path and boundaries.
#[derive(Clone, Debug, PartialEq)]
pub struct Route {
    /// The last cross section is followed by the first.
    pub closed: bool,
    /// Cross sections in driving order.
    pub cross_sections: Vec<CrossSection>,
}

/// One cross section of a route.
#[derive(Clone, Debug, PartialEq)]
pub struct CrossSection {
    /// Reference point, m.
    pub x: f64,
    /// Reference point, m.
    pub y: f64,
    /// Left boundary point, m.
    pub left: [f64; 2],
    /// Right boundary point, m.
    pub right: [f64; 2],
}

/// An occupancy grid map; the cell (column i, row k) is the square from (i, k) to (i+1, k+1)
/// times `resolution` in the frame (x, y, cos, sin).
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// Time of measurement.
    pub stamp_ns: i64,
    /// Origin, m.
    pub x: f64,
    /// Origin, m.
    pub y: f64,
    /// Direction of the rows.
    pub cos: f64,
    /// Direction of the rows.
    pub sin: f64,
    /// Side of a cell, m.
    pub resolution: f64,
    /// Columns.
    pub width: i64,
    /// Rows.
    pub height: i64,
    /// Bit row * width + column, least significant bit of each byte first.
    pub occupied: Vec<u8>,
    /// The same form; a cell both occupied and unknown is occupied.
    pub unknown: Option<Vec<u8>>,
}
