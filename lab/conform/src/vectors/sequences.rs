//! Sequences of the monitor as authors write them: what they leave out is that of the base.
//!
//! * settings that are left out are those of [`SETTINGS`]; the route is that of the base cycle;
//! * a cycle measures what the base cycle does but the grid, all of it stamped with its own time; `measured` is
//!   what differs, by pointer (RFC 6901);
//! * data are those of the base cycle, generated and stamped when they arrive, unless `generated_ns` and
//!   `stamp_ns` say otherwise; a list of `count` tracks repeats the first.

use std::fmt::Display;

use serde_json::{Map, Value, from_str, json};

/// Settings that every sequence but those about settings has.
const SETTINGS: &str = r#"{
    "kind": "monitor", "id": "", "profile": "hardened", "period_ns": 100000000,
    "parameters": {"tau": 0.2, "dt_max_ns": 200000000}
}"#;

/// Time of the decision in the base cycle, ns.
const NOW: i64 = 1_000_000_000;

/// The record of a sequence, written out.
pub fn written_out(sequence: &str, base: &str) -> Result<String, String> {
    let base: Value = from_str(base).map_err(text)?;
    let mut record: Map<String, Value> = from_str(SETTINGS).map_err(text)?;
    record.insert(String::from("route"), base["route"].clone());
    let changes: Map<String, Value> = from_str(sequence).map_err(text)?;
    for (key, value) in changes {
        if let (Some(old), Value::Object(new)) = (record.get_mut(&key), &value)
            && let Some(old) = old.as_object_mut()
        {
            old.extend(new.clone());
        } else {
            record.insert(key, value);
        }
    }
    let events = record.get_mut("events").and_then(Value::as_array_mut).ok_or("has no events")?;
    for event in events {
        complete(event, &base)?;
    }
    Ok(Value::Object(record).to_string())
}

fn text(error: impl Display) -> String {
    error.to_string()
}

/// An event with all its fields.
fn complete(event: &mut Value, base: &Value) -> Result<(), String> {
    let t_ns = event["t_ns"].as_i64().ok_or("an event has no t_ns")?;
    let event = event.as_object_mut().ok_or("an event is no object")?;
    let kind = event.get("type").and_then(Value::as_str).unwrap_or_default().to_owned();
    match kind.as_str() {
        "cycle" => {
            let changes = event.remove("measured").unwrap_or_else(|| json!({}));
            event.insert(String::from("measured"), measured(base, t_ns, &changes)?);
        }
        "tracks" | "trajectory" => {
            let stamp_ns = event.remove("stamp_ns").and_then(|it| it.as_i64()).unwrap_or(t_ns);
            let mut content = stamped(&base[&kind], stamp_ns);
            if let Some(count) = event.remove("count").and_then(|it| it.as_i64()) {
                let first = content["items"][0].clone();
                let track = |id| {
                    let mut track = first.clone();
                    track["id"] = Value::from(id);
                    track
                };
                content["items"] = (0..count).map(track).collect();
            }
            event.entry("generated_ns").or_insert(Value::from(t_ns));
            event.insert(kind, content);
        }
        _ => {}
    }
    Ok(())
}

/// What the base cycle measures, stamped with another time, and what differs.
fn measured(base: &Value, t_ns: i64, changes: &Value) -> Result<Value, String> {
    // Without the grid, which is the largest part of a cycle.
    let mut measured = json!({"ego": base["ego"], "grid": null});
    for key in ["trajectory", "tracks", "detections", "lead"] {
        measured[key] = stamped(&base[key], t_ns);
    }
    for (pointer, value) in changes.as_object().into_iter().flatten() {
        let place = measured.pointer_mut(pointer).ok_or_else(|| format!("no {pointer}"))?;
        *place = value.clone();
    }
    Ok(measured)
}

/// Data of the base with another stamp; the points of a trajectory move with it.
fn stamped(data: &Value, stamp_ns: i64) -> Value {
    let mut data = data.clone();
    if data.is_object() {
        data["stamp_ns"] = Value::from(stamp_ns);
    }
    for point in data.get_mut("points").and_then(Value::as_array_mut).into_iter().flatten() {
        let t_ns = point["t_ns"].as_i64().unwrap_or(0);
        point["t_ns"] = Value::from(t_ns.saturating_add(stamp_ns.saturating_sub(NOW)));
    }
    data
}
