//! The times that decide at places, by the error bounds of `Times`.

use crate::hardened::h14_fail_safe::cover::{Clock, Object};
use crate::hardened::h14_fail_safe::times::Times;
use crate::input::cycle::{Cycle, Ego, Route};
use crate::input::parameters::Parameters;
use crate::input::profile::Profile;
use crate::numbers::rounding::Real;
use crate::random::Random;
use crate::services::configuration::Configuration;
use crate::stages::llcc::sweep::MovingRectangle;

/// A CAV and nothing else.
pub(in crate::hardened::h14_fail_safe) fn standing(
    speed: f64,
    parameters: Parameters,
) -> Cycle<'static> {
    let (x, y, cos, sin) = (0.0, 0.0, 1.0, 0.0);
    Cycle {
        profile: Profile::HARDENED,
        parameters,
        now_ns: 0,
        configuration: Configuration::AllRemote,
        ego: Ego { x, y, cos, sin, speed, length: 4.8, width: 1.9, center_offset: 0.0 },
        trajectory: None,
        tracks: None,
        detections: None,
        lead: None,
        route: Route { closed: false, cross_sections: &[] },
        grid: None,
        detection_history: &[],
    }
}

/// Slow and fast, and where the CAV stops.
#[test]
fn times_err_by_no_more_than_the_places_count() {
    let mut random = Random::new(22);
    for _ in 0..4_000 {
        let speed = [0.0, 5e-324, 1e-6, random.number(75.0) + 75.0][random.below(4) as usize];
        let [a_b, tau, a_max] = [[0.1, 8.0, 100.0], [0.0, 0.1, 60.0], [0.1, 3.0, 100.0]]
            .map(|values| values[random.below(3) as usize]);
        let parameters = Parameters { a_b, tau, a_max, ..Parameters::default() };
        let times = Times::<Real>::new(&standing(speed, parameters));
        let share = [0.0, 1e-300, 1e-15, 1e-9, 0.3, 1.0 - 1e-9, 1.0 - 1e-16, 1.0];
        let share = Real::new(share[random.below(8) as usize]);
        let differs = |plain: f64, exact: Real, longest: Real| {
            let off = (Real::new(plain) - exact).magnitude();
            off > 1e-12 + exact.off() + longest.value() * 1e-15
        };
        for way in [times.s_stop * share, times.s_tau * share] {
            let (plain, exact) = (times.plainly_first(way), times.first(way));
            assert!(!differs(plain, exact, times.until_stop), "{plain} {exact:?}");
        }
        let way = times.s_tyre * share;
        let (plain, exact) = (times.plainly_last(way), times.last(way));
        assert!(!differs(plain, exact, times.until_stop), "{plain} {exact:?}");
    }
}

/// `r_b` of the text over the speed.
#[test]
fn braking_errs_by_no_more_than_a_few_roundings() {
    let mut random = Random::new(23);
    for _ in 0..4_000 {
        let speed =
            [5e-324, 1e-200, 1e-6, 1e4][random.below(4) as usize] * random.number(1.0).abs();
        let a_b: f64 = [0.1, 8.0, 100.0][random.below(3) as usize];
        let a_tyre = a_b.max(11.5);
        let stops = speed / a_tyre;
        let all = [0.0, 1e-9, 60.0, 1e5, 0.5 * stops, stops, stops * (1.0 - 1e-15)];
        let seconds = all[random.below(7) as usize];
        let clock = Clock::new(&standing(0.0, Parameters { a_b, ..Parameters::default() }));
        let least = speed * [0.0, 1e-9, 0.5, 1.0][random.below(4) as usize];
        let at = MovingRectangle::cav(&standing(0.0, Parameters::default()).ego, [1.0, 0.0]);
        let plain = clock.braked(&Object { at, speed, least, age: seconds }, 0.0);
        let [t, w, least, a] = [seconds, speed, least, a_tyre].map(Real::new);
        let stops = least.over(a);
        let t = if t.certainly_below(stops) { t } else { stops };
        let half = Real::new(0.5) * t;
        let braked = |w: Real| t * least.over(w) - half * (a * t).over(w);
        let exact = if speed > 0.0 { braked(w) } else { Real::ZERO };
        let off = (Real::new(plain) - exact).magnitude();
        assert!(off <= 1e-270 + exact.off() + exact.value() * 1e-15, "{plain} {exact:?}");
    }
}
