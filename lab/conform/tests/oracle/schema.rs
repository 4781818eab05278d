//! The rules of `spec/5-interfaces.md` for numbers, keys, traces and compositions, one test per
//! rule, named after it.

use mufasa_records::cycles_from_lines;
use serde_json::{Value, json};

use crate::common::{COMPOSITION, CYCLE, TRACE, accepted, answer, refused, with};

/// The x of the CAV when `text` stands there.
fn x(text: &str) -> f64 {
    let line = with(CYCLE, "\"ego\": {\"x\": 0", &format!("\"ego\": {{\"x\": {text}"));
    cycles_from_lines(&line).remove(0).unwrap().1.ego.x
}

fn now(text: &str) -> String {
    with(CYCLE, "\"now_ns\": 1000", &format!("\"now_ns\": {text}"))
}

#[test]
fn numbers_are_read_as_the_nearest_double() {
    let third = "0.333333333333333314829616256247390992939472198486328125";
    let half_way_up = "1.00000000000000011102230246251565404236316680908203125";
    for (text, value) in [
        ("0.1", 0.1),
        (third, 1.0 / 3.0),
        // Half way between two doubles goes to the even one, anything above it upwards.
        (half_way_up, 1.0),
        ("1.000000000000000111022302462515654042363166809082031250000000001", 1.0 + f64::EPSILON),
        ("9007199254740993", 9_007_199_254_740_992.0),
        ("1E2", 100.0),
        ("5e-324", f64::from_bits(1)),
        ("2e-324", 0.0),
        ("17976931348623157e292", f64::MAX),
    ] {
        assert_eq!(x(text).to_bits(), value.to_bits(), "{text}");
    }
    assert_eq!(x("-0").to_bits(), (-0.0_f64).to_bits());
    let long = format!("{}e-399", "1".repeat(400));
    assert_eq!(x(&long).to_bits(), 1.111_111_111_111_111_1_f64.to_bits());
}

#[test]
fn the_strings_nan_inf_and_minus_inf_stand_for_those_values() {
    assert!(x("\"nan\"").is_nan());
    assert_eq!(x("\"inf\"").to_bits(), f64::INFINITY.to_bits());
    assert_eq!(x("\"-inf\"").to_bits(), f64::NEG_INFINITY.to_bits());
    for wrong in ["\"NaN\"", "\"+inf\"", "\"infinity\"", "\"1\"", "\"\"", "true", "[]", "null"] {
        let line = with(CYCLE, "\"ego\": {\"x\": 0", &format!("\"ego\": {{\"x\": {wrong}"));
        refused(&line, "ego.x", None);
    }
}

#[test]
fn a_number_beyond_the_range_of_doubles_is_infinite_hence_invalid() {
    for (text, value) in [("1e400", f64::INFINITY), ("-1e999999999999999999999", f64::NEG_INFINITY)]
    {
        assert_eq!(x(text).to_bits(), value.to_bits());
        let line = with(CYCLE, "\"ego\": {\"x\": 0", &format!("\"ego\": {{\"x\": {text}"));
        refused(&line, "ego.x", None);
    }
    let remote = accepted(&with(CYCLE, "\"vy\": 0", "\"vy\": 1e400"));
    assert_eq!(remote["failed_stage"], "input");
}

/// INPUT-01
#[test]
fn fractions_and_exponents_are_errors_where_an_integer_is_asked_for() {
    for wrong in ["1000.0", "1e3", "1E3", "1000.5", "1e0", "\"1000\"", "\"nan\"", "true", "null"] {
        refused(&now(wrong), "now_ns", None);
    }
    refused(&with(CYCLE, "\"id\": 7", "\"id\": 7.0"), "tracks.items.id", Some(0));
    refused(&with(CYCLE, "\"t_ns\": 1000", "\"t_ns\": 1e3"), "trajectory.points.t_ns", Some(0));
    refused(&with(CYCLE, "\"width\": 10,", "\"width\": 1e1,"), "grid.width", None);
}

