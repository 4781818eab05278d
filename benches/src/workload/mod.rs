//! The workloads W1 (urban), W2 (dense) and W3 (stress) as cycles. The base case passes every
//! stage, which costs most.

#[cfg(test)]
mod checksum;
mod draws;
mod geometry;
pub mod recipe;

use mufasa::cycle::check;
use mufasa::input::cycle::{
    CrossSection, Cycle, Detection, DetectionList, Ego, Grid, Route, Track, TrackList, Trajectory,
    TrajectoryPoint,
};
use mufasa::input::parameters::Parameters;
use mufasa::input::profile::Profile;
use mufasa::input::scratch::{Column, Row, Scratch, Sizes};
use mufasa::report::{Outcome, Rule, Stage};
use mufasa::services::configuration::Configuration;

use self::geometry::Pose;
use self::recipe::{HISTORY_AGES, LENGTH, Numbers, Object, SPEED, Size, WIDTH};

/// Time of every cycle, ns.
const NOW_NS: i64 = 1_000_000_000;

/// Clutter is shorter than this, m.
const CLUTTER: f64 = 2.5;

/// W1, W2, W3.
pub const SIZES: [Size; 3] = [
    Size {
        number: 1,
        tracks: 30,
        detections: 40,
        points: 50,
        cross_sections: 200,
        step: 1.0,
        cells: 600,
        resolution: 0.2,
        on_lanes: 6,
    },
    Size {
        number: 2,
        tracks: 200,
        detections: 260,
        points: 100,
        cross_sections: 1000,
        step: 0.5,
        cells: 2000,
        resolution: 0.1,
        on_lanes: 24,
    },
    Size {
        number: 3,
        tracks: 1000,
        detections: 1200,
        points: 200,
        cross_sections: 5000,
        step: 0.2,
        cells: 4000,
        resolution: 0.1,
        on_lanes: 60,
    },
];

/// What is wrong with a workload.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variant {
    /// Nothing: every stage passes.
    Pass,
    /// A tenth of the tracks are somewhere else: stage i fails.
    Ghost,
    /// Every track is displaced by a metre or so: stage i fails.
    Drift,
    /// The last moment at which this stage can see it, there is something: it fails.
    Fail(Stage),
}

/// The lists of a cycle, owned.
#[derive(Clone, Debug)]
pub struct Workload {
    /// `W1`
    pub name: String,
    /// The numbers of the recipe.
    pub numbers: Numbers,
    ego: Ego,
    points: Vec<TrajectoryPoint>,
    tracks: Vec<Track>,
    detections: Vec<Detection>,
    /// For the hardened profile: clutter that by chance seems to move into the way, by index.
    left_out: Vec<usize>,
    /// For the hardened profile: tracks that cross the way, by id.
    crossing: Vec<i64>,
    /// For the hardened profile: earlier detections.
    history: [Vec<Detection>; 3],
    cross_sections: Vec<CrossSection>,
    resolution: f64,
    cells: i64,
    occupied: Vec<u8>,
    /// For the hardened profile: the cells behind the occupied ones.
    unknown: Vec<u8>,
}

impl Workload {
    /// The same numbers in every run.
    ///
    /// # Panics
    /// Never: sizes fit their types.
    pub fn new(size: &Size, variant: Variant) -> Self {
        let numbers = Numbers::new(size);
        let points: Vec<_> =
            numbers.trajectory.iter().map(|&(t, _, pose)| point(t, pose)).collect();
        let first = points[0];
        let ego = Ego {
            x: first.x,
            y: first.y,
            cos: first.cos,
            sin: first.sin,
            speed: SPEED,
            length: LENGTH,
            width: WIDTH,
            center_offset: 0.0,
        };
        let received = match variant {
            Variant::Ghost => &numbers.ghost,
            Variant::Drift => &numbers.drift,
            Variant::Pass | Variant::Fail(_) => &numbers.tracks,
        };
        let tracks: Vec<_> =
            received.iter().zip(1..).map(|(object, id)| track(object, id)).collect();
        let detections = numbers.detections.iter().map(detection).collect();
        let boundaries = numbers.left.iter().zip(&numbers.right);
        let cross_sections = numbers
            .reference
            .iter()
            .zip(boundaries)
            .map(|(&[x, y], (&left, &right))| CrossSection { x, y, left, right });
        let mut workload = Self {
            name: format!("W{}", size.number),
            ego,
            points,
            tracks,
            detections,
            left_out: Vec::new(),
            crossing: Vec::new(),
            history: numbers.history.each_ref().map(|list| list.iter().map(detection).collect()),
            cross_sections: cross_sections.collect(),
            resolution: size.resolution,
            cells: i64::try_from(size.cells).expect("a few thousand"),
            occupied: bitmap(&numbers.occupied),
            unknown: bitmap(&behind(&numbers.occupied, size.cells)),
            numbers,
        };
        workload.clear_the_way();
        if let Variant::Fail(stage) = variant {
            workload.spoil(stage);
        }
        workload
    }

