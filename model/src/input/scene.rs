//! A valid cycle in exact numbers, and the reading in which it is decided.

use crate::input::cycle::{self, Cycle, DetectionList, TrackList};
use crate::input::parameters::Parameters;
use crate::input::profile::Profile;
use crate::numbers::cells::{self, Cell, Cells};
use crate::numbers::polyline::Segment;
use crate::numbers::reading::{Comparisons, Reading};
use crate::numbers::real::Real;
use crate::numbers::rectangle::Rectangle;
use crate::numbers::vector::{Frame, Vector};
use crate::services::configuration::Configuration;

/// Everything that the stages look at. Lists that are missing or not current are `None`, except
/// received tracks, which stage i checks whatever their age.
#[derive(Debug)]
pub struct Scene {
    /// Profile in force.
    pub profile: Profile,
    /// Configuration in force.
    pub configuration: Configuration,
    /// How numbers compare in the reading that decides.
    pub reads: Comparisons,
    /// Exact parameters.
    pub parameters: Thresholds,
    /// Time of the decision, ns.
    pub now_ns: i64,
    /// The CAV.
    pub ego: Ego,
    /// The current trajectory.
    pub trajectory: Option<Vec<Point>>,
    /// The received or local track list of any age.
    pub tracks: Option<Tracks>,
    /// The track list is current.
    pub tracks_current: bool,
    /// Current detections.
    pub detections: Option<Detections>,
    /// The current leading vehicle: gap in m, v_lead in m/s.
    pub lead: Option<Lead>,
    /// The route.
    pub route: Route,
    /// The current grid map.
    pub grid: Option<Grid>,
    /// Earlier lists of the CAV's own detections, none older than 60 s.
    pub detection_history: Vec<Detections>,
}

