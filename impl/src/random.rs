//! Random numbers of the unit tests: the same in every run, of every size, and often related.

use std::vec::Vec;

/// A linear congruential generator (Knuth's MMIX constants), high bits used.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn bits(&mut self) -> u64 {
        let [high, low] = [self.step(), self.step()];
        (high >> 32) << 32 | low >> 32
    }

    fn step(&mut self) -> u64 {
        let Self(state) = self;
        *state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        *state
    }

    /// A number below `limit`.
    pub(crate) fn below(&mut self, limit: u64) -> u64 {
        self.bits() % limit
    }

    /// A double of up to 2^24 in size: now and then tiny, subnormal, 0 or an integer.
    pub(crate) fn double(&mut self) -> f64 {
        let exponent = match self.below(8) {
            0 => self.below(1047),
            1 => return self.below(64) as f64 - 32.0,
            2 => return [0.0, -0.0, 5e-324, 1e-310][self.below(4) as usize],
            _ => 1023 + 24 - 1 - self.below(50),
        };
        f64::from_bits(self.bits() & (1 << 63 | 0x000f_ffff_ffff_ffff) | exponent << 52)
    }

    /// Some doubles, of which later ones may be equal or next to earlier ones.
    pub(crate) fn related(&mut self, count: usize) -> Vec<f64> {
        let mut values = std::vec![self.double()];
        while values.len() < count {
            let old = values[self.below(values.len() as u64) as usize];
            values.push(match self.below(4) {
                0 => old,
                1 => f64::from_bits(old.to_bits() ^ self.below(4)),
                _ => self.double(),
            });
        }
        values
    }
}
