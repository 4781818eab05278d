//! A CAV and nothing else.

use mufasa::input::cycle::{Cycle, Ego, Route};
use mufasa::input::parameters::Parameters;
use mufasa::input::profile::Profile;
use mufasa::services::configuration::Configuration;

/// Time of the decision, ns.
pub const NOW_NS: i64 = 1_000_000_000;

/// The CAV at the origin.
pub const EGO: Ego = Ego {
    x: 0.0,
    y: 0.0,
    cos: 1.0,
    sin: 0.0,
    speed: 2.0,
    length: 4.0,
    width: 2.0,
    center_offset: 0.0,
};

/// The CAV and its parameters alone, in `AllRemote`. No list of it depends on a choice, or places in memory
/// would.
pub fn alone(profile: Profile, parameters: Parameters, ego: Ego, now_ns: i64) -> Cycle<'static> {
    Cycle {
        profile,
        parameters,
        now_ns,
        configuration: Configuration::AllRemote,
        ego,
        trajectory: None,
        tracks: None,
        detections: None,
        lead: None,
        route: Route { closed: false, cross_sections: &[] },
        grid: None,
        detection_history: &[],
    }
}
