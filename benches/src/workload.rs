//! Cycles of urban driving in three sizes; the base case passes every stage, which costs most.

use mufasa::configuration::Configuration;
use mufasa::cycle::{
    Cycle, Detection, DetectionList, Ego, Grid, Profile, Route, Station, Track, TrackList,
    Trajectory, TrajectoryPoint,
};
use mufasa::parameters::Parameters;
use mufasa::schedule::check;
use mufasa::scratch::{Column, Row, Scratch, Sizes};
use mufasa::verdict::Report;

/// Time of every cycle, ns.
const NOW_NS: i64 = 1_000_000_000;
/// Speed of the CAV and of its trajectory, m/s.
const SPEED: f64 = 13.9;
/// Half width of the corridor, m.
const HALF_WIDTH: f64 = 1.75;

/// How much there is of everything.
#[derive(Clone, Copy, Debug)]
pub struct Size {
    /// Name in the report.
    pub name: &'static str,
    /// Tracks; detections are a third more.
    pub tracks: usize,
    /// Trajectory points, over 5 s.
    pub points: u32,
    /// Route stations.
    pub stations: u32,
    /// Columns and rows of the grid.
    pub cells: u32,
    /// Side of a cell, m.
    pub resolution: f64,
}

/// A city street, a crowded square, and far more than that.
pub const SIZES: [Size; 3] = [
    Size { name: "urban", tracks: 30, points: 50, stations: 200, cells: 600, resolution: 0.2 },
    Size { name: "dense", tracks: 200, points: 100, stations: 1000, cells: 2000, resolution: 0.1 },
    Size {
        name: "stress",
        tracks: 1000,
        points: 200,
        stations: 5000,
        cells: 4000,
        resolution: 0.1,
    },
];

/// The lists of a cycle, owned.
#[derive(Clone, Debug)]
pub struct Workload {
    ego: Ego,
    points: Vec<TrajectoryPoint>,
    /// The received tracks.
    pub tracks: Vec<Track>,
    /// What the CAV sees.
    pub detections: Vec<Detection>,
    stations: Vec<Station>,
    origin: (f64, f64),
    resolution: f64,
    cells: i64,
    occupied: Vec<u8>,
}

impl Workload {
    /// The same numbers in every run.
    pub fn new(size: Size) -> Self {
        let mut random = Random(20_250_430);
        let road = Road::new(size.stations);
        let start = 0.4 * road.length();
        let points: Vec<_> = (0..size.points)
            .map(|i| {
                let dt_ns = 5_000_000_000 / i64::from(size.points) * i64::from(i);
                let t = 5.0 / f64::from(size.points) * f64::from(i);
                let (x, y, heading) = road.at(start + SPEED * t, 0.0);
                let (sin, cos) = heading.sin_cos();
                TrajectoryPoint { t_ns: NOW_NS + dt_ns, x, y, cos, sin }
            })
            .collect();
        let first = points[0];
        let ego = Ego {
            x: first.x,
            y: first.y,
            cos: first.cos,
            sin: first.sin,
            speed: SPEED,
            length: 4.8,
            width: 1.9,
            center_offset: 1.4,
        };
        let (tracks, detections) = objects(&mut random, &road, start, size.tracks);
        let half = 0.5 * size.resolution * f64::from(size.cells);
        let origin = (first.x - half, first.y - half);
        let occupied = occupied(&tracks, origin, size);
        Self {
            ego,
            points,
            tracks,
            detections,
            stations: road.stations(),
            origin,
            resolution: size.resolution,
            cells: i64::from(size.cells),
            occupied,
        }
    }

    /// Ghosts in the CAV's lane, where nothing is seen, a tenth as many as there are tracks: stage
    /// i has to refuse the list.
    #[must_use]
    pub fn with_ghosts(mut self) -> Self {
        for i in 0..=u32::try_from(self.tracks.len() / 10).unwrap_or(0) {
            let ahead = 1.0 + 0.5 * f64::from(i);
            let mut ghost = self.tracks[0];
            ghost.id = i64::MAX - i64::from(i);
            ghost.x = self.ego.x + ahead * self.ego.cos;
            ghost.y = self.ego.y + ahead * self.ego.sin;
            self.tracks.push(ghost);
        }
        self
    }

