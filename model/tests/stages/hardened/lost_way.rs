//! F-40, what stays open of F-28 and F-29: a trajectory that keeps H-11 and H-12 and weaves within a lane.

use mufasa_model::input::cycle::{Cycle, Profile, Trajectory, TrajectoryPoint};
use mufasa_model::report::{Rule, Stage};
use mufasa_model::services::configuration::Configuration::{self, MotRemote, PlanRemote};

use crate::base::*;

/// x, y in m, heading in degrees, 0.1 s apart: found by a search for the least x at way s_stop = 7.65 m
/// within a lane of 3.5 m. Its steps are as short and as long as start_tolerance allows (H-12).
const WEAVE: [[f64; 3]; 26] = [
    [0.0, 0.0, 0.0],
    [0.294_866, 0.055_263, 10.0],
    [1.482_909, 0.443_919, 15.0],
    [1.781_47, 0.414_566, -15.0],
    [1.822_117, 0.385_449, -45.0],
    [1.912_557, 0.207_066, -70.0],
    [1.984_484, -0.388_607, -85.0],
    [2.080_057, -1.634_948, -75.0],
    [2.100_7, -1.680_488, -45.0],
    [2.141_347, -1.709_605, -15.0],
    [2.191_107, -1.714_497, 15.0],
    [2.461_623, -1.584_8, 25.0],
    [2.917_084, -1.194_217, 45.0],
    [3.128_37, -0.854_573, 60.0],
    [3.227_745, -0.467_113, 80.0],
    [3.229_39, -0.417_141, 85.0],
    [3.222_95, 0.182_825, 85.0],
    [3.219_73, 0.482_808, 85.0],
    [3.218_656, 0.582_802, 85.0],
    [3.216_51, 0.782_79, 85.0],
    [3.215_973, 0.832_787, 85.0],
    [3.214_9, 0.932_782, 85.0],
    [3.214_363, 0.982_779, 85.0],
    [3.213_29, 1.082_773, 85.0],
    [3.212_753, 1.132_77, 85.0],
    [3.206_313, 1.732_736, 85.0],
];

/// The CAV drives at 10 m/s; a car stands ahead with its rear at `rear`.
fn weave(configuration: Configuration, rear: f64) -> Cycle {
    let mut cycle = base(Profile::Hardened, configuration);
    (cycle.ego.length, cycle.ego.width, cycle.ego.center_offset) = (4.8, 1.9, 1.4);
    let point = |(i, [x, y, degrees]): (i64, &[f64; 3])| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        TrajectoryPoint { cos, sin, ..at_time(i * 100_000_000, *x, *y) }
    };
    let points = (0..).zip(&WEAVE).map(point).collect();
    cycle.trajectory = Some(Trajectory { stamp_ns: NOW, points });
    cycle.tracks = tracks(vec![track(1, rear + 2.0, 0.0)]);
    cycle.detections = detections(vec![detection(rear + 2.0, 0.0)]);
    cycle
}

/// Open: a CAV that brakes straight on at a_b comes to 7.65 m with its front at 11.45 m; accepted is a
/// trajectory that meets nothing although a car stands from 6.7 m on. Nearer than that it is met.
#[test]
fn a_weave_that_no_vehicle_drives_loses_4_m_of_its_way() {
    for configuration in [MotRemote, PlanRemote] {
        assert_eq!(failed(&weave(configuration, 6.7)), None, "{configuration:?}: open");
    }
    assert_eq!(rule(&weave(MotRemote, 6.0), Stage::Iv), Some(Rule::Collision));
}
