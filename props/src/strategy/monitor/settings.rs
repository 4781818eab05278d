//! Settings of a monitor, of which nearly all are at a bound of what is refused.

use mufasa_model::input::parameters::Parameters;
use mufasa_model::input::profile::Profile;
use mufasa_model::monitor::settings::{Memory, Settings, Stall};
use mufasa_model::offloading::requester;

use super::times::MS;
use crate::strategy::draw::Draw;

/// Settings that are not refused, at 10 Hz.
pub fn accepted(draw: &mut Draw<'_>, profile: Profile) -> Settings {
    let dt_max_ns = draw.pick(&[150 * MS, 100 * MS + 1, 220 * MS]);
    let l_max_ns = draw.pick(&[50 * MS, 20 * MS]);
    let parameters = Parameters {
        max_age_ns: draw.pick(&[100 * MS, 100 * MS, l_max_ns]),
        tau: draw.pick(&[0.25, 0.1_f64.next_up()]),
        ..Parameters::default()
    };
    let requester = requester::Parameters {
        t_wait_ns: draw.pick(&[1_000, 0, 10_000]) * MS,
        request_timeout_ns: draw.pick(&[500, 200]) * MS,
        l_max_ns,
        dt_max_ns,
        qos_hold: draw.one_in(3),
    };
    let stall = Stall { way: 1.0, time_ns: 1_000 * MS };
    Settings {
        profile,
        parameters,
        requester,
        period_ns: 100 * MS,
        last_session: draw.pick(&[0, 7, 1 << 32]),
        supervise_local: draw.one_in(2),
        stall: draw.one_in(2).then_some(stall),
        memory: Memory { tracks: 2, detections: 3, cross_sections: 3 },
    }
}
