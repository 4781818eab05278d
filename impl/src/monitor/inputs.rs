//! What the CAV knows when a cycle begins (`spec/monitor.md#monitor`).

use super::element::{Accepted, Element};
use super::time::Time;
use crate::input::cycle::{
    Detection, DetectionList, Ego, Grid, Lead, Track, TrackList, Trajectory, TrajectoryPoint,
};

/// The inputs of one cycle. What is not given is missing. Neither configuration nor profile,
/// parameters, route or earlier detections are among them: the monitor has them.
///
/// All places are in one right-handed frame of the road plane, any that stands still; a direction is
/// (cos, sin) of the angle from x towards y, left of it is (-sin, cos). Units are m, m/s and s
/// (`spec/5-interfaces.md#cycle`). Source: `spec/monitor.md#monitor`.
#[derive(Clone, Copy, Debug)]
#[must_use = "inputs are for a cycle"]
pub struct Inputs<'c> {
    pub(super) now: Time,
    pub(super) ego: Ego,
    pub(super) detections: Option<DetectionList<'c>>,
    pub(super) lead: Option<Lead>,
    pub(super) grid: Option<Grid<'c>>,
    pub(super) local_tracks: Option<TrackList<'c>>,
    pub(super) local_trajectory: Option<Trajectory<'c>>,
    pub(super) remote_tracks: Option<Element<'c, Track>>,
    pub(super) remote_trajectory: Option<Element<'c, TrajectoryPoint>>,
}

impl<'c> Inputs<'c> {
    /// Nothing but the CAV itself. `now` is the time that pose and speed are of: carry older ones forward to it
    /// (H-14.14). `tau` and `brake_by` count from it. Source: `spec/monitor.md#monitor`.
    pub const fn new(now: Time, ego: Ego) -> Self {
        Self {
            now,
            ego,
            detections: None,
            lead: None,
            grid: None,
            local_tracks: None,
            local_trajectory: None,
            remote_tracks: None,
            remote_trajectory: None,
        }
    }

    /// With the detections of all local detectors, measured at `stamp`. The monitor keeps a copy for
    /// later cycles. Source: `spec/hardened/what-the-cav-saw.md`.
    pub const fn detections(mut self, stamp: Time, items: &'c [Detection]) -> Self {
        self.detections = Some(DetectionList { stamp_ns: stamp.as_nanoseconds(), items });
        self
    }

    /// With the leading vehicle, measured at `stamp`; its speed at that time in m/s, >= 0. A lead that is absent or not
    /// current means that nobody is ahead: then no stage looks at the gap, and no outcome shows it.
    /// Source: `spec/5-interfaces.md#cycle`.
    pub const fn lead(mut self, stamp: Time, gap: Gap, speed_mps: f64) -> Self {
        let stamp_ns = stamp.as_nanoseconds();
        self.lead = Some(Lead { stamp_ns, gap: gap.m, speed: speed_mps });
        self
    }

    /// With the occupancy grid map, measured at `stamp`. Source: `spec/5-interfaces.md#cycle`.
    pub const fn grid(mut self, stamp: Time, map: GridMap<'c>) -> Self {
        let GridMap { x, y, cos, sin, resolution, width, height, occupied, unknown } = map;
        let stamp_ns = stamp.as_nanoseconds();
        self.grid =
            Some(Grid { stamp_ns, x, y, cos, sin, resolution, width, height, occupied, unknown });
        self
    }

    /// With the tracks of the CAV's own MOT, valid for `stamp`: used while MOT is not remote. Source:
    /// `spec/monitor.md#monitor`.
    pub const fn local_tracks(mut self, stamp: Time, items: &'c [Track]) -> Self {
        self.local_tracks = Some(TrackList { stamp_ns: stamp.as_nanoseconds(), items });
        self
    }

    /// With the trajectory of the CAV's own planner, made at `stamp`: used while PLAN is not remote.
    /// While anything is remote do not drive one that does not come out (F-61). What its points have to be like: as of [`Self::remote_trajectory`].
    /// Source: `spec/monitor.md#monitor`.
    pub const fn local_trajectory(mut self, stamp: Time, points: &'c [TrajectoryPoint]) -> Self {
        self.local_trajectory = Some(Trajectory { stamp_ns: stamp.as_nanoseconds(), points });
        self
    }

