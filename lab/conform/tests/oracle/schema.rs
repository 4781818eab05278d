//! The rules of `spec/5-interfaces.md` for lines, numbers, keys and values. What the vectors of
//! `vectors/interfaces` show is not repeated here.

use mufasa_model::input::cycle::Cycle;
use mufasa_records::cycles_from_lines;
use serde_json::Value;

use crate::oracle::common::{COMPOSITION, CYCLE, TRACE, accepted, answer, refused, with};

/// The cycle of a record that is accepted.
pub fn cycle(line: &str) -> Cycle {
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

pub fn parameters(text: &str) -> String {
    with(CYCLE, "\"parameters\": {}", &format!("\"parameters\": {{{text}}}"))
}

/// A trace of these events.
pub fn trace(events: &str) -> String {
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
