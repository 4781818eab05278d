//! The widening of `spec/hardened/H-14.md#requirements-the-cav`, and what asks it.

use mufasa_model::cycle::check;
use mufasa_model::hardened::h14_fail_safe::widening::wider_by;
use mufasa_model::input::cycle::{Cycle, Profile, Trajectory, TrajectoryPoint};
use mufasa_model::input::profile::HardenedRule;
use mufasa_model::numbers::real::Real;
use mufasa_model::report::{Outcome, Reading, Rule, Stage};
use mufasa_model::services::configuration::Configuration::PlanRemote;

use super::following::{READINGS, beside, keeps_beside, moves_by_m};
use super::scene;
use crate::base::*;
use crate::near::{NEAR_SAFE, NO, Near, YES, margins_move_rules, points, safe};

/// The CAV at the origin at `v` m/s, s_b(v) = v^2/16, looks along x; the trajectory leads through these points.
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
    for cycle in [cycle(v, places), cycle(v, &mirrored), turned] {
        for found in widenings(&cycle) {
            assert_eq!(&found, expected, "{v} {places:?}");
        }
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
    // On the line from (-1, 0.25) to (3, 1.25) it is 0.5 m aside at p; R is 3 m.
    is_wider_by(5.0, &[[-1.0, 0.25], [3.0, 1.25]], &share(1, 2));
    // From one side to the other, and z half a metre aside at f = 0.5 m.
    is_wider_by(5.0, &[[-0.5, -0.5], [0.5, 0.5]], &share(11, 24));
    // In the form of an S: its first point is on the line through p, and so is what comes after it.
    let s = [[-2.0, 0.0], [-1.5, -0.5], [-1.0, 0.25], [-0.25, 0.5], [0.5, 0.5], [2.0, 0.0]];
    is_wider_by(5.0, &s, &share(1, 2));
    let far = [[-2.0, 3.0], [-1.0, -3.0], [-0.5, 0.0], [1.0, 0.0], [2.0, 0.0]];
    is_wider_by(5.0, &far, &Real::zero());
}

/// abs(a_y) from f_y = 0 on.
/// H-14.65.
#[test]
fn a_point_that_is_hardly_ahead_is_where_it_passes() {
    let z = [1.0, 0.0];
    is_wider_by(5.0, &[[-0.0625, 0.5], z], &share(8, 17));
    for f_y in [0.0, 0.0625, 0.125] {
        is_wider_by(5.0, &[[f_y, 0.5], z], &share(1, 2));
        is_wider_by(5.0, &[[-2.0, 0.0], [f_y, 0.5], z], &share(1, 2));
    }
}

/// Wherever its points are behind p or up to 1/8 m ahead.
/// H-14.65.
#[test]
fn without_a_node_it_passes_where_it_begins() {
    for v in [0.0, 5.0] {
        is_wider_by(v, &[[-1.0, 0.25]], &share(1, 4));
        is_wider_by(v, &[[0.0, 0.5]], &share(1, 2));
        is_wider_by(v, &[[-1.0, 2.0], [0.0, 1.0], [0.125, 0.5]], &Real::from_integer(2));
        is_wider_by(v, &[[0.0, 0.5], [-1.0, 0.0]], &share(1, 2));
    }
    // The same points pass where they are when a node comes after them.
    is_wider_by(5.0, &[[-1.0, 2.0], [0.0, 1.0], [0.125, 0.5], [1.0, 0.0]], &share(1, 2));
}

/// Where z is the first point, and at each node after it: abs(a_x) - f^2 / (2 R).
/// H-14.64.
#[test]
fn what_a_circle_leads_to_is_no_widening() {
    is_wider_by(5.0, &[[0.5, 0.5]], &share(11, 24));
    is_wider_by(5.0, &[[1.0, 0.125]], &Real::zero());
    // R is 3 m for a CAV that stands; z counts, though s_b(0) = 0.
    is_wider_by(0.0, &[[0.75, 0.5]], &share(13, 32));
    is_wider_by(0.0, &[[0.75, 0.5], [1.0, 2.0]], &share(13, 32));
    // It goes aside at once: the greatest of all, not the first or the last.
    let aside = [[-1.0, 0.0], [0.5, 0.0], [1.0, 0.5], [1.25, 1.0], [1.5, 1.0]];
    is_wider_by(6.5, &aside, &share(71, 96));
    // What goes back is asked as if it were beside p, up to a length of s_b(v).
    let back = [[0.5, 0.0], [-1.0, 0.75], [1.0, 0.0]];
    is_wider_by(7.0, &back, &share(3, 4));
    is_wider_by(6.5, &back, &Real::zero());
    is_wider_by(0.0, &back, &Real::zero());
}

