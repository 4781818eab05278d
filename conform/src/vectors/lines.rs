//! Lines that break the schema (`spec/3-stages.md#invalid-input`, `spec/5-interfaces.md`).

use mufasa_model::input::cycle::Profile::Paper;

use crate::vectors::base::{detection, detections, fine_grid, lead, track, with};
use crate::vectors::book::{Book, Topic};
use crate::vectors::expected::refused;
use crate::vectors::stages::collision::standing;
use mufasa_records::cycle_to_line;

const CYCLE: Topic = Topic::new("interfaces/cycle-lines", "spec/3-stages.md#invalid-input.1");
const TRACE: Topic = Topic::new("interfaces/offloading-lines", "spec/3-stages.md#invalid-input.1");
const TASK: Topic = Topic::new("interfaces/composition-lines", "spec/3-stages.md#invalid-input.1");

/// Name, text that is replaced, replacement, field, index.
type Change = (&'static str, &'static str, &'static str, &'static str, Option<usize>);

const CYCLE_CHANGES: [Change; 31] = [
    ("kind-unknown", "\"kind\": \"cycle\"", "\"kind\": \"cycles\"", "kind", None),
    ("kind-missing", "\"kind\": \"cycle\", ", "", "kind", None),
    ("id-number", "\"id\": \"line\"", "\"id\": 1", "id", None),
    ("id-missing", "\"id\": \"line\", ", "", "id", None),
    ("profile-unknown", "\"paper\"", "\"Paper\"", "profile", None),
    ("profile-null", "\"paper\"", "null", "profile", None),
    ("parameters-null", "\"parameters\": {}", "\"parameters\": null", "parameters", None),
    (
        "parameter-unknown",
        "\"parameters\": {}",
        "\"parameters\": {\"max_age\": 1}",
        "parameters.max_age",
        None,
    ),
    (
        "parameter-string",
        "\"parameters\": {}",
        "\"parameters\": {\"a_b\": \"8\"}",
        "parameters.a_b",
        None,
    ),
    ("configuration-unknown", "PlanRemote", "planremote", "configuration", None),
    ("configuration-missing", "\"configuration\": \"PlanRemote\", ", "", "configuration", None),
    ("now-fraction", "\"now_ns\": 1000000000", "\"now_ns\": 1000000000.0", "now_ns", None),
    ("now-exponent", "\"now_ns\": 1000000000", "\"now_ns\": 1e9", "now_ns", None),
    ("now-too-large", "\"now_ns\": 1000000000", "\"now_ns\": 9223372036854775808", "now_ns", None),
    ("now-string", "\"now_ns\": 1000000000", "\"now_ns\": \"1000000000\"", "now_ns", None),
    (
        "now-twice",
        "\"now_ns\": 1000000000",
        "\"now_ns\": 1000000000, \"now_ns\": 1000000000",
        "now_ns",
        None,
    ),
    ("unknown-field", "\"kind\": \"cycle\"", "\"kind\": \"cycle\", \"extra\": 1", "extra", None),
    ("ego-unknown-field", "\"speed\": 0,", "\"speed\": 0, \"mass\": 1,", "ego.mass", None),
    ("ego-null", "\"speed\": 0,", "\"speed\": null,", "ego.speed", None),
    ("ego-missing", "\"speed\": 0, ", "", "ego.speed", None),
    ("ego-twice", "\"speed\": 0,", "\"speed\": 0, \"speed\": 0,", "ego.speed", None),
    ("number-word", "\"speed\": 0,", "\"speed\": \"NaN\",", "ego.speed", None),
    ("number-boolean", "\"speed\": 0,", "\"speed\": true,", "ego.speed", None),
    ("track-missing", "\"vx\": 0, ", "", "tracks.items.vx", Some(0)),
    ("track-id-fraction", "{\"id\": 1,", "{\"id\": 1.0,", "tracks.items.id", Some(0)),
    ("station-side-short", "\"left\": [200, 3]", "\"left\": [200]", "route.stations.left", Some(1)),
    (
        "station-side-long",
        "\"left\": [200, 3]",
        "\"left\": [200, 3, 0]",
        "route.stations.left",
        Some(1),
    ),
    ("closed-number", "\"closed\": false", "\"closed\": 0", "route.closed", None),
    ("bitmap-length", "\"width\": 40", "\"width\": 41", "grid.occupied", None),
    ("bitmap-alphabet", "\"occupied\": \"A", "\"occupied\": \"-", "grid.occupied", None),
    ("beyond-doubles", "\"speed\": 0,", "\"speed\": 1e400,", "ego.speed", None),
];

const TRACE_LINE: &str = r#"{"kind": "offloading", "id": "line", "profile": "paper", "parameters": {"t_wait_ns": 5}, "events": [{"t_ns": 0, "type": "offer", "station": 1, "groups": ["mot", "plan"]}, {"t_ns": 1, "type": "tick"}, {"t_ns": 2, "type": "confirm", "station": 1, "group": "mot", "session": 1}, {"t_ns": 3, "type": "data", "station": 1, "group": "mot", "session": 1, "generated_ns": 1}, {"t_ns": 4, "type": "verdict", "verdict": "unsafe", "groups": ["mot"]}]}"#;

