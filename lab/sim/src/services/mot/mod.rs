//! MOT: multi-object tracking.
//!
//! A stand-in for the paper's labeled multi-Bernoulli filter: a Kalman filter with constant velocity for
//! each track, one detection per track by the global nearest neighbour, and birth and death by counts. It
//! cannot show what a multi-hypothesis filter does with doubt: it keeps one assignment, has no probability
//! of existence, and takes a vehicle that brakes or turns for one with noise.

pub mod assignment;
pub mod kalman;

use std::collections::BTreeSet;

use mufasa::input::cycle::{Detection, Track};

use crate::pose::Point;
use crate::services::mot::assignment::assigned;
use crate::services::mot::kalman::Filter;
use crate::time::seconds;

/// Standard deviation of a coordinate of a detection, m.
const POSITION_SIGMA: f64 = 0.06;
/// Standard deviation of the acceleration of an object along each axis, m/s^2.
const ACCELERATION_SIGMA: f64 = 2.0;
/// Standard deviation of the velocity of an object that was detected once, along each axis, m/s.
const SPEED_SIGMA: f64 = 10.0;
/// Greatest square of the Mahalanobis distance between a detection and where it was expected: exceeded by one
/// detection in 1000 (chi-squared, 2 degrees of freedom).
const GATE: f64 = 13.8;
/// Detections that make a track, ...
const BIRTH_HITS: u32 = 3;
/// ... among so many cycles in a row, at most 32.
const BIRTH_CYCLES: u32 = 5;
/// Cycles in a row without a detection after which a track ends.
const DEATH_MISSES: u32 = 5;
/// Greatest standard deviation of a coordinate, m: a track with more ends.
const DEATH_SIGMA: f64 = 2.0;

/// A tracker.
#[derive(Clone, Debug, Default)]
pub struct Tracker {
    /// Time of the last update, ns.
    stamp_ns: Option<i64>,
    objects: Vec<Object>,
    /// Where the search for a free id begins.
    next_id: u8,
}

/// Greatest number of tracks: that of the objects of a CPM (`spec/6-link.md`).
const MOST_TRACKS: usize = 128;

/// One object that may be there.
#[derive(Clone, Debug)]
struct Object {
    /// None before birth.
    id: Option<u8>,
    filter: Filter,
    /// Mean of the detected directions, and of length and width.
    heading: (f64, f64),
    size: [f64; 2],
    /// Bit k: whether it was detected k cycles ago.
    hits: u32,
    age: u32,
    misses: u32,
}

impl Tracker {
    /// Forgets all tracks; ids go on.
    pub fn reset(&mut self) {
        self.objects.clear();
        self.stamp_ns = None;
    }

    /// Takes in the detections of a time, ns. Those not later than the last ones are not used.
    pub fn update(&mut self, t_ns: i64, detections: &[Detection]) {
        let Some(dt) = self.elapsed(t_ns) else { return };
        self.stamp_ns = Some(t_ns);
        for object in &mut self.objects {
            object.filter.predict(dt, ACCELERATION_SIGMA);
            (object.hits, object.age) = (object.hits << 1, object.age.saturating_add(1));
            object.misses = object.misses.saturating_add(1);
        }
        let places: Vec<Point> = detections.iter().map(|d| Point::new(d.x, d.y)).collect();
        let mut free: BTreeSet<usize> = (0..detections.len()).collect();
        // Tracks choose first: what was seen once or twice, with its wide gate, takes no detection of theirs.
        for born in [true, false] {
            self.assign(born, detections, &places, &mut free);
        }
        self.objects.retain(Object::lives);
        for index in free {
            if self.objects.len() < MOST_TRACKS {
                self.objects.push(Object::new(&detections[index]));
            }
        }
        self.name();
    }

    /// The tracks at a time, ns: those of the last update moved on by their velocity, in order of birth.
    pub fn tracks(&self, t_ns: i64) -> Vec<Track> {
        let dt = self.stamp_ns.map_or(0.0, |stamp_ns| seconds(t_ns - stamp_ns));
        self.objects.iter().filter_map(|object| object.track(dt)).collect()
    }

    /// Seconds since the last update; none for a time that is not later.
    fn elapsed(&self, t_ns: i64) -> Option<f64> {
        let Some(stamp_ns) = self.stamp_ns else { return Some(0.0) };
        (t_ns > stamp_ns).then(|| seconds(t_ns - stamp_ns))
    }