    /// Changes what is seen until the base case passes H-14 in the hardened profile: among so many
    /// things there is at times an earlier one, with support, from which another would come into the
    /// way. Clutter that would is left out; from where something else would, nothing was seen in that
    /// scan; nor is a track there that crosses the way.
    fn clear_the_way(&mut self) {
        loop {
            let cycle = self.cycle(Profile::HARDENED, Configuration::MotRemote);
            let shown = cycle.detections.map_or(&[][..], |list| list.items);
            let Sizes { rows, columns } = Sizes::for_cycle(&cycle);
            let (mut rows, mut columns) =
                (vec![Row::default(); rows], vec![Column::default(); columns]);
            let report = check(&cycle, &mut Scratch::new(&mut rows, &mut columns));
            let stages = report.expect("the workloads are valid input").stages;
            let found = stages.into_iter().find_map(|outcome| match outcome {
                Outcome::Failed(witness) if witness.rule == Rule::FailSafe => Some(witness),
                _ => None,
            });
            let Some(witness) = found else { return };
            if let Some(id) = witness.track {
                self.crossing.push(id);
                continue;
            }
            let age_of = |list: &DetectionList<'_>| Some(NOW_NS - list.stamp_ns) == witness.age_ns;
            let list = cycle.detection_history.iter().position(age_of);
            let detection = witness.detection.and_then(|it| shown.get(it)).copied();
            let clutter = detection.filter(|detection| detection.length < CLUTTER);
            match (clutter, list, witness.item) {
                (Some(clutter), _, _) => {
                    let index = self.detections.iter().position(|it| *it == clutter);
                    self.left_out.extend(index);
                }
                (None, Some(list), Some(item)) => {
                    self.history[list].remove(item);
                }
                (None, _, _) => return,
            }
        }
    }

    /// Puts something where the stage has to see it, at the last point that every profile examines.
    fn spoil(&mut self, stage: Stage) {
        let braking = SPEED * SPEED / (2.0 * Parameters::default().a_b);
        let horizon = match stage {
            Stage::Iii => SPEED * Parameters::default().safety_time,
            Stage::I | Stage::Ii | Stage::Iv | Stage::V => braking,
        };
        let arcs = self.numbers.trajectory.iter();
        let last = arcs.take_while(|(_, arc, _)| *arc <= horizon - 0.5).count() - 1;
        let (t, _, Pose { x, y, heading }) = self.numbers.trajectory[last];
        let (cos, sin) = (heading.cos(), heading.sin());
        match stage {
            Stage::I => self.detections.truncate(self.detections.len() / 2),
            Stage::Ii => {
                if let Some(end) = self.points.last_mut() {
                    (end.x, end.y) = (end.x - 3.0 * end.sin, end.y + 3.0 * end.cos);
                }
            }
            Stage::Iii => {
                if let Some(track) = self.tracks.last_mut() {
                    (track.x, track.y) = (x - track.vx * t, y - track.vy * t);
                }
            }
            Stage::Iv => {
                self.detections.push(Detection { x, y, cos, sin, length: 0.5, width: 0.5 });
            }
            Stage::V => {
                let [gx, gy] = self.numbers.origin;
                let ahead = 0.5 * LENGTH;
                let column = cell((x + ahead * cos - gx) / self.resolution);
                let row = cell((y + ahead * sin - gy) / self.resolution);
                let bit = row * cell(f64::from(u32::try_from(self.cells).unwrap_or(0))) + column;
                self.occupied[bit / 8] |= 1 << (bit % 8);
            }
        }
    }

