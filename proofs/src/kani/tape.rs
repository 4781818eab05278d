//! The tape that one run of a harness draws from.

use core::cell::RefCell;
use std::collections::BTreeMap;
use std::string::String;
use std::vec::Vec;

/// One draw of finitely many values.
#[derive(Clone, Copy, Debug)]
struct Digit {
    value: u64,
    radix: u64,
}

/// Where draws come from and what was drawn in this run.
#[derive(Debug)]
pub(super) struct Tape {
    /// All tapes in turn, or random ones.
    every: bool,
    digits: Vec<Digit>,
    drawn: usize,
    /// A number of 64 bits was drawn: the domain is not finite.
    pub(super) unbounded: bool,
    random: u64,
    /// In a calm run all numbers are near the range that is asked for.
    pub(super) calm: bool,
    /// The numbers of this run, for later ones to be equal or next to.
    pub(super) integers: Vec<i64>,
    pub(super) floats: Vec<f64>,
    /// Covers seen, and how many runs satisfied each.
    pub(super) covers: BTreeMap<&'static str, u64>,
}

impl Tape {
    const fn new() -> Self {
        Self {
            every: true,
            digits: Vec::new(),
            drawn: 0,
            unbounded: false,
            random: 0,
            calm: false,
            integers: Vec::new(),
            floats: Vec::new(),
            covers: BTreeMap::new(),
        }
    }

    /// A tape for all runs of a harness. `every`: enumerate; else draw at random from this seed.
    pub(super) fn start(&mut self, every: bool, seed: u64) {
        *self = Self { every, random: seed, ..Self::new() };
        self.begin();
    }

    /// The next run. `false`: every tape has been run.
    pub(super) fn advance(&mut self) -> bool {
        self.digits.truncate(self.drawn);
        if self.every {
            while self.digits.last().is_some_and(|digit| digit.value + 1 == digit.radix) {
                self.digits.pop();
            }
            let Some(last) = self.digits.last_mut() else { return false };
            last.value += 1;
        }
        self.begin();
        true
    }

    fn begin(&mut self) {
        self.drawn = 0;
        self.integers.clear();
        self.floats.clear();
        if !self.every {
            self.digits.clear();
            self.calm = self.random_below(4) != 0;
        }
    }

    /// A value below `radix`, which is at least 1.
    pub(super) fn digit(&mut self, radix: u64) -> u64 {
        if self.drawn == self.digits.len() {
            let value = if self.every { 0 } else { self.random_below(radix) };
            self.digits.push(Digit { value, radix });
        }
        let value = self.digits[self.drawn].value;
        self.drawn += 1;
        value
    }

    pub(super) fn random_below(&mut self, limit: u64) -> u64 {
        self.random_bits() % limit
    }

    /// SplitMix64 (Steele, Lea, Flood 2014).
    pub(super) fn random_bits(&mut self) -> u64 {
        self.random = self.random.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = self.random;
        let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub(super) fn cover(&mut self, condition: bool, name: &'static str) {
        *self.covers.entry(name).or_default() += u64::from(condition);
    }

    /// What was drawn in this run, to see why a case failed.
    pub(super) fn describe(&self) -> String {
        let choices: Vec<u64> = self.digits[..self.drawn].iter().map(|digit| digit.value).collect();
        let (integers, floats) = (&self.integers, &self.floats);
        std::format!("choices {choices:?}, integers {integers:?}, floats {floats:?}")
    }
}

std::thread_local! {
    static TAPE: RefCell<Tape> = const { RefCell::new(Tape::new()) };
}

pub(super) fn with_tape<T>(act: impl FnOnce(&mut Tape) -> T) -> T {
    TAPE.with(|tape| act(&mut tape.borrow_mut()))
}