#[test]
fn an_integer_outside_64_bits_breaks_the_schema() {
    for wrong in ["9223372036854775808", "-9223372036854775809", "100000000000000000000000"] {
        refused(&now(wrong), "now_ns", None);
    }
    for right in ["9223372036854775807", "-9223372036854775808", "-0"] {
        let cycle = cycles_from_lines(&now(right)).remove(0).unwrap().1;
        assert_eq!(cycle.now_ns, right.parse::<i64>().unwrap());
    }
}

/// INPUT-01
#[test]
fn unknown_fields_are_an_error() {
    for (text, before, path, index) in [
        (CYCLE, "{\"kind\"", "", None),
        (CYCLE, "{\"x\": 0, \"y\": 0, \"cos\": 1, \"sin\": 0, \"speed\"", "ego.", None),
        (CYCLE, "{\"stamp_ns\": 900, \"points\"", "trajectory.", None),
        (CYCLE, "{\"t_ns\"", "trajectory.points.", Some(0)),
        (CYCLE, "{\"id\": 7", "tracks.items.", Some(0)),
        (CYCLE, "{\"x\": 30", "detections.items.", Some(0)),
        (CYCLE, "{\"stamp_ns\": 900, \"gap\"", "lead.", None),
        (CYCLE, "{\"closed\"", "route.", None),
        (CYCLE, "{\"x\": 100", "route.stations.", Some(1)),
        (CYCLE, "{\"stamp_ns\": 900, \"x\"", "grid.", None),
        (TRACE, "{\"kind\"", "", None),
        (TRACE, "{\"t_wait_ns\"", "parameters.", None),
        (TRACE, "{\"t_ns\": 1, \"type\": \"tick\"", "events.", Some(2)),
        (COMPOSITION, "{\"kind\"", "", None),
        (COMPOSITION, "{\"id\": \"mot\"", "services.", Some(1)),
    ] {
        let more = before.replacen('{', "{\"extra\": [1, {}], ", 1);
        refused(&with(text, before, &more), &format!("{path}extra"), index);
    }
}

