//! The distances in doubles move the same way as over the reals: every operation is rounded, and
//! all that is used of rounding is that it is monotone and keeps 0.

use crate::numbers::real::Real;
use crate::numbers::real::formula::{at_most, given, less, round_every_result};
use crate::stages::distances::{s_b, s_follow};
use crate::theorem::{Theorem, Wrong};

const DOMAIN: &str = "all speeds >= 0, a_b > 0, safety_time >= 0; operations as in model/src/stages/distances.rs, \
                      every monotone rounding that keeps 0 and does not turn 2 a_b into it";

/// The theorems of this file.
pub const THEOREMS: &[Theorem] = &[
    Theorem {
        id: "rounded_s_b_grows_with_v",
        statement: "v <= w implies s_b(v) <= s_b(w), every operation rounded",
        domain: DOMAIN,
        claim: || {
            let Speeds { v, w, a_b, .. } = Speeds::new(false);
            at_most(&s_b(&v, &a_b), &s_b(&w, &a_b))
        },
        wrong: Wrong {
            statement: "v < w implies s_b(v) < s_b(w)",
            claim: || {
                let Speeds { v, w, a_b, .. } = Speeds::new(true);
                less(&s_b(&v, &a_b), &s_b(&w, &a_b))
            },
        },
    },
    Theorem {
        id: "rounded_s_follow_grows_with_v_now",
        statement: "v <= w implies s_follow(v, v_lead) <= s_follow(w, v_lead), every operation rounded",
        domain: DOMAIN,
        claim: || {
            let Speeds { v, w, u, a_b, time } = Speeds::new(false);
            at_most(&s_follow(&v, &u, &a_b, &time), &s_follow(&w, &u, &a_b, &time))
        },
        wrong: Wrong {
            statement: "v < w implies s_follow(v, v_lead) < s_follow(w, v_lead)",
            claim: || {
                let Speeds { v, w, u, a_b, time } = Speeds::new(true);
                less(&s_follow(&v, &u, &a_b, &time), &s_follow(&w, &u, &a_b, &time))
            },
        },
    },
    Theorem {
        id: "rounded_s_follow_falls_with_v_lead",
        statement: "v <= w implies s_follow(v_now, w) <= s_follow(v_now, v), every operation rounded",
        domain: DOMAIN,
        claim: || {
            let Speeds { v, w, u, a_b, time } = Speeds::new(false);
            at_most(&s_follow(&u, &w, &a_b, &time), &s_follow(&u, &v, &a_b, &time))
        },
        wrong: Wrong {
            statement: "v <= w implies s_follow(v_now, v) <= s_follow(v_now, w)",
            claim: || {
                let Speeds { v, w, u, a_b, time } = Speeds::new(false);
                at_most(&s_follow(&u, &v, &a_b, &time), &s_follow(&u, &w, &a_b, &time))
            },
        },
    },
];

struct Speeds {
    v: Real,
    w: Real,
    u: Real,
    a_b: Real,
    time: Real,
}

impl Speeds {
    /// v <= w, or v < w.
    fn new(differ: bool) -> Self {
        let [v, w, u, a_b, time] = ["v", "w", "u", "a_b", "safety_time"].map(Real::variable);
        given(less(&Real::zero(), &a_b));
        for number in [&v, &u, &time] {
            given(at_most(&Real::zero(), number));
        }
        given(if differ { less(&v, &w) } else { at_most(&v, &w) });
        // In doubles 2 a_b is exact.
        round_every_result();
        given(less(&Real::zero(), &(Real::from_integer(2) * &a_b)));
        Self { v, w, u, a_b, time }
    }
}
