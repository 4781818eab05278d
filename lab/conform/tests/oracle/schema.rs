//! The rules of `spec/5-interfaces.md` for lines, numbers, keys and values. What the vectors of
//! `vectors/interfaces` show is not repeated here.

use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_model::input::parameters::Parameters;
use mufasa_records::cycles_from_lines;
use serde_json::{Value, json};

use crate::oracle::common::{COMPOSITION, CYCLE, TRACE, accepted, answer, refused, with};

/// The cycle of a record that is accepted.
fn cycle(line: &str) -> Cycle {
    let mut cycles = cycles_from_lines(line);
    assert_eq!(cycles.len(), 1);
    cycles.remove(0).unwrap().1
}

/// The x of the CAV when `text` stands there.
fn x(text: &str) -> f64 {
    cycle(&with(CYCLE, "\"ego\": {\"x\": 0", &format!("\"ego\": {{\"x\": {text}"))).ego.x
}

fn now(text: &str) -> String {
    with(CYCLE, "\"now_ns\": 1000", &format!("\"now_ns\": {text}"))
}

fn parameters(text: &str) -> String {
    with(CYCLE, "\"parameters\": {}", &format!("\"parameters\": {{{text}}}"))
}

/// A trace of these events.
fn trace(events: &str) -> String {
    format!("{{\"kind\": \"offloading\", \"id\": \"o\", \"events\": [{events}]}}")
}

#[test]
fn numbers_are_read_as_the_nearest_double() {
    let third = "0.333333333333333314829616256247390992939472198486328125";
    let half_way_up = "1.00000000000000011102230246251565404236316680908203125";
    let long = format!("{}e-399", "1".repeat(400));
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
        ("-0", -0.0),
        ("17976931348623157e292", f64::MAX),
        (&long, 1.111_111_111_111_111_1),
        ("\"inf\"", f64::INFINITY),
        ("\"-inf\"", f64::NEG_INFINITY),
        // Beyond the range of doubles.
        ("1e400", f64::INFINITY),
        ("-1e999999999999999999999", f64::NEG_INFINITY),
    ] {
        assert_eq!(x(text).to_bits(), value.to_bits(), "{text}");
    }
    assert!(x("\"nan\"").is_nan());
    let remote = accepted(&with(CYCLE, "\"vy\": 0", "\"vy\": 1e400"));
    assert_eq!(remote["failed_stage"], "input");
}

#[test]
fn an_integer_of_64_bits_is_read_as_it_is() {
    for right in ["9223372036854775807", "-9223372036854775808", "-0"] {
        assert_eq!(cycle(&now(right)).now_ns, right.parse::<i64>().unwrap());
    }
}

/// A record, a text that stands once in it, what is put behind it in place of another text, and the place that the
/// error names.
type Row<'a> = (&'a str, &'a str, &'a str, &'a [&'a str], &'a str, Option<usize>);

