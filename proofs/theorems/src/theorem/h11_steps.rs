//! H-11: how far a trajectory that keeps it can slide (F-35).

use crate::hardened::h11_steps::step_failure;
use crate::input::cycle::Profile;
use crate::numbers::real::Real;
use crate::numbers::real::formula::{Formula, at_most};
use crate::theorem::base::{any_cav, home};
use crate::theorem::rectangle::vector;
use crate::theorem::{Theorem, Wrong};

/// The theorems of this file.
pub const THEOREMS: &[Theorem] = &[Theorem {
    id: "a_step_of_one_heading_slides_by_a_tenth_of_it_and_0.2_m_per_second",
    statement: "H-11, F-35: headings equal, abs(u x h) <= 0.1 u . h + 0.2 dt up to the rounding of the constants",
    domain: "steps of 100 ms with both headings along x, all u, L, W",
    claim: || slide(&Real::ratio(1, 10)),
    wrong: Wrong { statement: "by a twentieth of it", claim: || slide(&Real::ratio(1, 20)) },
}];

/// A step of 100 ms that H-11 lets pass.
fn slide(share: &Real) -> Formula {
    let scene = any_cav(Profile::Hardened);
    let mut trajectory = [home(&Real::from_integer(1)), home(&Real::from_integer(1))];
    trajectory[1].t_ns += 100_000_000;
    trajectory[1].pose.origin = vector("u");
    if step_failure(&scene, &trajectory).is_some() {
        return Formula::Known(true);
    }
    let u = &trajectory[1].pose.origin;
    // 0.1 in doubles is more than 1/10, by less than 2^-56.
    let limit = share * &u.x + Real::ratio(2, 100) + Real::ratio(1, 1_000_000_000);
    Formula::All(vec![at_most(&u.y, &limit), at_most(&-&u.y, &limit)])
}
