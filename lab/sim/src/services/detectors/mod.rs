//! Detectors: what radar, lidar and cameras make of the objects around.
//!
//! A stand-in for detectors of raw data, which the paper leaves out ("object detection is done on video,
//! radar, and lidar data"). Whatever a ray meets is detected as a whole, with its true size and direction,
//! noise aside: it cannot show boxes that shrink with what is visible, mistakes that last for several
//! cycles, or two objects taken for one. Noise, misses and clutter are independent from cycle to cycle.

pub mod lead;
pub mod random;
pub mod scan;
pub mod seen;

use mufasa::input::cycle::Detection;

use crate::pose::{Point, Pose};
use crate::services::detectors::random::Draws;
use crate::services::detectors::scan::{Scan, Sweep};
use crate::services::detectors::seen::Seen;

/// One detector.
#[derive(Clone, Debug)]
pub struct Detector {
    /// Where it is.
    pub mount: Mount,
    /// How it looks around.
    pub sweep: Sweep,
    /// How wrong it is.
    pub errors: Errors,
}

/// Where a detector is.
#[derive(Clone, Copy, Debug)]
pub enum Mount {
    /// On the vehicle that observes: this far ahead of its reference point, m, looking ahead.
    Vehicle(f64),
    /// Beside the road.
    Fixed(Pose),
}

/// Standard deviations and rates of what a detector gets wrong.
#[derive(Clone, Copy, Debug)]
pub struct Errors {
    /// Of each coordinate, m.
    pub position: f64,
    /// Of the direction, rad.
    pub heading: f64,
    /// Of length and width, m.
    pub size: f64,
    /// Of the distances in a scan, m.
    pub distance: f64,
    /// Share of the visible objects that are missed, in [0, 1].
    pub missed: f64,
    /// Share of the objects that are never detected, in [0, 1], the same ones for all observers of a run; rays meet them.
    pub blind: f64,
    /// Mean number of detections of nothing in a cycle, evenly over the covered area.
    pub clutter: f64,
}

impl Errors {
    /// No errors at all.
    pub const NONE: Self = Self {
        position: 0.0,
        heading: 0.0,
        size: 0.0,
        distance: 0.0,
        missed: 0.0,
        blind: 0.0,
        clutter: 0.0,
    };
}

impl Default for Errors {
    /// Such that the mean assignment cost of clean tracks stays well below `theta_tr` = 0.2 m.
    fn default() -> Self {
        Self {
            position: 0.05,
            heading: 0.02,
            size: 0.05,
            distance: 0.02,
            missed: 0.01,
            blind: 0.0,
            clutter: 0.0,
        }
    }
}

/// All detectors of a vehicle or of a station, whose detections come as one list.
#[derive(Clone, Debug)]
pub struct Observer {
    /// Seed of the run, and who of it observes: no two observers of a run have the same second number.
    pub seed: [u64; 2],
    /// Its detectors.
    pub detectors: Vec<Detector>,
    /// Detections of two detectors nearer than this are of one object, m.
    pub merge_radius: f64,
}

/// What an observer has in a cycle.
#[derive(Clone, Debug)]
pub struct Observation {
    /// The merged detections.
    pub detections: Vec<Detection>,
    /// What the rays of each detector met, in the order of the detectors.
    pub scans: Vec<Scan>,
}

impl Observer {
    /// What of the objects is seen from a pose in a cycle.
    ///
    /// The draws about an object depend on the seed, detector, cycle and its id alone.
    pub fn observe(&self, objects: &[Seen], pose: Pose, cycle: u64) -> Observation {
        let mut merged = Merged { radius: self.merge_radius, items: Vec::new() };
        let mut scans = Vec::with_capacity(self.detectors.len());
        for (index, detector) in (0..).zip(&self.detectors) {
            let key = |about| [self.seed[0], self.seed[1] << 16 | index, cycle, about];
            let mut scan = detector.scan(objects, pose);
            let sees = |id: u32| {
                let mut draws = Draws::new([self.seed[0], BLIND, 0, id.into()]);
                detector.errors.blind <= 0.0 || draws.share() >= detector.errors.blind
            };
            let of = |id: u32| Some(key(id.into())).filter(|_| sees(id));
            detector.report(objects, &scan, &of, &mut |detection| merged.add(index, detection));
            detector.invent(&scan, key(CLUTTER), &mut |detection| merged.add(index, detection));
            detector.blur(&mut scan, &mut Draws::new(key(DISTANCES)));
            scans.push(scan);
        }
        let detections = merged.items.into_iter().map(|item| item.mean).collect();
        Observation { detections, scans }
    }
}

/// What draws are about when they are about no object.
const CLUTTER: u64 = 1 << 32;
const DISTANCES: u64 = 1 << 33;
/// Who draws whom nobody sees: no observer.
const BLIND: u64 = u64::MAX;

