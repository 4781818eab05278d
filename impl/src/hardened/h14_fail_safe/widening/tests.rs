//! The widening against the text, in numbers with error bounds.

use crate::hardened::h14_fail_safe::spot::tests::standing;
use crate::hardened::h14_fail_safe::widening::wider_by;
use crate::input::cycle::{Cycle, Ego, TrajectoryPoint};
use crate::input::parameters::Parameters;
use crate::numbers::rounding::Real;
use crate::random::Random;

fn point([x, y]: [f64; 2], turned: f64) -> TrajectoryPoint {
    TrajectoryPoint { t_ns: 0, x, y, cos: libm::cos(turned), sin: libm::sin(turned) }
}

fn widened(speed: f64, places: &[[f64; 2]], turned: f64) -> f64 {
    let points: [TrajectoryPoint; 4] = core::array::from_fn(|index| {
        let place = places.get(index).or(places.last()).copied().unwrap_or_default();
        point(place, if index == 0 { turned } else { 0.0 })
    });
    let points = points.get(..places.len()).unwrap_or(&[]);
    wider_by(&standing(speed, Parameters::default()), points).magnitude()
}

/// F-59: the first heading turns the trajectory towards the CAV, or points behind the CAV lead away from it.
#[test]
fn neither_the_first_heading_nor_points_behind_hide_that_the_trajectory_is_beside() {
    for (places, turned) in [
        (&[[-2.65, -0.45], [-1.15, -0.45], [0.35, -0.45]][..], 0.168),
        (&[[-2.65, 0.0], [-1.15, -0.225], [-0.5, -0.45], [0.35, -0.45]], 0.0),
        (&[[-2.65, 0.0], [0.1, -0.45], [0.5, -0.3]], 0.0),
        (&[[0.125, 0.45], [1.0, 0.0]], 0.0),
    ] {
        let aside = widened(15.0, places, turned);
        assert!((0.45..0.45 + 1e-12).contains(&aside), "{aside}: {places:?}");
    }
    // On the way from y to z, and at points up to s_b(15) = 14.1 m that tyres do not come to.
    let tyres = |f: f64| f * f * 5.75 / (15.0 - 8.0 * f / 15.0) / (15.0 - 8.0 * f / 15.0);
    for (speed, places, expected) in [
        (15.0, &[[-1.0, 0.0], [3.0, 0.4]][..], 0.4 - tyres(3.0)),
        (15.0, &[[-1.0, 0.4], [3.0, 0.0]], 0.3),
        (15.0, &[[0.0, 0.0], [2.0, 0.0], [5.0, 3.0]], 3.0 - tyres(5.0)),
        (15.0, &[[0.0, 0.0], [14.0, 0.0], [14.1, 9.0]], 0.0),
        // Farther ahead than s_b.
        (8.0, &[[5.0, 5.0], [6.0, 9.0]], 5.0 - 25.0 / 6.0),
        (40.0, &[[150.0, 400.0]], 400.0 - 22_500.0 * 5.75 / 400.0),
        (0.0, &[[1.0, 0.5], [1.5, 2.0]], 0.5 - 1.0 / 6.0),
    ] {
        let aside = widened(speed, places, 0.0);
        assert!((aside - expected).abs() < 1e-11, "{aside}, not {expected}: {places:?}");
    }
    assert!(widened(15.0, &[[0.0, 0.0], [1.0, 0.02], [4.0, 0.3]], 0.0).to_bits() == 0);
}

/// In the text's words, of a list of points of which the first one ahead is known.
fn by_the_text(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> Real {
    let Ego { x, y, cos, sin, speed, .. } = cycle.ego;
    let [cos, sin, v] = [cos, sin, speed].map(Real::new);
    let seen = |it: &TrajectoryPoint| {
        let (dx, dy) = (Real::difference(it.x, x), Real::difference(it.y, y));
        [dx * cos + dy * sin, dx * sin - dy * cos]
    };
    let z = points.iter().position(|it| seen(it)[0].value() > 0.125);
    let least = Real::new(3.0);
    let radius = |f: Real| {
        if speed <= 0.0 {
            return least;
        }
        let u = v - (Real::new(cycle.parameters.a_b) * f).over(v);
        u.max(v * Real::new(0.5)).squared().over(Real::new(11.5)).max(least)
    };
    let s_b = v.squared().over(Real::new(2.0 * cycle.parameters.a_b));
    let passes = match z {
        None => points.first().map_or(Real::ZERO, |it| seen(it)[1].abs()),
        Some(0) => Real::ZERO,
        Some(z) => {
            let ([f_y, a_y], [f_z, a_z]) = (seen(&points[z - 1]), seen(&points[z]));
            let between = (a_y * f_z - a_z * f_y).abs().over(f_z - f_y);
            if f_y.value() > 0.0 { a_y.abs() } else { between }
        }
    };
    let mut most = passes;
    let (mut length, mut node, mut heading) = (Real::ZERO, [Real::ZERO; 2], [cos, sin]);
    for (index, it) in z.map_or(&[][..], |z| &points[z..]).iter().enumerate() {
        let to = [Real::difference(it.x, x), Real::difference(it.y, y)];
        let u = [to[0] - node[0], to[1] - node[1]];
        let [along, across] =
            [u[0] * heading[0] + u[1] * heading[1], u[0] * heading[1] - u[1] * heading[0]];
        length = length + along.abs() + across.abs();
        (node, heading) = (to, [it.cos, it.sin].map(Real::new));
        if index > 0 && length.value() >= s_b.value() {
            continue;
        }
        let [f, a] = seen(it);
        let f = f.max(Real::ZERO);
        let can = f.squared().over(radius(f) + radius(f));
        most = most.max(a.abs() - can);
    }
    most
}

#[test]
fn the_widening_is_that_of_the_text_and_never_less() {
    let (mut random, mut wide) = (Random::new(59), 0);
    for _ in 0..20_000 {
        let speed = [0.0, 5.87, 40.0, 150.0][random.below(4) as usize] * random.number(1.0).abs();
        let turned = random.number(3.2);
        let at = [0.0, 1e3, 1.6e7][random.below(3) as usize];
        let cycle = standing(speed, Parameters::default());
        let (cos, sin) = (libm::cos(turned), libm::sin(turned));
        let ego = Ego { x: at, y: -at, cos, sin, ..cycle.ego };
        let cycle = Cycle { ego, ..cycle };
        let aside = [0.02, 0.5][random.below(2) as usize];
        let points: [TrajectoryPoint; 8] = core::array::from_fn(|index| {
            let f = f64::from(u8::try_from(index).unwrap_or(0)) * (0.2 + speed * 0.05)
                - random.number(1.0).abs() * 3.0;
            let a = random.number(aside) + f * random.number(aside / 5.0);
            point([at + f * cos - a * sin, -at + f * sin + a * cos], 0.0)
        });
        let (made, text) = (wider_by(&cycle, &points), by_the_text(&cycle, &points));
        let more = (made - text).value();
        assert!(-1e-24 * at.max(1.0) <= more && more < 1e-12, "{more}: {cycle:?} {points:?}");
        wide += i32::from(text.value() > 0.1);
    }
    assert!((4_000..19_000).contains(&wide), "{wide}");
}
