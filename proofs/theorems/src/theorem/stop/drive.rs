//! Drives: a run of the system from a safe cycle to standstill with numbers that the solver chooses, as a table.
//! They show that the invariant is kept by CAVs that move, and what happens to one that brakes too late.

use super::motion::{Ahead, Examined, Limits};
use crate::drive::{COLUMNS, cell};
use crate::hardened::h14_fail_safe::times::a_tyre;
use crate::numbers::real::Real;
use crate::numbers::real::formula::{Formula, at_most, equal, given, less};
use crate::stages::distances::s_b;
use crate::theorem::h14_fail_safe::times::driven;

/// What happens at a time, s/100, before which control goes on.
type Events = [(i64, &'static str)];

/// tau is kept: the CAV brakes by `brake_by`, 0.25 s after the cycle.
pub const KEPT: &Events =
    &[(0, CYCLE), (10, "cycle, lost"), (20, "cycle, lost"), (25, "brake_by: brakes fully")];

/// The CAV brakes fully a period later than tau says.
pub const LATE: &Events =
    &[(0, CYCLE), (10, "cycle, lost"), (20, "cycle, lost"), (25, "brake_by"), (35, "brakes fully")];

/// Control goes on until a cycle is unsafe.
pub const IGNORED: &Events = &[
    (0, CYCLE),
    (10, "safe cycle, no trajectory"),
    (20, "safe cycle, no trajectory"),
    (30, "safe cycle, no trajectory"),
    (40, "safe cycle, no trajectory"),
    (50, "cycle, unsafe: brakes fully"),
];

const CYCLE: &str = "cycle, safe";

/// tau = 0.25 s, the default a_max and a_b.
pub fn limits() -> Limits {
    let [a_max, a_b] = [3, 8].map(Real::from_integer);
    Limits { tau: Real::ratio(1, 4), a_max, a_b }
}

/// Takes down numbers for the table.
fn row(number: usize, event: &str, numbers: [&Real; 5]) {
    for (column, value) in COLUMNS.iter().zip(numbers) {
        given(equal(&Real::variable(&cell(number, event, column)), value));
    }
}

/// A vehicle that goes on at one acceleration from -a_tyre to `most`: its speed after dt, and its way.
fn piece(limits: &Limits, v: &Real, most: &Real, dt: &Real) -> (Real, Real) {
    let a = Real::variable("a");
    given(at_most(&-a_tyre(&limits.a_b), &a));
    given(at_most(&a, most));
    let after = v + &a * dt;
    given(at_most(&Real::zero(), &after));
    (after, driven(v, &a, dt))
}

/// In every drive with these events from a cycle that is safe (gap > s_react, or > s_stop), at 5 to 15 m/s, to standstill
/// the CAV stands so many centimetres before what is ahead.
pub fn stands_before(events: &Events, ahead: Ahead, centimetres: i64) -> Formula {
    let limits = limits();
    let (mut v, mut place) = (Real::variable("v"), Real::zero());
    let mut gap = Real::variable("gap");
    let mut w = match ahead {
        Ahead::Standing => Real::zero(),
        Ahead::Lead => Real::variable("w"),
    };
    given(at_most(&Real::from_integer(5), &v));
    given(at_most(&v, &Real::from_integer(15)));
    given(at_most(&Real::zero(), &w));
    let examined = Examined { left: limits.tau.clone(), gap: gap.clone(), w: w.clone() };
    given(limits.holds(&v, &examined));
    for (number, (at, event)) in events.iter().enumerate() {
        if let Some((before, _)) = number.checked_sub(1).map(|before| events[before]) {
            let dt = Real::ratio(at - before, 100);
            let (speed, way) = piece(&limits, &v, &limits.a_max, &dt);
            let (of_lead, lead_way) = match ahead {
                Ahead::Standing => (Real::zero(), Real::zero()),
                Ahead::Lead => piece(&limits, &w, &Real::zero(), &dt),
            };
            (v, place, gap, w) = (speed, place + &way, gap + lead_way - way, of_lead);
        }
        let time = Real::ratio(*at, 100);
        row(number, event, [&time, &place, &v, &gap, &w]);
    }
    // The lead, which is not faster, stands first.
    given(at_most(&w, &v));
    let (last, _) = events[events.len() - 1];
    let way = s_b(&v, &limits.a_b);
    let time = Real::ratio(last, 100) + &v / &limits.a_b;
    let rest = gap + s_b(&w, &a_tyre(&limits.a_b)) - &way;
    let zero = Real::zero();
    row(events.len(), "stands", [&time, &(place + way), &zero, &rest, &zero]);
    less(&Real::ratio(centimetres, 100), &rest)
}
