//! The recipe of the workloads: every draw and every operation in the order of the published
//! generator, so that all numbers are the same to the bit (`checksum.rs`).

use std::f64::consts::{PI, TAU};

use super::draws::Draws;
use super::geometry::{Pose, Road, overlap};

/// How much there is of everything.
#[derive(Clone, Copy, Debug)]
pub struct Size {
    /// Number of the workload.
    pub number: u64,
    /// Tracks.
    pub tracks: usize,
    /// Detections.
    pub detections: usize,
    /// Trajectory points, over 5 s.
    pub points: usize,
    /// Route cross sections.
    pub cross_sections: usize,
    /// From cross section to cross section, m.
    pub step: f64,
    /// Columns and rows of the grid.
    pub cells: usize,
    /// Side of a cell, m.
    pub resolution: f64,
    /// Tracks that are on the lanes beside the CAV's.
    pub on_lanes: usize,
}

/// Speed of the CAV and of its trajectory, m/s.
pub const SPEED: f64 = 13.9;
/// The CAV's length, m.
pub const LENGTH: f64 = 4.8;
/// The CAV's width, m.
pub const WIDTH: f64 = 1.9;
const DISKS: usize = 4;
const SEED: u64 = 20_250_430;
const DURATION: f64 = 5.0;
/// How old the lists of the detection history are, s.
pub const HISTORY_AGES: [f64; 3] = [0.3, 0.5, 0.8];
/// The age of the reference list, s.
const REFERENCE_AGE: f64 = HISTORY_AGES[1];

/// A rectangle that stands or moves.
#[derive(Clone, Copy, Debug)]
pub struct Object {
    /// Centre and heading.
    pub pose: Pose,
    /// Length, m.
    pub length: f64,
    /// Width, m.
    pub width: f64,
    /// Velocity, m/s.
    pub velocity: [f64; 2],
}

/// The numbers of a workload.
#[derive(Clone, Debug)]
pub struct Numbers {
    /// Reference points.
    pub reference: Vec<[f64; 2]>,
    /// Left boundary points.
    pub left: Vec<[f64; 2]>,
    /// Right boundary points.
    pub right: Vec<[f64; 2]>,
    /// Time in s, arc length in m, pose.
    pub trajectory: Vec<(f64, f64, Pose)>,
    /// The tracks as they should be.
    pub tracks: Vec<Object>,
    /// A tenth of the tracks somewhere else.
    pub ghost: Vec<Object>,
    /// Every track displaced by a metre or so.
    pub drift: Vec<Object>,
    /// What the CAV sees, clutter among it.
    pub detections: Vec<Object>,
    /// What it saw at these ages.
    pub history: [Vec<Object>; 3],
    /// Origin of the grid, m.
    pub origin: [f64; 2],
    /// Radius of a disk, m.
    pub radius: f64,
    /// Occupied cells, row by row.
    pub occupied: Vec<bool>,
}

impl Numbers {
    /// Draws everything.
    pub fn new(size: &Size) -> Self {
        let road = Road::new(size.cross_sections, size.step);
        let scene = Scene::new(size, road);
        let tracks = scene.tracks();
        let detections = scene.detections(&tracks);
        let (ghost, drift) = (scene.ghost(&tracks), scene.drift(&tracks));
        let history = scene.history(&tracks, &detections);
        let ego = scene.ego();
        let half = scene.side / 2.0;
        let origin = [ego.x - half, ego.y - half];
        let radius = disk_radius();
        let occupied = scene.occupied(origin, radius);
        let Scene { road, trajectory, .. } = scene;
        let Road { reference, left, right, .. } = road;
        Self {
            reference,
            left,
            right,
            trajectory,
            tracks,
            ghost,
            drift,
            detections,
            history,
            origin,
            radius,
            occupied,
        }
    }
}

/// Half the diagonal of a quarter of the CAV, m.
fn disk_radius() -> f64 {
    (LENGTH / 8.0).hypot(WIDTH / 2.0)
}

/// What objects and cells are placed around.
struct Scene<'a> {
    size: &'a Size,
    road: Road,
    trajectory: Vec<(f64, f64, Pose)>,
    /// Side of the grid, m.
    side: f64,
    /// Where along the road the trajectory starts, m.
    start: f64,
    /// Farthest that an object is from the CAV, m.
    reach: f64,
}

impl<'a> Scene<'a> {
    fn new(size: &'a Size, road: Road) -> Self {
        let start = 0.4 * road.length();
        let points = count(size.points);
        let trajectory = (0..size.points).map(|i| {
            let t = count(i) * DURATION / points;
            let wave = (PI * t / DURATION).sin();
            let aside = 0.6 * (wave * wave);
            let slope = 0.6 * (PI / DURATION) * (TAU * t / DURATION).sin();
            let Pose { x, y, heading } = road.at(start + SPEED * t, aside);
            (t, SPEED * t, Pose { x, y, heading: heading + slope.atan2(SPEED) })
        });
        let trajectory = trajectory.collect();
        let side = count(size.cells) * size.resolution;
        Self { size, road, trajectory, side, start, reach: 0.48 * side }
    }

