//! The bytes of a message of every kind, which do not change: what is on the road understands them.
//! Another implementation of ASN.1 has read them (`docs/link-messages.md`).

use std::fmt::Write as _;

use mufasa_link::message::encode;

use super::common::{frame, messages};

/// LINK-01; `UPDATE_HEX=1` writes the file.
#[test]
fn the_bytes_are_those_of_the_file() {
    let mut text = String::new();
    for message in messages() {
        for byte in encode(&message, &frame()).unwrap() {
            write!(text, "{byte:02x}").unwrap();
        }
        text.push('\n');
    }
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/codec/messages.hex");
    if std::env::var_os("UPDATE_HEX").is_some() {
        std::fs::write(file, &text).unwrap();
    }
    assert_eq!(std::fs::read_to_string(file).unwrap(), text);
}

/// `spec/6-link.md#our-module`
#[test]
fn the_spec_has_the_module_in_full() {
    let read = |path: &str| {
        std::fs::read_to_string(format!("{}/{path}", env!("CARGO_MANIFEST_DIR"))).unwrap()
    };
    let module = read("asn1/mufasa-link.asn");
    let spec = read("../../spec/6-link.md");
    for line in module.lines() {
        assert!(
            spec.lines().any(|it| it.trim() == line.trim()),
            "spec/6-link.md has no line {line}"
        );
    }
    assert!(spec.contains(&format!("```asn1\n{module}```\n")), "spec/6-link.md has another order");
}
