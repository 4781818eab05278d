//! The record of one cycle as C gives it (`spec/5-interfaces.md#cycle`): positions in m, speeds in
//! m/s, directions as cos and sin. Values outside their domain are found by the check.

use crate::parameters::MufasaParameters;
use crate::time::{MufasaGap, MufasaTime};

/// A profile; `MufasaCycle.profile` and `mufasa_requester_init` take its number.
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

/// Pose, speed and size of the CAV: x, y is its reference point (the rear axle, or up to length/2 ahead of it), and the
/// centre of its rectangle is `center_offset` ahead of that.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "the names are those of spec/5-interfaces.md")]
pub struct MufasaEgo {
    pub x: f64,
    pub y: f64,
    pub cos: f64,
    pub sin: f64,
    pub speed: f64,
    pub length: f64,
    pub width: f64,
    pub center_offset: f64,
}

/// One pose of a trajectory.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "the names are those of spec/5-interfaces.md")]
pub struct MufasaTrajectoryPoint {
    pub t: MufasaTime,
    pub x: f64,
    pub y: f64,
    pub cos: f64,
    pub sin: f64,
}

/// The planned trajectory. Points are places of the reference point that MufasaEgo names.
///
/// In the hardened profile stage ii asks of the points, over their whole length:
/// * start: the first within `max_age_ns` of now and `start_tolerance` of the CAV's reference point (plus what it
///   drives since), at most `lateral_tolerance` aside, heading as the CAV to about 10 degrees (H-07);
/// * steps: at most `step_max_ns`, L and `v_max` dt from point to point, forwards along both headings, which
///   turn as a vehicle can (H-11);
/// * corridor: every point inside, none heading against the route (H-07);
/// * horizon: as far as the CAV needs to stand from its speed, less L, and for v / `a_b` after its start, nowhere
///   behind a full braking by more than `lag_tolerance` nor ahead of full acceleration (H-12).
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

/// A tracked object.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "the names are those of spec/5-interfaces.md")]
pub struct MufasaTrack {
    pub id: i64,
    pub x: f64,
    pub y: f64,
    pub cos: f64,
    pub sin: f64,
    pub vx: f64,
    pub vy: f64,
    pub length: f64,
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

/// A detected object.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "the names are those of spec/5-interfaces.md")]
pub struct MufasaDetection {
    pub x: f64,
    pub y: f64,
    pub cos: f64,
    pub sin: f64,
    pub length: f64,
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

/// The leading vehicle.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "the names are those of spec/5-interfaces.md")]
pub struct MufasaLead {
    pub stamp: MufasaTime,
    pub gap: MufasaGap,
    pub speed: f64,
}

/// One cross section of a route.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "the names are those of spec/5-interfaces.md")]
pub struct MufasaCrossSection {
    pub x: f64,
    pub y: f64,
    pub left: [f64; 2],
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

/// An occupancy grid map.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaGrid {
    /// Time of measurement.
    pub stamp: MufasaTime,
    /// Origin.
    pub x: f64,
    /// Origin.
    pub y: f64,
    /// Direction of the rows.
    pub cos: f64,
    /// Direction of the rows.
    pub sin: f64,
    /// Side of a cell.
    pub resolution: f64,
    /// Columns.
    pub width: i64,
    /// Rows.
    pub height: i64,
    /// Bit row * width + column, least significant bit of each byte first.
    pub occupied: *const u8,
    /// Bytes of `occupied`: (width * height + 7) / 8.
    pub occupied_len: usize,
    /// The same form, or null.
    pub unknown: *const u8,
    /// Bytes of `unknown`.
    pub unknown_len: usize,
}

/// One cycle. A null pointer is a missing input.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaCycle {
    /// A MufasaProfile.
    pub profile: u32,
    /// A MufasaConfiguration.
    pub configuration: u32,
    /// Time of the decision on the CAV's monotonic clock.
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
    /// in ALL_REMOTE each counts as standing, too (H-09), and no detection is explained (H-10); with
    /// none of them what moves is not looked for (H-13). The verdict is then valid, but rejects
    /// more and knows less. `mufasa_detection_index_init` saves reading a list in every cycle.
    pub detection_history: *const MufasaDetectionList,
    /// How many.
    pub detection_history_len: usize,
}
