//! How far a trajectory may lag behind a CAV that brakes at `a_b`, on both sides of the bound (H-12 of
//! `spec/3-stages.md#hardened-profile`, `findings/F-40.md`).

use crate::scene::{NOW_NS, scene};
use mufasa::input::cycle::TrajectoryPoint;
use mufasa::input::profile::Profile::Hardened;
use mufasa::report::{Rule, Witness};
use mufasa::services::configuration::Configuration::MotRemote;

/// Nearer to the bound than plain doubles are asked, and farther.
const OFF: [f64; 2] = [1e-7, 1e-5];

/// The last of the points, at 0.7 s.
const LAST: usize = 7;

/// Where a CAV that brakes at 8 m/s^2 from `v_lo`, 5 m/s or less, is after each 0.1 s: before `LAST`
/// it stands.
fn braking(v_lo: f64) -> impl Fn(usize) -> f64 {
    move |i| {
        let t = (0.1 * i as f64).min(v_lo / 8.0);
        v_lo * t - 4.0 * t * t
    }
}

/// What is wrong with points at these places, the first so much later than now.
fn judged(
    [start_tolerance, lag_tolerance]: [f64; 2],
    shift_ns: i64,
    at: impl Fn(usize) -> f64,
) -> Option<Witness> {
    let mut scene = scene(Hardened, MotRemote, [0.0, 0.0]);
    (scene.parameters.start_tolerance, scene.parameters.lag_tolerance) =
        (start_tolerance, lag_tolerance);
    let times = (0..).map(|i| NOW_NS + shift_ns + 100_000_000 * i);
    let point = |(t_ns, x)| TrajectoryPoint { t_ns, x, y: 0.0, cos: 1.0, sin: 0.0 };
    scene.points = times.zip((0..=LAST).map(at)).map(point).collect();
    scene.failure().map(|(_, witness)| witness)
}

#[test]
fn the_default_is_half_a_metre() {
    let parameters = scene(Hardened, MotRemote, [0.0, 0.0]).parameters;
    let tolerances = [parameters.start_tolerance, parameters.lag_tolerance];
    let b = braking(5.0);
    for off in OFF {
        assert_eq!(judged(tolerances, 0, |i| (b(i) - 0.5 + off).max(0.0)), None);
        let witness = judged(tolerances, 0, |i| (b(i) - 0.5 - off).max(0.0)).expect("a lag");
        assert_eq!((witness.rule, witness.point), (Rule::ArcTooShort, Some(2)));
    }
}

/// Whatever `start_tolerance` is: less, the same or more.
#[test]
fn a_trajectory_lags_no_farther_than_its_tolerance() {
    // The speed at the first point is at least v_lo: 50 ms of a_max or a_b less than 5 m/s.
    for (shift_ns, v_lo) in [(0, 5.0), (-50_000_000, 4.85), (50_000_000, 4.6)] {
        let b = braking(v_lo);
        // The first point that is to have moved is 1, or after 0.5 m 2.
        for (lag, first) in [(1e-3, 1), (0.05, 1), (0.2, 1), (0.5, 2)] {
            for start in [1e-3, 0.2, 2.0, 1e3] {
                for off in OFF {
                    let lagging =
                        |off: f64| judged([start, lag], shift_ns, |i| (b(i) - lag + off).max(0.0));
                    assert_eq!(lagging(off), None, "{shift_ns} {lag} {start}");
                    let witness = lagging(-off).expect("a lag");
                    let found = (witness.rule, witness.point);
                    let expected = (Rule::ArcTooShort, Some(first));
                    assert_eq!(found, expected, "{shift_ns} {lag} {start}");
                }
            }
        }
    }
}

/// After braking harder than `a_b`, only the last point lags so far.
#[test]
fn a_trajectory_stands_no_farther_back_than_its_tolerance() {
    let b = braking(5.0);
    for lag in [0.05, 0.2, 0.5] {
        for start in [1e-3, 2.0, 1e3] {
            for off in OFF {
                let standing =
                    |off: f64| judged([start, lag], 0, |i| b(i).min(b(LAST) - lag + off));
                assert_eq!(standing(off), None, "{lag} {start}");
                let witness = standing(-off).expect("a lag");
                let found = (witness.rule, witness.point);
                assert_eq!(found, (Rule::ArcTooShort, Some(LAST)), "{lag} {start}");
            }
        }
    }
}
