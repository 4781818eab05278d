//! The record of one cycle: what the CAV knows when it decides (`spec/5-interfaces.md#cycle`).
//!
//! Everything is borrowed from the caller; numbers are the doubles as they came, and
//! `cycle::check` says what is wrong with them.
//!
//! All places are in one right-handed frame of the road plane that stands still; a direction is
//! (cos, sin) of the angle from x towards y, and to the left of it is (-sin, cos). Times are of the CAV's
//! monotonic clock.

use crate::input::parameters::Parameters;
use crate::input::profile::Profile;
use crate::services::configuration::Configuration;

/// One cycle. Positions in m, speeds in m/s, times in ns, directions as (cos, sin). Source:
/// `spec/5-interfaces.md#cycle`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cycle<'a> {
    /// Profile in force.
    pub profile: Profile,
    /// Parameters in force.
    pub parameters: Parameters,
    /// Time of the decision on the CAV's monotonic clock, ns. With H-14 pose and speed are those of then:
    /// carry older ones forward (H-14.14).
    pub now_ns: i64,
    /// Which groups are remote.
    pub configuration: Configuration,
    /// The CAV itself.
    pub ego: Ego,
    /// The planned trajectory; `None` is a missing input, here and below.
    pub trajectory: Option<Trajectory<'a>>,
    /// The track list.
    pub tracks: Option<TrackList<'a>>,
    /// The detections of all local detectors.
    pub detections: Option<DetectionList<'a>>,
    /// The leading vehicle.
    pub lead: Option<Lead>,
    /// The route.
    pub route: Route<'a>,
    /// The occupancy grid map.
    pub grid: Option<Grid<'a>>,
    /// Earlier lists of the CAV's own detections, the youngest first: at most 4
    /// (`spec/hardened/what-the-cav-saw.md`).
    pub detection_history: &'a [DetectionList<'a>],
}

/// Pose, speed and size of the CAV. Source: `spec/5-interfaces.md#cycle`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ego {
    /// Position of the reference point, the rear axle or up to L/2 ahead of it, m.
    pub x: f64,
    /// Position of the reference point, m.
    pub y: f64,
    /// Direction.
    pub cos: f64,
    /// Direction.
    pub sin: f64,
    /// `v_now`, m/s.
    pub speed: f64,
    /// Length L, m.
    pub length: f64,
    /// Width W, m.
    pub width: f64,
    /// From the reference point forward to the centre of the rectangle, m.
    pub center_offset: f64,
}

/// A trajectory with the time at which it was made. Source: `spec/5-interfaces.md#cycle`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trajectory<'a> {
    /// Time of generation, ns.
    pub stamp_ns: i64,
    /// Points in order of time.
    pub points: &'a [TrajectoryPoint],
}

/// One pose of a trajectory: a place of the CAV's reference point. Source: `spec/5-interfaces.md#cycle`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrajectoryPoint {
    /// When the CAV is to be there, ns.
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

/// A list of tracks. Source: `spec/5-interfaces.md#cycle`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrackList<'a> {
    /// Time that the positions are valid for, ns.
    pub stamp_ns: i64,
    /// Tracks in list order.
    pub items: &'a [Track],
}

/// A tracked object. Source: `spec/5-interfaces.md#cycle`.
#[derive(Clone, Copy, Debug, PartialEq)]
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
    /// Velocity over ground, m/s.
    pub vx: f64,
    /// Velocity, m/s.
    pub vy: f64,
    /// Length, m.
    pub length: f64,
    /// Width, m.
    pub width: f64,
}

/// The detections of all local detectors. Source: `spec/5-interfaces.md#cycle`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DetectionList<'a> {
    /// Time of measurement, ns.
    pub stamp_ns: i64,
    /// Detections in list order.
    pub items: &'a [Detection],
}

/// A detected object. Source: `spec/5-interfaces.md#cycle`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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

impl Detection {
    /// All zero: a place to be lent, and no valid detection. Source: `spec/monitor.md#monitor`.
    pub const EMPTY: Self = Self { x: 0.0, y: 0.0, cos: 0.0, sin: 0.0, length: 0.0, width: 0.0 };
}

/// The leading vehicle. Source: `spec/5-interfaces.md#cycle`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lead {
    /// Time of measurement, ns.
    pub stamp_ns: i64,
    /// Free distance along the reference path, bumper to bumper: from the front edge of the CAV's
    /// rectangle to the nearest point of the leading vehicle, m.
    pub gap: f64,
    /// `v_lead` at that time, along the path, m/s.
    pub speed: f64,
}

/// A route: reference path and boundaries. Source: `spec/5-interfaces.md#cycle`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Route<'a> {
    /// The last cross section is followed by the first.
    pub closed: bool,
    /// Cross sections in driving order.
    pub cross_sections: &'a [CrossSection],
}

/// One cross section of a route. Source: `spec/5-interfaces.md#cycle`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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

impl CrossSection {
    /// All zero: a place to be lent. Source: `spec/monitor.md#monitor`.
    pub const EMPTY: Self = Self { x: 0.0, y: 0.0, left: [0.0; 2], right: [0.0; 2] };
}

/// An occupancy grid map; the cell (column i, row k) is the square from (i, k) to (i+1, k+1)
/// times `resolution` in the frame (x, y, cos, sin). Source: `spec/5-interfaces.md#cycle`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid<'a> {
    /// Time of measurement, ns.
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
    pub occupied: &'a [u8],
    /// The same form; a cell both occupied and unknown is occupied.
    pub unknown: Option<&'a [u8]>,
}
