//! The rules of `spec/5-interfaces.md#cycle`, one test per rule, named after it.

use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_model::input::parameters::Parameters;
use mufasa_records::cycles_from_lines;
use serde_json::Value;

use crate::common::{CYCLE, TRACE, accepted, answer, refused, with};

/// The cycle of a record that is accepted.
fn cycle(line: &str) -> Cycle {
    let mut cycles = cycles_from_lines(line);
    assert_eq!(cycles.len(), 1);
    cycles.remove(0).unwrap().1
}

#[test]
fn a_blank_line_is_a_line() {
    for blank in ["\n", " \n", "\t\r\n"] {
        refused(blank, "", None);
    }
}

#[test]
fn a_line_holds_one_json_object() {
    for line in
        ["[]", "1", "null", "\"x\"", "{} {}", "{", "{\"id\": 01}", "{\"a\": nan}", "\u{feff}{}"]
    {
        refused(line, "", None);
    }
    refused(&format!("{CYCLE}}}"), "", None);
    refused("{}", "kind", None);
}

/// As a reader might take them that is derived from the types alone.
#[test]
fn objects_are_no_lists_and_words_no_objects() {
    refused(&format!("[{CYCLE}]"), "", None);
    let lead = "{\"stamp_ns\": 900, \"gap\": 25, \"speed\": 10}";
    refused(&with(CYCLE, lead, "[900, 25, 10]"), "lead", None);
    refused(&with(CYCLE, "\"paper\"", "{\"paper\": null}"), "profile", None);
    refused(&with(CYCLE, "\"kind\": \"cycle\"", "\"kind\": {\"cycle\": null}"), "kind", None);
}

/// INPUT-01
#[test]
fn kind_is_one_of_the_three() {
    refused(&with(CYCLE, "\"kind\": \"cycle\"", "\"kind\": \"cycles\""), "kind", None);
    refused(&with(CYCLE, "\"kind\": \"cycle\"", "\"kind\": 1"), "kind", None);
    refused(&with(CYCLE, "\"kind\": \"cycle\", ", ""), "kind", None);
}

