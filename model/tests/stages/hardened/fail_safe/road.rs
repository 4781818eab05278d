//! `spec/hardened/H-14.md#requirements-the-road`

use mufasa_model::cycle::check;
use mufasa_model::input::cycle::{CrossSection, Cycle, Profile};
use mufasa_model::input::profile::HardenedRule;
use mufasa_model::report::{Outcome, Reading, Rule, Stage};
use mufasa_model::services::configuration::Configuration::PlanRemote;

use crate::base::*;
use crate::near::*;

/// Places alone are compared with the corridor, beside theta_map.
const ROAD: Profile = Profile::HARDENED.without(HardenedRule::H07);

/// Point, distance, limit and segment of the witness.
fn found(cycle: &Cycle, reading: Reading) -> Option<(usize, [f64; 2], usize)> {
    match &check(cycle, reading).expect("valid").stages[Stage::Ii as usize] {
        Outcome::Failed(it) => {
            assert_eq!(it.rule, Rule::Corridor);
            Some((it.point?, it.compared, it.segment?))
        }
        _ => None,
    }
}

/// The right boundary of the road comes 1 m over the reference path at x.
fn narrow_at(x: f64) -> Vec<CrossSection> {
    let at = |x: f64, right: f64| CrossSection { x, y: 0.0, left: [x, 3.0], right: [x, right] };
    vec![at(-100.0, -3.0), at(x - 0.5, -3.0), at(x, 1.0), at(x + 0.5, -3.0), at(200.0, -3.0)]
}

/// The CAV drives `y` m to the left of the reference path, the road being 0.1 m wide to each side.
fn drive_at(cycle: &mut Cycle, y: f64) {
    cycle.ego.y = y;
    points(cycle).iter_mut().for_each(|point| point.y = y);
    for section in &mut cycle.route.cross_sections {
        (section.left[1], section.right[1]) = (0.1, -0.1);
    }
}

/// MARGIN-17: the CAV drives along the left and along the right boundary; strictly the square is of 10^-5 m at least.
#[test]
fn margins_move_the_road() {
    let cases: [Near; 2] = [
        ("to the left", PlanRemote, ROAD, |c, e| drive_at(c, 0.1 + e)),
        ("to the right", PlanRemote, ROAD, |c, e| drive_at(c, -0.1 - e)),
    ];
    margins_move_strictly(&cases, 1e-5);
}

/// H-14.58: behind the last point, at x = 3 m, the road ends at 5 m, where place 20 is.
#[test]
fn the_way_behind_the_trajectory_is_on_the_road() {
    for profile in [Profile::HARDENED, ROAD] {
        let mut cycle = base(profile, PlanRemote);
        cycle.trajectory = Some(straight(4, 1.0));
        assert_eq!(found(&cycle, Reading::Strict), None);
        cycle.route = straight_route(-100.0, 5.0);
        assert_eq!(found(&cycle, Reading::Exact), Some((4 + 21, [0.25, 0.0], 0)));
        assert_eq!(found(&cycle, Reading::Strict), Some((4 + 20, [0.0, 0.0], 0)));
        assert_eq!(found(&cycle, Reading::Lax), Some((4 + 21, [0.25, 0.0], 0)));
        cycle.profile = Profile::PAPER;
        assert_eq!(found(&cycle, Reading::Strict), None);
    }
}

/// H-14.58: between two points, after `reach`.
#[test]
fn the_way_between_two_points_is_on_the_road() {
    let mut cycle = base(Profile::HARDENED, PlanRemote);
    cycle.route.cross_sections = narrow_at(4.5);
    assert_eq!(found(&cycle, Reading::Exact), Some((51 + 18, [0.0, 0.0], 1)));
    cycle.profile = Profile::HARDENED.without(HardenedRule::H14);
    assert_eq!(found(&cycle, Reading::Strict), None);
    let mut beyond = base(ROAD, PlanRemote);
    beyond.route.cross_sections = narrow_at(0.5);
    assert_eq!(found(&beyond, Reading::Exact), Some((51 + 2, [0.0, 0.0], 1)));
    points(&mut beyond).iter_mut().for_each(|point| (point.x, point.y) = (point.x + 1.0, 1.0));
    assert_eq!(rule(&beyond, Stage::Ii), Some(Rule::Reach));
}

/// p itself is not asked.
#[test]
fn the_cav_may_be_beside_the_road() {
    let mut cycle = base(Profile::HARDENED, PlanRemote);
    cycle.route = straight_route(0.125, 200.0);
    points(&mut cycle).iter_mut().for_each(|point| point.x += 1.0);
    assert_eq!(found(&cycle, Reading::Strict), None);
    cycle.route = straight_route(0.375, 200.0);
    assert_eq!(found(&cycle, Reading::Lax), Some((51 + 1, [0.125, 0.0], 0)));
}
