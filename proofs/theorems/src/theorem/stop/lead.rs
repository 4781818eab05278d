//! The stop theorem for a lead: the premise is the gap of H-04 (`spec/hardened/H-04.md#requirements`).

use super::drive;
use super::motion::{Ahead, DOMAIN, Examined, Limits, at_least_zero};
use super::system::{every_step_keeps, stands_before};
use crate::claim::{Theorem, Wrong};
use crate::hardened::h04_gap::failure_without_stage_iv;
use crate::hardened::h14_fail_safe::times::a_tyre;
use crate::input::cycle::{Lead, Profile};
use crate::numbers::real::Real;
use crate::numbers::real::formula::{Formula, at_most, forget_of_what_products_are, given, not};
use crate::numbers::real::hole::open_number;
use crate::services::configuration::Configuration;
use crate::theorem::base::{self, NOW_NS};
use crate::theorem::h14_fail_safe::times::driven;

/// The theorems of this file.
pub const THEOREMS: &[Theorem] = &[
    Theorem {
        id: "the_gap_of_a_CAV_that_passes_H-04_is_that_of_the_stop_invariant",
        statement: "H-04.2: where stage iv is silent the rule passes exactly when the stop invariant holds: the gap less s_since is \
                    above 0, and with s_tyre(v_lead) above s_stop",
        domain: "all gaps, v_now, v_lead, tau >= 0, a_max, a_b > 0; the lead is measured now or 50 ms ago",
        claim: || {
            forget_of_what_products_are();
            Formula::All(vec![gap(0, 0), gap(0, 50)])
        },
        wrong: Wrong { statement: "with tau 1 cs longer", claim: || gap(1, 0) },
    },
    Theorem {
        id: "every_transition_keeps_the_stop_invariant_of_a_lead",
        statement: "F-04: going on until brake_by, braking, a cycle that measures, passes, fails or is lost, a fallback, \
                    and a return to remote, while the lead brakes with at most a_tyre, keep: s_react(v, time left until brake_by, v_lead) < gap",
        domain: DOMAIN,
        claim: || every_step_keeps(Ahead::Lead),
        wrong: Wrong {
            statement: "tau one period too small: a CAV that brakes fully 0.1 s after brake_by comes at most 10 cm too far",
            claim: || drive::stands_before(drive::LATE, Ahead::Lead, -10),
        },
    },
    Theorem {
        id: "with_the_stop_invariant_a_CAV_stands_before_its_lead",
        statement: "F-04: it has not reached it, and after braking for v / a_b from brake_by on it stands and has not",
        domain: DOMAIN,
        claim: || stands_before(Ahead::Lead),
        wrong: Wrong {
            statement: "brake_by ignored: a CAV that goes on for 0.5 s without a trajectory comes at most 10 cm too far",
            claim: || drive::stands_before(drive::IGNORED, Ahead::Lead, -10),
        },
    },
];

/// H-04 passes exactly when the invariant holds with so many hundredths of a second more, for a lead measured so many ms
/// ago.
fn gap(more: i64, age_ms: i64) -> Formula {
    let mut cycle = base::cycle(Profile::HARDENED, Configuration::PlanRemote);
    let [gap, speed] = ["gap", "v_lead"].map(open_number);
    cycle.lead = Some(Lead { stamp_ns: NOW_NS - age_ms * 1_000_000, gap, speed });
    let mut scene = base::scene(&cycle);
    let limits = Limits::any();
    scene.ego.v_now = at_least_zero("v_now");
    scene.parameters.tau = limits.tau.clone();
    scene.parameters.a_max = limits.a_max.clone();
    scene.parameters.a_b = limits.a_b.clone();
    let [gap, w] = ["gap", "v_lead"].map(Real::named);
    for number in [&gap, &w] {
        given(at_most(&Real::zero(), number));
    }
    let left = &limits.tau + Real::ratio(more, 100);
    let since = driven(&scene.ego.v_now, &a_tyre(&limits.a_b), &Real::ratio(age_ms, 1000));
    let holds = limits.holds(&scene.ego.v_now, &Examined { left, gap: gap - since, w });
    match failure_without_stage_iv(&scene) {
        None => holds,
        Some(_) => not(holds),
    }
}