    fn ego(&self) -> Pose {
        self.trajectory[0].2
    }

    fn random(&self, stream: u64) -> Draws {
        Draws(SEED * 1000 + self.size.number * 10 + stream)
    }

    /// Whether the CAV comes within 0.25 m of the object, standing or moving.
    fn hits(&self, object: &Object) -> bool {
        let &Object { pose, length, width, velocity: [vx, vy] } = object;
        self.trajectory.iter().any(|&(t, _, cav)| {
            let places = [[pose.x, pose.y], [pose.x + vx * t, pose.y + vy * t]];
            places.into_iter().any(|[x, y]| {
                square(x - cav.x) + square(y - cav.y) < 64.0
                    && overlap((cav, LENGTH, WIDTH), (Pose { x, y, ..pose }, length, width), 0.25)
            })
        })
    }

    fn tracks(&self) -> Vec<Object> {
        let mut random = self.random(0);
        let ego = self.ego();
        let mut tracks: Vec<Object> = Vec::new();
        while tracks.len() < self.size.tracks {
            let (pose, speed, length, width) = if tracks.len() < self.size.on_lanes {
                let (s, pose, speed, length, width) = self.on_lane(&mut random, tracks.len());
                if s < 0.0 || s > self.road.length() {
                    continue;
                }
                (pose, speed, length, width)
            } else {
                let pose = self.anywhere(&mut random);
                let standing = random.uniform() < 0.4;
                let speed = if standing { 0.0 } else { 10.0 * random.uniform() };
                (pose, speed, 4.2 + 0.8 * random.uniform(), 1.7 + 0.3 * random.uniform())
            };
            let velocity = [speed * pose.heading.cos(), speed * pose.heading.sin()];
            let object = Object { pose, length, width, velocity };
            let near = |other: &Object| {
                square(pose.x - other.pose.x) + square(pose.y - other.pose.y) < square(5.5)
            };
            let far = (pose.x - ego.x).hypot(pose.y - ego.y) > self.reach;
            if !far && !tracks.iter().any(near) && !self.hits(&object) {
                tracks.push(object);
            }
        }
        tracks
    }

    /// A car on a lane beside the CAV's; the first two are forced to be near.
    fn on_lane(&self, random: &mut Draws, index: usize) -> (f64, Pose, f64, f64, f64) {
        let mut s = self.start + (random.uniform() - 0.5) * 0.9 * self.side;
        let mut oncoming = random.uniform() < 0.5;
        let mut speed = 8.0 + 7.0 * random.uniform();
        let (length, width) = (4.2 + 0.8 * random.uniform(), 1.7 + 0.3 * random.uniform());
        match index {
            0 => (s, oncoming) = (self.start + 6.0, true),
            1 => (s, oncoming, speed) = (self.start + 2.0, false, 2.0),
            _ => {}
        }
        let mut pose = self.road.at(s, if oncoming { 3.7 } else { -3.7 });
        if oncoming {
            pose.heading += PI;
        }
        (s, pose, speed, length, width)
    }

    /// A place around the CAV with a heading.
    fn anywhere(&self, random: &mut Draws) -> Pose {
        let [x, y] = self.around(random);
        Pose { x, y, heading: TAU * random.uniform() - PI }
    }

    fn around(&self, random: &mut Draws) -> [f64; 2] {
        let ego = self.ego();
        let r = self.reach * random.uniform().sqrt();
        let a = TAU * random.uniform();
        [ego.x + r * a.cos(), ego.y + r * a.sin()]
    }

    fn detections(&self, tracks: &[Object]) -> Vec<Object> {
        let mut random = self.random(1);
        let seen = tracks.iter().map(|&Object { pose, length, width, .. }| {
            let x = pose.x + 0.05 * random.normal();
            let y = pose.y + 0.05 * random.normal();
            let heading = pose.heading + 0.02 * random.normal();
            let (length, width) = (length + 0.05 * random.normal(), width + 0.05 * random.normal());
            Object { pose: Pose { x, y, heading }, length, width, velocity: [0.0; 2] }
        });
        let mut detections: Vec<Object> = seen.collect();
        while detections.len() < self.size.detections {
            let pose = self.anywhere(&mut random);
            let (length, width) = (0.5 + 1.5 * random.uniform(), 0.5 + 0.5 * random.uniform());
            let clutter = Object { pose, length, width, velocity: [0.0; 2] };
            if !self.hits(&clutter) {
                detections.push(clutter);
            }
        }
        for i in (1..detections.len()).rev() {
            detections.swap(i, truncated(random.uniform() * count(i + 1)));
        }
        detections
    }