    /// The detections but for those left out; never freed, as a part of a cycle: a bench ends soon.
    fn without_left_out(&self) -> Vec<Detection> {
        let detections = self.detections.iter().enumerate();
        detections.filter(|(i, _)| !self.left_out.contains(i)).map(|(_, it)| *it).collect()
    }

    fn without_crossing(&self) -> Vec<Track> {
        self.tracks.iter().filter(|it| !self.crossing.contains(&it.id)).copied().collect()
    }

    /// The lists of the history; never freed, as a part of a cycle: a bench ends soon.
    fn detection_history(&self) -> Vec<DetectionList<'_>> {
        let list = |(items, age): (_, f64)| {
            #[expect(clippy::cast_possible_truncation, reason = "below 1 s")]
            let age_ns = (age * 1e9).round() as i64;
            DetectionList { stamp_ns: NOW_NS - age_ns, items }
        };
        self.history.iter().map(Vec::as_slice).zip(HISTORY_AGES).map(list).collect()
    }

    /// The cycle. `MotRemote` runs stages i, ii, iv and v; `AllRemote` i, ii, iii (and iv in the
    /// hardened profile); `PlanRemote` ii and iii (and iv). In the hardened profile it has
    /// unknown cells.
    pub fn cycle(&self, profile: Profile, configuration: Configuration) -> Cycle<'_> {
        let stamp_ns = NOW_NS;
        let hardened = profile.looks_back();
        let detections: &[_] =
            if hardened { self.without_left_out().leak() } else { &self.detections };
        let tracks: &[_] = if hardened { self.without_crossing().leak() } else { &self.tracks };
        let [x, y] = self.numbers.origin;
        Cycle {
            profile,
            // W3 takes more than the default.
            parameters: Parameters { work_limit: 10_000_000_000, ..Parameters::default() },
            now_ns: NOW_NS,
            configuration,
            ego: self.ego,
            trajectory: Some(Trajectory { stamp_ns, points: &self.points }),
            tracks: Some(TrackList { stamp_ns, items: tracks }),
            detections: Some(DetectionList { stamp_ns, items: detections }),
            lead: None,
            route: Route { closed: false, cross_sections: &self.cross_sections },
            grid: Some(Grid {
                stamp_ns,
                x,
                y,
                cos: 1.0,
                sin: 0.0,
                resolution: self.resolution,
                width: self.cells,
                height: self.cells,
                occupied: &self.occupied,
                unknown: hardened.then_some(&self.unknown),
            }),
            detection_history: if hardened { self.detection_history().leak() } else { &[] },
        }
    }
}

/// The cells one row above those that are set.
fn behind(cells: &[bool], width: usize) -> Vec<bool> {
    let below = std::iter::repeat_n(&false, width).chain(cells);
    cells.iter().zip(below).map(|(&cell, &below)| below && !cell).collect()
}

/// Row by row, least significant bit first.
fn bitmap(cells: &[bool]) -> Vec<u8> {
    let byte =
        |cells: &[bool]| cells.iter().rev().fold(0, |byte, &cell| byte << 1 | u8::from(cell));
    cells.chunks(8).map(byte).collect()
}

fn point(t: f64, Pose { x, y, heading }: Pose) -> TrajectoryPoint {
    #[expect(clippy::cast_possible_truncation, reason = "at most 5e9")]
    let t_ns = (t * 1e9).round() as i64;
    TrajectoryPoint { t_ns: NOW_NS + t_ns, x, y, cos: heading.cos(), sin: heading.sin() }
}

fn track(object: &Object, id: i64) -> Track {
    let &Object { pose: Pose { x, y, heading }, length, width, velocity: [vx, vy] } = object;
    Track { id, x, y, cos: heading.cos(), sin: heading.sin(), vx, vy, length, width }
}

fn detection(object: &Object) -> Detection {
    let &Object { pose: Pose { x, y, heading }, length, width, .. } = object;
    Detection { x, y, cos: heading.cos(), sin: heading.sin(), length, width }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "inside the grid")]
fn cell(coordinate: f64) -> usize {
    coordinate as usize
}
