//! `spec/hardened/H-14.md#requirements-failure`: where and when an object meets the CAV.

use mufasa_model::input::cycle::{Profile, Track};
use mufasa_model::services::configuration::Configuration::MotRemote;

use crate::base::*;
use crate::near::{NEAR_SAFE, YES, safe};

const HARDENED: Profile = Profile::HARDENED;

/// Until the window ends, 560 s after now, a track of 100 m/s goes so far that D is 63 km, and the margin 7.3e-8 m.
/// MARGIN-16.
#[test]
fn what_goes_far_has_a_greater_margin() {
    let with = |it: Track| {
        let mut cycle = base(HARDENED, MotRemote);
        cycle.ego.speed = 0.0;
        cycle.parameters.delta = 1e-8;
        (cycle.parameters.t_yield, cycle.parameters.a_yield) = (60.0, 0.1);
        (cycle.tracks, cycle.detections) = (tracks(vec![it]), None);
        safe(&cycle)
    };
    // Its rear passes the CAV's front at the last place, 2 cm ahead.
    let crossing = |gap: f64, vy: f64| Track { vy, ..track(1, 4.020_625 + gap, -10.0 * vy) };
    assert_eq!(with(crossing(6e-8, 100.0)), NEAR_SAFE);
    assert_eq!(with(crossing(8e-8, 100.0)), YES);
    assert_eq!(with(crossing(6e-8, 0.0)), YES);
    assert_eq!(with(crossing(6e-9, 0.0)), NEAR_SAFE);
    // It keeps beside the path, if it shares no point with the CAV now.
    let beside = |gap: f64| Track { vx: 100.0, ..track(1, 0.0, 2.0 + gap) };
    assert_eq!(with(beside(6e-8)), NEAR_SAFE);
    assert_eq!(with(beside(8e-8)), YES);
}
