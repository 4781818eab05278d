//! Pieces of stages, a comparison or a count each (`spec/3-stages.md`).

use mufasa::parts::{gated_tracks, plainly_within, points_examined, starts_in_time};

use super::any::{below, integer_within, near, time_ns};
#[cfg(not(kani))]
use crate::kani;

/// Of a trajectory the points from the first on are examined, up to one that is not within the horizon; where plain doubles
/// cannot tell of one before it, they count none [DIST-03, DIST-04].
///
/// Domain: three points, any answers. Not covered: other numbers of points, the places behind them (H-04).
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(4))]
pub fn verify_points_examined_are_a_prefix() {
    let is_within = [any_answer(), any_answer()];
    let found = points_examined(is_within);
    let expected = match is_within {
        [Some(false), _] => Some(1),
        [Some(true), Some(false)] => Some(2),
        [Some(true), Some(true)] => Some(3),
        [None, _] | [Some(true), None] => None,
    };
    assert!(found == expected);
    kani::cover!(found == Some(1), "the first alone");
    kani::cover!(found == Some(3), "all");
}

/// A way counts in plain doubles as beyond the horizon only when it is, and as within only when it is not beyond; no NaN
/// counts as beyond [DIST-03].
///
/// Domain: all ways from 0, all horizons, any numbers of 64 bits, NaN among them. Not covered: how much plain doubles err.
#[cfg_attr(kani, kani::proof)]
pub fn verify_a_way_is_plainly_within_the_horizon() {
    let (arc, least, most) = (near(0.0, 8.0), near(0.0, 8.0), near(0.0, 8.0));
    kani::assume(arc.is_nan() || arc >= 0.0);
    let found = plainly_within(arc, [least, most]);
    assert!(found != Some(false) || arc > most);
    assert!(found != Some(true) || !exceeds(arc, least));
    kani::cover!(found == Some(false), "beyond");
    kani::cover!(found == Some(true) && arc > 0.0, "within");
    kani::cover!(found.is_none(), "open");
    kani::cover!(found == Some(true) && arc.is_nan(), "NaN");
}

/// H-07: a trajectory starts about now exactly when its first time is at most `max_age` from now, before or after it
/// [H-07.1].
///
/// Domain: all times of 64 bits, each `max_age` of the domain (0 to 60 s). Not covered: the place of the start.
#[cfg_attr(kani, kani::proof)]
pub fn verify_a_trajectory_starts_about_now() {
    let (t_ns, now_ns, max_age_ns) = (time_ns(), time_ns(), integer_within(0, 60_000_000_000));
    let away_ns = i128::from(now_ns) - i128::from(t_ns);
    let limit_ns = i128::from(max_age_ns);
    let found = starts_in_time(t_ns, now_ns, max_age_ns);
    assert!(found == (-limit_ns <= away_ns && away_ns <= limit_ns));
    kani::cover!(found && away_ns == limit_ns, "as old as it may be");
    kani::cover!(!found && away_ns < 0, "ahead");
}

/// Stage i: the gated tracks are listed once each and in the order of the list [S1-03].
///
/// Domain: three tracks, any answers, two rows. Not covered: other numbers of them, which tracks are gated.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(5))]
pub fn verify_gated_tracks_are_tracks() {
    let is_gated = [kani::any(), kani::any(), kani::any()];
    let found = gated_tracks(is_gated);
    let expected = match is_gated {
        [false, false, false] => [None, None],
        [true, false, false] => [Some(0), None],
        [false, true, false] => [Some(1), None],
        [false, false, true] => [Some(2), None],
        [true, true, _] => [Some(0), Some(1)],
        [true, false, true] => [Some(0), Some(2)],
        [false, true, true] => [Some(1), Some(2)],
    };
    assert!(found == expected);
    kani::cover!(found == [None, None], "none");
    kani::cover!(found == [Some(1), None], "the second alone");
    kani::cover!(found == [Some(0), Some(1)] && is_gated[2], "more than there are rows for");
}

fn any_answer() -> Option<bool> {
    match below(3) {
        0 => None,
        1 => Some(false),
        _ => Some(true),
    }
}

fn exceeds(one: f64, other: f64) -> bool {
    one > other
}
