//! H-07: the start of the trajectory on both sides of each bound.

use mufasa_model::input::cycle::Profile;
use mufasa_model::report::{Rule, Stage};
use mufasa_model::services::configuration::Configuration::PlanRemote;

use crate::base::*;
use crate::near::*;

const NEAR: &[Near] = &[
    ("start <= limit - m", PlanRemote, Profile::HARDENED, |c, e| c.ego.x = 2.0 + e),
    ("heading x heading <= 0.17 - m", PlanRemote, Profile::HARDENED, |c, e| {
        let sin = 0.17 + e;
        (c.ego.cos, c.ego.sin) = ((1.0 - sin * sin).sqrt(), sin);
    }),
    ("heading x heading >= -0.17 + m", PlanRemote, Profile::HARDENED, |c, e| {
        let sin = 0.17 + e;
        (c.ego.cos, c.ego.sin) = ((1.0 - sin * sin).sqrt(), -sin);
    }),
    ("passing to the right <= lateral_tolerance - m", PlanRemote, Profile::HARDENED, |c, e| {
        c.ego.y = -0.5 - e;
    }),
    ("passing to the left <= lateral_tolerance - m", PlanRemote, Profile::HARDENED, |c, e| {
        (c.ego.x, c.ego.y) = (0.5, 0.25 + e);
        c.parameters.lateral_tolerance = 0.25;
    }),
];

#[test]
fn margins_move_each_bound_of_the_start() {
    let [position, heading, offset] = [Rule::StartPosition, Rule::StartHeading, Rule::StartOffset];
    margins_move_rules(NEAR, &[position, heading, heading, offset, offset]);
}

/// The cross product alone would take the opposite for the same.
/// H-07.3.
#[test]
fn the_opposite_heading_is_another_one() {
    let mut cycle = base(Profile::HARDENED, PlanRemote);
    cycle.ego.cos = -1.0;
    assert_eq!(rule(&cycle, Stage::Ii), Some(Rule::StartHeading));
    // Position comes before heading, heading before offset.
    cycle.ego.y = 0.6;
    assert_eq!(rule(&cycle, Stage::Ii), Some(Rule::StartHeading));
    cycle.ego.y = 2.1;
    assert_eq!(rule(&cycle, Stage::Ii), Some(Rule::StartPosition));
}
