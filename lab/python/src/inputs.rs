//! What the CAV knows when a cycle begins, read from Python.

use mufasa::input::cycle::{Detection, Ego, Track, TrajectoryPoint};
use mufasa::monitor::{Accepted, Gap as NativeGap, GridMap, Inputs, Time as NativeTime};
use mufasa_model::report::InvalidInput;
use pyo3::prelude::*;

use crate::errors::wrong;
use crate::items;
use crate::quantities::{Gap, Time};

/// The arguments of a cycle as they come.
pub struct Given<'a, 'py> {
    pub now: &'a Bound<'py, PyAny>,
    pub ego: &'a Bound<'py, PyAny>,
    pub detections: Option<&'a Bound<'py, PyAny>>,
    pub lead: Option<&'a Bound<'py, PyAny>>,
    pub grid: Option<&'a Bound<'py, PyAny>>,
    pub local_tracks: Option<&'a Bound<'py, PyAny>>,
    pub local_trajectory: Option<&'a Bound<'py, PyAny>>,
}

/// The inputs of a cycle but for what stations sent.
pub struct Own {
    now: NativeTime,
    ego: Ego,
    detections: Option<(NativeTime, Vec<Detection>)>,
    lead: Option<(NativeTime, NativeGap, f64)>,
    grid: Option<Grid>,
    local_tracks: Option<(NativeTime, Vec<Track>)>,
    local_trajectory: Option<(NativeTime, Vec<TrajectoryPoint>)>,
}

struct Grid {
    stamp: NativeTime,
    /// x, y, cos, sin, resolution.
    frame: [f64; 5],
    sides: [i64; 2],
    occupied: Vec<u8>,
    unknown: Option<Vec<u8>>,
}

impl Own {
    /// Errors: a value that is missing or of the wrong kind.
    pub fn read(given: &Given<'_, '_>) -> Result<Self, InvalidInput> {
        Ok(Self {
            now: time(given.now, "now")?,
            ego: items::item(given.ego, "ego")?,
            detections: given
                .detections
                .map(|it| stamped(it, "detections", "items", "Detections"))
                .transpose()?,
            lead: given.lead.map(lead).transpose()?,
            grid: given.grid.map(grid).transpose()?,
            local_tracks: given
                .local_tracks
                .map(|it| stamped(it, "tracks", "items", "Tracks"))
                .transpose()?,
            local_trajectory: given
                .local_trajectory
                .map(|it| stamped(it, "trajectory", "points", "Trajectory"))
                .transpose()?,
        })
    }

    /// Inputs that no cycle calls safe: no CAV has a width that is no number.
    pub const fn nowhere(now: NativeTime) -> Self {
        let (x, y, cos, sin, speed) = (0.0, 0.0, 1.0, 0.0, 0.0);
        let (length, width, center_offset) = (1.0, f64::NAN, 0.0);
        let ego = Ego { x, y, cos, sin, speed, length, width, center_offset };
        let (detections, lead, grid, local_tracks, local_trajectory) =
            (None, None, None, None, None);
        Self { now, ego, detections, lead, grid, local_tracks, local_trajectory }
    }

    pub const fn now(&self) -> NativeTime {
        self.now
    }

    /// With the last elements that were accepted.
    pub fn with<'c>(
        &'c self,
        tracks: Option<&'c Accepted<Vec<Track>>>,
        trajectory: Option<&'c Accepted<Vec<TrajectoryPoint>>>,
    ) -> Inputs<'c> {
        let mut inputs = Inputs::new(self.now, self.ego);
        if let Some((stamp, items)) = &self.detections {
            inputs = inputs.detections(*stamp, items);
        }
        if let Some((stamp, gap, speed)) = self.lead {
            inputs = inputs.lead(stamp, gap, speed);
        }
        if let Some(grid) = &self.grid {
            let ([x, y, cos, sin, resolution], [width, height]) = (grid.frame, grid.sides);
            let (occupied, unknown) = (grid.occupied.as_slice(), grid.unknown.as_deref());
            let map = GridMap { x, y, cos, sin, resolution, width, height, occupied, unknown };
            inputs = inputs.grid(grid.stamp, map);
        }
        if let Some((stamp, items)) = &self.local_tracks {
            inputs = inputs.local_tracks(*stamp, items);
        }
        if let Some((stamp, points)) = &self.local_trajectory {
            inputs = inputs.local_trajectory(*stamp, points);
        }
        if let Some(tracks) = tracks {
            inputs = inputs.remote_tracks(tracks);
        }
        if let Some(trajectory) = trajectory {
            inputs = inputs.remote_trajectory(trajectory);
        }
        inputs
    }
}

fn time(value: &Bound<'_, PyAny>, field: &str) -> Result<NativeTime, InvalidInput> {
    let time = value.cast::<Time>().map(|time| time.get().time);
    time.map_err(|_| wrong(field, format!("must be a mufasa.Time, not {}", shown(value))))
}

fn stamped<T: items::Columns>(
    value: &Bound<'_, PyAny>,
    field: &str,
    list: &str,
    class: &str,
) -> Result<(NativeTime, Vec<T>), InvalidInput> {
    let stamp = part(value, field, "stamp", class)?;
    let stamp = time(&stamp, &format!("{field}.stamp"))?;
    Ok((stamp, items::list(&part(value, field, list, class)?, &format!("{field}.{list}"))?))
}

fn lead(value: &Bound<'_, PyAny>) -> Result<(NativeTime, NativeGap, f64), InvalidInput> {
    let part = |name| part(value, "lead", name, "Lead");
    let (stamp, gap) = (part("stamp")?, part("gap")?);
    let stamp = time(&stamp, "lead.stamp")?;
    let bare = |_| wrong("lead.gap", format!("must be a mufasa.Gap, not {}", shown(&gap)));
    let gap = gap.cast::<Gap>().map_err(bare)?.get().gap;
    Ok((stamp, gap, read(&part("speed")?, "lead.speed", "a number")?))
}

fn grid(value: &Bound<'_, PyAny>) -> Result<Grid, InvalidInput> {
    let part = |name: &str| part(value, "grid", name, "GridMap");
    let stamp = time(&part("stamp")?, "grid.stamp")?;
    let mut frame = [0.0; 5];
    for (place, name) in frame.iter_mut().zip(["x", "y", "cos", "sin", "resolution"]) {
        *place = read(&part(name)?, &format!("grid.{name}"), "a number")?;
    }
    let side = |name| read(&part(name)?, &format!("grid.{name}"), "an integer");
    let sides = [side("width")?, side("height")?];
    let occupied = read(&part("occupied")?, "grid.occupied", "bytes")?;
    let unknown = read(&part("unknown")?, "grid.unknown", "bytes or None")?;
    Ok(Grid { stamp, frame, sides, occupied, unknown })
}

fn part<'py>(
    value: &Bound<'py, PyAny>,
    field: &str,
    name: &str,
    class: &str,
) -> Result<Bound<'py, PyAny>, InvalidInput> {
    let part = value.getattr(name);
    part.map_err(|_| wrong(field, format!("must be a mufasa.{class}, not {}", shown(value))))
}

fn read<'a, 'py, T: FromPyObject<'a, 'py>>(
    value: &'a Bound<'py, PyAny>,
    field: &str,
    wanted: &str,
) -> Result<T, InvalidInput> {
    let part = value.extract();
    part.map_err(|_| wrong(field, format!("must be {wanted}, not {}", shown(value))))
}

fn shown(value: &Bound<'_, PyAny>) -> String {
    let text = value.repr().map_or_else(|error| error.to_string(), |text| text.to_string());
    mufasa_records::shown(&text)
}
