//! A cycle of arbitrary numbers, of small sizes.

use mufasa::input::cycle::{
    CrossSection, Cycle, Detection, DetectionList, Ego, Grid, Lead, Route, Track, TrackList,
    Trajectory, TrajectoryPoint,
};
use mufasa::input::parameters::Parameters;
use mufasa::input::profile::Profile;
use mufasa::report::Input;
use mufasa::services::configuration::Configuration;

use super::any::{index, near, near_integer, option};
use super::bounds::{DETECTIONS, DISKS, GRID, GRID_BYTES, POINTS, ROUTE, TRACKS};
use super::items::{self, FAR, detection, position, track};
#[cfg(not(kani))]
use crate::kani;

/// The items of all lists.
#[derive(Debug)]
pub struct World {
    tracks: [Track; TRACKS],
    detections: [Detection; DETECTIONS],
    points: [TrajectoryPoint; POINTS],
    cross_sections: [CrossSection; ROUTE],
    occupied: [u8; GRID_BYTES],
    unknown: [u8; GRID_BYTES],
}

impl World {
    /// Any items.
    pub fn any() -> Self {
        Self {
            tracks: [(); TRACKS].map(|()| track(direction())),
            detections: [(); DETECTIONS].map(|()| detection(direction())),
            points: core::array::from_fn(point),
            cross_sections: core::array::from_fn(cross_section),
            occupied: [kani::any(), kani::any()],
            unknown: [kani::any(), kani::any()],
        }
    }

    /// Any cycle with these items that holds nothing but these inputs (a lead
    /// with detections), each present or not: any parameters, ego and stamps, lists of any length up to the
    /// bounds, any grid that fits the bitmap or not.
    pub fn cycle(
        &self,
        profile: Profile,
        configuration: Configuration,
        holds: &[Input],
    ) -> Cycle<'_> {
        Cycle {
            profile,
            parameters: parameters(),
            now_ns: near_integer(10, 12),
            configuration,
            ego: ego(),
            trajectory: given(holds, Input::Trajectory, || Trajectory {
                stamp_ns: stamp_ns(),
                points: &self.points[..index(POINTS + 1)],
            }),
            tracks: given(holds, Input::Tracks, || list(&self.tracks)),
            detections: given(holds, Input::Detections, || DetectionList {
                stamp_ns: stamp_ns(),
                items: &self.detections[..index(DETECTIONS + 1)],
            }),
            lead: given(holds, Input::Detections, || Lead {
                stamp_ns: stamp_ns(),
                gap: near(0.0, 1e3),
                speed: near(0.0, 60.0),
            }),
            route: Route {
                closed: kani::any(),
                cross_sections: &self.cross_sections[..index(ROUTE + 1)],
            },
            grid: given(holds, Input::Grid, || self.grid()),
            detection_history: &[],
        }
    }

    fn grid(&self) -> Grid<'_> {
        let [cos, sin] = direction();
        Grid {
            stamp_ns: stamp_ns(),
            x: near(-FAR, 0.0),
            y: near(-FAR, 0.0),
            cos,
            sin,
            resolution: near(0.5, 10.0),
            width: side(),
            height: side(),
            occupied: &self.occupied,
            unknown: option(|| self.unknown.as_slice()),
        }
    }
}

/// Four cells, or any number.
fn side() -> i64 {
    const SIDE: i64 = GRID as i64;
    if kani::any() { SIDE } else { near_integer(1, SIDE) }
}

fn given<T>(holds: &[Input], input: Input, value: impl FnOnce() -> T) -> Option<T> {
    if holds.contains(&input) { option(value) } else { None }
}

fn list(items: &[Track; TRACKS]) -> TrackList<'_> {
    TrackList { stamp_ns: stamp_ns(), items: &items[..index(TRACKS + 1)] }
}

fn stamp_ns() -> i64 {
    near_integer(0, 12)
}

/// Directions of length 1 in all quadrants, or any two numbers.
fn direction() -> [f64; 2] {
    const UNIT: [[f64; 2]; 4] = [[1.0, 0.0], [0.6, 0.8], [-0.8, 0.6], [0.0, -1.0]];
    if kani::any() { UNIT[index(UNIT.len())] } else { [near(0.8, 0.8), near(0.6, 0.6)] }
}

/// The times of consecutive points increase, or are any.
fn point(at: usize) -> TrajectoryPoint {
    const FIRST_NS: [i64; POINTS] = [8, 16, 24];
    items::point(direction(), [FIRST_NS[at], FIRST_NS[at] + 7])
}

/// Consecutive cross sections go on, or are anywhere.
fn cross_section(at: usize) -> CrossSection {
    const FIRST: [f64; ROUTE] = [-40.0, -5.0, 20.0];
    let x = near(FIRST[at], FIRST[at] + 20.0);
    let left = [near(x, x), near(3.0, FAR)];
    let right = [near(x, x), near(-FAR, -3.0)];
    CrossSection { x, y: near(-1.0, 1.0), left, right }
}

/// Any CAV.
pub fn ego() -> Ego {
    let [cos, sin] = direction();
    Ego {
        x: position(),
        y: position(),
        cos,
        sin,
        speed: near(0.0, 60.0),
        length: near(0.01, 12.0),
        width: near(0.01, 3.0),
        center_offset: near(-2.0, 2.0),
    }
}

/// Any parameters.
pub fn parameters() -> Parameters {
    Parameters {
        theta_tr: near(0.1, 10.0),
        theta_map: near(0.1, 10.0),
        theta_obj: near(0.1, 10.0),
        a_b: near(0.1, 10.0),
        safety_time: near(0.0, 2.0),
        max_age_ns: near_integer(0, 60_000_000_000),
        n: near_integer(1, DISKS),
        theta_track_max: near(0.1, 10.0),
        miss_budget: near_integer(0, 2),
        tau: near(0.0, 1.0),
        a_max: near(0.1, 10.0),
        start_tolerance: near(0.1, 1e3),
        v_max: near(1.0, 1e3),
        step_max_ns: near_integer(0, 60_000_000_000),
        theta_velocity: near(0.1, 1e3),
        lateral_tolerance: near(0.1, 10.0),
        v_object: near(1.0, 1e3),
        t_yield: near(0.0, 2.0),
        a_yield: near(0.1, 10.0),
        work_limit: near_integer(0, 10_000_000_000),
        delta: near(1e-8, 1e-2),
    }
}
