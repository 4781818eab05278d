//! The same input, decided a second time with other memory.

use mufasa::scratch::{Column, Row, Scratch, Sizes};
use mufasa_model::cycle::{Cycle, Profile};
use mufasa_props::bridge::to_impl;
use mufasa_props::strategy::draw::Draw;
use mufasa_props::strategy::{input, track_validation, whole};

use crate::arbitrary;

const CYCLES: u64 = 4_000;

/// The answer with all bits of its numbers: Debug writes shortest decimals and the sign of zero.
fn answer(cycle: &Cycle, rows: &mut [Row], columns: &mut [Column]) -> String {
    let owned = to_impl(cycle);
    format!("{:?}", mufasa::schedule::check(&owned.borrow(), &mut Scratch::new(rows, columns)))
}

/// `spec/4-arithmetic.md#conformance-of-an-implementation.5`: verdict and witness are the same in
/// fresh scratch of the size asked for and in scratch that is too large and full of what other
/// cycles left there.
#[test]
fn the_same_input_gives_the_same_verdict_and_witness() {
    let Sizes { rows, columns } = Sizes::MAX;
    let (mut used_rows, mut used_columns) =
        (vec![Row::default(); rows + 3], vec![Column::default(); columns + 3]);
    let mut witnesses = 0;
    for seed in 0..CYCLES {
        let tape = arbitrary::tape(seed);
        let mut draw = Draw::new(&tape);
        let profile = draw.pick(&[Profile::Paper, Profile::Hardened]);
        let cycles = [
            whole::cycle(&mut draw, profile),
            track_validation::cycle(&mut draw, profile),
            input::cycle(&mut draw, profile),
            arbitrary::cycle(&tape),
        ];
        for cycle in cycles {
            let sizes = Sizes::for_cycle(&to_impl(&cycle).borrow());
            let mut rows = vec![Row::default(); sizes.rows];
            let mut columns = vec![Column::default(); sizes.columns];
            let first = answer(&cycle, &mut rows, &mut columns);
            assert_eq!(answer(&cycle, &mut used_rows, &mut used_columns), first, "{cycle:?}");
            assert_eq!(answer(&cycle, &mut rows, &mut columns), first, "{cycle:?}");
            witnesses += u64::from(first.contains("Witness"));
        }
    }
    assert!(witnesses > CYCLES, "only {witnesses} failures were compared");
}
