//! The border (`spec/4-arithmetic.md#domain`) on short lists: accepted is exactly what is in the
//! domain. Directions are constants here.

use mufasa::input::cycle::{
    CrossSection, Detection, DetectionList, Grid, Lead, Route, Track, TrackList, Trajectory,
    TrajectoryPoint,
};
use mufasa::parts::{
    detections_are_valid, grid_is_valid, lead_is_valid, route_is_valid, tracks_are_valid,
    trajectory_is_usable,
};

use super::any::{near, near_integer, same_number};
use super::items::{detection, point, track};
#[cfg(not(kani))]
use crate::kani;

const EAST: [f64; 2] = [1.0, 0.0];
/// Around now.
const TIMES_NS: [i64; 2] = [8, 24];

/// A route of two cross sections is valid exactly when every number is within its domain and the
/// reference points differ; no NaN is [INPUT-04, DOM-01, IMPL-05].
///
/// Domain: all numbers of 64 bits. Not covered: longer routes.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(4))]
pub fn verify_a_route_is_checked() {
    let cross_sections = [cross_section(), cross_section()];
    let [a, b] = cross_sections;
    let closed = kani::any();
    let valid = route_is_valid(&Route { closed, cross_sections: &cross_sections });
    let within = |it: CrossSection| {
        is_position(it.x)
            && is_position(it.y)
            && is_position(it.left[0])
            && is_position(it.left[1])
            && is_position(it.right[0])
            && is_position(it.right[1])
    };
    let equal = same_number(a.x, b.x) && same_number(a.y, b.y);
    assert!(valid == (within(a) && within(b) && !equal));
    kani::cover!(valid, "valid");
    kani::cover!(within(a) && within(b) && equal, "equal points");
    kani::cover!(within(a) && b.right[1].is_nan(), "NaN");
}

/// A list of two tracks is valid exactly when every number is within its domain, the ids differ,
/// and the stamp is at most 60 s from now, or older and the list not remote [INPUT-03, INPUT-04, DOM-01, IMPL-05].
///
/// Domain: all numbers of 64 bits, one direction. Not covered: longer lists, directions.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(10))]
pub fn verify_tracks_are_checked() {
    let items = [track(EAST), track(EAST)];
    let (stamp_ns, now_ns, remote) = (near_integer(0, 12), near_integer(0, 12), kani::any());
    let valid = tracks_are_valid(&TrackList { stamp_ns, items: &items }, now_ns, remote);
    let within = |it: Track| {
        is_position(it.x)
            && is_position(it.y)
            && is_in(it.vx, -150.0, 150.0)
            && is_in(it.vy, -150.0, 150.0)
            && is_size(it.length)
            && is_size(it.width)
    };
    let [a, b] = items;
    let fits = within(a) && within(b) && is_time(stamp_ns, now_ns, remote);
    assert!(valid == (fits && a.id != b.id));
    kani::cover!(valid && a.id > b.id, "valid");
    kani::cover!(fits && a.id == b.id, "a repeated id");
    kani::cover!(
        valid && is_time(stamp_ns, now_ns, false) && !is_time(stamp_ns, now_ns, true),
        "old"
    );
}

/// A list of two detections is valid exactly when every number is within its domain and the stamp
/// is not more than 60 s ahead of now [INPUT-03, INPUT-04, DOM-01, IMPL-05].
///
/// Domain: all numbers of 64 bits, one direction. Not covered: longer lists, directions.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(10))]
pub fn verify_detections_are_checked() {
    let items = [detection(EAST), detection(EAST)];
    let (stamp_ns, now_ns) = (near_integer(0, 12), near_integer(0, 12));
    let valid = detections_are_valid(&DetectionList { stamp_ns, items: &items }, now_ns);
    let within = |it: Detection| {
        is_position(it.x) && is_position(it.y) && is_size(it.length) && is_size(it.width)
    };
    let fits = within(items[0]) && within(items[1]);
    assert!(valid == (fits && is_time(stamp_ns, now_ns, false)));
    kani::cover!(valid, "valid");
    kani::cover!(fits && !valid, "from the future");
    kani::cover!(items[1].width.is_nan(), "NaN");
}

