//! Plain doubles are right where they decide, and decide what is not close, by the error bounds of
//! `rectangle` and of `Times`.

use super::{FINE, Spot};
use crate::hardened::h14_fail_safe::times::Times;
use crate::input::cycle::{Cycle, Ego, Route};
use crate::input::parameters::Parameters;
use crate::input::profile::Profile;
use crate::numbers::rectangle::{Rectangle, certainly_touch, possibly_swept, possibly_touch};
use crate::numbers::rounding::Real;
use crate::random::Random;
use crate::services::configuration::Configuration;
use crate::stages::llcc::sweep::{MARGIN, MovingRectangle};
use crate::stages::llcc::vector;

fn rectangle(it: &MovingRectangle, more: f64) -> Rectangle {
    let [length, width] = it.size.map(|size| size + 2.0 * more);
    Rectangle { centre: vector(it.centre), direction: vector(it.direction), length, width }
}

/// At a tiny distance from the CAV, or anywhere.
fn pair(random: &mut Random) -> [MovingRectangle; 2] {
    let far = [0.0, 1e3, 1e6][random.below(3) as usize];
    let mut one = |size: [f64; 2]| MovingRectangle {
        centre: [random.number(6.0) + far, random.number(6.0) - far],
        direction: random.direction(),
        velocity: [0.0; 2],
        size,
    };
    let (cav, mut object) = (one([4.8, 1.9]), one([4.0, 1.8]));
    if random.below(2) > 0 {
        // Beside it, with or without a gap.
        let ([cos, sin], [x, y]) = (cav.direction, cav.centre);
        let half: f64 = [0.95 + 0.9, 2.4 + 2.0][random.below(2) as usize];
        let (half, along) = (half + [0.0, 1e-9, 1e-6, 1e-2][random.below(4) as usize], 1.85 > half);
        object.direction = cav.direction;
        object.centre =
            if along { [x - half * sin, y + half * cos] } else { [x + half * cos, y + half * sin] };
    }
    [cav, object]
}

#[test]
fn what_is_apart_is_told_to_be_and_nothing_else() {
    let mut random = Random::new(21);
    let (mut missed, mut clear, mut close) = (0, 0, 0);
    for _ in 0..40_000 {
        let [cav, object] = pair(&mut random);
        let speed = [0.0, 5e-324, 1e-9, 1.0, 1e3][random.below(5) as usize];
        let moved = random.direction().map(|it| it * speed);
        let spot = Spot { cav };
        let sweeps =
            |more| possibly_swept(&rectangle(&cav, more), &rectangle(&object, 0.0), vector(moved));
        let is_apart = spot.is_apart(&object, moved, MARGIN);
        assert!(!(is_apart && sweeps(0.0)), "{cav:?} {object:?} {moved:?}");
        assert!(is_apart || sweeps(0.01), "{cav:?} {object:?} {moved:?}");
        missed += u32::from(is_apart);
        close += u32::from(!is_apart && !sweeps(0.0));
        let exact = rectangle(&object, 0.0);
        match spot.is_clear_of(&object) {
            Some(true) => assert!(!possibly_touch(&rectangle(&cav, 0.0), &exact), "{object:?}"),
            Some(false) => assert!(certainly_touch(&rectangle(&cav, 1e-8), &exact), "{object:?}"),
            None => assert!(cav.centre[0] > 1e5),
        }
        clear += u32::from(spot.is_clear_of(&object) == Some(true));
    }
    assert!(missed > 4_000 && clear > 4_000 && close > 100, "{missed} {clear} {close}");
    const { assert!(FINE < 0.5e-8) };
}

fn standing(speed: f64, parameters: Parameters) -> Cycle<'static> {
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
fn times_err_by_less_than_a_millionth() {
    let mut random = Random::new(22);
    for _ in 0..4_000 {
        let speed = [0.0, 5e-324, 1e-6, random.number(75.0) + 75.0][random.below(4) as usize];
        let [a_b, tau, a_max] = [[0.1, 8.0, 100.0], [0.0, 0.1, 60.0], [0.1, 3.0, 100.0]]
            .map(|values| values[random.below(3) as usize]);
        let parameters = Parameters { a_b, tau, a_max, ..Parameters::default() };
        let times = Times::<Real>::new(&standing(speed, parameters));
        let share = [0.0, 1e-300, 1e-9, 0.3, 1.0 - 1e-9, 1.0 - 1e-16, 1.0];
        let share = Real::new(share[random.below(7) as usize]);
        let differs = |plain: f64, exact: Real, longest: Real| {
            let off = (Real::new(plain) - exact).magnitude();
            off > 1e-6 + exact.off() + longest.value() * 1e-14
        };
        for way in [times.s_stop * share, times.s_tau * share] {
            let (plain, exact) = (times.plainly_first(way), times.first(way));
            assert!(!differs(plain, exact, times.until_stop), "{plain} {exact:?}");
        }
        let way = times.s_b * share;
        let (plain, exact) = (times.plainly_last(way), times.last(way));
        assert!(!differs(plain, exact, times.until_stop), "{plain} {exact:?}");
    }
}
