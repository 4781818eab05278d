//! H-04: the gap that a stop needs behind a leading vehicle (`spec/hardened/H-04.md`).

use crate::claim::{Theorem, Wrong};
use crate::hardened::h04_gap::s_react;
use crate::numbers::real::Real;
use crate::numbers::real::formula::{Formula, at_most, given, iff, implies, less};
use crate::stages::distances::{s_b, s_cav, s_follow};
use crate::theorem::h14_fail_safe::times::{Cav, braked, kept};

/// The theorems of this file.
pub const THEOREMS: &[Theorem] = &[
    Theorem {
        id: "a_CAV_is_never_more_than_s_react_farther_than_a_lead_that_brakes",
        statement: "H-04: a CAV that speeds up with a_max for tau and then brakes with a_b has gone at each time at most \
                    s_react farther than a lead that brakes with a_b at once; so it reaches none that is \
                    farther ahead",
        domain: "all times, v, v_lead, tau >= 0, a_max, a_b > 0",
        claim: || any_gone_farther(at_most),
        wrong: Wrong { statement: "less than s_react farther", claim: || any_gone_farther(less) },
    },
    Theorem {
        id: "s_react_is_at_most_s_follow_exactly_when_tau_is_short",
        statement: "H-04: for v_lead <= v_now, s_react <= s_follow exactly when s_stop <= s_b(v_now) + s_CAV; for \
                    v_lead > v_now, too, when that holds",
        domain: "all v, v_lead, tau, safety_time >= 0, a_max, a_b > 0",
        claim: || {
            let (less_than_follow, short, slower) = beside_s_follow();
            Formula::All(vec![
                implies(slower, iff(&less_than_follow, &short)),
                implies(short, less_than_follow),
            ])
        },
        wrong: Wrong {
            statement: "whatever v_lead, exactly when that holds",
            claim: || {
                let (less_than_follow, short, _) = beside_s_follow();
                iff(&less_than_follow, &short)
            },
        },
    },
];

/// A CAV and the speed of its lead.
fn behind() -> (Cav, Real) {
    let (cav, v_lead) = (Cav::any(), Real::variable("v_lead"));
    given(at_most(&Real::zero(), &v_lead));
    (cav, v_lead)
}

fn any_gone_farther(order: fn(&Real, &Real) -> Formula) -> Formula {
    let ((cav, v_lead), t) = (behind(), Real::variable("t"));
    given(at_most(&Real::zero(), &t));
    given(kept(&cav, &cav.fastest(&t)));
    gone_farther(&cav, &v_lead, &t, order)
}

/// The way of the fastest CAV after t, and that of a lead that brakes at once and s_react.
pub fn gone_farther(
    cav: &Cav,
    v_lead: &Real,
    t: &Real,
    order: fn(&Real, &Real) -> Formula,
) -> Formula {
    let driving = cav.driving();
    let of_lead = braked(v_lead, driving.a_b, t);
    order(&cav.fastest(t).way, &(s_react(&driving, v_lead) + of_lead))
}

/// s_react <= s_follow, s_stop <= s_b(v_now) + s_CAV, v_lead <= v_now.
fn beside_s_follow() -> (Formula, Formula, Formula) {
    let (cav, v_lead) = behind();
    let time = Real::variable("safety_time");
    given(at_most(&Real::zero(), &time));
    let driving = cav.driving();
    let follow = s_follow(driving.v, &v_lead, driving.a_b, &time);
    let enough = s_b(driving.v, driving.a_b) + s_cav(&time, driving.v);
    (
        at_most(&s_react(&driving, &v_lead), &follow),
        at_most(&driving.s_stop(), &enough),
        at_most(&v_lead, driving.v),
    )
}
