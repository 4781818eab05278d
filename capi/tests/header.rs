//! The committed header is the one that the sources give.

use std::fs;
use std::path::Path;

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
const SOURCES: [&str; 15] = [
    "status",
    "version",
    "time",
    "cycle",
    "detection_index",
    "report",
    "check",
    "event",
    "requester",
    "monitor/settings",
    "monitor/element",
    "monitor/decision",
    "monitor/place",
    "monitor/calls",
    "monitor/problem",
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
