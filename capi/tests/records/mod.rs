//! Records of the model as C has them.

use std::ptr::null;

use mufasa_capi::cycle::{
    MufasaCrossSection, MufasaDetection, MufasaDetectionList, MufasaEgo, MufasaGrid, MufasaLead,
    MufasaTrack, MufasaTrackList, MufasaTrajectory, MufasaTrajectoryPoint,
};
use mufasa_capi::time::{MufasaGap, MufasaTime};
use mufasa_model::input::cycle::{
    CrossSection, Detection, Ego, Grid, Lead, Route, Track, TrajectoryPoint,
};

pub fn time(ns: i64) -> MufasaTime {
    MufasaTime { ns }
}

/// A struct of C with the same fields.
macro_rules! same {
    ($from:expr => $to:ident { $($field:ident),* } $($rest:tt)*) => {
        $to { $($field: $from.$field,)* $($rest)* }
    };
}

pub fn track(it: &Track) -> MufasaTrack {
    same!(it => MufasaTrack { id, x, y, cos, sin, vx, vy, length, width })
}

pub fn point(it: &TrajectoryPoint) -> MufasaTrajectoryPoint {
    same!(it => MufasaTrajectoryPoint { x, y, cos, sin } t: time(it.t_ns))
}

pub fn detection(it: &Detection) -> MufasaDetection {
    same!(it => MufasaDetection { x, y, cos, sin, length, width })
}

pub fn ego(it: &Ego) -> MufasaEgo {
    same!(it => MufasaEgo { x, y, cos, sin, speed, length, width, center_offset })
}

pub fn lead(Lead { stamp_ns, gap, speed }: &Lead) -> MufasaLead {
    let gap = MufasaGap { between_bumpers: *gap };
    MufasaLead { stamp: time(*stamp_ns), gap, speed: *speed }
}

/// It points into the record, as the lists below.
pub fn grid(it: &Grid) -> MufasaGrid {
    let unknown = it.unknown.as_ref();
    same!(it => MufasaGrid { x, y, cos, sin, resolution, width, height }
        stamp: time(it.stamp_ns),
        occupied: it.occupied.as_ptr(),
        occupied_len: it.occupied.len(),
        unknown: unknown.map_or(null(), Vec::as_ptr),
        unknown_len: unknown.map_or(0, Vec::len))
}

pub fn cross_sections(route: &Route) -> Vec<MufasaCrossSection> {
    let section = |it: &CrossSection| same!(it => MufasaCrossSection { x, y, left, right });
    route.cross_sections.iter().map(section).collect()
}

pub fn track_list(stamp_ns: i64, items: &[MufasaTrack]) -> MufasaTrackList {
    MufasaTrackList { stamp: time(stamp_ns), items: items.as_ptr(), items_len: items.len() }
}

pub fn detection_list(stamp_ns: i64, items: &[MufasaDetection]) -> MufasaDetectionList {
    MufasaDetectionList { stamp: time(stamp_ns), items: items.as_ptr(), items_len: items.len() }
}

pub fn path(stamp_ns: i64, points: &[MufasaTrajectoryPoint]) -> MufasaTrajectory {
    MufasaTrajectory { stamp: time(stamp_ns), points: points.as_ptr(), points_len: points.len() }
}
