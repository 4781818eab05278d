//! The intervals in front of the model's exact arithmetic only save time
//! (EXACT-01, EXACT-02): without them every report is the same, down to
//! the numbers of its witnesses.

use std::collections::BTreeMap;

use mufasa_model::cycle::check;
use mufasa_model::input::cycle::Profile;
use mufasa_model::numbers::real::unfiltered;
use mufasa_model::report::Reading;
use mufasa_props::conformance::name;
use mufasa_props::differential::runner;
use mufasa_props::strategy::draw::{Draw, tape};
use mufasa_props::strategy::whole;
use proptest::strategy::{Strategy, ValueTree};

/// Cycles of each profile; exact numbers alone take their time.
const CYCLES: usize = 500;

#[test]
fn the_filter_changes_no_report_of_drawn_cycles() {
    let mut runner = runner();
    let mut seen = BTreeMap::<&str, u32>::new();
    for index in 0..2 * CYCLES {
        let tape = tape().new_tree(&mut runner).expect("a tape is always drawn").current();
        let profile = [Profile::PAPER, Profile::HARDENED][index % 2];
        let cycle = whole::cycle(&mut Draw::new(&tape), profile);
        for reading in [Reading::Strict, Reading::Exact, Reading::Lax] {
            let filtered = check(&cycle, reading);
            let plain = unfiltered(|| check(&cycle, reading));
            assert_eq!(format!("{filtered:?}"), format!("{plain:?}"), "{cycle:?}");
            if let (Reading::Exact, Ok(report)) = (reading, plain) {
                *seen.entry(name(report.failed_stage)).or_default() += 1;
            }
        }
    }
    println!("{seen:?}");
    for verdict in ["safe", "i", "ii", "iii", "iv", "v"] {
        assert!(seen.get(verdict).is_some_and(|count| *count > 10), "{verdict}: {seen:?}");
    }
}
