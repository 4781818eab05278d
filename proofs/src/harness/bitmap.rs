//! The cells of a grid as bits (`spec/5-interfaces.md#cycle`), piece by piece: a word, a row, the rows around a cell.

use mufasa::parts::{bits_from, cell_within, first_in_row, row_is_free};

use super::bounds::{GRID, GRID_BYTES};
#[cfg(not(kani))]
use crate::kani;

const SIDE: i64 = GRID as i64;

/// A word has the 57 bits from a place on, and no others.
///
/// Domain: all bitmaps of 8 bytes, places in the first. Not covered: other sizes and places.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(10))]
pub fn verify_a_word_has_the_bits_from_a_place() {
    let all: u64 = kani::any();
    let bytes = all.to_le_bytes();
    for from in 0..8 {
        let expected = (all >> from) & ((1 << 57) - 1);
        assert!(bits_from(&bytes, from) == Some(expected));
    }
    kani::cover!(bits_from(&bytes, 7) == Some(1 << 56), "the last bit of eight bytes");
    kani::cover!(bits_from(&bytes, 0) == Some(0) && all > 0, "bits that are left out");
}

/// A word at the end of a bitmap has the bits that are left, and beyond the end there are none.
///
/// Domain: all bitmaps of 2 bytes, places from 1 before them to 8 behind. Not covered: other sizes and places.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(27))]
pub fn verify_a_word_ends_with_the_bitmap() {
    let bits = cells();
    let all = u64::from(u16::from_le_bytes(bits));
    for from in -1..=24 {
        let expected = if (0..24).contains(&from) { Some(all >> from) } else { None };
        assert!(bits_from(&bits, from) == expected);
    }
    kani::cover!(bits_from(&bits, 15) == Some(1), "the last bit");
    kani::cover!(bits_from(&bits, 16) == Some(0) && all > 0, "behind the last bit");
}

/// The first set cell of a row between two columns is found, wherever these are, and in no row outside
/// the grid any.
///
/// Domain: all grids of 4 by 4 cells, the last row, columns from -1 to 4. Not covered: other sizes and rows.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(9))]
pub fn verify_the_first_set_cell_of_a_row_is_found() {
    let bits = cells();
    for from in -1..=SIDE {
        for to in -1..=SIDE {
            let found = first_in_row(&bits, [SIDE; 2], LAST, [from, to]);
            assert!(found == (from..=to).find(|&column| is_set(bits, column, LAST)));
        }
    }
    let [before, first, behind] =
        [-1, LAST, SIDE].map(|row| first_in_row(&bits, [SIDE; 2], row, [i64::MIN, i64::MAX]));
    assert!(before.is_none() && behind.is_none());
    kani::cover!(first == Some(3), "the last cell alone");
    kani::cover!(first.is_none(), "an empty row");
}

/// A row is free between two columns exactly when no cell of it is set there.
///
/// Domain: all grids of 4 by 4 cells, the last row, all columns within. Not covered: other sizes and rows.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(9))]
pub fn verify_a_free_row_has_no_set_cell() {
    let bits = cells();
    for from in 0..SIDE {
        for end in 0..=SIDE {
            let found = row_is_free(&bits, [SIDE; 2], LAST, [from, end]);
            assert!(found == (from..end).all(|column| !is_set(bits, column, LAST)));
        }
    }
    let last = row_is_free(&bits, [SIDE; 2], LAST, [0, SIDE]);
    kani::cover!(last && bits != [0; GRID_BYTES], "free");
    kani::cover!(!last, "set");
}

/// The cell that is found around another one is the first set one, by row, then column, whose squared
/// distance is at most what is asked for, and the distance is the right one [S5-03].
///
/// Domain: all grids of 4 by 4 cells, around a cell inside, squared distances of 1, 4 and 8. Not covered:
/// other sizes, cells and distances.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(9))]
pub fn verify_the_first_near_cell_is_found() {
    let bits = cells();
    for most in [1, 4, FARTHEST] {
        assert!(cell_within(&bits, [SIDE; 2], CELL, most) == nearest(bits, CELL, most));
    }
    kani::cover!(nearest(bits, CELL, FARTHEST) == Some([3, 0, 8]), "the farthest");
    kani::cover!(nearest(bits, CELL, 4).is_none() && bits != [0; GRID_BYTES], "none near");
}

/// The row at the end of the bitmap.
const LAST: i64 = 3;
/// Column and row.
const CELL: [i64; 2] = [1, 2];
/// The square of the distance from there to the corner that is farthest.
const FARTHEST: i64 = 8;

fn nearest(bits: [u8; GRID_BYTES], [column, row]: [i64; 2], most: i64) -> Option<[i64; 3]> {
    (0..SIDE).find_map(|k| {
        (0..SIDE).find_map(|i| {
            let squared = (i - column) * (i - column) + (k - row) * (k - row);
            (squared <= most && is_set(bits, i, k)).then_some([i, k, squared])
        })
    })
}

fn cells() -> [u8; GRID_BYTES] {
    [kani::any(), kani::any()]
}

/// Bit 4 row + column; none outside the grid.
fn is_set(bits: [u8; GRID_BYTES], column: i64, row: i64) -> bool {
    let within = |at: i64| (0..SIDE).contains(&at);
    let all = u16::from_le_bytes(bits);
    within(column) && within(row) && all >> (SIDE * row + column) & 1 == 1
}
