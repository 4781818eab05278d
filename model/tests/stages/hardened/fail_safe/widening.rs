//! The widening of `spec/hardened/H-14.md#requirements-the-cav`, and what asks it.

use mufasa_model::cycle::check;
use mufasa_model::hardened::h14_fail_safe::widening::{passing_distance, wider_by};
use mufasa_model::input::cycle::{Cycle, Profile, Trajectory, TrajectoryPoint};
use mufasa_model::numbers::real::Real;
use mufasa_model::report::{Outcome, Reading, Rule, Stage};
use mufasa_model::services::configuration::Configuration::PlanRemote;

use super::following::{READINGS, beside, keeps_beside, moves_by_m, sagitta};
use super::scene;
use crate::base::*;
use crate::near::{NEAR_SAFE, YES, points, safe};

/// The CAV at the origin at `v` m/s looks along x; the trajectory leads through these points.
fn cycle(v: f64, places: &[[f64; 2]]) -> Cycle {
    let mut cycle = base(Profile::HARDENED, PlanRemote);
    cycle.ego.speed = v;
    let point = |(i, [x, y]): (i64, &[f64; 2])| at_time(i * 100_000_000, *x, *y);
    let points = (0..).zip(places).map(point).collect();
    cycle.trajectory = Some(Trajectory { stamp_ns: NOW, points });
    cycle
}

/// The widening in the readings strict, exact, lax.
fn widenings(cycle: &Cycle) -> [Real; 3] {
    READINGS.map(|reading| {
        let scene = scene(cycle, reading);
        wider_by(&scene, scene.trajectory.as_ref().expect("it is current"))
    })
}

fn share(n: i128, of: i128) -> Real {
    Real::from_integer(n) / Real::from_integer(of)
}

/// The widening of a trajectory, the same in all readings; to the other side and turned it is the same.
fn is_wider_by(v: f64, places: &[[f64; 2]], expected: &Real) {
    let mirrored: Vec<[f64; 2]> = places.iter().map(|[x, y]| [*x, -y]).collect();
    let mut turned = cycle(v, &places.iter().map(|[x, y]| [-y, *x]).collect::<Vec<_>>());
    (turned.ego.cos, turned.ego.sin) = (0.0, 1.0);
    points(&mut turned).iter_mut().for_each(|point| (point.cos, point.sin) = (0.0, 1.0));
    for cycle in [cycle(v, places), cycle(v, &mirrored), turned] {
        for found in widenings(&cycle) {
            assert_eq!(&found, expected, "{v} {places:?}");
        }
    }
}

/// The distance at which a trajectory passes p; to the other side it is the same.
fn passes_at(v: f64, places: &[[f64; 2]], expected: &Real) {
    let mirrored: Vec<[f64; 2]> = places.iter().map(|[x, y]| [*x, -y]).collect();
    for cycle in [cycle(v, places), cycle(v, &mirrored)] {
        let scene = scene(&cycle, Reading::Exact);
        let trajectory = scene.trajectory.as_ref().expect("it is current");
        assert_eq!(&passing_distance(&scene, trajectory), expected, "{v} {places:?}");
    }
}

/// A CAV 0.45 m beside a straight plan that begins 2.65 m behind it, the first heading turned by 0.168.
fn beside_its_plan() -> Cycle {
    let mut cycle = base(Profile::HARDENED, PlanRemote);
    (cycle.ego.y, cycle.parameters.start_tolerance) = (0.45, 3.0);
    let points = points(&mut cycle);
    points.iter_mut().for_each(|point| point.x -= 2.65);
    (points[0].cos, points[0].sin) = ((1.0 - 0.168f64 * 0.168).sqrt(), 0.168);
    cycle
}

/// A car 0.2 m before the CAV overlaps its front by 0.4 m, and is 5 cm beside the plan.
/// H-14.26, H-14.64, H-14.65, H-07.5.
#[test]
fn a_turned_first_heading_hides_nothing() {
    let mut cycle = beside_its_plan();
    assert_eq!(widenings(&cycle), [0.45; 3].map(Real::from_double));
    assert_eq!(safe(&cycle), YES);
    (cycle.tracks, cycle.detections) = (None, detections(vec![detection(4.2, 2.05)]));
    assert_eq!(rule(&cycle, Stage::Iv), Some(Rule::FailSafe));
    cycle.parameters.lateral_tolerance = 0.449;
    assert_eq!(rule(&cycle, Stage::Ii), Some(Rule::StartOffset));
}

/// Between y and z on the line through both; points before y say nothing.
/// H-14.65.
#[test]
fn the_trajectory_passes_between_two_points() {
    // On the line from (-1, 0.25) to (3, 1.25) it is 0.5 m aside at p.
    passes_at(5.0, &[[-1.0, 0.25], [3.0, 1.25]], &share(1, 2));
    passes_at(5.0, &[[-0.25, -0.25], [0.5, 0.5]], &Real::zero());
    // In the form of an S: its first point is on the line through p, and so is what comes after it.
    let s = [[-2.0, 0.0], [-1.5, -0.5], [-1.0, 0.25], [-0.25, 0.5], [0.5, 0.5], [2.0, 0.0]];
    passes_at(5.0, &s, &share(1, 2));
    let far = [[-2.0, 3.0], [-1.0, -3.0], [-0.5, 0.0], [1.0, 0.0], [2.0, 0.0]];
    passes_at(5.0, &far, &Real::zero());
    passes_at(5.0, &[[0.5, 0.5], [1.0, 0.0]], &Real::zero());
}

