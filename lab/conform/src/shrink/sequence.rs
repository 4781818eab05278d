//! A sequence of the monitor made smaller: a later start, cycles that measure less, everything of an event at its
//! time, round times.

use serde_json::{Value, json};

use crate::shrink::cycle::rounded;
use crate::shrink::record::{Case, leaves};

/// Events so long before a session is confirmed may be what it comes of, ns: its request; a list of detections half a
/// second before that; a history.
const BEFORE_NS: [i64; 3] = [20_000_000, 620_000_000, 1_100_000_000];

/// What a cycle may do without, the longest first.
const OPTIONAL: [&str; 5] = ["grid", "tracks", "trajectory", "detections", "lead"];

/// Fewer events: the monitor is started at a later session, numbered on from the one before.
pub fn shorter(case: &mut Case<'_>) {
    let events = case.value["events"].as_array().cloned().unwrap_or_default();
    let time = |event: &Value| event["t_ns"].as_i64().unwrap_or(0);
    let confirmed = events.iter().rev().filter(|event| event["type"] == "confirm");
    // Where both groups are asked for, PLAN has the second number.
    let starts = confirmed.flat_map(|event| {
        let session = event["session"].as_i64().unwrap_or(0);
        let of = |last: i64| BEFORE_NS.map(|it| (last, time(event).saturating_sub(it)));
        [of(session.saturating_sub(1)), of(session.saturating_sub(2))].concat()
    });
    for (last_session, start_ns) in starts {
        // Offers stay: a station may have made its own long before.
        let is_kept = |event: &&Value| event["type"] == "offer" || time(event) >= start_ns;
        let kept: Vec<Value> = events.iter().filter(is_kept).cloned().collect();
        let is_shorter = kept.len() < events.len();
        if is_shorter
            && case.change(|record| {
                record["events"] = kept.into();
                record["last_session"] = json!(last_session);
            })
        {
            break;
        }
    }
}

/// Cycles that measure less, sessions from 1 on, and numbers with fewer digits.
pub fn rounder(case: &mut Case<'_>) {
    let cycles = leaves(&case.value, |place, _| place.ends_with("/measured/ego/x"));
    let cycles: Vec<String> =
        cycles.iter().filter_map(|it| it.strip_suffix("/ego/x")).map(str::to_owned).collect();
    for key in OPTIONAL {
        let without = |case: &mut Case<'_>, places: &[String]| {
            case.change(|record| {
                for place in places {
                    let measured = record.pointer_mut(place).and_then(Value::as_object_mut);
                    measured.map(|it| it.remove(key));
                }
            })
        };
        if !without(case, &cycles) {
            for place in cycles.chunks(1) {
                without(case, place);
            }
        }
    }
    let before = case.value["last_session"].as_i64().unwrap_or(0);
    case.change(|record| {
        record["last_session"] = json!(0);
        for event in record["events"].as_array_mut().into_iter().flatten() {
            if let Some(session) = event.get("session").and_then(Value::as_i64) {
                event["session"] = json!(session.saturating_sub(before));
            }
        }
    });
    times(case);
    rounded(case);
}

/// The first event at 0; what an event holds at the time of the event; each event, with all that it holds, at a
/// multiple of 100, 10 or 1 ms.
fn times(case: &mut Case<'_>) {
    let of = |case: &Case<'_>, prefix: &str| {
        leaves(&case.value, |place, _| place.starts_with(prefix) && place.ends_with("_ns"))
    };
    let moved = |case: &mut Case<'_>, prefix: &str, by_ns: i64| {
        let places = of(case, prefix);
        case.change_at(&places, |old| Some(json!(old.as_i64()?.saturating_add(by_ns))))
    };
    let first_ns = case.value["events"][0]["t_ns"].as_i64().unwrap_or(0);
    moved(case, "/events/", first_ns.saturating_neg());
    for at in 0..case.value["events"].as_array().map_or(0, Vec::len) {
        let prefix = format!("/events/{at}/");
        let time_ns = case.value["events"][at]["t_ns"].as_i64().unwrap_or(0);
        for place in of(case, &prefix) {
            if place.ends_with("stamp_ns") || place.ends_with("generated_ns") {
                case.put(&place, [time_ns]);
            }
        }
        let _ = [100_000_000, 10_000_000, 1_000_000].into_iter().any(|unit| {
            let over_ns = time_ns.rem_euclid(unit);
            over_ns == 0 || moved(case, &prefix, -over_ns) || moved(case, &prefix, unit - over_ns)
        });
    }
}
