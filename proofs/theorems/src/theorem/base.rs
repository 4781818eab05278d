//! A cycle with nothing in it, whose numbers may be holes: a hole stands for any number.

use crate::input::cycle::{CrossSection, Cycle, Ego, Profile, Route, Trajectory, TrajectoryPoint};
use crate::input::parameters::Parameters;
use crate::input::scene::{Point, Scene};
use crate::numbers::real::Real;
use crate::numbers::real::hole::open_number;
use crate::numbers::vector::{Frame, Vector};
use crate::report::Reading;
use crate::services::configuration::Configuration;

/// Now, ns.
pub const NOW_NS: i64 = 0;

/// The CAV at the origin along x, L = 4 m, W = 2 m, on a straight route, with a trajectory of the
/// point that it is at, and nothing else.
pub fn cycle(profile: Profile, configuration: Configuration) -> Cycle {
    let cross_section = |x: f64| CrossSection { x, y: 0.0, left: [x, 5.0], right: [x, -5.0] };
    Cycle {
        profile,
        parameters: Parameters::default(),
        now_ns: NOW_NS,
        configuration,
        ego: Ego {
            x: 0.0,
            y: 0.0,
            cos: 1.0,
            sin: 0.0,
            speed: 0.0,
            length: 4.0,
            width: 2.0,
            center_offset: 0.0,
        },
        trajectory: Some(Trajectory { stamp_ns: NOW_NS, points: vec![point(0, 0.0, 0.0)] }),
        tracks: None,
        detections: None,
        lead: None,
        route: Route {
            closed: false,
            cross_sections: vec![cross_section(-50.0), cross_section(150.0)],
        },
        grid: None,
        detection_history: Vec::new(),
    }
}

/// A trajectory point along x.
pub fn point(t_ns: i64, x: f64, y: f64) -> TrajectoryPoint {
    TrajectoryPoint { t_ns, x, y, cos: 1.0, sin: 0.0 }
}

/// The exact scene of a cycle.
pub fn scene(cycle: &Cycle) -> Scene {
    Scene::new(cycle, Reading::Exact)
}

/// The base scene with holes for the speed of the CAV and its size.
pub fn any_cav(profile: Profile) -> Scene {
    let mut cycle = cycle(profile, Configuration::PlanRemote);
    cycle.ego.speed = open_number("v_now");
    cycle.ego.length = open_number("L");
    cycle.ego.width = open_number("W");
    scene(&cycle)
}

/// A pose at the origin whose direction is `scale` along x.
pub fn home(scale: &Real) -> Point {
    let origin = Vector { x: Real::zero(), y: Real::zero() };
    let direction = Vector { x: scale.clone(), y: Real::zero() };
    Point { t_ns: NOW_NS, pose: Frame { origin, direction } }
}