impl Detector {
    fn scan(&self, objects: &[Seen], pose: Pose) -> Scan {
        let from = match self.mount {
            Mount::Vehicle(ahead) => Pose { at: pose.ahead(ahead, 0.0), ..pose },
            Mount::Fixed(pose) => pose,
        };
        self.sweep.scan(objects, from)
    }

    /// Detections of the objects that a ray met. `of`: with what is drawn about an object; none: it is not reported.
    fn report(
        &self,
        objects: &[Seen],
        scan: &Scan,
        of: &impl Fn(u32) -> Option<[u64; 4]>,
        add: &mut impl FnMut(Detection),
    ) {
        for object in scan.visible(objects) {
            let Some(mut draws) = of(object.id).map(Draws::new) else { continue };
            if draws.share() >= self.errors.missed {
                let rectangle = object.rectangle;
                let Pose { at, .. } = rectangle.pose;
                let angle = rectangle.pose.angle();
                add(self.blurred(at, angle, [rectangle.length, rectangle.width], &mut draws));
            }
        }
    }

    /// Detections of nothing.
    fn invent(&self, scan: &Scan, key: [u64; 4], add: &mut impl FnMut(Detection)) {
        let mut draws = Draws::new(key);
        for _ in 0..draws.count(self.errors.clutter) {
            // Evenly over the area, not over the distance.
            let distance = self.sweep.range() * draws.share().sqrt();
            let half = self.sweep.field_of_view() / 2.0;
            let (sin, cos) = libm::sincos(draws.between(-half, half));
            let place = scan.pose.ahead(distance * cos, distance * sin);
            let angle = draws.between(-core::f64::consts::PI, core::f64::consts::PI);
            add(self.blurred(place, angle, [4.5, 1.8], &mut draws));
        }
    }

    fn blurred(&self, at: Point, angle: f64, size: [f64; 2], draws: &mut Draws) -> Detection {
        let [x, y] = draws.normal_pair();
        let [length, width] = draws.normal_pair();
        let [turn, _] = draws.normal_pair();
        let (sin, cos) = libm::sincos(angle + self.errors.heading * turn);
        Detection {
            x: at.x + self.errors.position * x,
            y: at.y + self.errors.position * y,
            cos,
            sin,
            length: (size[0] + self.errors.size * length).max(LEAST_SIZE_M),
            width: (size[1] + self.errors.size * width).max(LEAST_SIZE_M),
        }
    }

    /// Puts noise on the distances of rays that met something.
    fn blur(&self, scan: &mut Scan, draws: &mut Draws) {
        if self.errors.distance <= 0.0 {
            return;
        }
        let range = scan.range;
        for ray in scan.rays.iter_mut().filter(|ray| ray.met.is_some()) {
            let [error, _] = draws.normal_pair();
            ray.distance = (ray.distance + self.errors.distance * error).clamp(0.0, range);
        }
    }
}

/// Sizes stay above it, m.
const LEAST_SIZE_M: f64 = 0.2;

/// Detections of several detectors, those of one object as their mean.
struct Merged {
    radius: f64,
    items: Vec<Item>,
}

struct Item {
    mean: Detection,
    count: f64,
    /// The last detector that added to it: one detector sees two objects where it reports two.
    last: u64,
}

impl Merged {
    fn add(&mut self, detector: u64, new: Detection) {
        let place = Point::new(new.x, new.y);
        let near = self.items.iter_mut().filter(|item| item.last != detector);
        let near = near.map(|item| (place.distance(Point::new(item.mean.x, item.mean.y)), item));
        let nearest = near.min_by(|(a, _), (b, _)| a.total_cmp(b));
        if let Some((_, item)) = nearest.filter(|(distance, _)| *distance < self.radius) {
            item.add(detector, new);
        } else {
            self.items.push(Item { mean: new, count: 1.0, last: detector });
        }
    }
}

impl Item {
    fn add(&mut self, detector: u64, new: Detection) {
        self.count += 1.0;
        let mean = |old: f64, new: f64| old + (new - old) / self.count;
        let old = self.mean;
        let (cos, sin) = (mean(old.cos, new.cos), mean(old.sin, new.sin));
        let norm = (cos * cos + sin * sin).sqrt();
        // Two opposite directions have no mean: the first one stays.
        let (cos, sin) = if norm > 0.1 { (cos / norm, sin / norm) } else { (old.cos, old.sin) };
        self.mean = Detection {
            x: mean(old.x, new.x),
            y: mean(old.y, new.y),
            cos,
            sin,
            length: mean(old.length, new.length),
            width: mean(old.width, new.width),
        };
        self.last = detector;
    }
}
