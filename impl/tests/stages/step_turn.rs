//! How far a single step may turn, on both sides of the bounds (H-11 of
//! `spec/hardened/H-11.md`).

use crate::scene::{NOW_NS, scene};
use mufasa::input::cycle::TrajectoryPoint;
use mufasa::input::profile::Profile;
use mufasa::report::{Rule, Witness};
use mufasa::services::configuration::Configuration::MotRemote;

/// A point at this time in s, place and heading.
fn point((t, x, y, sin): (f64, f64, f64, f64)) -> TrajectoryPoint {
    let t_ns = NOW_NS + (t * 1e9).round() as i64;
    TrajectoryPoint { t_ns, x, y, cos: (1.0 - sin * sin).sqrt(), sin }
}

/// A CAV that drives 1 m in 0.2 s, moves by this in a step of so many s that turns by this sine, and
/// stands.
fn turning_in_a_step(sin: f64, dt: f64, [x, y]: [f64; 2]) -> Option<Witness> {
    let mut scene = scene(Profile::HARDENED, MotRemote, [0.0, 0.0]);
    (scene.ego.speed, scene.parameters.start_tolerance) = (0.0, 5.0);
    let straight = [(0.0, 0.0, 0.0, 0.0), (0.2, 1.0, 0.0, 0.0)];
    let turned = (0..5).map(|i| (0.2 + dt + 0.1 * f64::from(i), 1.0 + x, y, sin));
    scene.points = straight.into_iter().chain(turned).map(point).collect();
    scene.failure().map(|(_, witness)| witness)
}

/// 0.1, 0.1 for each s, and 0.5 for each m, forward or aside.
#[test]
fn no_vehicle_turns_on_the_spot_in_a_step() {
    for (dt, u, most) in [
        (0.001, [0.0, 0.0], 0.1001),
        (0.1, [0.0, 0.0], 0.11),
        (0.2, [0.0, 0.0], 0.12),
        (0.1, [0.3, 0.0], 0.26),
        (0.1, [0.12, 0.05], 0.175),
    ] {
        for side in [1.0, -1.0] {
            let turned = |sin: f64| turning_in_a_step(side * sin, dt, [u[0], side * u[1]]);
            assert_eq!(turned(most - 1e-7).map(|it| it.rule), None, "{dt} {u:?}");
            let witness = turned(most + 1e-7).expect("a turn on the spot");
            assert_eq!((witness.rule, witness.point), (Rule::StepTurn, Some(2)), "{dt} {u:?}");
            assert_eq!(witness.compared.map(rounded), [most + 1e-7, most].map(rounded));
        }
    }
}

/// However long the step is; where it turns on the spot, too, the witness shows the cosine.
#[test]
fn no_step_turns_by_30_degrees() {
    let turned = |cos: f64, x: f64| turning_in_a_step((1.0 - cos * cos).sqrt(), 0.1, [x, 0.2 * x]);
    assert_eq!(turned(0.866 + 1e-7, 1.0).map(|it| it.rule), None);
    for x in [1.0, 0.0] {
        let witness = turned(0.866 - 1e-7, x).expect("a turn by 30 degrees");
        assert_eq!((witness.rule, witness.point), (Rule::StepTurn, Some(2)), "{x}");
        assert_eq!(witness.compared.map(rounded), [0.866 - 1e-7, 0.866].map(rounded), "{x}");
    }
}

/// To 1e-9.
fn rounded(value: f64) -> i64 {
    (value * 1e9).round() as i64
}
