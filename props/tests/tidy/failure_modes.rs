//! The failure modes on the page of hazards: a row for each field that a vehicle gives its monitor, and of each message.

use std::collections::BTreeSet;

use serde_json::Value;

use super::tree::{Tree, sections};

const PAGE: &str = "docs/hazards.md";

/// The tables whose first column names fields. `.y` behind `a.x` is `a.y`.
const TABLES: [&str; 2] =
    ["failure-modes-of-the-inputs-of-a-cycle", "failure-modes-of-the-messages"];

/// Has the module of messages; `lab/link/tests/codec/golden.rs` compares it with that of the code.
const LINK: &str = "spec/6-link.md";

/// What names a record, and what is walked through by itself.
const NO_FIELDS: [&str; 3] = ["id", "kind", "events"];

/// Fields without a row, and names in the first column that are no field. `record` is the schema of a monitor's.
pub fn missing(tree: &Tree, record: &Value) -> Vec<(String, String)> {
    let text = |path: &str| tree.0.get(path).map_or("", String::as_str);
    let (mut fields, rows) = (of_record(record), of_rows(text(PAGE)));
    fields.extend(of_messages(text(LINK)));
    let without = fields.difference(&rows).map(|it| format!("`{it}` has no row"));
    let unknown = rows.difference(&fields).map(|it| format!("`{it}` is no field"));
    without.chain(unknown).map(|what| (PAGE.to_owned(), what)).collect()
}

fn of_rows(page: &str) -> BTreeSet<String> {
    let tables = sections(page).into_iter().filter(|it| TABLES.contains(&it.anchor.as_str()));
    let cells =
        tables.flat_map(|it| it.lines).filter_map(|it| it.strip_prefix("| ")?.split('|').next());
    let mut names = BTreeSet::new();
    for cell in cells {
        let mut before = "";
        for name in cell.split('`').skip(1).step_by(2) {
            if name.starts_with('.') {
                names.insert(format!("{before}{name}"));
            } else {
                names.insert(name.to_owned());
                before = name.rsplit_once('.').map_or("", |it| it.0);
            }
        }
    }
    names
}

/// Dotted paths as errors name them. A field of an event stands behind its type, except what the cycle measures, the
/// contents of a result and the time, which each event has. Parameters are one field.
fn of_record(schema: &Value) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for (name, of) in properties(schema).filter(|it| !NO_FIELDS.contains(&it.0)) {
        walk(schema, of, name, &mut found);
    }
    let events = schema["$defs"]["MonitorEvent"]["oneOf"].as_array().into_iter().flatten();
    for event in events {
        let kind = event["properties"]["type"]["const"].as_str().unwrap_or_default();
        let own = properties(event).filter(|it| !["type", "t_ns"].contains(&it.0));
        let own: Vec<_> = own.collect();
        for &(name, of) in &own {
            let path = match name {
                "measured" => String::new(),
                _ if name == kind => name.to_owned(),
                _ => format!("{kind}.{name}"),
            };
            walk(schema, of, &path, &mut found);
        }
        found.insert(if own.is_empty() { kind } else { "t_ns" }.to_owned());
    }
    found
}

fn properties(schema: &Value) -> impl Iterator<Item = (&str, &Value)> {
    let all = schema["properties"].as_object().into_iter().flatten();
    all.map(|(name, of)| (name.as_str(), of))
}

/// Numbers, words and lists below a path; a list is a field for its length, too.
fn walk(schema: &Value, of: &Value, path: &str, found: &mut BTreeSet<String>) {
    let name = of["$ref"].as_str().and_then(|it| it.rsplit('/').next());
    let of = name.map_or(of, |name| &schema["$defs"][name]);
    if let Some(either) = of["anyOf"].as_array() {
        let some = either.iter().filter(|it| it["type"] != "null");
        some.for_each(|it| walk(schema, it, path, found));
    } else if of["properties"].is_object() && path != "parameters" {
        for (name, of) in properties(of) {
            let dot = if path.is_empty() { "" } else { "." };
            walk(schema, of, &format!("{path}{dot}{name}"), found);
        }
    } else {
        found.insert(path.to_owned());
        if of["items"].is_object() {
            walk(schema, &of["items"], path, found);
        }
    }
}

/// `Type.field` of each SEQUENCE and CHOICE of the module.
fn of_messages(spec: &str) -> BTreeSet<String> {
    let module = spec.split_once("```asn1\n").and_then(|it| it.1.split_once("```"));
    let lines = module.map_or("", |it| it.0).lines();
    let code: Vec<&str> = lines.filter_map(|line| line.split("--").next()).collect();
    let code = code.join(" ");
    let parts: Vec<&str> = code.split("::=").collect();
    let mut found = BTreeSet::new();
    for pair in parts.windows(2) {
        let name = pair[0].split_whitespace().next_back().unwrap_or_default();
        let body = ["SEQUENCE {", "CHOICE {"].iter().find_map(|it| pair[1].trim().strip_prefix(it));
        let fields = body.and_then(|it| it.split_once('}')).map_or("", |it| it.0).split(',');
        let fields = fields.filter_map(|it| it.split_whitespace().next());
        found.extend(fields.map(|field| format!("{name}.{field}")));
    }
    found
}

#[test]
fn a_field_without_a_row_is_seen() {
    let record = serde_json::json!({
        "properties": {
            "id": {"type": "string"},
            "parameters": {"properties": {"tau": {}}},
            "route": {"$ref": "#/$defs/Route"},
        },
        "$defs": {
            "Route": {"properties": {"places": {"items": {"properties": {"x": {}, "y": {}}}}}},
            "MonitorEvent": {"oneOf": [
                {"properties": {"type": {"const": "tick"}, "t_ns": {}}},
                {"properties": {"type": {"const": "tracks"}, "t_ns": {}, "session": {},
                    "tracks": {"properties": {"stamp_ns": {}}}}},
                {"properties": {"type": {"const": "cycle"}, "t_ns": {},
                    "measured": {"properties": {"gap": {"anyOf": [{"type": "null"}, {}]}}}}},
            ]},
        },
    });
    let module = "```asn1\nA ::= SEQUENCE {\n  b  INTEGER (0..1), -- c, d\n  e  F\n}\n\
                  F ::= CHOICE { g NULL }\nH ::= ENUMERATED { i }\n```\n";
    let rows = "now: `t_ns` `tick` `parameters` `gap` `route.places` `route.places.x`, `.y` \
                `tracks.session`, `.stamp_ns` `A.b`, `.e` `F.g`";
    let of = |first: &str, module: &str| {
        let page =
            format!("## Failure modes of the messages\n| {first} | of `x` |\n## Else\n| `y` |");
        let files = [(PAGE, page.as_str()), (LINK, module)];
        let files = files.map(|(path, text)| (path.to_owned(), text.to_owned()));
        missing(&Tree(files.into()), &record).len()
    };
    assert_eq!(of(rows, module), 0);
    for name in rows.split(' ').filter(|it| it.starts_with('`')) {
        assert!(of(&rows.replace(name, ""), module) > 0, "{name}");
    }
    assert_eq!(of(&format!("{rows} `speed`"), module), 1, "no field");
    assert_eq!(of(rows, &module.replace("b  INTEGER", "b  B, z  INTEGER")), 1, "a new field");
    assert_eq!(of(rows, ""), 3, "no module");
}