    /// The cycle with these of its inputs.
    pub fn cycle(&self, profile: Profile, of: Inputs) -> Cycle<'_> {
        let stamp_ns = NOW_NS;
        let origin = self.origin;
        Cycle {
            profile,
            parameters: Parameters::default(),
            now_ns: NOW_NS,
            configuration: of.configuration(),
            ego: self.ego,
            trajectory: of.trajectory().then_some(Trajectory { stamp_ns, points: &self.points }),
            tracks: of.tracks().then_some(TrackList { stamp_ns, items: &self.tracks }),
            detections: of
                .detections()
                .then_some(DetectionList { stamp_ns, items: &self.detections }),
            lead: None,
            route: Route { closed: false, stations: &self.stations },
            grid: of.grid().then_some(Grid {
                stamp_ns,
                x: origin.0,
                y: origin.1,
                cos: 1.0,
                sin: 0.0,
                resolution: self.resolution,
                width: self.cells,
                height: self.cells,
                occupied: &self.occupied,
                unknown: None,
            }),
            previous_tracks: None,
        }
    }
}

/// Which inputs a cycle has, so that it times one stage. Stage ii runs with every trajectory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inputs {
    /// Stage i alone: no trajectory.
    StageI,
    /// Stage ii alone.
    StageIi,
    /// Stages ii and iii.
    StageIii,
    /// Stages ii and iv.
    StageIv,
    /// Stages ii and v.
    StageV,
    /// Everything, all remote.
    Whole,
}

impl Inputs {
    fn configuration(self) -> Configuration {
        match self {
            Self::StageI | Self::StageV => Configuration::MotRemote,
            Self::StageIi | Self::StageIii | Self::StageIv => Configuration::PlanRemote,
            Self::Whole => Configuration::AllRemote,
        }
    }

    fn trajectory(self) -> bool {
        self != Self::StageI
    }

    fn tracks(self) -> bool {
        matches!(self, Self::StageI | Self::StageIii | Self::Whole)
    }

    fn detections(self) -> bool {
        matches!(self, Self::StageI | Self::StageIv | Self::Whole)
    }

    fn grid(self) -> bool {
        matches!(self, Self::StageV | Self::Whole)
    }
}

/// Scratch for a cycle, kept between calls.
#[derive(Debug)]
pub struct Memory {
    rows: Vec<Row>,
    columns: Vec<Column>,
}

impl Memory {
    /// As much as this cycle needs.
    pub fn for_cycle(cycle: &Cycle<'_>) -> Self {
        let sizes = Sizes::for_cycle(cycle);
        let rows = vec![Row::default(); sizes.rows];
        Self { rows, columns: vec![Column::default(); sizes.columns] }
    }

    /// The report on a cycle.
    ///
    /// # Panics
    /// When its input is invalid.
    pub fn check(&mut self, cycle: &Cycle<'_>) -> Report {
        let mut scratch = Scratch::new(&mut self.rows, &mut self.columns);
        check(cycle, &mut scratch).expect("the workloads are valid input")
    }
}

/// A road that winds a little, one station per metre or less.
struct Road {
    step: f64,
    /// Reference points with headings.
    points: Vec<(f64, f64, f64)>,
}

impl Road {
    fn new(stations: u32) -> Self {
        let step = 1000.0 / f64::from(stations.max(1000)) * if stations < 1000 { 2.0 } else { 1.0 };
        let heading = |s: f64| 0.5 + 0.15 * (std::f64::consts::TAU * s / 200.0).sin();
        let mut points = vec![(0.0, 0.0, heading(0.0))];
        for i in 1..stations {
            let s = step * f64::from(i);
            let middle = heading(s - 0.5 * step);
            let (x, y, _) = points[points.len() - 1];
            points.push((x + step * middle.cos(), y + step * middle.sin(), heading(s)));
        }
        Self { step, points }
    }

    #[expect(clippy::cast_precision_loss, reason = "there are few stations")]
    fn length(&self) -> f64 {
        self.step * (self.points.len() - 1) as f64
    }