/// u = v - a_b f/v up to f = s_b(v), v/2 from there on; R = u^2 / (11.5 m/s^2) where that is above 3 m.
/// H-14.64.
#[test]
fn a_cav_that_brakes_drives_a_smaller_circle() {
    // u = 12.5 - 1 and R = 11.5, at z and at a node after it.
    is_wider_by(12.5, &[[1.5625, 0.5]], &share(2319, 5888));
    is_wider_by(12.5, &[[0.5, 0.0], [1.5625, 0.5]], &share(2319, 5888));
    // f is 0 for what goes back, whatever u is.
    is_wider_by(12.5, &[[0.5, 0.0], [-1.0, 0.5]], &share(1, 2));
    // u = 11.5 and R = 11.5 for a first node at s_b(23) = 33.0625 m and for one farther ahead: v/2.
    is_wider_by(23.0, &[[33.0625, 48.027_343_75]], &share(1, 2));
    is_wider_by(23.0, &[[46.0, 92.5]], &share(1, 2));
    is_wider_by(23.0, &[[-1.0, 0.0], [46.0, 94.0]], &Real::from_integer(2));
}

/// s_b(4) = 1 m: a node after z counts where its length is below s_b(v) + m, z anywhere.
/// H-14.64, MARGIN-01.
#[test]
fn nodes_from_a_length_of_s_b_on_do_not_count() {
    // Its length is x + 0.5 m.
    let counts = |x: f64| {
        let all = widenings(&cycle(4.0, &[[0.375, 0.0], [x, 0.5], [3.0, 0.0]]));
        all.map(|it| it > Real::zero())
    };
    let [inside, outside] = [[true, true, false], [true, false, false]];
    assert_eq!([0.5 - 2e-6, 0.5 - 0.5e-6].map(counts), [YES, inside]);
    assert_eq!([0.5, 0.5 + 0.5e-6, 0.5 + 2e-6].map(counts), [outside, outside, NO]);
    let [strict, exact, _] = widenings(&cycle(4.0, &[[0.375, 0.0], [0.5, 0.5]]));
    assert_eq!([strict, exact], [share(11, 24), Real::zero()]);
    is_wider_by(4.0, &[[1.0, 0.5]], &share(1, 3));
    is_wider_by(4.0, &[[-1.0, 0.0], [2.0, 1.5]], &share(5, 6));
}

/// Along a piece it grows along and across the heading of the node before it.
/// H-14.59, H-14.64.
#[test]
fn the_length_goes_along_and_across_headings() {
    let mut cycle = cycle(4.0, &[[0.5, 0.0], [0.75, 0.25]]);
    cycle.parameters.delta = 1e-8;
    let [_, exact, lax] = widenings(&cycle);
    assert_eq!([exact, lax], [0; 2].map(Real::from_integer));
    // 0.5 m, and 0.35 m along and 0.05 m across.
    let z = &mut points(&mut cycle)[0];
    (z.cos, z.sin) = (0.6, 0.8);
    assert_eq!(widenings(&cycle), [5; 3].map(|n| share(n, 32)));
}

/// At 10 m/s, s_b = 6.25 m: after 5 m by 90 degrees, and 12 m on. Behind the turn the progress stays at 5 m.
/// H-14.64.
#[test]
fn a_plan_that_turns_off_has_no_widening_behind_the_turn() {
    let to_the_turn = (0..=5).map(|x| [f64::from(x), 0.0]);
    let behind_it = (1..=12).map(|y| [5.0, f64::from(y)]);
    let plan: Vec<[f64; 2]> = to_the_turn.chain(behind_it).collect();
    is_wider_by(10.0, &plan, &Real::zero());
    // With the headings of the turn.
    let mut turning = cycle(10.0, &plan);
    points(&mut turning)[6..].iter_mut().for_each(|point| (point.cos, point.sin) = (0.0, 1.0));
    assert_eq!(widenings(&turning), [0; 3].map(Real::from_integer));
    // The same nodes do count where the CAV needs farther to brake.
    let faster = widenings(&cycle(20.0, &plan));
    assert!(faster.iter().all(|it| *it > Real::from_integer(11)));
}

/// The rule that stage ii breaks, its point, and what it compares.
type Found = (Rule, Option<usize>, [String; 2]);

