//! `spec/hardened/H-14.md#requirements-windows`

use mufasa_model::hardened::h04_gap::s_react;
use mufasa_model::hardened::h14_fail_safe::times::{Driving, a_tyre, window};
use mufasa_model::numbers::reading::Comparisons;
use mufasa_model::numbers::real::Real;
use mufasa_model::report::Reading;

fn r(value: f64) -> Real {
    Real::from_double(value)
}

/// 2 m/s faster after half a second.
fn with<T>(v: f64, judge: impl FnOnce(&Driving) -> T) -> T {
    let [v, tau, a_max, a_b] = [v, 0.5, 4.0, 8.0].map(r);
    judge(&Driving { v: &v, tau: &tau, a_max: &a_max, a_b: &a_b })
}

/// The formulas against values worked out by hand.
/// H-14.10.
#[test]
fn times_and_distances_are_the_formulas() {
    with(8.0, |driving| {
        assert_eq!([driving.v_tau(), driving.s_tau()], [10.0, 4.5].map(r));
        assert_eq!([driving.s_stop(), driving.t_stop()], [4.5 + 100.0 / 16.0, 1.75].map(r));
        assert_eq!(driving.s_b(), r(4.0));
        // 64 + 8 f is 81 and 100; then 100 - 16 (f - 4.5) is 36 and 0, and less than 0 beyond.
        let first = [0.0, 17.0 / 8.0, 4.5, 8.5, 10.75, 11.0].map(|f| driving.first(&r(f)));
        assert_eq!(first, [0.0, 0.25, 0.5, 1.0, 1.75, 1.75].map(r));
    });
}

/// H-14.10, H-04: `a_tyre` is 11.5 m/s^2, or `a_b` where that is more.
#[test]
fn no_vehicle_brakes_harder_than_tyres_hold() {
    assert_eq!([8.0, 11.5, 20.0].map(|a_b| a_tyre(&r(a_b))), [11.5, 11.5, 20.0].map(r));
    with(11.5, |driving| {
        assert_eq!(driving.s_tyre(driving.v), r(5.75));
        // 132.25 - 23 f is 11.5^2, 5.75^2, 0.
        let last = [0.0, 4.3125, 5.75, 6.0].map(|f| driving.last(&r(f)));
        assert_eq!(last, [0.0, 0.5, 1.0, 1.0].map(r));
    });
    // s_stop = 10.75 m; 5.75 m and 23 m less.
    with(8.0, |driving| {
        assert_eq!([11.5, 23.0].map(|w| s_react(driving, &r(w))), [5.0, 0.0].map(r));
    });
}

#[test]
fn a_cav_that_stands_may_stand_at_once() {
    let [v, tau, a_max, a_b] = [0.0, 0.0, 4.0, 8.0].map(r);
    let driving = Driving { v: &v, tau: &tau, a_max: &a_max, a_b: &a_b };
    assert_eq!([driving.s_stop(), driving.t_stop(), driving.s_b()], [0.0; 3].map(r));
    assert_eq!(driving.first(&Real::zero()), Real::zero());
}

/// H-14.11, H-14.12, H-14.13: from first(least progress around) to last(length after); without an end
/// from s_tyre(v) on, as the reading moves it, and at the last place.
#[test]
fn windows_reach_from_the_place_before_to_the_place_after() {
    with(11.5, |driving| {
        let end = |reading: Reading, length_after: Option<f64>| {
            let reads = Comparisons::new(reading, r(1e-6));
            let window = window(&reads, driving, &r(3.0), length_after.map(r).as_ref());
            assert_eq!(window.begin, r(0.25));
            window.end
        };
        let exact = Reading::Exact;
        assert_eq!([end(exact, Some(4.3125)), end(exact, None)], [Some(r(0.5)), None]);
        assert!(end(exact, Some(5.75f64.next_down())).is_some());
        assert_eq!(end(exact, Some(5.75)), None);
        let stands = |length: f64| {
            let of = |reading| end(reading, Some(length)).is_none();
            [Reading::Strict, exact, Reading::Lax].map(of)
        };
        assert_eq!(stands(5.75 - 2e-6), [false; 3]);
        assert_eq!(stands(5.75 - 0.5e-6), [true, false, false]);
        assert_eq!(stands(5.75 + 0.5e-6), [true, true, false]);
        assert_eq!(stands(5.75 + 2e-6), [true; 3]);
    });
}
