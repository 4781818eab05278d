//! A tape of choices: one source of randomness for proptest, for fuzzers and for hand-made cases.
//!
//! Generators read the tape front to back; behind its end every choice is the first, simplest
//! one. A shorter tape and smaller numbers thus give a simpler case, which is all that shrinking
//! needs.

use proptest::collection::vec;
use proptest::prelude::{Strategy, any};

/// Length of the tapes for cycles; every generator of a cycle reads less.
const TAPE: usize = 160;

/// Length of the tapes for sequences of events.
const LONG_TAPE: usize = 1_280;

/// Length of the tapes for sequences of a monitor, of which each step reads up to 15 choices.
const LONGEST_TAPE: usize = 2_400;

/// Reads choices from a tape.
#[derive(Clone, Debug)]
pub struct Draw<'a> {
    tape: &'a [u32],
    at: usize,
}

/// Tapes for sequences of events.
pub fn long_tape() -> impl Strategy<Value = Vec<u32>> {
    vec(any::<u32>(), LONG_TAPE)
}

/// Tapes for sequences of a monitor.
pub fn longest_tape() -> impl Strategy<Value = Vec<u32>> {
    vec(any::<u32>(), LONGEST_TAPE)
}

/// Tapes for cycles.
pub fn tape() -> impl Strategy<Value = Vec<u32>> {
    vec(any::<u32>(), TAPE)
}

impl<'a> Draw<'a> {
    /// Reads from `tape`.
    pub fn new(tape: &'a [u32]) -> Self {
        Self { tape, at: 0 }
    }

    /// The next 32 bits, 0 behind the end.
    pub fn bits(&mut self) -> u32 {
        let bits = self.tape.get(self.at).copied().unwrap_or(0);
        self.at += 1;
        bits
    }

    /// An index below `n`, which is at least 1. The high bits decide, as shrinking lowers them.
    pub fn below(&mut self, n: usize) -> usize {
        let scaled = (u64::from(self.bits()) * n as u64) >> 32;
        usize::try_from(scaled).unwrap_or(0)
    }

    /// A number from `lo` to `hi`, both included.
    pub fn between(&mut self, lo: usize, hi: usize) -> usize {
        lo + self.below(hi - lo + 1)
    }

    /// True once in `n` times; never behind the end of the tape.
    pub fn one_in(&mut self, n: usize) -> bool {
        self.below(n) == n - 1 && n > 1
    }

    /// One of the choices.
    pub fn pick<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.below(choices.len())]
    }

    /// A number in [lo, hi).
    pub fn range(&mut self, lo: f64, hi: f64) -> f64 {
        lo + (hi - lo) * f64::from(self.bits()) / 4_294_967_296.0
    }

    /// A signed distance from a threshold: zero, or 1e-9 to 1e-5 in size.
    pub fn offset(&mut self) -> f64 {
        if self.below(4) == 0 {
            return 0.0;
        }
        let sign = self.pick(&[1.0, -1.0]);
        sign * 10_f64.powf(self.range(-9.0, -5.0))
    }

    /// `value` at a threshold: exact, a few units in the last place off, or by `offset`.
    pub fn near(&mut self, value: f64) -> f64 {
        match self.below(8) {
            0 | 1 => value,
            2 => self.ulps(value),
            _ => value + self.offset(),
        }
    }

    /// `value` moved by one to four units in the last place.
    pub fn ulps(&mut self, value: f64) -> f64 {
        let up = self.below(2) == 0;
        let mut moved = value;
        for _ in 0..self.between(1, 4) {
            moved = if up { moved.next_up() } else { moved.next_down() };
        }
        moved
    }

    /// A time at a border: exact or one nanosecond beside it.
    pub fn near_ns(&mut self, value: i64) -> i64 {
        value.saturating_add(self.pick(&[0, 1, -1]))
    }

    /// About as long, at times exactly: mostly up to 1 ms shorter, or longer where it is shorter than that, and no
    /// whole number of us, so that a program that rounds times moves what moves.
    pub fn odd_ns(&mut self, value: i64) -> i64 {
        let (whole, rest) = (self.bits() % 1000, self.bits() % 999);
        let off = i64::from(1000 * whole + rest + 1);
        match self.below(4) {
            0 => value,
            _ if value < 1_000_000 => value.saturating_add(off),
            _ => value - off,
        }
    }

    /// A direction: exact (multiples of 90 degrees, 3-4-5, 5-12-13), any angle, or one that is
    /// not quite a unit vector (within the domain's 1e-6).
    pub fn direction(&mut self) -> (f64, f64) {
        const EXACT: [(f64, f64); 8] = [
            (1.0, 0.0),
            (0.0, 1.0),
            (-1.0, 0.0),
            (0.0, -1.0),
            (0.6, 0.8),
            (-0.8, 0.6),
            (5.0 / 13.0, 12.0 / 13.0),
            (0.28, -0.96),
        ];
        let (cos, sin) = if self.below(3) == 0 {
            self.pick(&EXACT)
        } else {
            let angle = self.range(-std::f64::consts::PI, std::f64::consts::PI);
            (angle.cos(), angle.sin())
        };
        if self.one_in(4) {
            let scale = 1.0 + self.range(-4.9e-7, 4.9e-7);
            (cos * scale, sin * scale)
        } else {
            (cos, sin)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn behind_the_end_every_choice_is_the_first() {
        let mut draw = Draw::new(&[]);
        assert_eq!(draw.below(7), 0);
        assert!(!draw.one_in(2));
        assert_eq!(draw.pick(&["simple", "rare"]), "simple");
        assert_eq!(draw.near(0.3).to_bits(), 0.3_f64.to_bits());
        assert_eq!(draw.direction(), (1.0, 0.0));
    }

    #[test]
    fn directions_stay_in_the_domain() {
        for seed in 0..5000_u32 {
            let tape: Vec<u32> = (1..6_u32).map(|i| seed.wrapping_mul(2_654_435_761 + i)).collect();
            let (cos, sin) = Draw::new(&tape).direction();
            assert!((cos * cos + sin * sin - 1.0).abs() < 1e-6);
        }
    }
}