macro_rules! exact_parameters {
    ($($(#[$doc:meta])* $name:ident: $number:ident = $default:literal in $domain:expr;)*) => {
        /// The parameters as exact numbers.
        #[derive(Debug)]
        pub struct Thresholds {
            $($(#[$doc])* pub $name: exact!($number),)*
        }

        impl Thresholds {
            fn new(parameters: &Parameters) -> Self {
                Self { $($name: exact!($number, parameters.$name),)* }
            }
        }
    };
}

/// The exact type of a parameter, and its value in it.
macro_rules! exact {
    (f64) => {
        Real
    };
    (i64) => {
        i64
    };
    (f64, $value:expr) => {
        Real::from_double($value)
    };
    (i64, $value:expr) => {
        $value
    };
}

crate::parameters!(exact_parameters);

/// The CAV.
#[derive(Debug)]
pub struct Ego {
    /// Position p.
    pub position: Vector,
    /// Direction.
    pub heading: Vector,
    /// v_now, m/s.
    pub v_now: Real,
    /// L, m.
    pub length: Real,
    /// W, m.
    pub width: Real,
    /// From a pose forward to the centre of the rectangle, m.
    pub center_offset: Real,
}

/// A trajectory point.
#[derive(Clone, Debug)]
pub struct Point {
    /// When, ns.
    pub t_ns: i64,
    /// Pose.
    pub pose: Frame,
}

/// A rectangle in the plane with a centre, a direction and a size.
#[derive(Clone, Debug)]
pub struct Object {
    /// Centre and direction.
    pub frame: Frame,
    /// Length along the direction, m.
    pub length: Real,
    /// Width across, m.
    pub width: Real,
}

/// A track list.
#[derive(Debug)]
pub struct Tracks {
    /// Time that the positions are valid for, ns.
    pub stamp_ns: i64,
    /// In list order.
    pub items: Vec<Track>,
}

/// A track.
#[derive(Debug)]
pub struct Track {
    /// Identity.
    pub id: i64,
    /// Pose and size at the stamp of the list.
    pub object: Object,
    /// v, m/s.
    pub velocity: Vector,
}

/// A list of the CAV's own detections.
#[derive(Debug)]
pub struct Detections {
    /// Time of measurement, ns.
    pub stamp_ns: i64,
    /// In list order.
    pub items: Vec<Object>,
}

/// The leading vehicle.
#[derive(Debug)]
pub struct Lead {
    /// Free distance, m.
    pub gap: Real,
    /// v_lead, m/s.
    pub speed: Real,
    /// Now minus the time of measurement, s.
    pub age: Real,
}

/// A route in exact numbers.
#[derive(Debug)]
pub struct Route {
    /// Reference points with left and right boundary points.
    pub cross_sections: Vec<[Vector; 3]>,
    /// The last cross section is followed by the first.
    pub closed: bool,
}

/// A grid map: exact frame, bitmaps as they came.
#[derive(Debug)]
pub struct Grid {
    /// Origin and direction of the rows.
    pub frame: Frame,
    /// Side of a cell, m.
    pub resolution: Real,
    /// Columns.
    pub width: i64,
    /// Rows.
    pub height: i64,
    occupied: Vec<u8>,
    unknown: Option<Vec<u8>>,
}

impl Route {
    /// Consecutive cross sections; in a closed route the last is followed by the first.
    pub fn pairs(&self) -> Vec<[&[Vector; 3]; 2]> {
        let all = &self.cross_sections;
        let closing = self.closed.then(|| [&all[all.len() - 1], &all[0]]);
        all.windows(2).map(|pair| [&pair[0], &pair[1]]).chain(closing).collect()
    }

    /// The polyline of the reference points.
    pub fn reference_path(&self) -> Vec<Segment> {
        self.pairs().into_iter().map(|[[a, ..], [b, ..]]| [a.clone(), b.clone()]).collect()
    }
}

impl Grid {
    /// The cell is one of the array.
    pub fn holds(&self, (column, row): Cell) -> bool {
        (0..self.width).contains(&column) && (0..self.height).contains(&row)
    }

    /// The cell is one of the array and occupied.
    pub fn is_occupied(&self, cell: Cell) -> bool {
        self.bit(&self.occupied, cell)
    }

    /// The cell is one of the array, unknown, and not occupied.
    pub fn is_unknown(&self, cell: Cell) -> bool {
        let unknown = self.unknown.as_ref().is_some_and(|bitmap| self.bit(bitmap, cell));
        unknown && !self.is_occupied(cell)
    }

    /// The cells of the array that are among these, by row and column.
    pub fn cells(&self, [columns, rows]: Cells) -> impl Iterator<Item = Cell> {
        cells::by_row([
            (*columns.start()).max(0)..=(*columns.end()).min(self.width - 1),
            (*rows.start()).max(0)..=(*rows.end()).min(self.height - 1),
        ])
    }

    fn bit(&self, bitmap: &[u8], cell: Cell) -> bool {
        let (column, row) = cell;
        let bit = row * self.width + column;
        self.holds(cell)
            && usize::try_from(bit / 8).is_ok_and(|byte| bitmap[byte] >> (bit % 8) & 1 == 1)
    }
}

impl Object {
    /// The rectangle of the object.
    pub fn rectangle(&self) -> Rectangle {
        Rectangle::new(self.frame.clone(), &self.length, &self.width)
    }
}

impl Scene {
    /// Takes the numbers of a valid cycle (`input::first_problem` found none) as exact.
    pub fn new(cycle: &Cycle, reading: Reading) -> Self {
        let is_current = |stamp_ns: i64| {
            let age = i128::from(cycle.now_ns) - i128::from(stamp_ns);
            (0..=i128::from(cycle.parameters.max_age_ns)).contains(&age)
        };
        let trajectory = cycle.trajectory.as_ref().filter(|list| is_current(list.stamp_ns));
        Self {
            profile: cycle.profile,
            configuration: cycle.configuration,
            reads: Comparisons::new(reading, Real::from_double(cycle.parameters.delta)),
            parameters: Thresholds::new(&cycle.parameters),
            now_ns: cycle.now_ns,
            ego: ego(cycle),
            trajectory: trajectory.map(|list| list.points.iter().map(point).collect()),
            tracks: cycle.tracks.as_ref().map(tracks),
            tracks_current: cycle.tracks.as_ref().is_some_and(|list| is_current(list.stamp_ns)),
            detections: (cycle.detections.as_ref())
                .filter(|list| is_current(list.stamp_ns))
                .map(detections),
            lead: cycle.lead.as_ref().filter(|lead| is_current(lead.stamp_ns)).map(|lead| Lead {
                gap: Real::from_double(lead.gap),
                speed: Real::from_double(lead.speed),
                age: Real::seconds(i128::from(cycle.now_ns) - i128::from(lead.stamp_ns)),
            }),
            route: route(&cycle.route),
            grid: cycle.grid.as_ref().filter(|grid| is_current(grid.stamp_ns)).map(grid),
            detection_history: (cycle.detection_history.iter())
                .filter(|list| !is_stale(cycle.now_ns, list.stamp_ns))
                .map(detections)
                .collect(),
        }
    }
}

/// More than 60 s before now: a local list that old counts as missing
/// (`spec/4-arithmetic.md#domain`).
fn is_stale(now_ns: i64, stamp_ns: i64) -> bool {
    i128::from(now_ns) - i128::from(stamp_ns) > 60_000_000_000
}

fn ego(cycle: &Cycle) -> Ego {
    Ego {
        position: Vector::from_doubles(cycle.ego.x, cycle.ego.y),
        heading: Vector::from_doubles(cycle.ego.cos, cycle.ego.sin),
        v_now: Real::from_double(cycle.ego.speed),
        length: Real::from_double(cycle.ego.length),
        width: Real::from_double(cycle.ego.width),
        center_offset: Real::from_double(cycle.ego.center_offset),
    }
}

fn frame([x, y]: [f64; 2], [cos, sin]: [f64; 2]) -> Frame {
    Frame { origin: Vector::from_doubles(x, y), direction: Vector::from_doubles(cos, sin) }
}

fn point(point: &cycle::TrajectoryPoint) -> Point {
    Point { t_ns: point.t_ns, pose: frame([point.x, point.y], [point.cos, point.sin]) }
}

fn object(centre: [f64; 2], direction: [f64; 2], [length, width]: [f64; 2]) -> Object {
    Object {
        frame: frame(centre, direction),
        length: Real::from_double(length),
        width: Real::from_double(width),
    }
}

fn detections(list: &DetectionList) -> Detections {
    let object = |d: &cycle::Detection| object([d.x, d.y], [d.cos, d.sin], [d.length, d.width]);
    Detections { stamp_ns: list.stamp_ns, items: list.items.iter().map(object).collect() }
}

fn tracks(list: &TrackList) -> Tracks {
    let track = |t: &cycle::Track| Track {
        id: t.id,
        object: object([t.x, t.y], [t.cos, t.sin], [t.length, t.width]),
        velocity: Vector::from_doubles(t.vx, t.vy),
    };
    Tracks { stamp_ns: list.stamp_ns, items: list.items.iter().map(track).collect() }
}

fn route(route: &cycle::Route) -> Route {
    let cross_section = |s: &cycle::CrossSection| {
        [[s.x, s.y], s.left, s.right].map(|[x, y]| Vector::from_doubles(x, y))
    };
    Route {
        cross_sections: route.cross_sections.iter().map(cross_section).collect(),
        closed: route.closed,
    }
}

fn grid(grid: &cycle::Grid) -> Grid {
    Grid {
        frame: frame([grid.x, grid.y], [grid.cos, grid.sin]),
        resolution: Real::from_double(grid.resolution),
        width: grid.width,
        height: grid.height,
        occupied: grid.occupied.clone(),
        unknown: grid.unknown.clone(),
    }
}
