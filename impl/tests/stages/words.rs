//! What a person reads: each problem has words of its own, and names what it is about.

use std::collections::BTreeSet;

use mufasa::monitor::{Advice, DropReason, MonitorError, Time, Unusual};
use mufasa::offloading::requester::RequesterError;
use mufasa::report::{InvalidInput, Problem};

#[test]
fn advice_and_reasons_have_words_of_their_own() {
    let [advice, reasons] =
        [Advice::ALL.map(|it| it.to_string()), DropReason::ALL.map(|it| it.to_string())];
    let words = advice.into_iter().chain(reasons);
    let words: BTreeSet<String> = words.filter(|text| text.len() > 10).collect();
    assert_eq!(words.len(), Advice::ALL.len() + DropReason::ALL.len(), "{words:?}");
}

#[test]
fn errors_name_what_they_are_about() {
    let unusual = Unusual { field: "stages.a_b", value: 80.0, least: 1.0, most: 12.0 };
    let memory = |field| MonitorError::Memory { field, needed: 7, given: 3 };
    let items =
        InvalidInput { field: "tracks.items.x", index: Some(4), problem: Problem::NotFinite };
    let errors: [(String, &[&str]); 7] = [
        (RequesterError::Station { station: -4 }.to_string(), &["-4"]),
        (RequesterError::TableFull { station: 9, capacity: 8 }.to_string(), &["9", "8"]),
        (Time::from_seconds(f64::NAN).unwrap_err().to_string(), &["seconds"]),
        (MonitorError::Unusual(unusual).to_string(), &["stages.a_b", "80", "12"]),
        (memory("slots").to_string(), &["slots", "7", "3", "Memory::slots_for"]),
        (memory("tracks").to_string(), &["tracks", "7", "3"]),
        (items.to_string(), &["tracks.items.x", "4"]),
    ];
    for (text, parts) in errors {
        assert!(parts.iter().all(|part| text.contains(part)), "{text}: {parts:?}");
    }
}
