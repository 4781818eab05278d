//! Times of a log that seem to be in another unit.

use serde_json::Value;

/// Times this near to each other are of one clock and unit, ns.
const NEAR_NS: i64 = 2_000_000_000;

/// The times that an event has beside its own, ns.
pub(super) fn stamps(event: &Value) -> Vec<(String, i64)> {
    let of = |(key, it): (&String, &Value)| match it.as_i64() {
        Some(ns) if key == "stamp_ns" || key == "generated_ns" => vec![(key.clone(), ns)],
        _ => stamps(it).into_iter().map(|(name, ns)| (format!("{key}.{name}"), ns)).collect(),
    };
    event.as_object().into_iter().flatten().flat_map(of).collect()
}

/// Whether a time is that of the call in us, ms or s, or the other way round.
pub(super) fn is_in_another_unit(now_ns: i64, ns: i64) -> bool {
    let near = |a: i64, b: i64| a.saturating_sub(b).saturating_abs() <= NEAR_NS;
    let factors = [1_000_i64, 1_000_000, 1_000_000_000];
    let is_other =
        |by: &i64| near(now_ns, ns.saturating_mul(*by)) || near(now_ns.saturating_mul(*by), ns);
    !near(now_ns, ns) && factors.iter().any(is_other)
}