#[test]
fn fields_of_another_type_of_event_are_unknown() {
    for (event, field) in [
        (r#"{"t_ns": 0, "type": "tick", "station": 1}"#, "station"),
        (r#"{"t_ns": 0, "type": "lost", "station": 1, "groups": []}"#, "groups"),
        (r#"{"t_ns": 0, "type": "offer", "station": 1, "group": "mot", "groups": []}"#, "group"),
        (r#"{"t_ns": 0, "type": "area", "groups": [], "station": 1}"#, "station"),
        (
            r#"{"t_ns": 0, "type": "confirm", "station": 1, "group": "mot", "session": 1, "generated_ns": 1}"#,
            "generated_ns",
        ),
        (
            r#"{"t_ns": 0, "type": "verdict", "verdict": "safe", "sessions": {}, "safe": true}"#,
            "safe",
        ),
    ] {
        refused(&trace(event), &format!("events.{field}"), Some(0));
    }
}

/// INPUT-01
#[test]
fn duplicate_keys_are_an_error() {
    for (text, pair, path, index) in [
        (CYCLE, "\"now_ns\": 1000", "now_ns", None),
        (CYCLE, "\"kind\": \"cycle\"", "kind", None),
        (CYCLE, "\"id\": \"c\"", "id", None),
        (CYCLE, "\"speed\": 0", "ego.speed", None),
        (CYCLE, "\"vx\": 10", "tracks.items.vx", Some(0)),
        (CYCLE, "\"left\": [100, 2]", "route.stations.left", Some(1)),
        (CYCLE, "\"unknown\": null", "grid.unknown", None),
        (TRACE, "\"type\": \"lost\"", "events.type", Some(7)),
        (TRACE, "\"generated_ns\": 1", "events.generated_ns", Some(5)),
        (COMPOSITION, "\"goal\": \"mot\"", "goal", None),
        (COMPOSITION, "\"guarantees\": [\"tracks\"]", "services.guarantees", Some(1)),
    ] {
        refused(&with(text, pair, &format!("{pair}, {pair}")), path, index);
    }
    let escaped = with(CYCLE, "\"now_ns\": 1000", r#""now_ns": 1000, "\u006eow_ns": 1000"#);
    refused(&escaped, "now_ns", None);
    let parameter = "\"parameters\": {\"n\": 4, \"n\": 4}";
    refused(&with(CYCLE, "\"parameters\": {}", parameter), "parameters.n", None);
}

/// A trace of one event.
fn trace(event: &str) -> String {
    format!("{{\"kind\": \"offloading\", \"id\": \"o\", \"events\": [{event}]}}")
}

#[test]
fn parameters_of_a_trace_are_those_five() {
    let given = |parameters: &str| with(TRACE, "{\"t_wait_ns\": 10000000000}", parameters);
    accepted(&given(
        r#"{"t_wait_ns": 0, "request_timeout_ns": 0, "l_max_ns": 9223372036854775807, "dt_max_ns": 0, "qos_hold": true}"#,
    ));
    accepted(&given("{}"));
    accepted(&with(TRACE, "\"parameters\": {\"t_wait_ns\": 10000000000}, ", ""));
    for (wrong, field) in [
        (r#"{"t_wait_ns": -1}"#, ".t_wait_ns"),
        (r#"{"l_max_ns": -1}"#, ".l_max_ns"),
        (r#"{"dt_max_ns": 1.0}"#, ".dt_max_ns"),
        (r#"{"request_timeout_ns": 9223372036854775808}"#, ".request_timeout_ns"),
        (r#"{"qos_hold": 1}"#, ".qos_hold"),
        (r#"{"theta_tr": 1}"#, ".theta_tr"),
        ("null", ""),
    ] {
        refused(&given(wrong), &format!("parameters{field}"), None);
    }
}

#[test]
fn parameters_of_a_trace_are_in_force() {
    let hold = |line: &str| accepted(line)["states"][6]["hold_until_ns"].clone();
    assert_eq!(hold(TRACE), 10_000_000_004_i64);
    assert_eq!(hold(&with(TRACE, "10000000000", "5")), 9);
}

/// INPUT-01
#[test]
fn an_unknown_type_of_event_is_an_error_with_its_index() {
    refused(&with(TRACE, "\"tick\"", "\"tock\""), "events.type", Some(2));
    refused(&with(TRACE, "\"type\": \"tick\"", "\"type\": null"), "events.type", Some(2));
    refused(&with(TRACE, ", \"type\": \"tick\"", ""), "events.type", Some(2));
}

/// INPUT-01
#[test]
fn an_unknown_group_is_an_error() {
    for wrong in ["\"MOT\"", "\"env\"", "0", "null", "[]"] {
        let event = format!(
            "{{\"t_ns\": 0, \"type\": \"reject\", \"station\": 1, \"group\": {wrong}, \"session\": 1}}"
        );
        refused(&trace(&event), "events.group", Some(0));
        let event = format!("{{\"t_ns\": 0, \"type\": \"area\", \"groups\": [\"mot\", {wrong}]}}");
        // The innermost list is that of the groups; the message names the event too.
        refused(&trace(&event), "events.groups", Some(1));
        let message = answer(&trace(&event))["error"]["message"].clone();
        assert!(message.as_str().unwrap().contains("events[0].groups[1]"), "{message}");
    }
}

#[test]
fn a_group_named_twice_counts_once() {
    let twice = trace(
        r#"{"t_ns": 0, "type": "offer", "station": 1, "groups": ["mot", "mot"]}, {"t_ns": 1, "type": "tick"}"#,
    );
    let once = trace(
        r#"{"t_ns": 0, "type": "offer", "station": 1, "groups": ["mot"]}, {"t_ns": 1, "type": "tick"}"#,
    );
    assert_eq!(accepted(&twice), accepted(&once));
    assert_eq!(accepted(&once)["states"][1]["mot"], "requested:1");
}

#[test]
fn stations_of_events_are_at_least_1() {
    for (kind, rest) in [
        ("offer", ", \"groups\": []"),
        ("withdraw", ""),
        ("lost", ""),
        ("confirm", ", \"group\": \"mot\", \"session\": 1"),
        ("reject", ", \"group\": \"mot\", \"session\": 1"),
        ("data", ", \"group\": \"mot\", \"session\": 1, \"generated_ns\": 1"),
    ] {
        let event = |station: &str| {
            trace(&format!("{{\"t_ns\": 0, \"type\": \"{kind}\", \"station\": {station}{rest}}}"))
        };
        accepted(&event("1"));
        accepted(&event("9223372036854775807"));
        refused(&event("0"), "events.station", Some(0));
        refused(&event("-1"), "events.station", Some(0));
    }
}

#[test]
fn a_verdict_of_an_event_is_safe_or_unsafe() {
    for wrong in ["\"error\"", "true", "null"] {
        refused(
            &with(TRACE, "\"verdict\": \"unsafe\"", &format!("\"verdict\": {wrong}")),
            "events.verdict",
            Some(6),
        );
    }
    accepted(&with(TRACE, "\"verdict\": \"unsafe\"", "\"verdict\": \"safe\""));
}

#[test]
fn more_than_10_000_events_are_an_error() {
    let ticks = |count: usize| trace(&vec![r#"{"t_ns": 0, "type": "tick"}"#; count].join(","));
    assert_eq!(accepted(&ticks(10_000))["states"].as_array().unwrap().len(), 10_000);
    refused(&ticks(10_001), "events", None);
    assert_eq!(accepted(&ticks(0))["states"], json!([]));
}

#[test]
fn times_of_events_may_stand_still_or_run_backwards() {
    let back = trace(
        r#"{"t_ns": 9223372036854775807, "type": "tick"}, {"t_ns": -9223372036854775808, "type": "tick"}"#,
    );
    assert_eq!(accepted(&back)["states"].as_array().unwrap().len(), 2);
}

#[test]
fn an_absent_goal_is_an_error() {
    refused(&with(COMPOSITION, "\"goal\": \"mot\", ", ""), "goal", None);
    refused(&with(COMPOSITION, "\"goal\": \"mot\"", "\"goal\": null"), "goal", None);
}

#[test]
fn a_goal_that_names_no_service_is_an_error() {
    refused(&with(COMPOSITION, "\"goal\": \"mot\"", "\"goal\": \"MOT\""), "goal", None);
    refused(&with(COMPOSITION, "\"goal\": \"mot\"", "\"goal\": \"\""), "goal", None);
}

#[test]
fn same_station_and_local_only_may_be_absent_but_not_null() {
    for (key, text) in [
        ("same_station", ", \"same_station\": [[\"env\", \"tpl\"]]"),
        ("local_only", ", \"local_only\": [\"control\"]"),
    ] {
        assert_eq!(accepted(&with(COMPOSITION, text, "")), accepted(COMPOSITION));
        refused(&with(COMPOSITION, text, &format!(", \"{key}\": null")), key, None);
        refused(
            &with(COMPOSITION, text, &format!(", \"{key}\": [[], 1]")),
            key,
            Some(usize::from(key == "same_station")),
        );
    }
}

/// Broken rules of a service set: the error names the service and the rule.
#[test]
fn a_service_set_that_breaks_a_rule_is_an_error_with_service_and_rule() {
    let rule = |old: &str, new: &str, field: &str, index: Option<usize>, words: [&str; 2]| {
        let line = with(COMPOSITION, old, new);
        refused(&line, field, index);
        let message = answer(&line)["error"]["message"].as_str().unwrap().to_owned();
        assert!(words.iter().all(|word| message.contains(word)), "{message}");
    };
    rule("\"id\": \"det\"", "\"id\": \"mot\"", "services.id", Some(1), ["mot", "twice"]);
    rule("[\"tracks\"]", "[\"a\", \"a\"]", "services.guarantees", Some(1), ["mot", "`a` twice"]);
    let requires = "\"requires\": [\"detections\"]";
    let twice = "\"requires\": [\"detections\", \"detections\"]";
    rule(requires, twice, "services.requires", Some(1), ["mot", "twice"]);
    rule("\"station\": 1", "\"station\": -1", "services.station", Some(1), ["mot", "-1"]);
    let empty = r#"{"kind": "composition", "id": "s", "services": [], "goal": "mot"}"#;
    refused(empty, "services", None);
}

#[test]
fn services_have_strings_and_integers() {
    refused(&with(COMPOSITION, "\"station\": 1", "\"station\": 1.0"), "services.station", Some(1));
    refused(&with(COMPOSITION, "[\"tracks\"]", "[\"tracks\", 1]"), "services.guarantees", Some(1));
    refused(&with(COMPOSITION, "[\"tracks\"]", "\"tracks\""), "services.guarantees", Some(1));
    refused(&with(COMPOSITION, "\"id\": \"det\"", "\"id\": 1"), "services.id", Some(0));
}

#[test]
fn without_a_composition_none_says_why() {
    let none = |line: &str| {
        let answer = accepted(line);
        assert_eq!(answer["compositions"], json!([]));
        answer["none"].clone()
    };
    assert_eq!(accepted(COMPOSITION)["none"], Value::Null);
    let less = with(COMPOSITION, "\"guarantees\": [\"detections\"]", "\"guarantees\": []");
    assert_eq!(none(&less), json!({"requirement": "detections", "service": "mot"}));
    let remote = with(COMPOSITION, "[\"control\"]", "[\"mot\"]");
    assert_eq!(none(&remote), json!({"rule": "local_only"}));
    let apart = with(COMPOSITION, "[\"env\", \"tpl\"]", "[\"det\", \"mot\"]");
    assert_eq!(none(&apart), json!({"rule": "same_station"}));
    let round = with(COMPOSITION, "\"requires\": []", "\"requires\": [\"tracks\"]");
    assert_eq!(none(&round), json!({"rule": "acyclic"}));
}

#[test]
fn more_than_10_000_closed_choices_are_an_error() {
    let mut services = Vec::new();
    let mut requires = Vec::new();
    for interface in 0..14 {
        requires.push(format!("\"i{interface}\""));
        for provider in ["a", "b"] {
            services.push(format!(
                "{{\"id\": \"{provider}{interface}\", \"requires\": [], \"guarantees\": [\"i{interface}\"], \"station\": 0}}"
            ));
        }
    }
    let goal = format!(
        "{{\"id\": \"goal\", \"requires\": [{}], \"guarantees\": [], \"station\": 0}}",
        requires.join(", ")
    );
    let line = format!(
        "{{\"kind\": \"composition\", \"id\": \"s\", \"services\": [{}, {goal}], \"goal\": \"goal\"}}",
        services.join(", ")
    );
    refused(&line, "services", None);
}

/// `spec/5-interfaces.md#offloading-trace`: an absent group was not used, another key is an error.
#[test]
fn a_verdict_names_sessions_of_groups() {
    let verdict = |sessions: &str| {
        trace(&format!(
            "{{\"t_ns\": 0, \"type\": \"verdict\", \"verdict\": \"safe\", \"sessions\": {sessions}}}"
        ))
    };
    for fine in ["{}", r#"{"mot": 1}"#, r#"{"plan": -3, "mot": 9223372036854775807}"#] {
        accepted(&verdict(fine));
    }
    refused(&verdict(r#"{"env": 1}"#), "events.sessions.env", Some(0));
    refused(&verdict(r#"{"mot": null}"#), "events.sessions.mot", Some(0));
    refused(&verdict(r#"{"mot": 1.5}"#), "events.sessions.mot", Some(0));
    refused(&verdict("[1]"), "events.sessions", Some(0));
}