    /// The tracks where they were, seen with 5 cm of noise; of the clutter each second thing where it
    /// is now, the others elsewhere; in any order.
    fn history(&self, tracks: &[Object], detections: &[Object]) -> [Vec<Object>; 3] {
        let mut random = self.random(5);
        HISTORY_AGES.map(|age| {
            let mut seen = tracks.to_vec();
            for object in &mut seen {
                let [vx, vy] = object.velocity;
                object.pose.x += 0.05 * random.normal() - age * vx;
                object.pose.y += 0.05 * random.normal() - age * vy;
            }
            if age.to_bits() == REFERENCE_AGE.to_bits() {
                self.thin_out(&mut seen);
            }
            let is_clutter = |object: &&Object| object.length < 2.5;
            for (index, &clutter) in detections.iter().filter(is_clutter).enumerate() {
                let pose = if index % 2 == 0 { clutter.pose } else { self.anywhere(&mut random) };
                seen.push(Object { pose, ..clutter });
            }
            for i in (1..seen.len()).rev() {
                seen.swap(i, truncated(random.uniform() * count(i + 1)));
            }
            seen
        })
    }

    /// Near the CAV no two things were so close together that one may have been the other (H-14 would
    /// find a collision): the later one was missed in this scan.
    fn thin_out(&self, seen: &mut Vec<Object>) {
        let ego = self.ego();
        let apart = |a: Pose, b: Pose| (a.x - b.x).hypot(a.y - b.y);
        let mut kept: Vec<Object> = Vec::new();
        for &object in seen.iter() {
            let is_near = apart(object.pose, ego) < 200.0;
            if !is_near || kept.iter().all(|other| apart(other.pose, object.pose) > 3.0) {
                kept.push(object);
            }
        }
        *seen = kept;
    }

    fn ghost(&self, tracks: &[Object]) -> Vec<Object> {
        let mut random = self.random(3);
        let mut ghost = tracks.to_vec();
        let first = tracks.len() - tracks.len() / 10;
        for track in &mut ghost[first..] {
            [track.pose.x, track.pose.y] = self.around(&mut random);
        }
        ghost
    }

    fn drift(&self, tracks: &[Object]) -> Vec<Object> {
        let mut random = self.random(4);
        let mut drift = tracks.to_vec();
        for track in &mut drift {
            track.pose.x += 1.0 * random.normal();
            track.pose.y += 1.0 * random.normal();
        }
        drift
    }

    /// Rectangles beside the road, then anywhere, until 8 % of the cells are occupied; none
    /// within 0.35 m of a disk.
    fn occupied(&self, [gx, gy]: [f64; 2], radius: f64) -> Vec<bool> {
        let (cells, cell) = (self.size.cells, self.size.resolution);
        let disks = self.disks();
        let mut random = self.random(2);
        let mut occupied = vec![false; cells * cells];
        let target = 0.08 * count(cells) * count(cells);
        let (mut total, mut beside) = (0_usize, 0_usize);
        while count(total) < target {
            let (x0, y0, w, h);
            if beside < 41 {
                (w, h) = (1.0 + random.uniform(), 1.0 + random.uniform());
                let side = if beside.is_multiple_of(2) { 1.0 } else { -1.0 };
                let aside = (2.0 + 2.0 * random.uniform()) * side;
                let place = self.road.at(self.start - 6.0 + 2.0 * count(beside), aside);
                (x0, y0) = (place.x - w / 2.0 - gx, place.y - h / 2.0 - gy);
                beside += 1;
            } else {
                (w, h) = (1.0 + 11.0 * random.uniform(), 1.0 + 11.0 * random.uniform());
                (x0, y0) = (random.uniform() * self.side, random.uniform() * self.side);
            }
            let (i0, k0) = (truncated(x0 / cell), truncated(y0 / cell));
            let i1 = cells.min(i0 + truncated((w / cell).ceil()));
            let k1 = cells.min(k0 + truncated((h / cell).ceil()));
            let x = [gx + count(i0) * cell, gx + count(i1) * cell];
            let y = [gy + count(k0) * cell, gy + count(k1) * cell];
            let outside = |[from, to]: [f64; 2], at: f64| (from - at).max(at - to).max(0.0);
            let near = disks.iter().any(|&[a, b]| {
                square(outside(x, a)) + square(outside(y, b)) < square(radius + 0.35)
            });
            if near {
                continue;
            }
            for row in k0..k1 {
                // Beside the grid there are no cells.
                let run = &mut occupied[row * cells + i0.min(i1)..row * cells + i1];
                total += run.iter().filter(|&&cell| !cell).count();
                run.fill(true);
            }
        }
        occupied
    }

    /// The disk centres at every trajectory point.
    fn disks(&self) -> Vec<[f64; 2]> {
        let along = |i: usize| (count(i) - (count(DISKS) - 1.0) / 2.0) * LENGTH / count(DISKS);
        let centres = self.trajectory.iter().flat_map(|&(_, _, Pose { x, y, heading })| {
            (0..DISKS).map(move |i| [x + along(i) * heading.cos(), y + along(i) * heading.sin()])
        });
        centres.collect()
    }
}

fn square(value: f64) -> f64 {
    value * value
}

#[expect(clippy::cast_precision_loss, reason = "sizes are far below 2^53")]
fn count(items: usize) -> f64 {
    items as f64
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "as the recipe does")]
fn truncated(value: f64) -> usize {
    value as usize
}
