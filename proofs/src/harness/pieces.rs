//! Pieces of stages on small lists: none panics at any numbers, and what they name is there. Compiled,
//! they go on whatever `exact`, `rounding` and `libm` answer.

use mufasa::input::cycle::{Cycle, Detection, DetectionList, Track, TrackList, TrajectoryPoint};
use mufasa::input::profile::Profile;
use mufasa::parts::{gated_tracks, points_examined, start_failure};
use mufasa::report::{Rule, Witness};

use super::any::{near, near_integer, profile};
use super::bounds::{DETECTIONS, POINTS, TRACKS};
use super::items::{detection, ego, parameters, point, track};
use super::scene::alone;
#[cfg(not(kani))]
use crate::kani;

/// Of a trajectory stage v examines the points from the first on, at least that one and no more than there
/// are, whatever the distances.
///
/// Domain: 3 points and a cycle of any numbers of 64 bits, both profiles. Not covered: other numbers of
/// points, how many they are, the places that are examined behind them (H-04).
pub fn verify_points_examined_are_points() {
    let examined = points_examined(&cycle(profile()), &points());
    assert!((1..=POINTS).contains(&examined));
    kani::cover!(examined == 1, "the first alone");
    kani::cover!(examined == POINTS, "all");
}

/// H-07: the start of a trajectory breaks no other rule than one of the start, and at its first point.
///
/// Domain: 3 points and a cycle of any numbers of 64 bits. Not covered: other numbers of points, which
/// starts are accepted.
pub fn verify_the_start_breaks_rules_of_the_start() {
    let found = start_failure(&cycle(Profile::HARDENED), &points());
    if let Some(Witness { rule, point, .. }) = found {
        assert!(rule >= Rule::StartTime && rule <= Rule::StartOffset && point == Some(0));
    }
    kani::cover!(found.is_none(), "accepted");
    kani::cover!(found.is_some_and(|it| it.rule == Rule::StartTime), "a time");
    kani::cover!(found.is_some_and(|it| it.rule == Rule::StartOffset), "aside");
}

/// Stage i: the gated tracks are tracks of the list, each once and in its order.
///
/// Domain: 2 tracks and 2 detections of any numbers of 64 bits, both profiles. Not covered: other
/// numbers of them, which tracks are gated.
pub fn verify_gated_tracks_are_tracks() {
    let (tracks, detections) = (tracks(), detections());
    let tracks = TrackList { stamp_ns: near_integer(0, 12), items: &tracks };
    let detections = DetectionList { stamp_ns: near_integer(0, 12), items: &detections };
    let gated = gated_tracks(&cycle(profile()), &tracks, &detections);
    assert!([[None, None], [Some(0), None], [Some(1), None], [Some(0), Some(1)]].contains(&gated));
    kani::cover!(gated == [None, None], "none");
    kani::cover!(gated == [Some(1), None], "the second alone");
    kani::cover!(gated == [Some(0), Some(1)], "both");
}

fn points() -> [TrajectoryPoint; POINTS] {
    [(); POINTS].map(|()| point(direction(), [8, 24]))
}

fn tracks() -> [Track; TRACKS] {
    [(); TRACKS].map(|()| track(direction()))
}

fn detections() -> [Detection; DETECTIONS] {
    [(); DETECTIONS].map(|()| detection(direction()))
}

/// Any two numbers.
fn direction() -> [f64; 2] {
    [near(1.0, 1.0), near(0.0, 0.0)]
}

/// Any CAV and its parameters alone.
fn cycle(profile: Profile) -> Cycle<'static> {
    alone(profile, parameters(), ego(direction()), near_integer(10, 12))
}
