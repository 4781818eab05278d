//! The excess of `spec/hardened/H-14.md#requirements-reach`: its value, and each part on both sides of
//! lateral_tolerance.

use mufasa_model::hardened::h14_fail_safe::excess::{of_place, of_point};
use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_model::input::profile::HardenedRule;
use mufasa_model::numbers::real::Real;
use mufasa_model::numbers::vector::{Frame, Vector};
use mufasa_model::report::{Reading, Rule};
use mufasa_model::services::configuration::Configuration::PlanRemote;

use super::reach::leads;
use super::scene;
use super::widening::{found, witness};
use crate::base::*;
use crate::near::*;

fn share(n: i128, of: i128) -> Real {
    Real::from_integer(n) / Real::from_integer(of)
}

/// The excess of the point f ahead and a aside of a CAV at v m/s. Behind it and on the other side it is the same, and
/// of a place with the heading of the CAV, too.
fn is_beyond(v: f64, f: f64, a: f64, expected: &Real) {
    let mut cycle = base(Profile::HARDENED, PlanRemote);
    (cycle.ego.cos, cycle.ego.sin, cycle.ego.speed) = (0.0, 1.0, v);
    let scene = scene(&cycle, Reading::Exact);
    for [f, a] in [[f, a], [-f, a], [f, -a], [-f, -a]] {
        let x = Vector::from_doubles(a, f);
        assert_eq!(&of_point(&scene, &x), expected, "{v} {f} {a}");
        let place = Frame { origin: x, direction: scene.ego.heading.clone() };
        assert_eq!(&of_place(&scene, &place), expected, "{v} {f} {a}");
    }
}

/// u = v - 8 f/v up to f = v^2/16, v/2 from there on; R = u^2 / (11.5 m/s^2) where that is above 3 m, else 3 m.
/// H-14.64.
#[test]
fn the_excess_is_beyond_the_smallest_circle() {
    is_beyond(5.0, 0.5, 0.5, &share(11, 24));
    is_beyond(0.0, 0.75, 0.5, &share(13, 32));
    // u = 11.5 and R = 11.5.
    is_beyond(12.5, 1.5625, 0.5, &share(2319, 5888));
    is_beyond(23.0, 33.0625, 48.027_343_75, &share(1, 2));
    is_beyond(23.0, 46.0, 92.5, &share(1, 2));
}

/// Its front is 2 m + abs(center_offset) ahead: on a line turned by 3/5, less f/3.
/// H-14.64.
#[test]
fn the_excess_is_the_swing_of_front_or_rear() {
    let of = |center_offset: f64, sin: f64, [f, a]: [f64; 2]| {
        let mut cycle = base(Profile::HARDENED, PlanRemote);
        (cycle.ego.speed, cycle.ego.center_offset) = (5.0, center_offset);
        let direction = Vector { x: share(4, 5), y: Real::from_double(sin) };
        let place = Frame { origin: Vector::from_doubles(f, a), direction };
        of_place(&scene(&cycle, Reading::Exact), &place)
    };
    for sin in [0.625, -0.625] {
        for f in [0.75, -0.75] {
            let all = [0.0, 1.0, -1.0].map(|center_offset| of(center_offset, sin, [f, 0.0]));
            assert_eq!(all, [share(6, 8), share(9, 8), share(9, 8)], "{sin} {f}");
        }
    }
    // The greater of both: 29/32 m aside.
    assert_eq!(of(0.0, 0.625, [0.75, 1.0]), share(29, 32));
}

const NO_STEPS: Profile = Profile::HARDENED.without(HardenedRule::H11);

/// A CAV at v m/s on a trajectory through these points, which look along x; lateral_tolerance is 1/4 m.
fn path(c: &mut Cycle, v: f64, places: &[[f64; 2]]) {
    let poses: Vec<[f64; 4]> = places.iter().map(|[x, y]| [*x, *y, 1.0, 0.0]).collect();
    *c = leads(v, &poses);
    c.parameters.lateral_tolerance = 0.25;
}

