//! Quality of service (`spec/2-offloading.md#quality-of-service`), from an arbitrary state of the
//! session: one step is enough, because every later one starts from such a state again.

use mufasa::offloading::quality_of_service::{
    Arrivals, Element, Limits, Violation, latency_violation,
};

use super::any::{duration_ns, option, time_ns};
#[cfg(not(kani))]
use crate::kani;

/// Latency is a violation beyond `l_max` and at no less, and always for data from the future [QOS-03, QOS-05, FALL-10].
///
/// Domain: all times and limits of 64 bits. Not covered: nothing of this function.
#[cfg_attr(kani, kani::proof)]
pub fn verify_latency_is_exact() {
    let (now_ns, generated_ns, limits) = (time_ns(), time_ns(), limits());
    let latency_ns = i128::from(now_ns) - i128::from(generated_ns);
    let found = latency_violation(now_ns, generated_ns, limits);
    let expected = if latency_ns < 0 {
        Some(Violation::FromTheFuture)
    } else if latency_ns > i128::from(limits.l_max_ns) {
        Some(Violation::Latency)
    } else {
        None
    };
    assert!(found == expected);
    kani::cover!(found == Some(Violation::FromTheFuture), "from the future");
    kani::cover!(found == Some(Violation::Latency), "too late");
    kani::cover!(latency_ns == i128::from(limits.l_max_ns), "exactly l_max is no violation");
    kani::cover!(latency_ns > i128::from(i64::MAX), "a latency beyond 64 bits");
}

/// Silence is a violation beyond `dt_max` and at no less; time that runs backwards is none [QOS-03, QOS-04, FALL-10].
///
/// Domain: all states, times and limits of 64 bits. Not covered: nothing of this function.
#[cfg_attr(kani, kani::proof)]
pub fn verify_silence_is_exact() {
    let (arrivals, now_ns, limits) = (arrivals(), time_ns(), limits());
    let silent_ns = i128::from(now_ns) - i128::from(arrivals.last_arrival_ns());
    let found = arrivals.silence(now_ns, limits);
    assert!(found.is_some() == (silent_ns > i128::from(limits.dt_max_ns)));
    kani::cover!(found == Some(Violation::InterArrival), "silent for too long");
    kani::cover!(silent_ns == i128::from(limits.dt_max_ns), "exactly dt_max is no violation");
    kani::cover!(silent_ns < 0, "time that runs backwards");
}

/// Every element is used, stale or violating as the text says, and nothing else changes: violating
/// ones are no arrivals, stale ones are, and only a used one moves the order on [QOS-01, QOS-02, QOS-08].
///
/// Domain: all states, times and limits of 64 bits. Not covered: nothing of this function.
#[cfg_attr(kani, kani::proof)]
pub fn verify_arrivals_take_an_element() {
    let (before, now_ns, generated_ns) = (arrivals(), time_ns(), time_ns());
    let limits = limits();
    let mut after = before;
    let found = after.arrive(now_ns, generated_ns, limits);
    let violation =
        latency_violation(now_ns, generated_ns, limits).or(before.silence(now_ns, limits));
    let ordered = before.last_used_ns().is_none_or(|last_ns| last_ns < generated_ns);
    let (expected, arrived_ns, used_ns) = match violation {
        Some(violation) => {
            (Element::Violating(violation), before.last_arrival_ns(), before.last_used_ns())
        }
        None if ordered => (Element::Used, now_ns, Some(generated_ns)),
        None => (Element::Stale, now_ns, before.last_used_ns()),
    };
    assert!(found == expected);
    assert!(after.last_arrival_ns() == arrived_ns);
    assert!(after.last_used_ns() == used_ns);
    assert!(after.has_used() == used_ns.is_some());
    kani::cover!(found == Element::Used, "used");
    kani::cover!(found == Element::Stale, "stale");
    kani::cover!(matches!(found, Element::Violating(_)), "violating");
    kani::cover!(
        found == Element::Stale && before.last_used_ns() == Some(generated_ns),
        "an equal generation time is stale"
    );
}

fn arrivals() -> Arrivals {
    let last_arrival_ns = time_ns();
    Arrivals::from_parts(last_arrival_ns, option(time_ns))
}

fn limits() -> Limits {
    Limits { l_max_ns: duration_ns(), dt_max_ns: duration_ns() }
}
