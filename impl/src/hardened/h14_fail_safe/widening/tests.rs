//! The widening against the text, in numbers with error bounds.

use crate::hardened::h14_fail_safe::nodes::Nodes;
use crate::hardened::h14_fail_safe::path::Path;
use crate::hardened::h14_fail_safe::spot::tests::standing;
use crate::hardened::h14_fail_safe::widening::wider_by;
use crate::input::cycle::{Cycle, Ego, TrajectoryPoint};
use crate::input::parameters::Parameters;
use crate::numbers::plane::Vector;
use crate::numbers::rounding::Real;
use crate::random::Random;
use crate::stages::llcc::Pose;

fn point([x, y]: [f64; 2], turned: f64) -> TrajectoryPoint {
    TrajectoryPoint { t_ns: 0, x, y, cos: libm::cos(turned), sin: libm::sin(turned) }
}

fn widened(speed: f64, places: &[[f64; 2]], turned: f64) -> f64 {
    let points: [TrajectoryPoint; 4] = core::array::from_fn(|index| {
        let place = places.get(index).or(places.last()).copied().unwrap_or_default();
        point(place, if index == 0 { turned } else { 0.0 })
    });
    let points = points.get(..places.len()).unwrap_or(&[]);
    wider_by(&standing(speed, Parameters::default()), points)
}

/// F-59: the first heading turns the trajectory towards the CAV, or points behind the CAV lead away from it.
#[test]
fn neither_the_first_heading_nor_points_behind_hide_that_the_trajectory_is_beside() {
    for (places, turned) in [
        (&[[-2.65, -0.45], [-1.15, -0.45], [0.35, -0.45]][..], 0.168),
        (&[[-2.65, 0.0], [-1.15, -0.225], [-0.5, -0.45], [0.35, -0.45]], 0.0),
        (&[[-2.65, 0.0], [0.0, -0.45], [0.5, -0.3]], 0.0),
        (&[[-2.65, 0.1], [0.0, -0.45]], 0.0),
    ] {
        let aside = widened(15.0, places, turned);
        assert!((0.45..0.45 + 4e-9).contains(&aside), "{aside}: {places:?}");
    }
    let tyres = |f: f64| f * f * 5.75 / (15.0 - 8.0 * f / 15.0) / (15.0 - 8.0 * f / 15.0);
    for (speed, places, expected) in [
        // What tyres do not come to: a point behind, a node, and a place before one.
        (15.0, &[[-1.0, 0.4], [3.0, 0.0]][..], 0.4 - tyres(1.0)),
        (15.0, &[[-1.0, 0.0], [0.25, 0.4]], 0.4 - tyres(0.25)),
        (15.0, &[[-1.0, 0.0], [3.0, 0.4]], 0.8 / 3.0 - tyres(2.0)),
        (15.0, &[[0.0, 0.0], [2.0, 0.0], [5.0, 3.0]], 3.0 - tyres(5.0)),
        // To and fro on the spot.
        (3.0, &[[0.13, 0.0], [0.13, 0.6], [0.13, 0.0], [0.5, 0.0]], 0.6 - 0.13 * 0.13 / 6.0),
        // As far as a CAV that stands can come in tau.
        (0.0, &[[1.0, 0.5], [1.5, 2.0]], 0.5 * 0.020_625 - 0.020_625 * 0.020_625 / 6.0),
        // Points behind, as the CAV may have come.
        (0.0, &[[-1.5, 0.5], [-1.0, 0.5], [0.0, 0.0]], 0.5 - 1.0 / 6.0),
    ] {
        let aside = widened(speed, places, 0.0);
        assert!((aside - expected).abs() < 4e-9, "{aside}, not {expected}: {places:?}");
    }
    assert!(widened(15.0, &[[0.0, 0.0], [1.0, 0.02], [4.0, 0.3]], 0.0) < 5e-3);
    assert!(widened(15.0, &[[0.0, 0.0], [1.0, 0.0], [4.0, 0.0]], 0.0).to_bits() == 0);
}

