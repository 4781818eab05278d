//! The random numbers of the recipe.

use std::f64::consts::TAU;

/// `SplitMix64`, as the recipe prescribes it: the workloads have to be the same numbers, bit for bit
/// (`checksums.txt`), in any language.
pub struct Draws(pub u64);

impl Draws {
    /// A number in [0, 1).
    pub fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        #[expect(clippy::cast_precision_loss, reason = "53 bits are left")]
        let whole = ((z ^ (z >> 31)) >> 11) as f64;
        whole * (0.5_f64).powi(53)
    }

    /// Box and Muller, the cosine branch only.
    pub fn normal(&mut self) -> f64 {
        let (a, b) = (self.uniform(), self.uniform());
        (-2.0 * (1.0 - a).ln()).sqrt() * (TAU * b).cos()
    }
}
