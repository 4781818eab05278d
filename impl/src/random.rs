//! Random numbers of the unit tests: the same in every run, of every size, and often related.

use std::vec::Vec;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

pub(crate) struct Random(ChaCha8Rng);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    /// A number below `limit`.
    pub(crate) fn below(&mut self, limit: u64) -> u64 {
        self.0.random_range(0..limit)
    }

    /// A double of up to 2^24 in size: now and then tiny, subnormal, 0 or an integer.
    pub(crate) fn double(&mut self) -> f64 {
        let exponent = match self.below(8) {
            0 => self.below(1047),
            1 => return self.below(64) as f64 - 32.0,
            2 => return [0.0, -0.0, 5e-324, 1e-310][self.below(4) as usize],
            _ => 1023 + 24 - 1 - self.below(50),
        };
        f64::from_bits(self.0.random::<u64>() & (1 << 63 | 0x000f_ffff_ffff_ffff) | exponent << 52)
    }

    /// From -size to size, in steps of a millionth of it.
    pub(crate) fn number(&mut self, size: f64) -> f64 {
        (self.below(2_000_001) as f64 / 1e6 - 1.0) * size
    }

    /// As far from a unit vector as the domain allows.
    pub(crate) fn direction(&mut self) -> [f64; 2] {
        let (sin, cos) = self.number(3.2).sin_cos();
        let stretch = 1.0 + self.number(4.9e-7);
        [cos * stretch, sin * stretch]
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
