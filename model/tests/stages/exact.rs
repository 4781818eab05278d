//! Decisions of the model against decisions made otherwise: by trying everything, in integers, or
//! by the program of somebody else (`docs/exactness.md`). Thresholds are met exactly, and missed by
//! a tiny distance on either side.

mod assignments;
mod cells;
mod distances;
mod rectangles;

/// A small linear congruential generator: the tests need no more than reproducible variety.
pub struct Draw(pub u64);

impl Draw {
    /// An integer from `low` to `high`.
    pub fn between(&mut self, low: i32, high: i32) -> i32 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let count = i64::from(high) - i64::from(low) + 1;
        let drawn = i64::try_from(self.0 >> 33).expect("31 bits") % count;
        low + i32::try_from(drawn).expect("below the count")
    }
}
