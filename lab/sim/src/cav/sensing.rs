//! What the CAV measures in a period.

use mufasa::input::cycle::{Detection, Ego};

use crate::map::route::Route;
use crate::pose::Pose;
use crate::services::detectors::lead::{Front, MeasuredLead, measured_lead};
use crate::services::detectors::random::Draws;
use crate::services::detectors::scan::Sweep;
use crate::services::detectors::{Detector, Errors, Mount, Observer};
use crate::services::grid::{OccupancyMap, OwnedGrid};
use crate::snapshot::Snapshot;
use crate::vehicle::Body;

/// The measurements of one moment.
#[derive(Clone, Debug)]
pub struct Sensed {
    /// Of all of them, ns.
    pub stamp_ns: i64,
    /// Where the CAV was.
    pub ego: Ego,
    /// What its detectors saw.
    pub detections: Vec<Detection>,
    /// The leading vehicle, if there is one.
    pub lead: Option<MeasuredLead>,
    /// The occupancy grid.
    pub grid: OwnedGrid,
}

/// The sensors of the CAV: a lidar all around, on the middle of the vehicle, and a radar at the front.
#[derive(Debug)]
pub struct Sensors {
    observer: Observer,
    map: OccupancyMap,
    seed: u64,
}

/// Which of the detectors is the radar that measures the leading vehicle.
const RADAR: usize = 1;
/// Standard deviation of the measured gap, m, and speed, m/s.
const LEAD_SIGMA: f64 = 0.05;
/// Half of the width of the strip in which vehicles lead, m: the CAV's and a little more.
const LEAD_MARGIN: f64 = 0.3;

impl Sensors {
    /// Sensors with these errors.
    pub fn new(seed: u64, body: &Body, errors: Errors) -> Self {
        let full = 2.0 * core::f64::consts::PI;
        let detector = |ahead, range, view, rays| Detector {
            mount: Mount::Vehicle(ahead),
            sweep: Sweep::new(range, view, rays),
            errors,
        };
        let lidar = detector(body.middle, 60.0, full, 360);
        let radar = detector(body.middle + body.length / 2.0, 100.0, full / 6.0, 90);
        let observer =
            Observer { seed: [seed, 1], detectors: vec![lidar, radar], merge_radius: 1.5 };
        Self { observer, map: OccupancyMap::default(), seed }
    }

    /// What they measure now.
    pub fn sense(&mut self, truth: &Snapshot, route: &Route, body: &Body, stamp_ns: i64) -> Sensed {
        let ego = ego(truth, body);
        let objects = truth.seen();
        let cycle = truth.time_ns.unsigned_abs();
        let observation = self.observer.observe(&objects, truth.ego.rear, cycle);
        let near = truth.ego.s;
        let s = route.path.project_within(truth.ego.rear.at, near - 10.0, near + 10.0).s;
        let front = Front {
            s,
            ahead: body.middle + body.length / 2.0,
            half_width: body.width / 2.0 + LEAD_MARGIN,
        };
        let radar = &observation.scans[RADAR];
        let mut draws = Draws::new([self.seed, 2, cycle, 0]);
        let lead = measured_lead(&objects, radar, &route.path, front, LEAD_SIGMA, &mut draws);
        let grid = self.map.update(stamp_ns, &ego, &observation.scans[0]);
        Sensed { stamp_ns, ego, detections: observation.detections, lead, grid }
    }
}

/// The CAV as records have it: the reference point is the middle of the rear axle.
pub fn ego(truth: &Snapshot, body: &Body) -> Ego {
    let Pose { at, cos, sin } = truth.ego.rear;
    Ego {
        x: at.x,
        y: at.y,
        cos,
        sin,
        speed: truth.ego.speed,
        length: body.length,
        width: body.width,
        center_offset: body.middle,
    }
}