/// A trajectory of two points is valid exactly when every number is within its domain, times
/// increase, and times are at most 60 s ahead of now and, unless the trajectory is too old to be
/// used, at most 60 s old; a remote one that old is refused [INPUT-03, INPUT-04, DOM-01, IMPL-05].
///
/// Domain: all numbers of 64 bits, one direction. Not covered: longer lists, directions.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(10))]
pub fn verify_a_trajectory_is_checked() {
    let points = [point(EAST, TIMES_NS), point(EAST, TIMES_NS)];
    let (stamp_ns, now_ns, remote) = (near_integer(0, 12), near_integer(0, 12), kani::any());
    let found = trajectory_is_usable(&Trajectory { stamp_ns, points: &points }, now_ns, remote);
    let usable = is_time(stamp_ns, now_ns, true);
    let within = |it: TrajectoryPoint| {
        is_position(it.x) && is_position(it.y) && is_time(it.t_ns, now_ns, usable)
    };
    let [a, b] = points;
    let fits = is_time(stamp_ns, now_ns, remote) && within(a) && within(b);
    let valid = fits && a.t_ns < b.t_ns;
    assert!(found == if valid { Some(usable) } else { None });
    kani::cover!(found == Some(true), "usable");
    kani::cover!(found == Some(false), "too old to be used");
    kani::cover!(fits && a.t_ns == b.t_ns, "the same time twice");
}

/// A lead is valid exactly when its gap is from 0 to 1e6 m, its speed from 0 to 150 m/s, and its
/// stamp not more than 60 s ahead of now [INPUT-03, INPUT-04, DOM-01, IMPL-05].
///
/// Domain: all numbers of 64 bits. Not covered: nothing.
#[cfg_attr(kani, kani::proof)]
pub fn verify_a_lead_is_checked() {
    let (stamp_ns, now_ns) = (near_integer(0, 12), near_integer(0, 12));
    let lead = Lead { stamp_ns, gap: near(0.0, 1e6), speed: near(0.0, 150.0) };
    let valid = lead_is_valid(&lead, now_ns);
    let fits = is_in(lead.gap, 0.0, 1e6) && is_in(lead.speed, 0.0, 150.0);
    assert!(valid == (fits && is_time(stamp_ns, now_ns, false)));
    kani::cover!(valid, "valid");
    kani::cover!(fits && !valid, "from the future");
    kani::cover!(lead.gap.is_nan(), "NaN");
}

/// A grid is valid exactly when every number is within its domain and each bitmap has the bytes
/// for its cells [INPUT-03, INPUT-04, DOM-01, IMPL-05].
///
/// Domain: all numbers of 64 bits, bitmaps of up to 3 bytes, one direction. Not covered: longer
/// bitmaps, directions.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(10))]
pub fn verify_a_grid_is_checked() {
    const BYTES: [u8; 3] = [0; 3];
    let (of_occupied, of_unknown, is_known): (u8, u8, bool) =
        (super::any::below(4), super::any::below(4), kani::any());
    let (stamp_ns, now_ns) = (near_integer(0, 12), near_integer(0, 12));
    let grid = Grid {
        stamp_ns,
        x: near(-8.0, 8.0),
        y: near(-8.0, 8.0),
        cos: 1.0,
        sin: 0.0,
        resolution: near(0.5, 10.0),
        width: near_integer(1, 5),
        height: near_integer(1, 5),
        occupied: &BYTES[..usize::from(of_occupied)],
        unknown: if is_known { None } else { Some(&BYTES[..usize::from(of_unknown)]) },
    };
    let valid = grid_is_valid(&grid, now_ns);
    let fits = is_position(grid.x)
        && is_position(grid.y)
        && is_in(grid.resolution, 0.01, 10.0)
        && is_time(stamp_ns, now_ns, false);
    let sides = grid.width >= 1 && grid.width <= 24 && grid.height >= 1 && grid.height <= 24;
    let bytes = if sides { (grid.width * grid.height + 7) / 8 } else { -1 };
    let has_all = i64::from(of_occupied) == bytes && (is_known || i64::from(of_unknown) == bytes);
    assert!(valid == (fits && has_all));
    kani::cover!(valid && !is_known, "valid");
    kani::cover!(fits && sides && !has_all, "a bitmap of the wrong length");
}

fn is_in(value: f64, least: f64, most: f64) -> bool {
    least <= value && value <= most
}

fn is_position(value: f64) -> bool {
    is_in(value, -16_777_216.0, 16_777_216.0)
}

fn is_size(value: f64) -> bool {
    is_in(value, 0.01, 100.0)
}

/// At most 60 s ahead of now; of remote data also at most 60 s old.
fn is_time(stamp_ns: i64, now_ns: i64, remote: bool) -> bool {
    let age_ns = i128::from(now_ns) - i128::from(stamp_ns);
    age_ns >= -60_000_000_000 && !(remote && age_ns > 60_000_000_000)
}

fn cross_section() -> CrossSection {
    let place = || [near(-8.0, 8.0), near(-8.0, 8.0)];
    let ([x, y], left, right) = (place(), place(), place());
    CrossSection { x, y, left, right }
}