    fn assign(
        &mut self,
        born: bool,
        detections: &[Detection],
        places: &[Point],
        free: &mut BTreeSet<usize>,
    ) {
        let mut chosen: Vec<&mut Object> =
            self.objects.iter_mut().filter(|object| object.id.is_some() == born).collect();
        let expected: Vec<_> =
            chosen.iter().map(|object| object.filter.expected(POSITION_SIGMA)).collect();
        let found = assigned(&expected, places, free, GATE);
        for (object, index) in chosen.iter_mut().zip(found) {
            if let Some(index) = index {
                object.detected(&detections[index]);
            }
        }
    }

    /// Gives ids to objects with enough detections, as long as there are free ones.
    fn name(&mut self) {
        let mut used = [false; 256];
        for id in self.objects.iter().filter_map(|object| object.id) {
            used[usize::from(id)] = true;
        }
        for object in &mut self.objects {
            if object.id.is_none() && object.is_born() {
                while used[usize::from(self.next_id)] {
                    self.next_id = self.next_id.wrapping_add(1);
                }
                object.id = Some(self.next_id);
                self.next_id = self.next_id.wrapping_add(1);
            }
        }
    }
}

/// Shares of a new detection in the means of direction and size.
const HEADING_GAIN: f64 = 0.4;
const SIZE_GAIN: f64 = 0.2;
/// From this speed on, m/s, nobody drives backwards.
const FORWARD_MPS: f64 = 3.0;
/// Square of the Mahalanobis distance of a velocity from zero below which it is none (1 of 100 standing
/// objects exceeds it, chi-squared with 2 degrees of freedom).
const STANDING: f64 = 9.2;

impl Object {
    fn new(detection: &Detection) -> Self {
        let place = Point::new(detection.x, detection.y);
        Self {
            id: None,
            filter: Filter::new(place, POSITION_SIGMA, SPEED_SIGMA),
            heading: (detection.cos, detection.sin),
            size: [detection.length, detection.width],
            hits: 1,
            age: 1,
            misses: 0,
        }
    }

    fn is_born(&self) -> bool {
        (self.hits << (32 - BIRTH_CYCLES)).count_ones() >= BIRTH_HITS
    }

    fn lives(&self) -> bool {
        let sharp = self.filter.position_sigma() <= DEATH_SIGMA;
        if self.id.is_some() {
            return sharp && self.misses < DEATH_MISSES;
        }
        self.is_born() || self.age < BIRTH_CYCLES
    }

    fn detected(&mut self, detection: &Detection) {
        self.filter.update(Point::new(detection.x, detection.y), POSITION_SIGMA);
        (self.hits, self.misses) = (self.hits | 1, 0);
        let mean = |old: f64, new: f64, gain: f64| old + gain * (new - old);
        // The direction comes from detections: a velocity lags, and points aside in turns. But it tells front
        // and back.
        let velocity = self.filter.velocity();
        let along = velocity.x * detection.cos + velocity.y * detection.sin;
        let sign = if along < -FORWARD_MPS { -1.0 } else { 1.0 };
        let cos = mean(self.heading.0, sign * detection.cos, HEADING_GAIN);
        let sin = mean(self.heading.1, sign * detection.sin, HEADING_GAIN);
        let norm = (cos * cos + sin * sin).sqrt();
        self.heading = if norm > 0.1 {
            (cos / norm, sin / norm)
        } else {
            (sign * detection.cos, sign * detection.sin)
        };
        let [length, width] = self.size;
        self.size =
            [mean(length, detection.length, SIZE_GAIN), mean(width, detection.width, SIZE_GAIN)];
    }

    fn track(&self, dt: f64) -> Option<Track> {
        let id = self.id?;
        let stands = self.filter.moving() < STANDING;
        let velocity = if stands { Point::default() } else { self.filter.velocity() };
        let place = self.filter.place();
        Some(Track {
            id: id.into(),
            x: place.x + velocity.x * dt,
            y: place.y + velocity.y * dt,
            cos: self.heading.0,
            sin: self.heading.1,
            vx: velocity.x,
            vy: velocity.y,
            length: self.size[0],
            width: self.size[1],
        })
    }
}
