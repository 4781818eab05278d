//! IMPL-06: the same input gives the same
//! verdict and witness, bit for bit, whatever scratch memory held before and where lists lie.

use mufasa::input::scratch::{Column, Row, Scratch, Sizes};
use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_props::bridge::{check_impl, invalid_input_from_impl, report_from_impl, to_impl};
use mufasa_props::differential::runner;
use mufasa_props::strategy::draw::{Draw, tape};
use mufasa_props::strategy::whole;
use proptest::strategy::{Strategy, ValueTree};

#[test]
fn the_same_input_gives_the_same_answer_bit_for_bit() {
    let mut runner = runner();
    // Scratch of the largest size, used for every cycle and never cleared.
    let mut rows = vec![Row::default(); Sizes::MAX.rows];
    let mut columns = vec![Column::default(); Sizes::MAX.columns];
    let mut failed = 0;
    for index in 0..4000 {
        let tape = tape().new_tree(&mut runner).expect("a tape is always drawn").current();
        let profile = [Profile::PAPER, Profile::HARDENED][index % 2];
        let cycle = whole::cycle(&mut Draw::new(&tape), profile);
        let first = format!("{:?}", check_impl(&cycle));
        assert_eq!(first, format!("{:?}", check_impl(&cycle)), "the second run of {cycle:?}");
        assert_eq!(first, format!("{:?}", check_impl(&moved(&cycle))), "other memory: {cycle:?}");
        let owned = to_impl(&cycle);
        let mut scratch = Scratch::new(&mut rows, &mut columns);
        let used = mufasa::cycle::check(&owned.borrow(&owned.history()), &mut scratch);
        let fresh = {
            let mut rows = vec![Row::default(); Sizes::MAX.rows];
            let mut columns = vec![Column::default(); Sizes::MAX.columns];
            let mut scratch = Scratch::new(&mut rows, &mut columns);
            mufasa::cycle::check(&owned.borrow(&owned.history()), &mut scratch)
        };
        assert_eq!(format!("{used:?}"), format!("{fresh:?}"), "used scratch: {cycle:?}");
        let used = used.map(|it| report_from_impl(&it)).map_err(|it| invalid_input_from_impl(&it));
        assert_eq!(format!("{used:?}"), first, "scratch of another size: {cycle:?}");
        failed += u32::from(first.contains("Failed"));
    }
    assert!(failed > 400, "only {failed} cycles had a witness");
}

/// The same values in lists of another capacity, so at another place in memory.
fn moved(cycle: &Cycle) -> Cycle {
    let mut moved = cycle.clone();
    moved.route.cross_sections.reserve(57);
    if let Some(list) = &mut moved.tracks {
        list.items.reserve(33);
    }
    if let Some(list) = &mut moved.trajectory {
        list.points.reserve(91);
    }
    moved
}