    /// With tracks of a station: used while MOT is remote, if they are the last ones that the monitor
    /// accepted in the running session; others count as missing. Tracks that were not accepted are no
    /// argument:
    ///
    /// ```compile_fail,E0308
    /// # use mufasa::{input::cycle::Track, monitor::Inputs};
    /// fn skip_the_requester<'c>(inputs: Inputs<'c>, tracks: &'c Vec<Track>) -> Inputs<'c> {
    ///     inputs.remote_tracks(tracks)
    /// }
    /// ```
    ///
    /// Source: `spec/monitor.md#monitor`.
    pub fn remote_tracks<L: AsRef<[Track]>>(mut self, tracks: &'c Accepted<L>) -> Self {
        self.remote_tracks = Some(tracks.element());
        self
    }

    /// With the trajectory of a station: used while PLAN is remote, if it is the last one that the
    /// monitor accepted in the running session; another counts as missing.
    ///
    /// Points are places of the reference point that `ego` names, in order of time, at most 1024.
    /// In the hardened profile stage ii asks of the points, over their whole length:
    /// * start: the first within `max_age_ns` of now, at most `lateral_tolerance` aside, heading as the CAV to about 10
    ///   degrees (H-07);
    /// * position: none farther from the CAV's reference point than the CAV can drive by its time, speeding up by
    ///   `a_max`, and `start_tolerance` (H-07);
    /// * steps: at most `step_max_ns`, L and `v_max` dt from point to point, forwards along both headings, which
    ///   turn as a vehicle can (H-11);
    /// * corridor: every point inside, none heading against the route (H-07);
    /// * reach: the path from the CAV through those that are ahead of it, and straight on, beyond what the CAV can
    ///   drive by at most `lateral_tolerance` (H-14). Behind its last point, and whatever its times say, the CAV has to be able to
    ///   go on and stop.
    ///
    /// Source: `spec/monitor.md#monitor`, `spec/hardened/README.md`.
    pub fn remote_trajectory<L: AsRef<[TrajectoryPoint]>>(
        mut self,
        trajectory: &'c Accepted<L>,
    ) -> Self {
        self.remote_trajectory = Some(trajectory.element());
        self
    }
}

/// The gap to the leading vehicle: the free distance along the reference path, bumper to bumper, from
/// the front edge of the CAV's rectangle to the nearest point of the leading vehicle, >= 0, m. A bare
/// number is no gap, because measured from elsewhere it is wrong by metres:
///
/// ```compile_fail,E0308
/// # use mufasa::monitor::{Gap, Inputs, Time};
/// fn from_where(inputs: Inputs<'_>, now: Time) -> Inputs<'_> {
///     inputs.lead(now, 25.0, 10.0)
/// }
/// ```
///
/// Source: `spec/5-interfaces.md#cycle`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    m: f64,
}

impl Gap {
    /// Measured from the CAV's front bumper to the rear bumper of the leading vehicle, m. Source:
    /// `spec/5-interfaces.md#cycle`.
    pub const fn between_bumpers(m: f64) -> Self {
        Self { m }
    }

    /// Measured from the CAV's reference point (`ego.x`, `ego.y`) to the rear bumper of the leading
    /// vehicle, m. Overlap is a gap of 0. Source: `spec/5-interfaces.md#cycle`.
    pub fn from_reference_point(m: f64, ego: &Ego) -> Self {
        let m = m - (ego.center_offset + 0.5 * ego.length);
        // NaN stays NaN, which no cycle accepts.
        Self { m: if m < 0.0 { 0.0 } else { m } }
    }

    /// m. Source: `spec/5-interfaces.md#cycle`.
    pub const fn metres(self) -> f64 {
        self.m
    }
}

/// An occupancy grid map but for its time; as `input::cycle::Grid`. Source:
/// `spec/5-interfaces.md#cycle`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GridMap<'c> {
    /// Origin, the corner of the cell (0, 0), m.
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
    pub occupied: &'c [u8],
    /// The same form; a cell both occupied and unknown is occupied.
    pub unknown: Option<&'c [u8]>,
}

#[cfg(test)]
mod tests {
    use super::Gap;
    use crate::input::cycle::Ego;

    /// `spec/5-interfaces.md#cycle`: bumper to bumper. A rear axle 3.65 m behind the front.
    #[test]
    fn a_gap_begins_at_the_front_bumper() {
        let ego = Ego {
            x: 0.0,
            y: 0.0,
            cos: 1.0,
            sin: 0.0,
            speed: 0.0,
            length: 4.5,
            width: 1.9,
            center_offset: 1.25,
        };
        let gap = |m| Gap::from_reference_point(m, &ego).metres();
        assert_eq!((gap(13.5), gap(3.5), gap(1.0)), (10.0, 0.0, 0.0));
        assert!(gap(f64::NAN).is_nan());
    }
}