/// 0 where y is ahead, and without y or z: then their excess says how far aside they are.
/// H-14.65.
#[test]
fn only_what_leads_from_behind_passes_p() {
    let z = [1.0, 0.0];
    passes_at(5.0, &[[-0.0625, 0.5], z], &share(8, 17));
    passes_at(5.0, &[[0.0, 0.5], z], &share(1, 2));
    for f_y in [1e-9, 0.125] {
        passes_at(5.0, &[[f_y, 0.5], z], &Real::zero());
        passes_at(5.0, &[[-2.0, 0.5], [f_y, 0.5], z], &Real::zero());
    }
    passes_at(0.0, &[[-1.0, 0.25]], &Real::zero());
    is_wider_by(0.0, &[[0.0, 0.25], [0.0, 0.125]], &share(1, 4));
}

/// A place behind p counts as one ahead; what is behind the last place does not.
/// H-14.26, H-14.64.
#[test]
fn the_widening_is_that_of_the_places() {
    let back = [[0.5, 0.0], [-1.0, 0.75], [1.0, 0.0]];
    is_wider_by(7.0, &back, &share(7, 12));
    // s_stop is less than 1/4 m.
    is_wider_by(1.0, &back, &Real::zero());
    // At 10 m/s: 5 m ahead, and by 90 degrees up to the first place farther than 8.65 m from p, 7.25 m aside. u is 6 m/s.
    let to_the_turn = (0..=5).map(|x| [f64::from(x), 0.0]);
    let behind_it = (1..=12).map(|y| [5.0, f64::from(y)]);
    let plan: Vec<[f64; 2]> = to_the_turn.chain(behind_it).collect();
    is_wider_by(10.0, &plan, &share(469, 144));
    // With the headings of the turn.
    let mut turning = cycle(10.0, &plan);
    points(&mut turning)[6..].iter_mut().for_each(|point| (point.cos, point.sin) = (0.0, 1.0));
    assert_eq!(widenings(&turning), [0; 3].map(|_| share(469, 144)));
}

/// A node on the line along h that is turned by 3/5: 2 m (3/5 - 1/6).
/// H-14.26, H-14.64.
#[test]
fn a_turned_place_has_a_widening() {
    let mut cycle = cycle(5.0, &[[0.0, 0.0], [0.5, 0.0], [1.0, 0.0]]);
    assert_eq!(widenings(&cycle), [0; 3].map(Real::from_integer));
    let node = &mut points(&mut cycle)[1];
    (node.cos, node.sin) = (0.8, 0.6);
    let expected = Real::from_integer(2) * (Real::from_double(0.6) - share(1, 6));
    assert_eq!(widenings(&cycle), [0; 3].map(|_| expected.clone()));
}

/// The rule that stage ii breaks, its point, and what it compares.
pub(super) type Found = (Rule, Option<usize>, [String; 2]);

pub(super) fn found(cycle: &Cycle, reading: Reading) -> Option<Found> {
    let report = check(cycle, reading).expect("valid");
    match &report.stages[Stage::Ii as usize] {
        Outcome::Failed(it) => {
            Some((it.rule, it.point, it.compared.each_ref().map(ToString::to_string)))
        }
        _ => None,
    }
}

pub(super) fn witness(rule: Rule, point: usize, compared: [&str; 2]) -> Found {
    (rule, Some(point), compared.map(ToString::to_string))
}

/// The witness is at the first point and compares the distance at which the trajectory passes p with lateral_tolerance.
/// H-07.5.
#[test]
fn the_trajectory_passes_within_lateral_tolerance() {
    let at = |y: f64| {
        let mut cycle = base(Profile::HARDENED, PlanRemote);
        cycle.ego.y = y;
        cycle
    };
    for side in [1.0, -1.0] {
        assert_eq!(safe(&at(side * 0.5)), NEAR_SAFE);
        assert_eq!(found(&at(side * 0.5), Reading::Exact), None);
        let offset = |compared| Some(witness(Rule::StartOffset, 0, compared));
        assert_eq!(found(&at(side * 0.5), Reading::Strict), offset(["0.5", "0.5"]));
        assert_eq!(found(&at(side * 0.625), Reading::Exact), offset(["0.625", "0.5"]));
    }
}

/// E_k is greater by it: 0.25 m of distance at p, half of both widths, and 0.25 m.
/// H-14.42.
#[test]
fn who_keeps_beside_leaves_room_for_the_widening() {
    moves_by_m("widening", |e| {
        let mut cycle = beside(-10.0, 2.5 + sagitta(8.0) - e, 8.0, 0.0);
        cycle.ego.y = 0.25;
        keeps_beside(&cycle)
    });
}

/// The longest trajectory, all of it at one point that intervals do not tell apart.
#[test]
fn the_longest_trajectory_has_a_widening() {
    let mut long = cycle(5.0, &[[0.5, 0.5]]);
    (long.ego.cos, long.ego.sin) = (0.6, 0.8);
    let one = points(&mut long)[0].clone();
    let short = widenings(&long);
    let later = (0..1024).map(|i| TrajectoryPoint { t_ns: one.t_ns + i, ..one.clone() });
    *points(&mut long) = later.collect();
    assert_eq!(widenings(&long), short);
}
