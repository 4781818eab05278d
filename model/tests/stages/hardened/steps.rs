//! H-11: steps and ways aside on both sides of each bound.

use mufasa_model::input::cycle::{Profile, TrajectoryPoint};
use mufasa_model::report::Rule;
use mufasa_model::services::configuration::Configuration::PlanRemote;

use crate::base::*;
use crate::near::*;

const HARDENED: Profile = Profile::HARDENED;

/// Mean direction of the headings (1, 0) and (0.96, 0.28), for a step along an arc.
const BETWEEN: [f64; 2] = [1.96, 0.28];

const NEAR: &[Near] = &[
    ("step <= L - m", PlanRemote, HARDENED, |c, e| two_points(c, 100, [4.0 + e, 0.0])),
    ("step <= v_max dt - m", PlanRemote, HARDENED, |c, e| two_points(c, 20, [3.0 + e, 0.0])),
    ("u . h >= -0.1 dt + m", PlanRemote, HARDENED, |c, e| two_points(c, 100, [-0.01 - e, 0.0])),
    ("lateral step <= W/2 - m", PlanRemote, HARDENED, |c, e| {
        two_points(c, 100, [1.5, 0.1 + e]);
        c.ego.width = 0.2;
    }),
    ("dot product of headings >= 0.866 + m", PlanRemote, HARDENED, |c, e| {
        two_points(c, 400, [1.931_85, 0.517_64]);
        c.parameters.step_max_ns = 400_000_000;
        turn(c, 0.866 - e);
    }),
    ("turn of a step <= bound - m", PlanRemote, HARDENED, |c, e| {
        // 0.28 <= 0.1 + 0.01 + 0.5 abs(u), after a metre straight on
        two_points(c, 100, [1.0, 0.0]);
        let [x, y] = BETWEEN.map(|part| part * (0.34 - 2.0 * e) / BETWEEN[0].hypot(BETWEEN[1]));
        let last = TrajectoryPoint { cos: 0.96, sin: 0.28, ..at_time(200_000_000, 1.0 + x, y) };
        points(c).push(last);
    }),
    ("slide <= bound - m", PlanRemote, HARDENED, |c, e| {
        // Both headings along x: 2 y <= 0.1 * 2 + 0.1 + 0.02 * 0.1.
        two_points(c, 100, [1.0, 0.151 + e / 2.0]);
    }),
    ("slide of a turn <= bound - m", PlanRemote, HARDENED, |c, e| {
        // u x (h1 + h2) = 0.56 - 1.96 y, L (h1 x h2)/2 = 0.56: the CAV turns left about a point to
        // its right. 1.12 - 1.96 y <= 0.56 + 0.1 (3.92 + 0.28 y) + 0.104
        two_points(c, 200, [2.0, 0.0]);
        turn(c, 0.96);
        points(c)[1].y = (0.56 - 0.496 - e) / 1.988;
    }),
];

/// The second heading.
fn turn(cycle: &mut mufasa_model::input::cycle::Cycle, cos: f64) {
    (points(cycle)[1].cos, points(cycle)[1].sin) = (cos, (1.0 - cos * cos).sqrt());
}

#[test]
fn margins_move_each_bound_of_a_step() {
    let rules = [
        Rule::StepLength,
        Rule::StepSpeed,
        Rule::StepForward,
        Rule::StepLateral,
        Rule::StepTurn,
        Rule::StepTurn,
        Rule::Slide,
        Rule::Slide,
    ];
    margins_move_rules(NEAR, &rules);
}
