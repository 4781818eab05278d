//! The cycle (`spec/5-interfaces.md#cycle`).

use mufasa_model::input::cycle as model;
use mufasa_model::input::domain::{Problem, first_problem};
use mufasa_model::input::profile::Profile;
use mufasa_model::report::InvalidInput;
use mufasa_model::services::configuration::Configuration;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::parameters::StageParameters;
use super::value::{Bitmap, Integer, MaybeNone, Number, Pair, Word};
use super::{Recorded, record};

/// The domain of a grid (`spec/4-arithmetic.md#domain`): outside of it the model says what is
/// wrong, and the length of the bitmap says nothing.
const GRID_SIDE: std::ops::RangeInclusive<i64> = 1..=1 << 15;
const GRID_CELLS: i64 = 1 << 24;

#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "a word")]
pub enum CycleKind {
    #[default]
    Cycle,
}

record! {
    /// What the CAV knows when it decides: m, m/s, ns, directions as cos and sin.
    Cycle = model::Cycle {
        /// Hardened when it is absent.
        #[serde(default = "hardened")]
        profile: Word<Profile>,
        /// Defaults where they are absent.
        #[serde(default)]
        parameters: StageParameters,
        /// Time of the decision on the CAV's monotonic clock.
        now_ns: Integer,
        /// Which groups are remote.
        configuration: Word<Configuration>,
        /// The CAV itself.
        ego: Ego,
        /// The planned trajectory; null or absent is a missing input, here and below.
        trajectory: Option<Trajectory>,
        /// The track list.
        tracks: Option<TrackList>,
        /// The detections of all local detectors.
        detections: Option<DetectionList>,
        /// The leading vehicle.
        lead: Option<Lead>,
        /// The route.
        route: Route,
        /// The occupancy grid map.
        grid: Option<Grid>,
        /// Earlier lists of the CAV's own detections, the youngest first; null or absent is none.
        #[serde(default)]
        detection_history: MaybeNone<DetectionList>,
    } + {
        /// The kind of the record.
        kind: CycleKind,
        /// Names the record in its answer.
        id: String,
    }

    /// Pose, speed and size of the CAV.
    Ego = model::Ego {
        /// Position, m.
        x: Number,
        /// Position, m.
        y: Number,
        /// Direction.
        cos: Number,
        /// Direction.
        sin: Number,
        /// v_now, m/s.
        speed: Number,
        /// Length L, m.
        length: Number,
        /// Width W, m.
        width: Number,
        /// From the position forward to the centre of the rectangle, m.
        center_offset: Number,
    }

    /// A trajectory with the time at which it was made.
    Trajectory = model::Trajectory {
        /// Time of generation.
        stamp_ns: Integer,
        /// Points in order of time.
        points: Vec<TrajectoryPoint>,
    }

    /// One pose of a trajectory.
    TrajectoryPoint = model::TrajectoryPoint {
        /// When the CAV is to be there.
        t_ns: Integer,
        /// Position, m.
        x: Number,
        /// Position, m.
        y: Number,
        /// Direction.
        cos: Number,
        /// Direction.
        sin: Number,
    }

    /// A list of tracks.
    TrackList = model::TrackList {
        /// Time that the positions are valid for.
        stamp_ns: Integer,
        /// Tracks in list order.
        items: Vec<Track>,
    }

    /// A tracked object.
    Track = model::Track {
        /// Identity over time.
        id: Integer,
        /// Centre, m.
        x: Number,
        /// Centre, m.
        y: Number,
        /// Direction.
        cos: Number,
        /// Direction.
        sin: Number,
        /// Velocity, m/s.
        vx: Number,
        /// Velocity, m/s.
        vy: Number,
        /// Length, m.
        length: Number,
        /// Width, m.
        width: Number,
    }

    /// The detections of all local detectors.
    DetectionList = model::DetectionList {
        /// Time of measurement.
        stamp_ns: Integer,
        /// Detections in list order.
        items: Vec<Detection>,
    }

    /// A detected object.
    Detection = model::Detection {
        /// Centre, m.
        x: Number,
        /// Centre, m.
        y: Number,
        /// Direction.
        cos: Number,
        /// Direction.
        sin: Number,
        /// Length, m.
        length: Number,
        /// Width, m.
        width: Number,
    }

    /// The leading vehicle.
    Lead = model::Lead {
        /// Time of measurement.
        stamp_ns: Integer,
        /// Free distance, m.
        gap: Number,
        /// v_lead, m/s.
        speed: Number,
    }

    /// A route: reference path and boundaries.
    Route = model::Route {
        /// The last cross section is followed by the first.
        closed: bool,
        /// Cross sections in driving order.
        #[serde(rename = "stations")]
        cross_sections: Vec<CrossSection>,
    }

    /// A reference point with its boundary points.
    CrossSection = model::CrossSection {
        /// Reference point, m.
        x: Number,
        /// Reference point, m.
        y: Number,
        /// Left boundary point, m.
        left: Pair,
        /// Right boundary point, m.
        right: Pair,
    }

    /// An occupancy grid map; the cell (column i, row k) is the square from (i, k) to (i+1, k+1)
    /// times the resolution in the frame (x, y, cos, sin).
    Grid = model::Grid {
        /// Time of measurement.
        stamp_ns: Integer,
        /// Origin, m.
        x: Number,
        /// Origin, m.
        y: Number,
        /// Direction of the rows.
        cos: Number,
        /// Direction of the rows.
        sin: Number,
        /// Side of a cell, m.
        resolution: Number,
        /// Columns.
        width: Integer,
        /// Rows.
        height: Integer,
        /// Cells that are occupied.
        occupied: Bitmap,
        /// Cells that are unknown; a cell both occupied and unknown is occupied.
        unknown: Option<Bitmap>,
    }
}

/// The profile of a record that has none.
pub fn hardened() -> Word<Profile> {
    Word(Profile::HARDENED)
}

impl TryFrom<Cycle> for model::Cycle {
    type Error = InvalidInput;

    /// Errors: times of the protocol outside their domain, bitmaps that do not fit the grid, or what
    /// is wrong before these in the order of INPUT-02.
    fn try_from(record: Cycle) -> Result<Self, InvalidInput> {
        record.parameters.check()?;
        let misfit = record.grid.as_ref().and_then(|grid| {
            let occupied = grid.check("occupied", Some(&grid.occupied));
            occupied.and_then(|()| grid.check("unknown", grid.unknown.as_ref())).err()
        });
        let cycle = record.into_model();
        match (misfit, first_problem(&cycle)) {
            (None, _) => Ok(cycle),
            (Some(misfit), Some(Problem::Local(first))) if first.field != misfit.field => {
                Err(first)
            }
            (Some(misfit), _) => Err(misfit),
        }
    }
}

impl Grid {
    fn check(&self, name: &str, bitmap: Option<&Bitmap>) -> Result<(), InvalidInput> {
        let (Integer(columns), Integer(rows)) = (self.width, self.height);
        let is_in_domain = [columns, rows].iter().all(|side| GRID_SIDE.contains(side))
            && columns * rows <= GRID_CELLS;
        let Some(Bitmap(bytes)) = bitmap.filter(|_| is_in_domain) else { return Ok(()) };
        let wanted = (columns * rows + 7) / 8;
        if usize::try_from(wanted) == Ok(bytes.len()) {
            return Ok(());
        }
        let field = format!("grid.{name}");
        let message = format!(
            "{field} must hold {wanted} bytes for {columns} * {rows} cells, not {}",
            bytes.len()
        );
        Err(InvalidInput { field, index: None, message })
    }
}
