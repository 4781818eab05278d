//! The memory of the largest cycle.

use core::ptr::null;

use super::{Counts, HISTORY};
use crate::check::mufasa_parameters_default;
use crate::cycle::{
    MufasaCycle, MufasaDetectionList, MufasaEgo, MufasaRoute, MufasaTrackList, MufasaTrajectory,
};
use crate::parameters::MufasaParameters;
use crate::time::MufasaTime;

/// `MUFASA_SCRATCH_BYTES_MAX` would be too little else.
#[test]
fn the_largest_cycle_needs_what_is_said_of_every_cycle() {
    let (stamp, len) = (MufasaTime { ns: 0 }, usize::MAX);
    let trajectory = MufasaTrajectory { stamp, points: null(), points_len: len };
    let tracks = MufasaTrackList { stamp, items: null(), items_len: len };
    let detections = MufasaDetectionList { stamp, items: null(), items_len: len };
    let history = [detections; HISTORY];
    let cycle = MufasaCycle {
        profile: 0,
        configuration: 0,
        now: stamp,
        parameters: MufasaParameters { miss_budget: 1025, ..mufasa_parameters_default() },
        ego: MufasaEgo {
            x: 0.0,
            y: 0.0,
            cos: 1.0,
            sin: 0.0,
            speed: 0.0,
            length: 1.0,
            width: 1.0,
            center_offset: 0.0,
        },
        route: MufasaRoute { closed: 0, cross_sections: null(), cross_sections_len: len },
        trajectory: &raw const trajectory,
        tracks: &raw const tracks,
        detections: &raw const detections,
        lead: null(),
        grid: null(),
        detection_history: history.as_ptr(),
        detection_history_len: len,
    };
    // SAFETY: of the lists only their lengths are read; the history has as many as are looked at.
    let counts = unsafe { Counts::of(&cycle) }.unwrap();
    assert_eq!(counts.bytes(), Counts::MAX.bytes());
}