const TRACE_CHANGES: [Change; 14] = [
    ("parameter-unknown", "t_wait_ns", "theta_tr", "parameters.theta_tr", None),
    ("parameter-negative", "\"t_wait_ns\": 5", "\"t_wait_ns\": -1", "parameters.t_wait_ns", None),
    ("parameter-fraction", "\"t_wait_ns\": 5", "\"t_wait_ns\": 5.0", "parameters.t_wait_ns", None),
    ("qos-hold-number", "\"t_wait_ns\": 5", "\"qos_hold\": 1", "parameters.qos_hold", None),
    ("type-unknown", "\"tick\"", "\"tock\"", "events.type", Some(1)),
    ("type-missing", ", \"type\": \"tick\"", "", "events.type", Some(1)),
    ("time-missing", "\"t_ns\": 1, ", "", "events.t_ns", Some(1)),
    (
        "field-of-another-type",
        "\"type\": \"tick\"",
        "\"type\": \"tick\", \"station\": 1",
        "events.station",
        Some(1),
    ),
    (
        "station-of-the-cav",
        "\"type\": \"offer\", \"station\": 1",
        "\"type\": \"offer\", \"station\": 0",
        "events.station",
        Some(0),
    ),
    (
        "group-unknown",
        "\"group\": \"mot\", \"session\": 1}",
        "\"group\": \"env\", \"session\": 1}",
        "events.group",
        Some(2),
    ),
    ("groups-unknown", "[\"mot\", \"plan\"]", "[\"mot\", \"env\"]", "events.groups", Some(1)),
    ("verdict-unknown", "\"unsafe\"", "\"error\"", "events.verdict", Some(4)),
    (
        "session-too-large",
        "\"session\": 1, \"generated_ns\"",
        "\"session\": 9223372036854775808, \"generated_ns\"",
        "events.session",
        Some(3),
    ),
    ("events-missing", "\"events\"", "\"event\"", "event", None),
];

const TASK_LINE: &str = r#"{"kind": "composition", "id": "line", "services": [{"id": "det", "requires": [], "guarantees": ["detections"], "station": 0}, {"id": "mot", "requires": ["detections"], "guarantees": ["tracks"], "station": 1}], "goal": "mot", "same_station": [["env", "tpl"]], "local_only": ["control"]}"#;

const TASK_CHANGES: [Change; 8] = [
    ("goal-missing", "\"goal\": \"mot\", ", "", "goal", None),
    ("goal-null", "\"goal\": \"mot\"", "\"goal\": null", "goal", None),
    ("station-fraction", "\"station\": 1", "\"station\": 1.0", "services.station", Some(1)),
    ("guarantees-number", "[\"tracks\"]", "[\"tracks\", 1]", "services.guarantees", Some(1)),
    (
        "service-unknown-field",
        "\"id\": \"mot\",",
        "\"id\": \"mot\", \"name\": \"x\",",
        "services.name",
        Some(1),
    ),
    ("same-station-null", "[[\"env\", \"tpl\"]]", "null", "same_station", None),
    ("local-only-string", "[\"control\"]", "\"control\"", "local_only", None),
    ("services-twice", "\"goal\": \"mot\"", "\"goal\": \"mot\", \"goal\": \"mot\"", "goal", None),
];

/// Adds them.
pub fn add(book: &mut Book) {
    for (name, line) in [
        ("blank", ""),
        ("spaces", "  "),
        ("no-json", "{"),
        ("list", "[]"),
        ("number", "1"),
        ("string", "\"x\""),
        ("two", "{} {}"),
        ("leading-zero", "{\"id\": 01}"),
        ("bare-nan", "{\"id\": nan}"),
    ] {
        let note = "A line that is no JSON object; a blank line is a line.";
        book.line(CYCLE, name, note, line, &refused("", None));
    }
    let cycle = with(standing(Paper, track(1, 60.0, 0.0)), |cycle| {
        cycle.detections = Some(detections(vec![detection(60.0, 0.0)]));
        cycle.lead = lead(90.0, 10.0);
        cycle.grid = Some(fine_grid());
    });
    let cycle = cycle_to_line("line", &cycle);
    changed(book, CYCLE, &cycle, &CYCLE_CHANGES);
    changed(book, TRACE, TRACE_LINE, &TRACE_CHANGES);
    changed(book, TASK, TASK_LINE, &TASK_CHANGES);
}

fn changed(book: &mut Book, topic: Topic, line: &str, changes: &[Change]) {
    for (name, old, new, field, index) in changes {
        let note = format!("A record with one thing wrong: {name}.");
        let broken = line.replacen(old, new, 1);
        book.line(topic, name, &note, &broken, &refused(field, *index));
    }
}
