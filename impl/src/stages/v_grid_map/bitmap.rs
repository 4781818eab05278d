//! The cells of a grid as bits (`spec/5-interfaces.md#cycle`).

/// Bit row * width + column, least significant bit of each byte first.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bitmap<'a> {
    pub(crate) bits: &'a [u8],
    pub(crate) width: i64,
    pub(crate) height: i64,
}

/// A set cell near another one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct NearCell {
    pub(crate) row: i64,
    pub(crate) column: i64,
    /// The square of the distance that was asked for, in cells.
    pub(crate) squared: i64,
}

/// So many bits of eight bytes are left when up to seven are not wanted.
const WHOLE: i64 = 57;

impl Bitmap<'_> {
    /// The first set cell of the row with from <= column <= to; columns outside the array are not
    /// set.
    pub(crate) fn first_in_row(&self, row: i64, from: i64, to: i64) -> Option<i64> {
        let (from, to) = (from.max(0), to.min(self.width.saturating_sub(1)));
        if row < 0 || row >= self.height || from > to {
            return None;
        }
        let start = row.saturating_mul(self.width);
        let last = start.saturating_add(to);
        let mut bit = start.saturating_add(from);
        while bit <= last {
            let word = self.bits_from(bit)?;
            let found = bit.saturating_add(i64::from(word.trailing_zeros()));
            if word != 0 {
                return (found <= last).then(|| found.saturating_sub(start));
            }
            bit = bit.saturating_add(WHOLE);
        }
        None
    }

    /// The set cells of the row with from <= column <= to.
    pub(crate) fn set_in_row(&self, row: i64, from: i64, to: i64) -> impl Iterator<Item = i64> {
        let after = move |&i: &i64| self.first_in_row(row, i.saturating_add(1), to);
        core::iter::successors(self.first_in_row(row, from, to), after)
    }

    /// Whether no cell of the row with from <= column < end is set; all of them have to be within
    /// the array.
    pub(crate) fn row_is_free(&self, row: i64, from: i64, end: i64) -> bool {
        let start = row.wrapping_mul(self.width);
        let (mut bit, end) = (start.wrapping_add(from), start.wrapping_add(end));
        while bit < end {
            let Some(word) = self.bits_from(bit) else { return false };
            let left = end.wrapping_sub(bit);
            let wanted = if left < WHOLE { (1_u64 << left).wrapping_sub(1) } else { u64::MAX };
            if word & wanted != 0 {
                return false;
            }
            bit = bit.wrapping_add(WHOLE);
        }
        true
    }

    /// `WHOLE` bits from this one on, in a word whose other bits are not set; beyond the end of the
    /// bitmap none are.
    pub(crate) fn bits_from(&self, bit: i64) -> Option<u64> {
        let rest = self.bits.get(usize::try_from(bit >> 3).ok()?..)?;
        let word = rest.first_chunk().copied().unwrap_or_else(|| {
            let mut bytes = [0; 8];
            bytes.iter_mut().zip(rest).for_each(|(byte, &given)| *byte = given);
            bytes
        });
        Some((u64::from_le_bytes(word) >> (bit & 7)) & ((1 << WHOLE) - 1))
    }

    /// The first set cell, by row, then column, whose centre is at most the root of `most` cells
    /// away from that of a cell, and the square of that distance.
    pub(crate) fn within(&self, column: i64, row: i64, most: i64) -> Option<NearCell> {
        let reach = root(most);
        let rows = row.saturating_sub(reach).max(0)..=row.saturating_add(reach);
        rows.take_while(|&k| k < self.height).find_map(|k| {
            let up = square(k.saturating_sub(row));
            let across = root(most.saturating_sub(up));
            let from = column.saturating_sub(across);
            let found = self.first_in_row(k, from, column.saturating_add(across))?;
            let squared = up.saturating_add(square(found.saturating_sub(column)));
            Some(NearCell { row: k, column: found, squared })
        })
    }
}

fn square(value: i64) -> i64 {
    value.saturating_mul(value)
}

/// The largest integer whose square is at most `value`; 0 for negative values.
fn root(value: i64) -> i64 {
    i64::try_from(u64::try_from(value).unwrap_or(0).isqrt()).unwrap_or(i64::MAX)
}

#[cfg(test)]
mod tests;