    /// The place at arc length `s`, `aside` to the left, with the heading.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
    fn at(&self, s: f64, aside: f64) -> (f64, f64, f64) {
        let last = self.points.len() - 2;
        let index = ((s / self.step).max(0.0) as usize).min(last);
        let part = s / self.step - f64::from(u32::try_from(index).unwrap_or(0));
        let ((x, y, heading), next) = (self.points[index], self.points[index + 1]);
        let (sin, cos) = heading.sin_cos();
        let (x, y) = (x + part * (next.0 - x), y + part * (next.1 - y));
        (x - aside * sin, y + aside * cos, heading)
    }

    fn stations(&self) -> Vec<Station> {
        let beside = |x: f64, y: f64, heading: f64, aside: f64| {
            [x - aside * heading.sin(), y + aside * heading.cos()]
        };
        let station = |&(x, y, heading): &(f64, f64, f64)| Station {
            x,
            y,
            left: beside(x, y, heading, HALF_WIDTH),
            right: beside(x, y, heading, -HALF_WIDTH),
        };
        self.points.iter().map(station).collect()
    }
}

/// Cars on both sides of the road, one after another, seen with an error of some centimetres; and
/// a third more detections of other things farther off.
fn objects(
    random: &mut Random,
    road: &Road,
    start: f64,
    count: usize,
) -> (Vec<Track>, Vec<Detection>) {
    let (mut tracks, mut detections) = (Vec::new(), Vec::new());
    for (id, place) in (1..).zip(0..u32::try_from(count).unwrap_or(0)) {
        let lane = f64::from(place % 24 / 2);
        let along = start - 60.0 + 8.0 * f64::from(place / 24) + random.range(-0.5, 0.5);
        let side = if place % 2 == 0 { 1.0 } else { -1.0 };
        let (x, y, heading) = road.at(along, side * (5.0 + 3.5 * lane));
        let (sin, cos) = heading.sin_cos();
        let (length, width) = (4.5, 1.8);
        tracks.push(Track { id, x, y, cos, sin, vx: 9.0 * cos, vy: 9.0 * sin, length, width });
        let (x, y) = (x + random.range(-0.06, 0.06), y + random.range(-0.06, 0.06));
        detections.push(Detection { x, y, cos, sin, length, width });
    }
    for _ in 0..count / 3 {
        let side = if random.range(0.0, 1.0) < 0.5 { 1.0 } else { -1.0 };
        let aside = side * random.range(60.0, 90.0);
        let (x, y, heading) = road.at(start + random.range(-60.0, 60.0), aside);
        let (sin, cos) = heading.sin_cos();
        detections.push(Detection { x, y, cos, sin, length: 1.0, width: 1.0 });
    }
    (tracks, detections)
}

/// The cells whose centres lie within a metre of a track.
fn occupied(tracks: &[Track], origin: (f64, f64), size: Size) -> Vec<u8> {
    let mut bitmap = vec![0; (size.cells as usize * size.cells as usize).div_ceil(8)];
    let centre = |index: u32| size.resolution * (f64::from(index) + 0.5);
    let near = |value: f64| {
        let inside = move |index: &u32| (centre(*index) - value).abs() <= 1.0;
        (0..size.cells).filter(inside).collect::<Vec<u32>>()
    };
    for track in tracks {
        let (a, b) = (track.x - origin.0, track.y - origin.1);
        let columns = near(a);
        for row in near(b) {
            for column in &columns {
                if (centre(*column) - a).hypot(centre(row) - b) <= 1.0 {
                    let bit = row as usize * size.cells as usize + *column as usize;
                    bitmap[bit / 8] |= 1 << (bit % 8);
                }
            }
        }
    }
    bitmap
}

/// `SplitMix64`: the same numbers everywhere.
struct Random(u64);

impl Random {
    /// A number in [lo, hi).
    fn range(&mut self, lo: f64, hi: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^= z >> 31;
        let high = u32::try_from(z >> 32).unwrap_or(0);
        lo + (hi - lo) * f64::from(high) / 4_294_967_296.0
    }
}