/// In the text's words, of the places that the path has.
fn by_the_text(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> Real {
    let Ego { x, y, cos, sin, speed, length, center_offset, .. } = cycle.ego;
    let [cos, sin, v] = [cos, sin, speed].map(Real::new);
    let seen = |[dx, dy]: [Real; 2]| [dx * cos + dy * sin, dx * sin - dy * cos];
    let of = |it: &TrajectoryPoint| seen([Real::difference(it.x, x), Real::difference(it.y, y)]);
    let nodes = Nodes::new(cycle, points);
    let others = nodes.others(points);
    let radius = |f: Real| {
        if speed <= 0.0 {
            return Real::new(3.0);
        }
        let u = v - (Real::new(cycle.parameters.a_b) * f).over(v);
        let tyres = u.max(v * Real::new(0.5)).squared().over(Real::new(11.5));
        tyres.max(Real::new(3.0))
    };
    let aside = |[f, a]: [Real; 2]| {
        let f = f.abs();
        a.abs() - f.squared().over(radius(f) + radius(f))
    };
    let mut most = match (others.last().map(of), nodes.points.first().map(of)) {
        (Some([f_y, a_y]), Some([f_z, a_z])) if f_y.value() <= 0.0 => {
            (a_y * f_z - a_z * f_y).abs().over(f_z - f_y)
        }
        _ => Real::ZERO,
    };
    for it in others {
        most = most.max(aside(of(it)));
    }
    for piece in Path::new(nodes).pieces() {
        for k in (0..piece.count()).filter(|&k| piece.first + k > 0) {
            let Pose { at, heading: [to_x, to_y] } = piece.place(k).pose;
            let at = at - Vector::new(x, y);
            let seen_at = seen([at.x, at.y]);
            let sine = (cos * Real::new(to_y) - sin * Real::new(to_x)).abs();
            let turned = sine - seen_at[0].abs().over(radius(seen_at[0].abs()));
            let swung = turned * (Real::new(center_offset.abs()) + Real::new(0.5 * length));
            most = most.max(aside(seen_at)).max(swung);
        }
    }
    most
}

#[test]
fn the_widening_is_that_of_the_text_and_never_less() {
    let (mut random, mut wide, mut swung) = (Random::new(59), 0, 0);
    for _ in 0..20_000 {
        let speed = [-0.0, 5.87, 10.0, 30.0][random.below(4) as usize] * random.number(1.0).abs();
        let turned = random.number(3.2);
        let at = [0.0, 1e3, 1.6e7][random.below(3) as usize];
        let cycle = standing(speed, Parameters::default());
        let (cos, sin) = (libm::cos(turned), libm::sin(turned));
        let center_offset = random.number(1.5);
        let ego = Ego { x: at, y: -at, cos, sin, center_offset, ..cycle.ego };
        let cycle = Cycle { ego, ..cycle };
        let aside = [0.02, 0.5][random.below(2) as usize];
        let wave = [0.0, 0.01, 0.3][random.below(3) as usize];
        let points: [TrajectoryPoint; 8] = core::array::from_fn(|index| {
            let f = f64::from(u8::try_from(index).unwrap_or(0)) * (0.2 + speed * 0.05)
                - random.number(1.0).abs() * 3.0;
            let a = random.number(aside) + f * random.number(aside / 5.0);
            let place = [at + f * cos - a * sin, -at + f * sin + a * cos];
            point(place, turned + random.number(wave))
        });
        let (made, text) = (wider_by(&cycle, &points), by_the_text(&cycle, &points));
        let more = (Real::new(made) - text).value();
        assert!(-1e-24 * at.max(1.0) <= more && more < 4e-9, "{more}: {cycle:?} {points:?}");
        wide += i32::from(text.value() > 0.1);
        let straight = points.map(|it| TrajectoryPoint { cos, sin, ..it });
        swung += i32::from(by_the_text(&cycle, &straight).value() + 0.1 < text.value());
    }
    assert!((4_000..19_000).contains(&wide), "{wide}");
    assert!(swung > 1_000, "{swung}");
}
