//! The examples of `spec/5-interfaces.md`, taken from its text.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

use crate::oracle::common::{accepted, refused};

const SPEC: &str = include_str!("../../../../spec/5-interfaces.md");

/// The indented block after the first line that begins with `before`.
fn block(before: &str) -> String {
    SPEC.lines()
        .skip_while(|line| !line.starts_with(before))
        .skip(1)
        .skip_while(|line| line.is_empty())
        .take_while(|line| line.starts_with("    "))
        .collect::<Vec<_>>()
        .join(" ")
}

/// The example of a cycle with a bitmap in place of the words that stand there.
fn cycle() -> String {
    let zeros = STANDARD.encode(vec![0; 600 * 200 / 8]);
    let words = "base64 of the bitmap, row-major from the origin, least significant bit first";
    block("## Cycle").replace(words, &zeros)
}

/// The example itself holds words for a bitmap.
#[test]
fn the_example_of_a_cycle_is_refused_at_its_bitmap() {
    refused(&block("## Cycle"), "grid.occupied", None);
}

/// The witness of the example names point 4, of one point: only its form can be compared.
#[test]
fn the_example_of_a_cycle_is_answered_in_the_form_shown() {
    let shown: Value = serde_json::from_str(&block("Answer:")).unwrap();
    let answer = accepted(&cycle());
    let keys = |value: &Value| value.as_object().unwrap().keys().cloned().collect::<Vec<_>>();
    assert_eq!(keys(&answer), keys(&shown));
    assert_eq!(keys(&answer["stages"]), keys(&shown["stages"]));
    assert_eq!(answer["id"], shown["id"]);
}

/// The lead at 25 m is nearer than the 25.02 m of the legal safety distance at 13.9 m/s and the
/// 5.8 m by which the CAV brakes longer, but stage iii ran and so stage iv does not.
#[test]
fn the_example_of_a_cycle_is_safe_in_the_paper_profile() {
    let answer = accepted(&cycle());
    assert_eq!(answer["verdict"], "safe");
    let passed = json!({"outcome": "passed"});
    let skipped = json!({"outcome": "skipped", "reason": "other_stage_ran"});
    assert_eq!(
        answer["stages"],
        json!({"i": passed, "ii": passed, "iii": passed, "iv": skipped, "v": skipped})
    );
    assert_eq!((&answer["strict"], &answer["lax"]), (&json!("safe"), &json!("safe")));
}

/// Moved to the CAV, the track of the example collides; the answer then has the form shown for
/// stage iii.
#[test]
fn a_collision_in_the_example_is_answered_as_shown() {
    let shown: Value = serde_json::from_str(&block("Answer:")).unwrap();
    let near = cycle()
        .replace("\"id\": 7, \"x\": 30", "\"id\": 7, \"x\": 5.4")
        .replace("[{\"x\": 30, \"y\": 0.1", "[{\"x\": 5.4, \"y\": 0")
        // A stamp at the time of the point, so that nothing is predicted.
        .replace("\"tracks\": {\"stamp_ns\": 990000000", "\"tracks\": {\"stamp_ns\": 1000000000");
    let mut answer = accepted(&near);
    let witness = answer["stages"]["iii"]["witness"].as_object_mut().unwrap();
    assert_eq!(witness.insert("point".into(), json!(4)), Some(json!(0)));
    let compared = witness.insert("compared".into(), json!(["4.1", "5"])).unwrap();
    // The centres of track and CAV are 5.4 - 1.4 m apart; 4 is a double, 5.4 - 1.4 is not quite.
    let distance: f64 = compared[0].as_str().unwrap().parse().unwrap();
    assert!((distance - 4.0).abs() < 1e-14, "{compared}");
    assert_eq!(compared[1], "5");
    assert_eq!(answer, shown);
}

#[test]
fn the_example_of_a_trace_is_answered_as_shown() {
    let trace = block("## Offloading trace");
    let answer = accepted(&trace);
    let shown = SPEC.lines().find_map(|line| line.strip_prefix("Answer: `")).unwrap();
    let first = shown.split(", ...]}`").next().unwrap();
    let shown: Value = serde_json::from_str(&format!("{first}]}}")).unwrap();
    assert_eq!(answer["id"], shown["id"]);
    assert_eq!(answer["states"][0], shown["states"][0]);
    let request = |group: &str, session: i64| json!({"send": "request", "station": 1, "group": group, "session": session});
    let release = |group: &str, session: i64| json!({"send": "release", "station": 1, "group": group, "session": session});
    assert_eq!(
        answer["states"],
        json!([
            {"mot": "local", "plan": "local", "hold_until_ns": null, "actions": []},
            {"mot": "requested:1", "plan": "requested:1", "hold_until_ns": null,
             "actions": [request("mot", 1), request("plan", 2)]},
            {"mot": "remote:1", "plan": "requested:1", "hold_until_ns": null,
             "actions": [{"deactivate": "mot"}]},
            {"mot": "remote:1", "plan": "requested:1", "hold_until_ns": null, "actions": []},
            {"mot": "local", "plan": "local", "hold_until_ns": 10_000_000_004_i64,
             "actions": [release("mot", 1), release("plan", 2), {"activate": "mot"}]},
        ])
    );
}

/// The example of a composition leaves services out; with them it is answered in the form shown.
#[test]
fn the_example_of_a_composition_is_answered_in_the_form_shown() {
    let example = SPEC
        .lines()
        .find_map(|line| line.strip_prefix("`{\"kind\": \"composition\""))
        .and_then(|line| line.split('`').next())
        .map(|rest| format!("{{\"kind\": \"composition\"{rest}"))
        .unwrap();
    let services = r#"{"id": "detection", "requires": [], "guarantees": ["detections"], "station": 1}, {"id": "actuation", "requires": ["tracks"], "guarantees": [], "station": 0}"#;
    let answer = accepted(&example.replace("...", services));
    assert_eq!(
        answer,
        json!({
            "id": "s-1",
            "compositions": [{
                "members": ["actuation", "detection", "mot"],
                "links": [["detection", "detections", "mot"], ["mot", "tracks", "actuation"]],
                "switches": [["detection", "mot"]],
                "distributed": true,
            }],
            "none": null,
        })
    );
}
