//! Arbitrary values: choices from the tape, and numbers that are often equal, next to each other,
//! or at a limit.

use super::tape::{Tape, with_tape};

/// Types with arbitrary values.
pub trait Arbitrary {
    /// Any value.
    fn any() -> Self;
}

/// Any value of the type.
pub fn any<T: Arbitrary>() -> T {
    T::any()
}

/// A byte below `limit`, which is at least 1.
pub fn below(limit: u8) -> u8 {
    with_tape(|tape| tape.digit(u64::from(limit))).to_le_bytes()[0]
}

/// Any double. `least` and `most` say where this engine looks most; no value is left out.
pub fn near(least: f64, most: f64) -> f64 {
    with_tape(|tape| {
        tape.unbounded = true;
        let value = tape.float(least, most);
        tape.floats.push(value);
        value
    })
}

/// Any integer. `least` and `most` say where this engine looks most; no value is left out.
pub fn near_integer(least: i64, most: i64) -> i64 {
    with_tape(|tape| {
        tape.unbounded = true;
        let value = tape.integer(least, most);
        tape.integers.push(value);
        value
    })
}

macro_rules! arbitrary {
    ($($Type:ty: $value:expr;)*) => {$(
        impl Arbitrary for $Type {
            fn any() -> Self {
                $value
            }
        }
    )*};
}

arbitrary! {
    bool: with_tape(|tape| tape.digit(2)) == 1;
    u8: with_tape(|tape| tape.digit(256)).to_le_bytes()[0];
    i64: near_integer(i64::MIN, i64::MAX);
    u64: u64::from_ne_bytes(i64::any().to_ne_bytes());
    f64: near(f64::MIN, f64::MAX);
}

const INTEGERS: [i64; 6] = [i64::MIN, i64::MIN + 1, -1, 0, 1, i64::MAX];
const FLOATS: [f64; 10] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MAX,
    f64::MIN,
    -0.0,
    5e-324,
    f64::MIN_POSITIVE,
    1e-160,
    -1e160,
];

impl Tape {
    fn integer(&mut self, least: i64, most: i64) -> i64 {
        let value = match self.random_below(8) {
            0 => INTEGERS[self.index(INTEGERS.len())],
            1 => least,
            2 => most,
            3 => least.saturating_add_unsigned(self.random_below(8)),
            4 if !self.integers.is_empty() => self.related_integer(),
            5 if self.integers.len() > 1 => {
                let other = self.related_integer();
                self.related_integer().saturating_add(other)
            }
            6 => i64::from_ne_bytes(self.random_bits().to_ne_bytes()) >> self.random_below(64),
            _ => self.integer_within(least, most),
        };
        if self.calm && !(least..=most).contains(&value) {
            self.integer_within(least, most)
        } else {
            value
        }
    }

    /// An earlier number of this run, or one next to it.
    fn related_integer(&mut self) -> i64 {
        let at = self.index(self.integers.len());
        let old = self.integers[at];
        match self.random_below(4) {
            0 => old.saturating_add(1),
            1 => old.saturating_sub(1),
            _ => old,
        }
    }

    fn integer_within(&mut self, least: i64, most: i64) -> i64 {
        let span = u64::from_ne_bytes(most.wrapping_sub(least).to_ne_bytes());
        let offset = span.checked_add(1).map_or(0, |values| self.random_bits() % values);
        least.wrapping_add_unsigned(offset)
    }

    fn float(&mut self, least: f64, most: f64) -> f64 {
        let value = match self.random_below(8) {
            0 => FLOATS[self.index(FLOATS.len())],
            1 => least,
            2 => most,
            3 => self.whole(),
            4 if !self.floats.is_empty() => self.related_float(),
            5 => f64::from_bits(self.random_bits()),
            6 => self.whole() / 8.0,
            _ => self.float_within(least, most),
        };
        if self.calm && !(least..=most).contains(&value) {
            self.float_within(least, most)
        } else {
            value
        }
    }

    /// An earlier number of this run, one next to it, or its negative.
    fn related_float(&mut self) -> f64 {
        let at = self.index(self.floats.len());
        let old = self.floats[at];
        match self.random_below(4) {
            0 => f64::from_bits(old.to_bits().wrapping_add(1)),
            1 => f64::from_bits(old.to_bits().wrapping_sub(1)),
            2 => -old,
            _ => old,
        }
    }

    /// A whole number from -16 to 16.
    fn whole(&mut self) -> f64 {
        f64::from(i8::try_from(self.random_below(33)).unwrap_or(0) - 16)
    }

    fn float_within(&mut self, least: f64, most: f64) -> f64 {
        let share =
            f64::from(u32::try_from(self.random_bits() >> 32).unwrap_or(0)) / 4_294_967_295.0;
        least * (1.0 - share) + most * share
    }

    fn index(&mut self, len: usize) -> usize {
        usize::try_from(self.random_below(len as u64)).unwrap_or(0)
    }
}
