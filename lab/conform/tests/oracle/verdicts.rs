//! Every verdict that a cycle can have, in the words of `spec/5-interfaces.md#cycle`.

use serde_json::{Value, json};

use crate::oracle::common::{CYCLE, answer};

/// The safe cycle with one thing changed.
fn changed(change: impl FnOnce(&mut Value)) -> Value {
    let mut record: Value = serde_json::from_str(CYCLE).unwrap();
    change(&mut record);
    answer(&record.to_string())
}

/// `record` without these inputs.
fn without(record: &mut Value, keys: &[&str]) {
    for key in keys {
        record[key] = Value::Null;
    }
}

/// Puts the first item of a list at a place beside the road or on it.
fn put(record: &mut Value, list: &str, x: f64, y: f64) {
    record[list]["items"][0]["x"] = json!(x);
    record[list]["items"][0]["y"] = json!(y);
}

/// CYCLE-01, CYCLE-02: an answer of every kind, and which members it has.
#[test]
fn a_verdict_is_safe_unsafe_or_error_and_a_failed_stage_has_its_name() {
    let unsafe_at = |stage: &str, answer: Value| (json!("unsafe"), json!(stage), answer);
    let answers = [
        (json!("safe"), Value::Null, changed(|_| {})),
        (json!("error"), Value::Null, changed(|record| record["ego"]["speed"] = json!(-1))),
        unsafe_at("input", changed(|record| record["tracks"]["items"][0]["vx"] = json!("nan"))),
        unsafe_at("i", changed(|record| put(record, "tracks", 29.0, 1.0))),
        unsafe_at("ii", changed(|record| record["trajectory"]["points"][0]["y"] = json!(9))),
        unsafe_at(
            "iii",
            changed(|record| {
                put(record, "tracks", 5.0, 0.0);
                put(record, "detections", 5.0, 0.0);
            }),
        ),
        unsafe_at(
            "iv",
            changed(|record| {
                without(record, &["tracks", "lead"]);
                put(record, "detections", 5.0, 0.0);
            }),
        ),
        unsafe_at(
            "v",
            changed(|record| {
                without(record, &["tracks", "detections"]);
                record["grid"]["occupied"] = json!("/////w==");
            }),
        ),
        unsafe_at(
            "no_obstacle_check",
            changed(|record| {
                record["profile"] = json!("hardened");
                without(record, &["tracks", "detections", "lead", "grid"]);
            }),
        ),
    ];
    for (verdict, failed_stage, answer) in answers {
        assert_eq!((&answer["verdict"], &answer["failed_stage"]), (&verdict, &failed_stage));
        assert_eq!(answer["id"], "c");
        let is_error = verdict == "error";
        assert_eq!(answer.get("error").is_some(), is_error, "{answer}");
        assert_eq!(answer.get("stages").is_none(), is_error, "{answer}");
        assert_eq!(answer.get("input").is_some(), failed_stage == "input", "{answer}");
        if let Some(stage) = answer["stages"].get(failed_stage.as_str().unwrap_or_default()) {
            assert_eq!(stage["outcome"], "failed", "{answer}");
        }
    }
}

/// CYCLE-03: field, index and message.
#[test]
fn an_error_has_field_index_and_message() {
    let answer = changed(|record| record["route"]["stations"][1]["left"][0] = json!("inf"));
    let error = answer["error"].as_object().unwrap();
    assert_eq!((&error["field"], &error["index"]), (&json!("route.stations.left"), &json!(1)));
    assert!(error["message"].as_str().is_some_and(|message| !message.is_empty()));
}

/// CYCLE-04: the mean distance is the root of 2, whose nearest double this
/// is, and `theta_tr` the double nearest to 0.2, which is not 0.2.
#[test]
fn compared_numbers_are_shortest_decimals_of_the_nearest_doubles() {
    let answer = changed(|record| {
        put(record, "tracks", 29.0, 1.0);
        put(record, "detections", 30.0, 0.0);
    });
    let compared = &answer["stages"]["i"]["witness"]["compared"];
    assert_eq!(*compared, json!(["1.4142135623730951", "0.2"]));
}
