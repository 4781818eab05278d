//! The sensors of the station.

use crate::map::route::Route;
use crate::pose::Pose;
use crate::services::detectors::scan::Sweep;
use crate::services::detectors::{Detector, Errors, Mount};

/// Distance between the sensors along the route, m, and how far each looks.
const SENSORS_M: (f64, f64) = (60.0, 70.0);

/// Sensors beside the route, one each few metres, that look all around.
pub(super) fn beside(route: &Route, errors: Errors) -> Vec<Detector> {
    let (spacing, range) = SENSORS_M;
    let mut sensors = Vec::new();
    let mut s = spacing / 2.0;
    while s < route.path.length() {
        let along = route.path.pose_at(s);
        let pose = Pose { at: along.ahead(0.0, -8.0), ..along };
        let sweep = Sweep::new(range, 2.0 * core::f64::consts::PI, 240);
        sensors.push(Detector { mount: Mount::Fixed(pose), sweep, errors });
        s += spacing;
    }
    sensors
}
