//! The record of one cycle as C gives it (`spec/5-interfaces.md#cycle`): positions in m, speeds in
//! m/s, directions as cos and sin. Values outside their domain are found by the check.

use crate::parameters::MufasaParameters;
use crate::time::{MufasaGap, MufasaTime};

/// A profile; `MufasaMonitorSettings.profile` and `MufasaCycle.profile` take its number.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MufasaProfile {
    /// The published method.
    Paper = 1,
    /// The published method and the rules H-nn.
    Hardened = 2,
}

/// Which groups are remote; `MufasaCycle.configuration` takes its number.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MufasaConfiguration {
    /// None.
    Local = 1,
    /// MOT.
    MotRemote = 2,
    /// MOT and PLAN.
    AllRemote = 3,
    /// PLAN.
    PlanRemote = 4,
}

/// Pose, speed and size of the CAV, in the right-handed frame of the cycle, which stands still. x, y is its reference
/// point (the rear axle, or up to length/2 ahead of it), and the centre of its rectangle is `center_offset` ahead of that.
/// (cos, sin) is the direction that it heads in, as an angle from x towards y.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaEgo {
    /// Place of the reference point, m.
    pub x: f64,
    /// Place of the reference point, m.
    pub y: f64,
    /// cos of the direction.
    pub cos: f64,
    /// sin of the direction.
    pub sin: f64,
    /// Not below 0, m/s.
    pub speed: f64,
    /// Of the rectangle, along the direction, m.
    pub length: f64,
    /// Of the rectangle, across, m.
    pub width: f64,
    /// From the reference point forward to the centre of the rectangle (negative: back), m.
    pub center_offset: f64,
}

/// One pose of a trajectory: x, y is the place of the CAV's reference point (that of MufasaEgo, not the centre of its
/// rectangle), (cos, sin) the direction that it heads in, in the right-handed frame of the cycle, which stands still.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaTrajectoryPoint {
    /// When the CAV is to be there.
    pub t: MufasaTime,
    /// Place of the reference point, m.
    pub x: f64,
    /// Place of the reference point, m.
    pub y: f64,
    /// cos of the direction.
    pub cos: f64,
    /// sin of the direction.
    pub sin: f64,
}

/// The planned trajectory. Points are places of the CAV's reference point (that of MufasaEgo), in the right-handed frame of
/// the cycle, which stands still.
///
/// In the hardened profile stage ii asks of the points, over their whole length:
/// * start: the first within `max_age_ns` of now, at most `lateral_tolerance` aside, heading as the CAV to about 10
///   degrees (H-07);
/// * position: none farther from the CAV's reference point than the CAV can drive by its time, speeding up by
///   `a_max`, and `start_tolerance` (H-07);
/// * steps: at most `step_max_ns`, L and `v_max` dt from point to point, forwards along both headings, which
///   turn as a vehicle can (H-11);
/// * reach: the path from the CAV through those that are ahead of it, and straight on, beyond what the CAV can
///   drive by at most `lateral_tolerance` (H-14). Behind its last point, and whatever its times say, the CAV has to be able to
///   go on and stop;
/// * corridor: every point inside, none heading against the route (H-07), and each place of that path inside, up to
///   where the CAV stands at the latest (H-14).
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaTrajectory {
    /// Time of generation.
    pub stamp: MufasaTime,
    /// Points in order of time.
    pub points: *const MufasaTrajectoryPoint,
    /// How many.
    pub points_len: usize,
}

/// A tracked object, in the right-handed frame of the cycle, which stands still (not relative to the CAV). x, y is the
/// centre of its rectangle, (cos, sin) its direction; its velocity is over ground in the same frame.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaTrack {
    /// Identity over time.
    pub id: i64,
    /// Centre of the rectangle, m.
    pub x: f64,
    /// Centre of the rectangle, m.
    pub y: f64,
    /// cos of the direction.
    pub cos: f64,
    /// sin of the direction.
    pub sin: f64,
    /// Velocity along the frame's x, m/s.
    pub vx: f64,
    /// Velocity along the frame's y, m/s.
    pub vy: f64,
    /// Of the rectangle, along the direction, m.
    pub length: f64,
    /// Of the rectangle, across, m.
    pub width: f64,
}

/// A list of tracks.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaTrackList {
    /// Time that the positions are valid for.
    pub stamp: MufasaTime,
    /// Tracks in list order.
    pub items: *const MufasaTrack,
    /// How many.
    pub items_len: usize,
}

/// A detected object, in the right-handed frame of the cycle, which stands still (not relative to the CAV). x, y is the
/// centre of its rectangle, (cos, sin) its direction.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaDetection {
    /// Centre of the rectangle, m.
    pub x: f64,
    /// Centre of the rectangle, m.
    pub y: f64,
    /// cos of the direction.
    pub cos: f64,
    /// sin of the direction.
    pub sin: f64,
    /// Of the rectangle, along the direction, m.
    pub length: f64,
    /// Of the rectangle, across, m.
    pub width: f64,
}

