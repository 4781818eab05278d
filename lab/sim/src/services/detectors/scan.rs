//! Rays from a sensor against rectangles.

use core::f64::consts::{PI, TAU};

use parry2d_f64::math::Vector;
use parry2d_f64::query::{Ray, RayCast};
use parry2d_f64::shape::Cuboid;

use crate::pose::{Point, Pose, Rectangle};
use crate::services::detectors::seen::Seen;

/// How a sensor looks around: rays at equal angles.
#[derive(Clone, Debug)]
pub struct Sweep {
    range: f64,
    field_of_view: f64,
    /// Direction of every ray in the sensor's frame.
    directions: Vec<(f64, f64)>,
}

/// What the rays of a sensor met.
#[derive(Clone, Debug)]
pub struct Scan {
    /// Where the sensor was.
    pub pose: Pose,
    /// How far it looks, m.
    pub range: f64,
    /// Every ray from right to left.
    pub rays: Vec<Return>,
}

/// What one ray met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Return {
    /// Direction over ground.
    pub cos: f64,
    /// Direction over ground.
    pub sin: f64,
    /// How far the ray went, m; the range if it met nothing.
    pub distance: f64,
    /// Index of the object that it met within the range.
    pub met: Option<usize>,
}

impl Scan {
    /// Those of the objects that a ray met.
    pub(super) fn visible<'o>(&self, objects: &'o [Seen]) -> impl Iterator<Item = &'o Seen> {
        let mut visible = vec![false; objects.len()];
        self.rays.iter().filter_map(|ray| ray.met).for_each(|index| visible[index] = true);
        objects.iter().zip(visible).filter_map(|(object, is_visible)| is_visible.then_some(object))
    }
}

impl Sweep {
    /// So many rays over a field of view, rad, up to 2 pi, as far as `range`, m.
    pub fn new(range: f64, field_of_view: f64, rays: u32) -> Self {
        let step = field_of_view / f64::from(rays);
        let directions = (0..rays).map(|ray| {
            let (sin, cos) = libm::sincos((f64::from(ray) + 0.5) * step - field_of_view / 2.0);
            (cos, sin)
        });
        Self { range, field_of_view, directions: directions.collect() }
    }

    /// How far it looks, m.
    pub const fn range(&self) -> f64 {
        self.range
    }

    /// How wide it looks, rad.
    pub const fn field_of_view(&self) -> f64 {
        self.field_of_view
    }

    /// What the rays meet from a pose.
    pub fn scan(&self, objects: &[Seen], pose: Pose) -> Scan {
        let nothing = |&(cos, sin): &(f64, f64)| Return {
            cos: cos * pose.cos - sin * pose.sin,
            sin: cos * pose.sin + sin * pose.cos,
            distance: self.range,
            met: None,
        };
        let rays = self.directions.iter().map(nothing).collect();
        let mut scan = Scan { pose, range: self.range, rays };
        for (index, object) in objects.iter().enumerate() {
            self.cast(&mut scan, &object.rectangle, index);
        }
        scan
    }

    /// Shortens the rays that meet a rectangle.
    fn cast(&self, scan: &mut Scan, rectangle: &Rectangle, index: usize) {
        let circumradius =
            0.5 * Point::default().distance(Point::new(rectangle.length, rectangle.width));
        let distance = scan.pose.at.distance(rectangle.pose.at);
        if distance - circumradius > self.range {
            return;
        }
        let frame = rectangle.pose;
        let (x, y) = frame.local(scan.pose.at);
        let origin = Vector::new(x, y);
        let cuboid = Cuboid::new(Vector::new(rectangle.length / 2.0, rectangle.width / 2.0));
        for (first, last) in self.towards(scan.pose, rectangle, distance <= circumradius) {
            for ray in &mut scan.rays[first..last] {
                let ahead = ray.cos * frame.cos + ray.sin * frame.sin;
                let left = ray.sin * frame.cos - ray.cos * frame.sin;
                let cast = Ray::new(origin, Vector::new(ahead, left));
                if let Some(distance) = cuboid.cast_local_ray(&cast, ray.distance, true)
                    && distance < ray.distance
                {
                    (ray.distance, ray.met) = (distance, Some(index));
                }
            }
        }
    }

    /// The rays that may meet a rectangle, as ranges of indices: those between the bearings of its corners,
    /// and all when the sensor may be inside.
    fn towards(&self, pose: Pose, rectangle: &Rectangle, all: bool) -> [(usize, usize); 3] {
        if all {
            return [(0, self.directions.len()), (0, 0), (0, 0)];
        }
        let (x, y) = pose.local(rectangle.pose.at);
        let bearing = libm::atan2(y, x);
        let (mut least, mut most) = (0.0_f64, 0.0_f64);
        for (ahead, left) in [(0.5, 0.5), (0.5, -0.5), (-0.5, 0.5), (-0.5, -0.5)] {
            let corner = rectangle.pose.ahead(ahead * rectangle.length, left * rectangle.width);
            let (a, b) = pose.local(corner);
            let aside = libm::atan2(x * b - y * a, x * a + y * b);
            (least, most) = (least.min(aside), most.max(aside));
        }
        if most - least >= PI {
            return [(0, self.directions.len()), (0, 0), (0, 0)];
        }
        // A rectangle across the end of the field of view is met from both ends.
        [-TAU, 0.0, TAU].map(|turn| self.between(bearing + least + turn, bearing + most + turn))
    }

    /// The rays between two angles of the sensor's frame, and one more on each side.
    // Clamped to the rays there are, which are a u32.
    #[allow(clippy::cast_possible_truncation, clippy::cast_precision_loss, clippy::cast_sign_loss)]
    fn between(&self, from: f64, to: f64) -> (usize, usize) {
        let rays = self.directions.len() as f64;
        let index = |angle: f64| (angle / self.field_of_view + 0.5) * rays - 0.5;
        let first = index(from).floor().clamp(0.0, rays) as usize;
        let last = (index(to).ceil() + 1.0).clamp(0.0, rays) as usize;
        (first, last.max(first))
    }
}
