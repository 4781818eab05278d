//! `spec/hardened/H-14.md#requirements-failure`: where and when an object meets the CAV.

use mufasa_model::input::cycle::{CrossSection, Profile, Track};
use mufasa_model::services::configuration::Configuration::MotRemote;

use crate::base::*;
use crate::near::{NEAR_SAFE, YES, points, safe};

const HARDENED: Profile = Profile::HARDENED;

/// Until the window ends, 560 s after now, a track of 100 m/s goes so far that D is 63 km, and the margin 7.3e-8 m.
/// MARGIN-16.
#[test]
fn what_goes_far_has_a_greater_margin() {
    // The route leads along x, and 17 m ahead towards a point.
    let with = |it: Track, to: [f64; 2]| {
        let mut cycle = base(HARDENED, MotRemote);
        let at = |[x, y]: [f64; 2]| CrossSection { x, y, left: [x, y + 3.0], right: [x, y - 3.0] };
        cycle.route.cross_sections = [[-100.0, 0.0], [17.0, 0.0], to].map(at).into();
        points(&mut cycle).truncate(10);
        // The CAV stands, and the times of the points are not asked.
        (cycle.ego.speed, cycle.parameters.start_tolerance) = (0.0, 10.0);
        cycle.parameters.delta = 1e-8;
        (cycle.parameters.t_yield, cycle.parameters.a_yield) = (60.0, 0.1);
        (cycle.tracks, cycle.detections) = (tracks(vec![it]), None);
        safe(&cycle)
    };
    // Its rear passes the CAV's front at the last place, 2 cm ahead.
    let crossing = |gap: f64, vy: f64| {
        with(Track { vy, ..track(1, 4.020_625 + gap, -10.0 * vy) }, [200.0, 0.0])
    };
    assert_eq!(crossing(6e-8, 100.0), NEAR_SAFE);
    assert_eq!(crossing(8e-8, 100.0), YES);
    assert_eq!(crossing(6e-8, 0.0), YES);
    assert_eq!(crossing(6e-9, 0.0), NEAR_SAFE);
    // It keeps beside the route, if it shares no point with the CAV now: along the leg behind a corner, 5 m beside that,
    // and so long that it passes the CAV's corner at (2.020625, -1), which the margin moves by 1.4 times as much.
    let beside = |gap: f64| {
        let (length, width) = (80.0, 2.0 * (0.6 * 14.979_375 - 0.8 - 5.0 - gap));
        let (cos, sin, vx, vy) = (-0.8, -0.6, -80.0, -60.0);
        with(Track { cos, sin, vx, vy, length, width, ..track(1, 30.0, 16.0) }, [97.0, 60.0])
    };
    assert_eq!(beside(9e-8), NEAR_SAFE);
    assert_eq!(beside(1.1e-7), YES);
}
