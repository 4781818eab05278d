//! Against looking at every cell.

use std::vec;
use std::vec::Vec;

use super::{Bitmap, NearCell};
use crate::random::Random;

#[test]
fn searches_find_what_a_look_at_every_cell_finds() {
    let mut random = Random::new(7);
    let mut found = 0;
    for _ in 0..3_000 {
        let most = [20, 150][random.below(2) as usize];
        let (width, height) = (1 + random.below(most) as i64, 1 + random.below(6) as i64);
        let mut bits = vec![0_u8; (width * height + 7) as usize / 8];
        for _ in 0..random.below(5) {
            let at = random.below(bits.len() as u64 * 8) as usize;
            bits[at / 8] |= 1 << (at % 8);
        }
        let map = Bitmap { bits: &bits, width, height };
        let set = |column: i64, row: i64| {
            let bit = (row * width + column) as usize;
            bits[bit / 8] >> (bit % 8) & 1 == 1
        };
        let row = random.below(8) as i64 - 1;
        let (from, to) =
            (random.below(width as u64 + 4) as i64 - 2, random.below(width as u64 + 4) as i64 - 2);
        let columns = from.max(0)..=to.min(width - 1);
        let expected = columns.into_iter().filter(|&i| 0 <= row && row < height && set(i, row));
        let expected: Vec<_> = expected.collect();
        assert_eq!(map.set_in_row(row, from, to).collect::<Vec<_>>(), expected);
        let expected = expected.first().copied();
        assert_eq!(map.first_in_row(row, from, to), expected);
        let (start, end) = (from.clamp(0, width), (to + 1).clamp(0, width));
        if 0 <= row && row < height {
            assert_eq!(map.row_is_free(row, start, end), expected.is_none());
        }

        let (column, row, most) = (from, row, random.below(30) as i64);
        let squared = |i: i64, k: i64| (i - column) * (i - column) + (k - row) * (k - row);
        let mut cells = (0..height).flat_map(|k| (0..width).map(move |i| (i, k)));
        let expected = cells.find(|&(i, k)| set(i, k) && squared(i, k) <= most);
        let near = |(i, k)| NearCell { row: k, column: i, squared: squared(i, k) };
        assert_eq!(map.within(column, row, most), expected.map(near));
        found += u32::from(expected.is_some());
    }
    assert!(found > 200, "{found}");
}
