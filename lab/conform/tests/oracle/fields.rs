//! The rules of `spec/5-interfaces.md` for the fields of each kind of record.

use mufasa_model::input::cycle::Profile;
use mufasa_model::input::parameters::Parameters;
use mufasa_records::cycles_from_lines;
use serde_json::{Value, json};

use crate::oracle::common::{COMPOSITION, CYCLE, TRACE, accepted, answer, refused, with};
use crate::oracle::schema::{cycle, parameters, trace};

#[test]
fn profile_and_configuration_are_those_that_are_named() {
    assert_eq!(cycle(CYCLE).profile, Profile::PAPER);
    // By default it is the hardened one.
    for hardened in ["\"profile\": \"hardened\", ", ""] {
        let line = with(CYCLE, "\"profile\": \"paper\", ", hardened);
        assert_eq!(cycle(&line).profile, Profile::HARDENED);
    }
    for name in ["Local", "MotRemote", "AllRemote", "PlanRemote"] {
        let line = with(CYCLE, "AllRemote", name);
        assert_eq!(format!("{:?}", cycle(&line).configuration), name);
    }
}

macro_rules! override_each {
    ($($(#[$doc:meta])* $name:ident: $number:ident = $default:literal in $domain:expr;)*) => {
        /// Each parameter by its name, and what it then is.
        fn override_each() -> Vec<(&'static str, Parameters)> {
            let usual = Parameters::default;
            vec![
                $((stringify!($name), Parameters { $name: <$number>::from(7_u8), ..usual() }),)*
            ]
        }
    };
}

mufasa_model::parameters!(override_each);

#[test]
fn parameters_override_single_defaults_by_name() {
    let given = |text: &str| cycle(&parameters(text)).parameters;
    for (name, expected) in override_each() {
        assert_eq!(given(&format!("\"{name}\": 7")), expected, "{name}");
        assert_ne!(expected, Parameters::default(), "{name}");
    }
    let both = Parameters { a_b: 7.0, n: 3, ..Parameters::default() };
    assert_eq!(given("\"a_b\": 7, \"n\": 3"), both);
    assert_eq!(cycle(CYCLE).parameters, Parameters::default());
    accepted(&with(CYCLE, "\"parameters\": {}, ", ""));
    // A cycle checks the times of the protocol, and ignores them.
    for name in ["t_wait_ns", "request_timeout_ns", "l_max_ns", "dt_max_ns"] {
        let line = |value: &str| parameters(&format!("\"{name}\": {value}"));
        for right in ["0", "9223372036854775807"] {
            assert_eq!(cycle(&line(right)), cycle(CYCLE));
        }
        for wrong in ["-1", "1.5"] {
            refused(&line(wrong), &format!("parameters.{name}"), None);
        }
    }
}

#[test]
fn parameters_of_a_trace_are_those_five_and_in_force() {
    let given = |parameters: &str| with(TRACE, "{\"t_wait_ns\": 10000000000}", parameters);
    accepted(&given(
        r#"{"t_wait_ns": 0, "request_timeout_ns": 0, "l_max_ns": 9223372036854775807, "dt_max_ns": 0, "qos_hold": true}"#,
    ));
    accepted(&given("{}"));
    accepted(&with(TRACE, "\"parameters\": {\"t_wait_ns\": 10000000000}, ", ""));
    for (name, wrong) in
        [("l_max_ns", "-1"), ("dt_max_ns", "1.0"), ("request_timeout_ns", "9223372036854775808")]
    {
        let line = given(&format!("{{\"{name}\": {wrong}}}"));
        refused(&line, &format!("parameters.{name}"), None);
    }
    let hold = |line: &str| accepted(line)["states"][6]["hold_until_ns"].clone();
    assert_eq!(hold(TRACE), 10_000_000_004_i64);
    assert_eq!(hold(&given("{\"t_wait_ns\": 5}")), 9);
}

/// A missing input may be null or absent; it is named by its key.
#[test]
fn missing_inputs_may_be_null_or_absent() {
    let value: Value = serde_json::from_str(CYCLE).unwrap();
    for (key, none) in [
        ("tracks", "None"),
        ("detections", "None"),
        ("lead", "None"),
        ("grid", "None"),
        ("trajectory", "None"),
        ("detection_history", "[]"),
    ] {
        let (mut null, mut absent) = (value.clone(), value.clone());
        null[key] = Value::Null;
        absent.as_object_mut().unwrap().remove(key);
        assert_eq!(cycle(&null.to_string()), cycle(&absent.to_string()), "{key}");
        let one_less = format!("{:?}", cycle(&null.to_string()));
        assert!(one_less.contains(&format!("{key}: {none}")), "{key}");
    }
    assert_eq!(cycle(&with(CYCLE, ", \"unknown\": null", "")), cycle(CYCLE));
    for (key, stage) in [("tracks", "i"), ("trajectory", "ii"), ("grid", "v")] {
        let mut less = value.clone();
        less["configuration"] = json!("MotRemote");
        less[key] = Value::Null;
        let stages = accepted(&less.to_string())["stages"].clone();
        assert_eq!(stages[stage]["outcome"], "not_applicable", "{stages}");
        assert_eq!(stages[stage]["missing"], key, "{stages}");
    }
}

/// INPUT-01
#[test]
fn every_other_field_is_required_and_not_null() {
    let value: Value = serde_json::from_str(CYCLE).unwrap();
    let optional = [
        "/profile",
        "/parameters",
        "/tracks",
        "/detections",
        "/lead",
        "/grid",
        "/trajectory",
        "/detection_history",
        "/grid/unknown",
    ];
    let mut tried = 0;
    let mut open = vec![(String::new(), String::new(), None)];
    while let Some((pointer, path, index)) = open.pop() {
        match value.pointer(&pointer).unwrap() {
            Value::Object(fields) => {
                for key in fields.keys() {
                    let (inner, dot) =
                        (format!("{pointer}/{key}"), if path.is_empty() { "" } else { "." });
                    let field = format!("{path}{dot}{key}");
                    if !optional.contains(&inner.as_str()) {
                        tried += 1;
                        let mut less = value.clone();
                        less.pointer_mut(&pointer).unwrap().as_object_mut().unwrap().remove(key);
                        refused(&less.to_string(), &field, index);
                        let mut null = value.clone();
                        *null.pointer_mut(&inner).unwrap() = Value::Null;
                        refused(&null.to_string(), &field, index);
                    }
                    open.push((inner, field, index));
                }
            }
            Value::Array(items) if !path.ends_with("left") && !path.ends_with("right") => {
                for place in 0..items.len() {
                    open.push((format!("{pointer}/{place}"), path.clone(), Some(place)));
                }
            }
            _ => {}
        }
    }
    assert_eq!(tried, 6 + 8 + 2 + 5 + 2 + 9 + 2 + 6 + 3 + 2 + 2 * 4 + 9);
}

#[test]
fn bits_of_a_bitmap_are_read_and_unused_ones_ignored() {
    let line = with(CYCLE, "\"unknown\": null", "\"unknown\": \"/////w==\"");
    assert_eq!(cycle(&line).grid.unwrap().unknown, Some(vec![255; 4]));
    // 30 cells in 32 bits: the two highest of the last byte mean nothing.
    let with_bits = with(CYCLE, "AAAAAA==", "AAAAwA==");
    assert_eq!(cycle(&with_bits).grid.unwrap().occupied, [0, 0, 0, 0xc0]);
    let mut answer = accepted(&with_bits);
    assert_eq!(answer["verdict"], accepted(CYCLE)["verdict"]);
    assert_eq!(answer["stages"].take(), accepted(CYCLE)["stages"]);
}

/// INPUT-02: what is checked before the grid is named before it.
#[test]
fn what_is_wrong_before_a_bitmap_that_does_not_fit_is_named_first() {
    let short = with(CYCLE, "AAAAAA==", "AAAA");
    refused(&with(&short, "\"resolution\": 10", "\"resolution\": 0"), "grid.resolution", None);
    refused(&with(&short, "\"gap\": 25", "\"gap\": \"nan\""), "lead.gap", None);
    // What is checked after the grid, or is remote, is named after it.
    refused(&with(&short, "\"vx\": 10", "\"vx\": 1000"), "grid.occupied", None);
    let large = with(CYCLE, "\"width\": 10, \"height\": 3", "\"width\": 32768, \"height\": 32768");
    assert_eq!(answer(&large)["verdict"], "error");
    assert_ne!(answer(&large)["error"]["field"], "grid.occupied");
}

/// CYCLE-05, INPUT-07
#[test]
fn remote_data_outside_the_domain_is_unsafe_at_stage_input() {
    let answer = accepted(&with(CYCLE, "\"vx\": 10", "\"vx\": 1000"));
    assert_eq!(answer["verdict"], "unsafe");
    assert_eq!(answer["failed_stage"], "input");
    assert_eq!(answer["input"], json!({"field": "tracks.items.vx", "index": 0}));
    for stage in ["i", "ii", "iii", "iv", "v"] {
        assert_eq!(answer["stages"][stage]["outcome"], "skipped");
        assert_eq!(answer["stages"][stage]["reason"], "after_failure");
    }
    assert_eq!((&answer["strict"], &answer["lax"]), (&"unsafe".into(), &"unsafe".into()));
    // More tracks than the domain allows are no breach of the schema.
    let track =
        &CYCLE[CYCLE.find("{\"id\": 7").unwrap()..CYCLE.find("]}, \"detections\"").unwrap()];
    let many: Vec<String> =
        (0..2000).map(|id| track.replace("\"id\": 7", &format!("\"id\": {id}"))).collect();
    assert_eq!(accepted(&with(CYCLE, track, &many.join(", ")))["failed_stage"], "input");
}

#[test]
fn a_drive_holds_cycles_only_and_each_wrong_line_is_an_error_of_its_own() {
    let read = cycles_from_lines(&format!("{CYCLE}\n{TRACE}\n\n{CYCLE}"));
    assert_eq!(read.len(), 4);
    assert_eq!(read[0], read[3]);
    assert_eq!(read[0].as_ref().unwrap().0, "c");
    let trace = read[1].as_ref().unwrap_err();
    assert_eq!((trace.line, trace.field.as_str(), trace.id.as_deref()), (2, "kind", Some("o")));
    assert_eq!(read[2].as_ref().unwrap_err().line, 3);
}

/// `spec/5-interfaces.md#cycle`: of several problems in one object the first in the order of the keys.
#[test]
fn the_first_problem_in_the_order_of_the_keys_is_named() {
    let last_first = |problems: &[(&str, Option<Value>)]| {
        let mut value: Value = serde_json::from_str(CYCLE).unwrap();
        let fields = value.as_object_mut().unwrap();
        let mut line = String::from("{");
        for (key, problem) in problems {
            fields.remove(*key);
            if let Some(problem) = problem {
                line = line + "\"" + key + "\": " + &problem.to_string() + ", ";
            }
        }
        line + value.to_string().trim_start_matches('{')
    };
    let wrong = || Some(Value::from("wrong"));
    let ego = |text: &str| Some(serde_json::from_str(text).unwrap());
    let inner = r#"{"width": "a", "x": 0, "y": "a", "cos": 1, "sin": 0, "speed": 0, "length": 4}"#;
    let less = inner.replace("\"x\": 0, ", "");
    for (problems, first) in [
        // A wrong value, a missing key, an unknown key: whichever stands first in the order.
        ([("lead", wrong()), ("now_ns", wrong())], "now_ns"),
        ([("lead", wrong()), ("now_ns", None)], "now_ns"),
        ([("odd", wrong()), ("route", None)], "route"),
        ([("route", None), ("lead", wrong())], "lead"),
        // In an object of an object, and beside it.
        ([("lead", wrong()), ("ego", ego(inner))], "ego.y"),
        ([("lead", wrong()), ("ego", ego(&less))], "ego.x"),
        ([("configuration", None), ("ego", ego(&less))], "configuration"),
    ] {
        refused(&last_first(&problems), first, None);
    }
}

#[test]
fn a_group_named_twice_counts_once() {
    let offer = |groups: &str| {
        accepted(&trace(&format!(
            r#"{{"t_ns": 0, "type": "offer", "station": 1, "groups": {groups}}}, {{"t_ns": 1, "type": "tick"}}"#
        )))
    };
    assert_eq!(offer(r#"["mot", "mot"]"#), offer(r#"["mot"]"#));
    assert_eq!(offer(r#"["mot"]"#)["states"][1]["mot"], "requested:1");
}

#[test]
fn stations_of_events_are_at_least_1() {
    let of_group = ", \"group\": \"mot\", \"session\": 1";
    for (kind, rest) in [
        ("offer", ", \"groups\": []"),
        ("withdraw", ""),
        ("lost", ""),
        ("confirm", of_group),
        ("reject", of_group),
        ("data", ", \"group\": \"mot\", \"session\": 1, \"generated_ns\": 1"),
    ] {
        let event = |station: &str| {
            trace(&format!("{{\"t_ns\": 0, \"type\": \"{kind}\", \"station\": {station}{rest}}}"))
        };
        for right in ["1", "9223372036854775807"] {
            accepted(&event(right));
        }
        for wrong in ["0", "-1"] {
            refused(&event(wrong), "events.station", Some(0));
        }
    }
}

/// Of at most 10,000 events, whose times may stand still or run backwards; an absent group was not used.
#[test]
fn events_that_are_accepted() {
    let ticks = |count: usize| trace(&vec![r#"{"t_ns": 0, "type": "tick"}"#; count].join(","));
    assert_eq!(accepted(&ticks(10_000))["states"].as_array().unwrap().len(), 10_000);
    refused(&ticks(10_001), "events", None);
    assert_eq!(accepted(&ticks(0))["states"], json!([]));
    let back = trace(
        r#"{"t_ns": 9223372036854775807, "type": "tick"}, {"t_ns": -9223372036854775808, "type": "tick"}"#,
    );
    assert_eq!(accepted(&back)["states"].as_array().unwrap().len(), 2);
    accepted(&with(TRACE, "\"verdict\": \"unsafe\"", "\"verdict\": \"safe\""));
    for sessions in ["{}", r#"{"mot": 1}"#, r#"{"plan": -3, "mot": 9223372036854775807}"#] {
        accepted(&with(TRACE, "{\"mot\": 1}", sessions));
    }
}

/// Broken rules of a service set: the error names the service and the rule.
#[test]
fn a_service_set_that_breaks_a_rule_is_an_error_with_service_and_rule() {
    let requires = "\"requires\": [\"detections\"]";
    let twice = "\"requires\": [\"detections\", \"detections\"]";
    for (old, new, field, words) in [
        ("\"id\": \"det\"", "\"id\": \"mot\"", "services.id", ["mot", "twice"]),
        ("[\"tracks\"]", "[\"a\", \"a\"]", "services.guarantees", ["mot", "`a` twice"]),
        (requires, twice, "services.requires", ["mot", "twice"]),
        ("\"station\": 1", "\"station\": -1", "services.station", ["mot", "-1"]),
    ] {
        let line = with(COMPOSITION, old, new);
        refused(&line, field, Some(1));
        let message = answer(&line)["error"]["message"].as_str().unwrap().to_owned();
        assert!(words.iter().all(|word| message.contains(word)), "{message}");
    }
    let empty = r#"{"kind": "composition", "id": "s", "services": [], "goal": "mot"}"#;
    refused(empty, "services", None);
    for absent in [", \"same_station\": [[\"env\", \"tpl\"]]", ", \"local_only\": [\"control\"]"] {
        assert_eq!(accepted(&with(COMPOSITION, absent, "")), accepted(COMPOSITION));
    }
}
