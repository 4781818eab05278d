//! Settings of a monitor, of which nearly all are at a bound of what is refused.

use mufasa_model::input::parameters::Parameters;
use mufasa_model::input::profile::Profile;
use mufasa_model::monitor::settings::{Memory, Settings, Stall};
use mufasa_model::offloading::requester;

use super::scene::WAY;
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
    let stall = Stall { way: WAY, time_ns: 1_000 * MS };
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

/// Puts one of them at a bound of what is refused, or beside it.
pub fn at_a_bound(draw: &mut Draw<'_>, settings: &mut Settings) {
    let Settings { parameters, requester, .. } = settings;
    match draw.below(12) {
        0 => requester.dt_max_ns = draw.near_ns(settings.period_ns),
        1 => parameters.max_age_ns = draw.near_ns(requester.l_max_ns),
        2 => parameters.tau = draw.pick(&[0.1, 0.1_f64.next_up(), 0.1_f64.next_down()]),
        3 => requester.t_wait_ns = draw.pick(&[1_000 * MS, 1_000 * MS - 1, 1, 0]),
        4 => requester.request_timeout_ns = draw.pick(&[MS, MS - 1, 1, 0, -1]),
        5 => requester.l_max_ns = draw.pick(&[MS, MS - 1, 1, 0, -1]),
        6 => parameters.step_max_ns = draw.pick(&[MS, MS - 1, 1, 0, -1]),
        7 => settings.period_ns = draw.pick(&[MS, MS - 1, 0, -1]),
        8 => settings.last_session = draw.pick(&[i64::MAX - 1, i64::MAX, -1, 0]),
        9 => {
            let way = draw.pick(&[0.0, -0.0, f64::from_bits(1), -f64::from_bits(1)]);
            settings.stall = Some(Stall { way, time_ns: draw.near_ns(1_000 * MS) });
        }
        10 => {
            let places = draw.pick(&[(1, 1), (0, 1), (1, 0)]);
            (settings.memory.tracks, settings.memory.detections) = places;
        }
        _ => settings.memory.cross_sections = draw.pick(&[3, 2]),
    }
}