/// A node 1/2 m ahead, of a CAV that turns with 3 m radius, turned so that front or rear swing `beyond` m farther.
fn turned(c: &mut Cycle, center_offset: f64, side: f64, beyond: f64) {
    let sin = 0.5 / 3.0 + beyond / (2.0 + center_offset.abs());
    let node = [0.5, 0.0, (1.0 - sin * sin).sqrt(), side * sin];
    *c = leads(5.0, &[[0.0, 0.0, 1.0, 0.0], node, [0.75, 0.0, 1.0, 0.0]]);
    (c.ego.center_offset, c.parameters.lateral_tolerance) = (center_offset, 0.25);
}

/// What tyres lead a CAV of 10 m/s aside within 1 m: u = 9.2 m/s.
const TYRES: f64 = 11.5 / (2.0 * 9.2 * 9.2);

/// Places at 1/4 m beyond reach.
const PLACES: &[Near] = &[
    ("circle of 3 m", PlanRemote, NO_STEPS, |c, e| {
        path(c, 5.0, &[[1.0, 0.25 + 1.0 / 6.0 + e]]);
    }),
    ("to the right", PlanRemote, NO_STEPS, |c, e| {
        path(c, 5.0, &[[1.0, -0.25 - 1.0 / 6.0 - e]]);
    }),
    ("tyres", PlanRemote, NO_STEPS, |c, e| path(c, 10.0, &[[1.0, 0.25 + TYRES + e]])),
    ("tyres, at a later node", PlanRemote, NO_STEPS, |c, e| {
        path(c, 10.0, &[[0.0, 0.0], [0.5, 0.0], [1.0, 0.25 + TYRES + e]]);
    }),
    ("u >= v/2", PlanRemote, NO_STEPS, |c, e| {
        // Braking at once it stands after 2.25 m; at 3 m u is 6 m/s.
        path(c, 12.0, &[[0.0, 0.0], [2.0, 0.0], [3.0, 0.25 + 9.0 * 11.5 / 72.0 + e]]);
        (c.parameters.a_b, c.parameters.tau) = (32.0, 0.1);
    }),
    ("v = 0", PlanRemote, NO_STEPS, |c, e| {
        path(c, 0.0, &[[1.0, 0.25 + 1.0 / 6.0 + e]]);
        c.parameters.tau = 1.0;
    }),
    ("a place farther back", PlanRemote, NO_STEPS, |c, e| {
        let back = [0.0625, 0.25 + 1.0 / 1536.0 + e];
        path(c, 5.0, &[[0.0, 0.0], [0.15625, 0.0], back, [0.5, 0.0], [1.5, 0.0]]);
        c.parameters.tau = 0.1;
    }),
    ("swing", PlanRemote, NO_STEPS, |c, e| turned(c, 0.0, 1.0, 0.25 + e)),
    ("swing of the front", PlanRemote, NO_STEPS, |c, e| turned(c, 1.0, -1.0, 0.25 + e)),
    ("swing of the rear", PlanRemote, NO_STEPS, |c, e| turned(c, -1.0, 1.0, 0.25 + e)),
];

/// Points that are no nodes; the trajectory passes through p, and where one is behind p it begins there.
const POINTS: &[Near] = &[
    ("beside p", PlanRemote, NO_STEPS, |c, e| {
        path(c, 5.0, &[[0.0, 0.0], [0.0, 0.25 + e], [0.0, 0.0], [1.0, 0.0]]);
    }),
    ("hardly ahead", PlanRemote, NO_STEPS, |c, e| {
        let point = [0.0625, -0.25 - 1.0 / 1536.0 - e];
        path(c, 5.0, &[[0.0, 0.0], point, [0.0, 0.0], [1.0, 0.0]]);
    }),
    ("behind", PlanRemote, NO_STEPS, |c, e| {
        path(c, 5.0, &[[-1.0, 0.25 + 1.0 / 6.0 + e], [0.0, 0.0], [1.0, 0.0]]);
    }),
    ("behind, tyres", PlanRemote, NO_STEPS, |c, e| {
        path(c, 10.0, &[[-1.0, -0.25 - TYRES - e], [0.0, 0.0], [1.0, 0.0]]);
    }),
    ("v = 0", PlanRemote, NO_STEPS, |c, e| {
        path(c, 0.0, &[[-1.0, 0.25 + 1.0 / 6.0 + e], [0.0, 0.0]]);
    }),
];