/// INPUT-01
#[test]
fn id_is_a_string() {
    refused(&with(CYCLE, "\"id\": \"c\"", "\"id\": 1"), "id", None);
    refused(&with(CYCLE, "\"id\": \"c\", ", ""), "id", None);
    refused(&with(CYCLE, "\"id\": \"c\"", "\"id\": null"), "id", None);
    refused(&with(CYCLE, "\"id\": \"c\"", r#""id": "\ud800""#), "id", None);
    let escaped = with(CYCLE, "\"id\": \"c\"", r#""\u0069d": "\u00e9\"\n""#);
    assert_eq!(accepted(&escaped)["id"], "\u{e9}\"\n");
}

/// CYCLE-03
#[test]
fn the_id_of_an_error_is_null_when_it_could_not_be_read() {
    for line in ["{\"id\": \"a\"", "{\"id\": 1}", "{\"id\": \"a\", \"id\": \"a\"}", "[\"id\"]"] {
        assert_eq!(answer(line)["id"], Value::Null, "{line}");
    }
    for line in ["{\"id\": \"a\"}", "{\"kind\": \"cycle\", \"x\": {}, \"id\": \"a\"}"] {
        assert_eq!(answer(line)["id"], "a", "{line}");
    }
    // Values outside the domain are errors of a record whose id is known.
    assert_eq!(answer(&with(CYCLE, "\"speed\": 0,", "\"speed\": -1,"))["id"], "c");
}

#[test]
fn profile_is_paper_or_hardened_and_hardened_by_default() {
    assert_eq!(cycle(CYCLE).profile, Profile::PAPER);
    assert_eq!(cycle(&with(CYCLE, "\"profile\": \"paper\", ", "")).profile, Profile::HARDENED);
    let hardened = with(CYCLE, "\"paper\"", "\"hardened\"");
    assert_eq!(cycle(&hardened).profile, Profile::HARDENED);
    for wrong in ["\"Paper\"", "null", "\"\"", "true"] {
        refused(&with(CYCLE, "\"paper\"", wrong), "profile", None);
    }
}

#[test]
fn configuration_is_one_of_the_four() {
    for name in ["Local", "MotRemote", "AllRemote", "PlanRemote"] {
        let line = with(CYCLE, "AllRemote", name);
        assert_eq!(format!("{:?}", cycle(&line).configuration), name);
    }
    refused(&with(CYCLE, "AllRemote", "allremote"), "configuration", None);
    refused(&with(CYCLE, "\"configuration\": \"AllRemote\", ", ""), "configuration", None);
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
    let given = |text: String| {
        cycle(&with(CYCLE, "\"parameters\": {}", &format!("\"parameters\": {{{text}}}"))).parameters
    };
    for (name, expected) in override_each() {
        assert_eq!(given(format!("\"{name}\": 7")), expected, "{name}");
        assert_ne!(expected, Parameters::default(), "{name}");
    }
    let both = Parameters { a_b: 7.0, n: 3, ..Parameters::default() };
    assert_eq!(given(String::from("\"a_b\": 7, \"n\": 3")), both);
    assert_eq!(cycle(CYCLE).parameters, Parameters::default());
}

/// INPUT-01
#[test]
fn an_unknown_parameter_is_an_error() {
    for name in ["theta", "qos_hold", "theta_tr ", "max_age", "lease_ns"] {
        let line = with(CYCLE, "\"parameters\": {}", &format!("\"parameters\": {{\"{name}\": 1}}"));
        refused(&line, &format!("parameters.{name}"), None);
    }
}

#[test]
fn a_cycle_checks_the_times_of_the_protocol_and_ignores_them() {
    for name in ["t_wait_ns", "request_timeout_ns", "l_max_ns", "dt_max_ns"] {
        let line = |value: &str| {
            with(CYCLE, "\"parameters\": {}", &format!("\"parameters\": {{\"{name}\": {value}}}"))
        };
        assert_eq!(cycle(&line("0")), cycle(CYCLE));
        assert_eq!(cycle(&line("9223372036854775807")), cycle(CYCLE));
        refused(&line("-1"), &format!("parameters.{name}"), None);
        refused(&line("1.5"), &format!("parameters.{name}"), None);
    }
}

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
        let mut null = value.clone();
        null[key] = Value::Null;
        let mut absent = value.clone();
        absent.as_object_mut().unwrap().remove(key);
        assert_eq!(cycle(&null.to_string()), cycle(&absent.to_string()), "{key}");
        let one_less = format!("{:?}", cycle(&null.to_string()));
        assert!(one_less.contains(&format!("{key}: {none}")), "{key}");
    }
}

#[test]
fn a_missing_input_is_named_by_its_key() {
    let line = CYCLE.replace("\"AllRemote\"", "\"MotRemote\"");
    let mut value: Value = serde_json::from_str(&line).unwrap();
    for (key, stage) in [("tracks", "i"), ("trajectory", "ii"), ("grid", "v")] {
        let before = value[key].take();
        let stages = accepted(&value.to_string())["stages"].clone();
        assert_eq!(stages[stage]["outcome"], "not_applicable", "{stages}");
        assert_eq!(stages[stage]["missing"], key, "{stages}");
        value[key] = before;
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
fn profile_and_parameters_may_be_absent_but_not_null() {
    accepted(&with(CYCLE, "\"parameters\": {}, ", ""));
    refused(&with(CYCLE, "\"parameters\": {}", "\"parameters\": null"), "parameters", None);
}

/// INPUT-01
#[test]
fn a_station_has_two_numbers_on_each_side() {
    for wrong in ["[]", "[-10]", "[-10, 2, 0]", "[-10, \"x\"]", "[[-10, 2]]", "null", "{}"] {
        refused(&with(CYCLE, "[-10, 2]", wrong), "route.stations.left", Some(0));
    }
    refused(&with(CYCLE, "[100, -2]", "[100]"), "route.stations.right", Some(1));
}

#[test]
fn a_bitmap_is_base64_with_padding_of_the_exact_length() {
    for wrong in ["AAAAAA", "AAAAAA=", "AAAA", "", "AAAAAAA=", "AAA AA==", "AAA-AA==", "AAAAAB=="] {
        refused(&with(CYCLE, "AAAAAA==", wrong), "grid.occupied", None);
    }
    let unknown = |bits: &str| with(CYCLE, "\"unknown\": null", &format!("\"unknown\": {bits}"));
    assert_eq!(cycle(&unknown("\"/////w==\"")).grid.unwrap().unknown, Some(vec![255; 4]));
    refused(&unknown("\"/////w\""), "grid.unknown", None);
    refused(&unknown("\"////\""), "grid.unknown", None);
    refused(&unknown("7"), "grid.unknown", None);
}

#[test]
fn unknown_of_a_grid_may_be_absent_or_null() {
    assert_eq!(cycle(&with(CYCLE, ", \"unknown\": null", "")), cycle(CYCLE));
}

#[test]
fn unused_bits_of_a_bitmap_are_ignored() {
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
}

/// Of a size outside the domain the model speaks, not the length of the bitmap.
#[test]
fn a_grid_outside_the_domain_is_invalid_at_its_size() {
    for wrong in ["0", "-1", "32769", "9223372036854775807", "-9223372036854775808"] {
        refused(
            &with(CYCLE, "\"width\": 10,", &format!("\"width\": {wrong},")),
            "grid.width",
            None,
        );
        refused(
            &with(CYCLE, "\"height\": 3,", &format!("\"height\": {wrong},")),
            "grid.height",
            None,
        );
    }
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
    assert_eq!(answer["input"], serde_json::json!({"field": "tracks.items.vx", "index": 0}));
    for stage in ["i", "ii", "iii", "iv", "v"] {
        assert_eq!(answer["stages"][stage]["outcome"], "skipped");
        assert_eq!(answer["stages"][stage]["reason"], "after_failure");
    }
    assert_eq!((&answer["strict"], &answer["lax"]), (&"unsafe".into(), &"unsafe".into()));
}

#[test]
fn more_tracks_than_the_domain_allows_are_invalid_input_and_no_breach_of_the_schema() {
    let track =
        &CYCLE[CYCLE.find("{\"id\": 7").unwrap()..CYCLE.find("]}, \"detections\"").unwrap()];
    let many: Vec<String> =
        (0..2000).map(|id| track.replace("\"id\": 7", &format!("\"id\": {id}"))).collect();
    let answer = accepted(&with(CYCLE, track, &many.join(", ")));
    assert_eq!(answer["failed_stage"], "input");
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
    // A wrong value, a missing key, an unknown key: whichever stands first in the order.
    refused(&last_first(&[("lead", wrong()), ("now_ns", wrong())]), "now_ns", None);
    refused(&last_first(&[("lead", wrong()), ("now_ns", None)]), "now_ns", None);
    refused(&last_first(&[("odd", wrong()), ("route", None)]), "route", None);
    refused(&last_first(&[("route", None), ("lead", wrong())]), "lead", None);
    // In an object of an object, and beside it.
    let inner = r#"{"width": "a", "x": 0, "y": "a", "cos": 1, "sin": 0, "speed": 0, "length": 4}"#;
    refused(&last_first(&[("lead", wrong()), ("ego", ego(inner))]), "ego.y", None);
    let inner = inner.replace("\"x\": 0, ", "");
    refused(&last_first(&[("lead", wrong()), ("ego", ego(&inner))]), "ego.x", None);
    refused(&last_first(&[("configuration", None), ("ego", ego(&inner))]), "configuration", None);
}

/// `spec/5-interfaces.md#cycle`: pad bits of base64 that are not zero are refused.
#[test]
fn pad_bits_are_zero() {
    accepted(CYCLE);
    refused(&CYCLE.replace("AAAAAA==", "AAAAAB=="), "grid.occupied", None);
}