/// The detections of all local detectors.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaDetectionList {
    /// Time of measurement.
    pub stamp: MufasaTime,
    /// Detections in list order.
    pub items: *const MufasaDetection,
    /// How many.
    pub items_len: usize,
}

/// The leading vehicle: its free distance and speed along the reference path, the former bumper to bumper.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaLead {
    /// Time of measurement.
    pub stamp: MufasaTime,
    /// From bumper to bumper, in metres.
    pub gap: MufasaGap,
    /// Speed of the leading vehicle over ground along the reference path at the time of measurement, not below 0, m/s.
    pub speed: f64,
}

/// One cross section of a route, in the right-handed frame of the cycle, which stands still. x, y is its point of the
/// reference path; the left boundary is to the left of the driving direction (cos, sin), on the side of (-sin, cos).
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaCrossSection {
    /// Point of the reference path, m.
    pub x: f64,
    /// Point of the reference path, m.
    pub y: f64,
    /// x and y of the left boundary, m.
    pub left: [f64; 2],
    /// x and y of the right boundary, m.
    pub right: [f64; 2],
}

/// Reference path and boundaries.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaRoute {
    /// Not 0: the last cross section is followed by the first.
    pub closed: u8,
    /// Cross sections in driving order.
    pub cross_sections: *const MufasaCrossSection,
    /// How many.
    pub cross_sections_len: usize,
}

/// An occupancy grid map. x, y is its origin, a corner (not the centre), in the right-handed frame of the cycle, which
/// stands still; columns count from there in the direction (cos, sin), rows in (-sin, cos), to the left of it. The cell of
/// column i and row k is the square from (i, k) to (i + 1, k + 1) times `resolution`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaGrid {
    /// Time of measurement.
    pub stamp: MufasaTime,
    /// The origin, m.
    pub x: f64,
    /// The origin, m.
    pub y: f64,
    /// cos of the direction.
    pub cos: f64,
    /// sin of the direction.
    pub sin: f64,
    /// Side of a cell, m.
    pub resolution: f64,
    /// Columns.
    pub width: i64,
    /// Rows.
    pub height: i64,
    /// Bit row * width + column, least significant bit of each byte first; 1 is occupied.
    pub occupied: *const u8,
    /// Bytes of `occupied`: (width * height + 7) / 8.
    pub occupied_len: usize,
    /// The same form, 1 is unknown, or null; a cell both occupied and unknown is occupied.
    pub unknown: *const u8,
    /// Bytes of `unknown`.
    pub unknown_len: usize,
}

/// One cycle. A null pointer is a missing input.
///
/// All places are in one right-handed frame of the road plane that stands still (UTM, or any other); lengths in m,
/// speeds in m/s. A direction (cos, sin) is that of an angle from x towards y; to the left of it is (-sin, cos). Times
/// are of the CAV's monotonic clock.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaCycle {
    /// A MufasaProfile.
    pub profile: u32,
    /// A MufasaConfiguration.
    pub configuration: u32,
    /// The time that pose and speed of the CAV are of, on its monotonic clock: carry older ones forward to it (H-14.14).
    pub now: MufasaTime,
    /// Start from `mufasa_parameters_default`.
    pub parameters: MufasaParameters,
    /// The CAV itself.
    pub ego: MufasaEgo,
    /// The route.
    pub route: MufasaRoute,
    /// May be null.
    pub trajectory: *const MufasaTrajectory,
    /// May be null.
    pub tracks: *const MufasaTrackList,
    /// May be null.
    pub detections: *const MufasaDetectionList,
    /// May be null.
    pub lead: *const MufasaLead,
    /// May be null.
    pub grid: *const MufasaGrid,
    /// Earlier lists of the CAV's own detections, the youngest first (stamps strictly decreasing), at
    /// most 4. May be null when there is none. Keep every list that was `detections` for a second.
    /// Used are those that are 200 ms to 1 s older than `detections`: give the lists whose ages are
    /// nearest to 300, 500 and 800 ms, the one nearest to 500 ms being the reference. A cycle that was
    /// not safe leaves its detections in the history like any other; older than 60 s, a list counts
    /// as missing. With fewer than two of these no track is backed: none may miss its detection (H-01),
    /// and no detection is explained, so that each counts as standing, too; with none of them only
    /// tracks are looked at as moving (H-14). The verdict is then valid, but rejects more and knows less.
    pub detection_history: *const MufasaDetectionList,
    /// How many.
    pub detection_history_len: usize,
}
