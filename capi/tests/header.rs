//! The committed header is the one that the sources give.

use std::collections::BTreeSet;
use std::ffi::{CStr, c_char};
use std::fs;
use std::path::Path;

use mufasa_capi::text::{
    mufasa_action_text, mufasa_advice_text, mufasa_drop_reason_text, mufasa_failed_stage_text,
    mufasa_status_text,
};

/// The source of the structs of `src/parameters.rs`: cbindgen expands no macro.
macro_rules! source {
    ($struct:literal, $($(#[$doc:meta])* $name:ident: $kind:ident = $default:literal;)*) => {
        concat!(
            "/// Parameters; names, defaults and domains as in spec/.\n",
            "#[repr(C)]\npub struct ", $struct, " {\n",
            $($("#[", stringify!($doc), "]\n",)* "/// Default: ", stringify!($default), "\n", "pub ", stringify!($name), ": ", c_type!($kind), ",\n",)*
            "}\n"
        )
    };
}

macro_rules! c_type {
    (bool) => {
        "u32"
    };
    ($kind:ident) => {
        stringify!($kind)
    };
}

macro_rules! parameters {
    ($($(#[$doc:meta])* $name:ident: $kind:ident = $default:literal in $domain:expr;)*) => {
        source!("MufasaParameters", $($(#[$doc])* $name: $kind = $default;)*)
    };
}

macro_rules! requester_parameters {
    ($($(#[$doc:meta])* $name:ident: $kind:ident = $default:literal;)*) => {
        source!("MufasaRequesterParameters", $($(#[$doc])* $name: $kind = $default;)*)
    };
}

const PARAMETERS: [&str; 2] =
    [mufasa::parameters!(parameters), mufasa::requester_parameters!(requester_parameters)];

/// Those with what C sees, in the order of the header.
const SOURCES: [&str; 16] = [
    "status",
    "version",
    "time",
    "cycle",
    "report",
    "check",
    "event",
    "requester",
    "monitor/settings",
    "monitor/element",
    "monitor/decision",
    "monitor/place",
    "monitor/calls",
    "monitor/state",
    "monitor/problem",
    "text",
];

#[test]
fn the_header_is_the_one_of_the_sources() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let config = cbindgen::Config::from_file(here.join("cbindgen.toml")).expect("cbindgen.toml");
    let mut builder = cbindgen::Builder::new().with_config(config);
    for source in SOURCES {
        builder = builder.with_src(here.join("src").join(source).with_extension("rs"));
    }
    let structs = Path::new(env!("CARGO_TARGET_TMPDIR")).join("parameters.rs");
    fs::write(&structs, PARAMETERS.concat()).expect("the folder for tests can be written");
    let mut text = Vec::new();
    builder
        .with_src(structs)
        .generate()
        .expect("sources that cbindgen understands")
        .write(&mut text);
    let text = String::from_utf8(text).expect("UTF-8");
    let path = here.join("include/mufasa.h");
    if std::env::var_os("UPDATE_HEADER").is_some() {
        fs::write(&path, &text).expect("the header can be written");
    }
    let committed = fs::read_to_string(&path).unwrap_or_default();
    let line = committed.lines().zip(text.lines()).position(|(old, new)| old != new);
    assert!(
        committed == text,
        "include/mufasa.h differs from the sources, first at line {:?}; \
         UPDATE_HEADER=1 cargo test -p mufasa-capi --test header writes it anew",
        line.map(|line| line + 1),
    );
}

/// A file that is not among the sources would be missed by nobody else.
#[test]
fn every_call_is_in_the_header() {
    let (header, mut open) = (committed(), vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("src")]);
    let mut count = 0;
    while let Some(path) = open.pop() {
        if path.is_dir() {
            let entries = fs::read_dir(path).expect("the sources");
            open.extend(entries.map(|it| it.expect("a directory entry").path()));
            continue;
        }
        let source = fs::read_to_string(&path).expect("a source is text");
        for after in source.split("\"C\" fn mufasa_").skip(1) {
            let name = after.split('(').next().expect("a name");
            assert!(header.contains(&format!("mufasa_{name}(")), "{}: {name}", path.display());
            count += 1;
        }
    }
    assert!(count > 20, "{count}");
}

const FRAME: &str = "right-handed frame";
/// No frame of the CAV, which moves.
const STILL: &str = "stands still";
/// Structs with places and distances, and what the comment above each has to name: the frame, and what x and y
/// are of.
const PLACES: [(&str, &[&str]); 10] = [
    ("MufasaCycle", &[FRAME, STILL, "x towards y", "left of it is (-sin, cos)", "m/s"]),
    ("MufasaMonitorInputs", &[FRAME, STILL, "x towards y", "left of it is (-sin, cos)", "m/s"]),
    (
        "MufasaEgo",
        &[FRAME, STILL, "x, y", "reference point", "rear axle", "centre", "center_offset"],
    ),
    ("MufasaTrajectoryPoint", &[FRAME, STILL, "x, y", "reference point"]),
    ("MufasaTrajectory", &[FRAME, STILL, "reference point"]),
    ("MufasaTrack", &[FRAME, STILL, "x, y", "centre", "over ground"]),
    ("MufasaDetection", &[FRAME, STILL, "x, y", "centre"]),
    ("MufasaLead", &["reference path", "bumper to bumper"]),
    ("MufasaCrossSection", &[FRAME, STILL, "x, y", "reference path", "left", "driving direction"]),
    ("MufasaGrid", &[FRAME, STILL, "x, y", "origin", "corner", "column", "row", "(-sin, cos)"]),
];
/// Those of their `double` fields; a direction has none.
const UNITS: [&str; 4] = [", m.", ", m/s.", "cos of the direction.", "sin of the direction."];

fn committed() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("include/mufasa.h");
    fs::read_to_string(path).expect("the header")
}

/// The comment that ends this text, in one line.
fn comment_before(text: &str) -> String {
    let lines = text.lines().rev().map_while(|line| line.trim().strip_prefix("//"));
    let mut lines: Vec<&str> = lines.map(str::trim).collect();
    lines.reverse();
    lines.join(" ")
}

#[test]
fn the_header_names_frame_reference_point_and_units() {
    let header = committed();
    for (name, words) in PLACES {
        let start = format!("typedef struct {name} {{\n");
        let (before, after) = header.split_once(&start).expect(name);
        let above = comment_before(before);
        for word in words {
            assert!(above.contains(word), "{name}: {word:?} is not in {above:?}");
        }
        let (body, _) = after.split_once('}').expect(name);
        let lines: Vec<&str> = body.lines().map(str::trim).collect();
        for pair in lines.windows(2).filter(|pair| pair[1].starts_with("double ")) {
            let has_unit = UNITS.iter().any(|unit| pair[0].ends_with(unit));
            assert!(pair[0].starts_with("// ") && has_unit, "{name}: the unit of {:?}", pair[1]);
        }
    }
}

/// A new status, reason or action without a text would be told as "unknown".
#[test]
fn every_status_drop_reason_and_action_has_a_text() {
    let header = committed();
    let mut told = Vec::new();
    for (prefix, text) in [
        ("  MUFASA_STATUS_", mufasa_status_text as extern "C" fn(u32) -> *const c_char),
        ("  MUFASA_DROP_REASON_", mufasa_drop_reason_text),
        ("  MUFASA_ACTION_TYPE_", mufasa_action_text),
        ("  MUFASA_ADVICE_", mufasa_advice_text),
        ("  MUFASA_FAILED_STAGE_", mufasa_failed_stage_text),
    ] {
        let values = header.lines().filter(|line| line.starts_with(prefix));
        let numbers = values.map(|line| line.split(['=', ',']).nth(1).expect(line).trim());
        let numbers: Vec<u32> = numbers.map(|it| it.parse().expect("a number")).collect();
        // SAFETY: the texts are constants that end with a 0.
        let said = |number| unsafe { CStr::from_ptr(text(number)) }.to_str().expect("UTF-8");
        assert!(numbers.len() >= 5 && said(u32::MAX) == "unknown" && said(99) == "unknown");
        told.extend(numbers.into_iter().map(said));
    }
    assert!(told.iter().all(|it| it.len() > 2 && *it != "unknown"), "{told:?}");
    let differ: BTreeSet<_> = told.iter().collect();
    assert_eq!(differ.len(), told.len(), "{told:?}");
}