/// INPUT-01: values of another type or beyond what they may be.
#[test]
fn a_wrong_value_is_an_error_at_its_place() {
    let event = |kind: &str| trace(&format!("{{\"t_ns\": 0, \"type\": \"{kind}\"#}}"));
    let [reject, area, verdict] = [
        event("reject").replace('#', ", \"station\": 1, \"group\": \"mot\", \"session\": 1"),
        event("area").replace('#', ", \"groups\": [\"mot\", \"plan\"]"),
        event("verdict").replace('#', ", \"verdict\": \"safe\", \"sessions\": {}"),
    ];
    let no_number = ["\"NaN\"", "\"+inf\"", "\"infinity\"", "\"1\"", "\"\"", "true", "[]", "null"];
    let no_integer =
        ["1000.0", "1e3", "1E3", "1000.5", "1e0", "\"1000\"", "\"nan\"", "true", "null"];
    let beyond = ["9223372036854775808", "-9223372036854775809", "100000000000000000000000"];
    let no_cells = ["0", "-1", "32769", "9223372036854775807", "-9223372036854775808"];
    let no_side = ["[]", "[-10]", "[-10, 2, 0]", "[-10, \"x\"]", "[[-10, 2]]", "null", "{}"];
    let no_bitmap =
        ["AAAAAA", "AAAAAA=", "AAAA", "", "AAAAAAA=", "AAA AA==", "AAA-AA==", "AAAAAB=="];
    let no_group = ["\"MOT\"", "\"env\"", "0", "null", "[]"];
    let lead = "{\"stamp_ns\": 900, \"gap\": 25, \"speed\": 10}";
    let rows: &[Row<'_>] = &[
        (CYCLE, "\"kind\": ", "\"cycle\"", &["1", "{\"cycle\": null}"], "kind", None),
        (CYCLE, "\"id\": ", "\"c\"", &["null", r#""\ud800""#], "id", None),
        (
            CYCLE,
            "\"profile\": ",
            "\"paper\"",
            &["\"\"", "true", "{\"paper\": null}"],
            "profile",
            None,
        ),
        (CYCLE, "\"ego\": {\"x\": ", "0", &no_number, "ego.x", None),
        (CYCLE, "\"ego\": {\"x\": ", "0", &["1e400", "-1e400"], "ego.x", None),
        (CYCLE, "\"now_ns\": ", "1000", &no_integer, "now_ns", None),
        (CYCLE, "\"now_ns\": ", "1000", &beyond, "now_ns", None),
        (CYCLE, "\"t_ns\": ", "1000", &["1e3"], "trajectory.points.t_ns", Some(0)),
        (CYCLE, "\"lead\": ", lead, &["[900, 25, 10]"], "lead", None),
        (CYCLE, "\"left\": ", "[-10, 2]", &no_side, "route.stations.left", Some(0)),
        (CYCLE, "\"right\": ", "[100, -2]", &["[100]"], "route.stations.right", Some(1)),
        (CYCLE, "\"width\": ", "10,", &["1e1,"], "grid.width", None),
        // Of a size outside the domain the model speaks, not the length of the bitmap.
        (CYCLE, "\"resolution\": 10, \"width\": ", "10", &no_cells, "grid.width", None),
        (CYCLE, "\"height\": ", "3", &no_cells, "grid.height", None),
        // Base64 with padding of the exact length, whose pad bits are zero.
        (CYCLE, "\"occupied\": \"", "AAAAAA==", &no_bitmap, "grid.occupied", None),
        (CYCLE, "\"unknown\": ", "null", &["\"/////w\"", "\"////\"", "7"], "grid.unknown", None),
        (TRACE, "\"parameters\": ", "{\"t_wait_ns\": 10000000000}", &["null"], "parameters", None),
        (TRACE, "\"t_wait_ns\": ", "10000000000", &["-1", "1.0"], "parameters.t_wait_ns", None),
        (TRACE, "\"type\": ", "\"tick\"", &["null"], "events.type", Some(2)),
        (TRACE, "\"verdict\": ", "\"unsafe\"", &["true", "null"], "events.verdict", Some(6)),
        (&reject, "\"group\": ", "\"mot\"", &no_group, "events.group", Some(0)),
        // The innermost list is that of the groups; the message names the event, too.
        (&area, "[\"mot\", ", "\"plan\"", &no_group, "events.groups", Some(1)),
        (&verdict, "\"verdict\": ", "\"safe\"", &["\"error\""], "events.verdict", Some(0)),
        (&verdict, "\"sessions\": ", "{}", &["{\"env\": 1}"], "events.sessions.env", Some(0)),
        (&verdict, "\"sessions\": ", "{}", &["{\"mot\": null}"], "events.sessions.mot", Some(0)),
        (&verdict, "\"sessions\": ", "{}", &["{\"mot\": 1.5}"], "events.sessions.mot", Some(0)),
        (&verdict, "\"sessions\": ", "{}", &["[1]"], "events.sessions", Some(0)),
        (COMPOSITION, "\"goal\": ", "\"mot\"", &["\"MOT\"", "\"\""], "goal", None),
        (COMPOSITION, "[[\"env\", \"tpl\"]", "", &[", 1"], "same_station", Some(1)),
        (COMPOSITION, "\"local_only\": ", "[\"control\"]", &["null"], "local_only", None),
        (COMPOSITION, "\"local_only\": ", "[\"control\"]", &["[[], 1]"], "local_only", Some(0)),
        (
            COMPOSITION,
            "\"guarantees\": ",
            "[\"tracks\"]",
            &["\"tracks\""],
            "services.guarantees",
            Some(1),
        ),
        (COMPOSITION, "\"id\": ", "\"det\"", &["1"], "services.id", Some(0)),
    ];
    for &(record, before, old, values, field, index) in rows {
        for value in values {
            let [old, new] = [old, value].map(|it| format!("{before}{it}"));
            refused(&with(record, &old, &new), field, index);
        }
    }
    let wrong = with(&area, "\"plan\"", "0");
    let message = answer(&wrong)["error"]["message"].clone();
    assert!(message.as_str().unwrap().contains("events[0].groups[1]"), "{message}");
    for name in ["theta", "qos_hold", "theta_tr ", "lease_ns"] {
        refused(&parameters(&format!("\"{name}\": 1")), &format!("parameters.{name}"), None);
    }
}

#[test]
fn a_line_holds_one_json_object() {
    let list = format!("[{CYCLE}]");
    let more = format!("{CYCLE}}}");
    for line in ["\t\r\n", "null", "{\"a\": nan}", "\u{feff}{}", &list, &more] {
        refused(line, "", None);
    }
    refused("{}", "kind", None);
}

/// INPUT-01: in each object another key is an error, and so is one that stands twice.
#[test]
fn unknown_fields_and_duplicate_keys_are_an_error() {
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
    let (session, group) = ("\"session\": 1", "\"group\": \"mot\"");
    // The fields of an event are those of its type.
    for (fields, field) in [
        ("\"tick\", \"station\": 1", "station"),
        ("\"lost\", \"station\": 1, \"groups\": []", "groups"),
        (&format!("\"offer\", \"station\": 1, {group}, \"groups\": []"), "group"),
        ("\"area\", \"groups\": [], \"station\": 1", "station"),
        (
            &format!("\"confirm\", \"station\": 1, {group}, {session}, \"generated_ns\": 1"),
            "generated_ns",
        ),
        ("\"verdict\", \"verdict\": \"safe\", \"sessions\": {}, \"safe\": true", "safe"),
    ] {
        let event = trace(&format!("{{\"t_ns\": 0, \"type\": {fields}}}"));
        refused(&event, &format!("events.{field}"), Some(0));
    }
    for (text, pair, path, index) in [
        (CYCLE, "\"kind\": \"cycle\"", "kind", None),
        (CYCLE, "\"id\": \"c\"", "id", None),
        (CYCLE, "\"vx\": 10", "tracks.items.vx", Some(0)),
        (CYCLE, "\"left\": [100, 2]", "route.stations.left", Some(1)),
        (CYCLE, "\"unknown\": null", "grid.unknown", None),
        (TRACE, "\"type\": \"lost\"", "events.type", Some(7)),
        (TRACE, "\"generated_ns\": 1", "events.generated_ns", Some(5)),
        (COMPOSITION, "\"guarantees\": [\"tracks\"]", "services.guarantees", Some(1)),
    ] {
        refused(&with(text, pair, &format!("{pair}, {pair}")), path, index);
    }
    refused(&now(r#"1000, "\u006eow_ns": 1000"#), "now_ns", None);
    refused(&parameters("\"n\": 4, \"n\": 4"), "parameters.n", None);
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
    let escaped = with(CYCLE, "\"id\": \"c\"", r#""\u0069d": "\u00e9\"\n""#);
    assert_eq!(accepted(&escaped)["id"], "\u{e9}\"\n");
}

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

#[test]
fn without_a_composition_none_says_why() {
    assert_eq!(accepted(COMPOSITION)["none"], Value::Null);
    let guarantees = "\"guarantees\": [\"detections\"]";
    for (old, new, why) in [
        (guarantees, "\"guarantees\": []", json!({"requirement": "detections", "service": "mot"})),
        ("[\"control\"]", "[\"mot\"]", json!({"rule": "local_only"})),
        ("[\"env\", \"tpl\"]", "[\"det\", \"mot\"]", json!({"rule": "same_station"})),
        ("\"requires\": []", "\"requires\": [\"tracks\"]", json!({"rule": "acyclic"})),
    ] {
        let answer = accepted(&with(COMPOSITION, old, new));
        assert_eq!((&answer["compositions"], &answer["none"]), (&json!([]), &why));
    }
}

#[test]
fn more_than_10_000_closed_choices_are_an_error() {
    let service = |id: &str, requires: Vec<String>, guarantees: Vec<String>| json!({"id": id, "requires": requires, "guarantees": guarantees, "station": 0});
    let interfaces: Vec<String> = (0..14).map(|at| format!("i{at}")).collect();
    let providers = interfaces.iter().flat_map(|it| ["a", "b"].map(|by| (format!("{by}{it}"), it)));
    let mut services: Vec<Value> =
        providers.map(|(id, it)| service(&id, vec![], vec![it.clone()])).collect();
    services.push(service("goal", interfaces, vec![]));
    let task = json!({"kind": "composition", "id": "s", "services": services, "goal": "goal"});
    refused(&task.to_string(), "services", None);
}
