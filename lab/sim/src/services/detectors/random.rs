//! Draws that depend on who draws, when and about what, and not on what others drew before.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// The draws of one detector about one object in one cycle.
#[derive(Clone, Debug)]
pub struct Draws(ChaCha8Rng);

impl Draws {
    /// The stream of these four numbers.
    pub fn new(key: [u64; 4]) -> Self {
        let mut seed = [0; 32];
        for (bytes, number) in seed.chunks_exact_mut(8).zip(key) {
            bytes.copy_from_slice(&number.to_le_bytes());
        }
        Self(ChaCha8Rng::from_seed(seed))
    }

    /// Uniform in [0, 1).
    pub fn share(&mut self) -> f64 {
        self.0.random()
    }

    /// Uniform between two values.
    pub fn between(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * self.share()
    }

    /// Two independent normal draws with standard deviation one (Box and Muller 1958).
    pub fn normal_pair(&mut self) -> [f64; 2] {
        let radius = (-2.0 * libm::log(1.0 - self.share())).sqrt();
        let (sin, cos) = libm::sincos(core::f64::consts::TAU * self.share());
        [radius * cos, radius * sin]
    }

    /// How many events of a Poisson process, whose mean is `mean`, happen (Knuth's method: for small means).
    pub fn count(&mut self, mean: f64) -> usize {
        let least = libm::exp(-mean);
        let (mut product, mut events) = (self.share(), 0);
        while product > least {
            product *= self.share();
            events += 1;
        }
        events
    }
}
