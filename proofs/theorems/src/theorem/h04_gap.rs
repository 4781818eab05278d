//! H-04: the gap that a stop needs behind a leading vehicle (`spec/hardened/H-04.md`).

use crate::claim::{Theorem, Wrong};
use crate::hardened::h04_gap::s_react;
use crate::hardened::h14_fail_safe::times::a_tyre;
use crate::numbers::real::Real;
use crate::numbers::real::formula::{
    Formula, at_most, equal, forget_of_what_products_are, given, iff, implies, less,
};
use crate::stages::distances::{s_b, s_cav, s_follow};
use crate::theorem::h14_fail_safe::times::{Cav, braked, kept};

/// The theorems of this file.
pub const THEOREMS: &[Theorem] = &[
    Theorem {
        id: "a_CAV_slower_than_a_lead_that_brakes_has_gone_no_farther",
        statement: "H-04: a CAV that speeds up with a_max for tau and then brakes with a_b, and is slower then than a lead \
                    that brakes with a_tyre at once, has not gone farther",
        domain: "all times, v, v_lead, tau >= 0, a_max, a_b > 0",
        claim: || {
            let (cav, v_lead, t) = behind();
            let slower = less(&cav.fastest(&t).u, &slowed(&cav, &v_lead, &t));
            implies(slower, no_farther(&cav, &v_lead, &t))
        },
        wrong: Wrong {
            statement: "whatever its speed",
            claim: || {
                let (cav, v_lead, t) = behind();
                no_farther(&cav, &v_lead, &t)
            },
        },
    },
    Theorem {
        id: "a_lead_that_is_not_faster_stops_within_the_way_of_the_CAV",
        statement: "H-04: w <= u implies s_tyre(w) <= s_b(u); a lead that brakes with a_tyre has s_tyre(v_lead) less what it \
                    has gone to stop",
        domain: "all times, w, u, v_lead >= 0, a_b > 0",
        claim: || {
            let (cav, w, t) = behind();
            given(at_most(&w, &cav.v));
            Formula::All(vec![stops_sooner(&cav, &w, &cav.v), stops_where_it_would(&cav, &w, &t)])
        },
        wrong: Wrong {
            statement: "s_tyre(v_lead) is left of it whatever it has gone",
            claim: || {
                let (cav, w, t) = behind();
                let (gone, stops) = (braked(&w, &a_tyre(&cav.a_b), &t), cav.driving().s_tyre(&w));
                equal(&(gone + &stops), &stops)
            },
        },
    },
    Theorem {
        id: "a_CAV_is_never_more_than_s_react_farther_than_a_lead_that_brakes",
        statement: "H-04: a CAV that speeds up with a_max for tau and then brakes with a_b has gone at each time at most \
                    s_react farther than a lead that brakes with a_tyre at once; so it reaches none that is \
                    farther ahead",
        domain: "all times, v, v_lead, tau >= 0, a_max, a_b > 0",
        claim: || {
            forget_of_what_products_are();
            any_gone_farther(at_most)
        },
        wrong: Wrong { statement: "less than s_react farther", claim: || any_gone_farther(less) },
    },
    Theorem {
        id: "s_react_is_at_most_s_follow_exactly_when_tau_is_short",
        statement: "H-04: for v_lead <= v_now, s_react <= s_follow exactly when s_stop + s_b(v_lead) <= \
                    s_b(v_now) + s_CAV + s_tyre(v_lead); for v_lead > v_now, too, when that holds",
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

/// A CAV, the speed of its lead, and a time.
fn behind() -> (Cav, Real, Real) {
    let (cav, [v_lead, t]) = (Cav::any(), ["v_lead", "t"].map(Real::variable));
    for number in [&v_lead, &t] {
        given(at_most(&Real::zero(), number));
    }
    (cav, v_lead, t)
}

/// The speed of a lead that has braked with a_tyre for t.
fn slowed(cav: &Cav, v_lead: &Real, t: &Real) -> Real {
    (v_lead - a_tyre(&cav.a_b) * t).max(Real::zero())
}

/// s_tyre(w) <= s_b(u).
fn stops_sooner(cav: &Cav, w: &Real, u: &Real) -> Formula {
    at_most(&cav.driving().s_tyre(w), &s_b(u, &cav.a_b))
}

/// The way of that lead until t, and that of braking on from there, are s_tyre(v_lead).
fn stops_where_it_would(cav: &Cav, v_lead: &Real, t: &Real) -> Formula {
    let driving = cav.driving();
    let rest = driving.s_tyre(&slowed(cav, v_lead, t));
    equal(&(braked(v_lead, &a_tyre(&cav.a_b), t) + rest), &driving.s_tyre(v_lead))
}

/// The fastest CAV has gone no farther than that lead.
fn no_farther(cav: &Cav, v_lead: &Real, t: &Real) -> Formula {
    at_most(&cav.fastest(t).way, &braked(v_lead, &a_tyre(&cav.a_b), t))
}

fn any_gone_farther(order: fn(&Real, &Real) -> Formula) -> Formula {
    let (cav, v_lead, t) = behind();
    let (done, slowed) = (cav.fastest(&t), slowed(&cav, &v_lead, &t));
    given(kept(&cav, &done));
    if done.u < slowed {
        given(no_farther(&cav, &v_lead, &t));
    } else {
        given(stops_sooner(&cav, &slowed, &done.u));
        given(stops_where_it_would(&cav, &v_lead, &t));
    }
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
    let of_lead = braked(v_lead, &a_tyre(&cav.a_b), t);
    order(&cav.fastest(t).way, &(s_react(&driving, v_lead) + of_lead))
}

/// s_react <= s_follow, s_stop + s_b(v_lead) <= s_b(v_now) + s_CAV + s_tyre(v_lead), v_lead <= v_now.
fn beside_s_follow() -> (Formula, Formula, Formula) {
    let (cav, v_lead, _) = behind();
    let time = Real::variable("safety_time");
    given(at_most(&Real::zero(), &time));
    let driving = cav.driving();
    let follow = s_follow(driving.v, &v_lead, driving.a_b, &time);
    let enough = s_b(driving.v, driving.a_b) + s_cav(&time, driving.v) + driving.s_tyre(&v_lead);
    (
        at_most(&s_react(&driving, &v_lead), &follow),
        at_most(&(driving.s_stop() + s_b(&v_lead, driving.a_b)), &enough),
        at_most(&v_lead, driving.v),
    )
}