/// H-14.15, H-14.64, MARGIN-01.
#[test]
fn the_excess_of_a_place_is_at_most_lateral_tolerance() {
    margins_move_rules(PLACES, &[Rule::Reach; 10]);
}

/// H-14.15, H-14.64, MARGIN-01.
#[test]
fn the_excess_of_a_point_that_is_no_node_is_at_most_lateral_tolerance() {
    margins_move_rules(POINTS, &[Rule::Reach; 5]);
}

/// A place 1/16 m behind p has the excess of one ahead. Its path comes back in any case, which is asked after it.
/// H-14.15, H-14.64, H-14.68, MARGIN-01.
#[test]
fn a_place_behind_has_an_excess() {
    let [third, behind] = [3, 4 + 6].map(|point| Some(Some(point)));
    let at = |e: f64| {
        let mut cycle = base(NO_STEPS, PlanRemote);
        let back = [-0.0625, 0.25 + 1.0 / 1536.0 + e];
        path(&mut cycle, 5.0, &[[0.0, 0.0], [0.5, 0.0], [0.5, 0.0], back]);
        cycle.parameters.tau = 0.1;
        [Reading::Strict, Reading::Exact, Reading::Lax]
            .map(|reading| found(&cycle, reading).map(|it| it.1))
    };
    assert_eq!(at(-3e-6), [third; 3]);
    assert_eq!(at(-0.5e-6), [behind, third, third]);
    assert_eq!(at(0.5e-6), [behind, behind, third]);
    assert_eq!(at(3e-6), [behind; 3]);
}

/// The witness is at the first point that is no node, or else at the first place, and compares the excess with
/// lateral_tolerance; p is not asked, and H-14 alone asks it.
/// H-14.9, H-14.15.
#[test]
fn the_witness_is_the_first_point_beyond_reach() {
    // A turn on the spot: at 0.5 m it may be.
    let mut cycle = base(NO_STEPS, PlanRemote);
    for (point, i) in points(&mut cycle).iter_mut().zip(0u8..) {
        (point.x, point.y) = (0.0, f64::from(i) / 4.0);
    }
    points(&mut cycle).truncate(12);
    points(&mut cycle)[11].y = 0.0;
    assert_eq!(found(&cycle, Reading::Exact), Some(witness(Rule::Reach, 3, ["0.75", "0.5"])));
    // A node is a place: 3/4 m ahead 3/32 m aside are on the circle.
    let mut places = base(NO_STEPS, PlanRemote);
    path(&mut places, 5.0, &[[0.75, 0.59375], [1.5, 0.59375]]);
    (places.parameters.lateral_tolerance, places.parameters.delta) = (0.5, 1e-8);
    assert_eq!(found(&places, Reading::Exact), None);
    assert_eq!(found(&places, Reading::Strict), Some(witness(Rule::Reach, 2 + 3, ["0.5", "0.5"])));
    points(&mut places)[0].y = 0.625;
    assert_eq!(
        found(&places, Reading::Exact),
        Some(witness(Rule::Reach, 2 + 3, ["0.53125", "0.5"]))
    );
    places.profile = NO_STEPS.without(HardenedRule::H14);
    assert_eq!(found(&places, Reading::Strict), None);
}

/// Strictly a lateral_tolerance below m takes a point on the line along h for one beyond reach: at p its excess is 0.
/// MARGIN-01.
#[test]
fn a_lateral_tolerance_below_the_margin_is_too_small() {
    let mut cycle = base(NO_STEPS.without(HardenedRule::H07), PlanRemote);
    (cycle.parameters.lateral_tolerance, cycle.parameters.delta) = (1.0 / 128.0, 1.0 / 128.0);
    assert_eq!(found(&cycle, Reading::Strict), None);
    cycle.parameters.lateral_tolerance = 1.0 / 256.0;
    assert_eq!(found(&cycle, Reading::Strict), Some(witness(Rule::Reach, 0, ["0", "0.00390625"])));
    assert_eq!(found(&cycle, Reading::Exact), None);
}