fn found(cycle: &Cycle, reading: Reading) -> Option<Found> {
    let report = check(cycle, reading).expect("valid");
    match &report.stages[Stage::Ii as usize] {
        Outcome::Failed(it) => {
            Some((it.rule, it.point, it.compared.each_ref().map(ToString::to_string)))
        }
        _ => None,
    }
}

fn witness(rule: Rule, point: usize, compared: [&str; 2]) -> Found {
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
        // A plan to stay beside the CAV has no node.
        let stays = cycle(0.0, &[[0.0625, side * 0.625]; 2]);
        assert_eq!(found(&stays, Reading::Exact), offset(["0.625", "0.5"]));
        let goes_on = cycle(0.0, &[[0.0625, side * 0.625], [0.1875, side * 0.625]]);
        assert_eq!(found(&goes_on, Reading::Exact), offset(["0.625", "0.5"]));
    }
}

/// The trajectory begins ahead, at f = 0.75 m: 3/32 m aside is on the circle.
fn begins_ahead(y: f64) -> Cycle {
    let mut cycle = cycle(4.0, &[[0.75, y], [1.5, y], [2.25, y]]);
    cycle.parameters.delta = 1e-8;
    cycle
}

/// The witness is at the first point and compares the widening with lateral_tolerance; H-07 does not ask it.
/// H-14.66, H-07.5.
#[test]
fn the_widening_is_at_most_lateral_tolerance() {
    let reach = |compared| Some(witness(Rule::Reach, 0, compared));
    for side in [1.0, -1.0] {
        let at = |y: f64| begins_ahead(side * y);
        assert_eq!([0.59375, 0.59374].map(|y| safe(&at(y))), [NEAR_SAFE, YES]);
        assert_eq!(found(&at(0.59375), Reading::Exact), None);
        assert_eq!(found(&at(0.59375), Reading::Strict), reach(["0.5", "0.5"]));
        let mut wide = at(0.625);
        assert_eq!(found(&wide, Reading::Exact), reach(["0.53125", "0.5"]));
        wide.profile = wide.profile.without(HardenedRule::H14);
        assert_eq!(found(&wide, Reading::Strict), None);
    }
    // On each side of the bound, at a first point 1 m ahead and at a node after it.
    let near: &[Near] = &[
        ("a first point", PlanRemote, Profile::HARDENED, |c, e| {
            // u = 9.2 m/s after 1 m: on a circle of 84.64 m / 11.5.
            (c.ego.x, c.ego.y) = (-1.0, 0.25 + 11.5 / 169.28 + e);
            c.parameters.lateral_tolerance = 0.25;
        }),
        ("a later node", PlanRemote, Profile::HARDENED, |c, e| {
            let y = 0.25 + 11.5 / 169.28 + e;
            *c = cycle(10.0, &[[0.5, 0.0], [1.0, y], [1.5, y], [2.0, y]]);
            c.parameters.lateral_tolerance = 0.25;
            c.profile = c.profile.without(HardenedRule::H11);
        }),
    ];
    margins_move_rules(near, &[Rule::Reach; 2]);
}

/// H-14.15 and H-14.62 of every place come before the widening.
/// H-14.66.
#[test]
fn the_widening_comes_after_all_places() {
    // The first point is on the CAV; a later one turns aside, farther than tyres can.
    let mut later = cycle(4.0, &[[0.0, 0.0], [0.25, 0.625], [0.5, 0.625], [1.0, 0.625]]);
    later.profile = later.profile.without(HardenedRule::H11);
    let (rule, point, [aside, _]) = found(&later, Reading::Exact).expect("aside");
    assert_eq!((rule, point, aside.as_str()), (Rule::Reach, Some(4 + 3), "0.625"));
    // The node at f = 1.5 m looks across.
    let mut across = begins_ahead(0.625);
    across.profile = across.profile.without(HardenedRule::H11);
    assert_eq!(found(&across, Reading::Exact), Some(witness(Rule::Reach, 0, ["0.53125", "0.5"])));
    let node = &mut points(&mut across)[1];
    (node.cos, node.sin) = (0.0, 1.0);
    assert_eq!(found(&across, Reading::Exact), Some(witness(Rule::Reach, 3 + 6, ["0", "0"])));
}

/// E_k is greater by it: 0.25 m of distance at p, half of both widths, and 0.25 m.
/// H-14.42.
#[test]
fn who_keeps_beside_leaves_room_for_the_widening() {
    moves_by_m("widening", |e| {
        let mut cycle = beside(-10.0, 2.5 - e, 8.0, 0.0);
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
