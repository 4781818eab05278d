//! The three readings of a comparison (`spec/4-arithmetic.md#strict-and-lax`).
//!
//! A stage compares as the paper does, by one of the functions of [`Comparisons`]. What `less`,
//! `at_most`, `greater` and `at_least` say lets something pass; what `may_be_less` and
//! `may_be_at_most` say lets something be examined or fail. The strict reading makes the former
//! harder and the latter easier by the margin delta, the lax reading the other way round, and the
//! exact reading takes both as written.

use crate::numbers::real::Real;

/// Which of the three models decides.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Reading {
    /// The model itself: every comparison as written.
    Exact,
    /// Every margin towards rejection; what an implementation must accept.
    Strict,
    /// Every margin towards acceptance; information only.
    Lax,
}

/// How numbers compare in a reading.
#[derive(Debug)]
pub struct Comparisons {
    /// The reading.
    pub reading: Reading,
    /// The margin of the strict and the lax reading, m.
    pub delta: Real,
    /// +delta in the strict, -delta in the lax, 0 in the exact reading.
    m: Real,
}

/// More items than this on an edge: not every choice of them is tried.
const MOST_ON_THE_EDGE: usize = 6;

impl Comparisons {
    /// The comparisons of a reading.
    pub fn new(reading: Reading, delta: Real) -> Self {
        let m = match reading {
            Reading::Exact => Real::zero(),
            Reading::Strict => delta.clone(),
            Reading::Lax => -&delta,
        };
        Self { reading, delta, m }
    }

    /// a < b
    pub fn less(&self, a: &Real, b: &Real) -> bool {
        *a < self.lowered(b)
    }

    /// a <= b
    pub fn at_most(&self, a: &Real, b: &Real) -> bool {
        *a <= self.lowered(b)
    }

    /// a > b
    pub fn greater(&self, a: &Real, b: &Real) -> bool {
        *a > self.raised(b)
    }

    /// a >= b
    pub fn at_least(&self, a: &Real, b: &Real) -> bool {
        *a >= self.raised(b)
    }

    /// a < b, or nearly so
    pub fn may_be_less(&self, a: &Real, b: &Real) -> bool {
        *a < self.raised(b)
    }

    /// a <= b, or nearly so
    pub fn may_be_at_most(&self, a: &Real, b: &Real) -> bool {
        *a <= self.raised(b)
    }

    /// The reading is the strict one.
    pub fn is_strict(&self) -> bool {
        self.reading == Reading::Strict
    }

    /// b - m: what is less than this is less than b in this reading.
    pub fn lowered(&self, b: &Real) -> Real {
        b - &self.m
    }

    /// b + m: what is greater than this is greater than b in this reading.
    pub fn raised(&self, b: &Real) -> Real {
        b + &self.m
    }

    /// m, strictly at least `least`.
    pub fn m_at_least(&self, least: Real) -> Real {
        if self.is_strict() { least.max(self.m.clone()) } else { self.m.clone() }
    }

    /// The largest number that may be the least one: exactly that, else the greater of delta and 10^-5 more.
    pub fn nearly(&self, least: &Real) -> Real {
        match self.reading {
            Reading::Exact => least.clone(),
            Reading::Strict | Reading::Lax => {
                least + self.delta.clone().max(Real::from_double(1e-5))
            }
        }
    }

    /// Whether something holds of some of the items that may be the nearest; strictly of each of them.
    pub fn some<T>(&self, nearest: &[T], holds: impl Fn(&T) -> bool) -> bool {
        match self.reading {
            Reading::Exact | Reading::Lax => nearest.iter().any(holds),
            Reading::Strict => nearest.iter().all(holds),
        }
    }

    /// Whether the work that an assignment takes makes the stage fail: an implementation may answer
    /// so, and only the strict reading counts on it.
    pub fn refuses(&self, work: i128, limit: i128) -> bool {
        self.is_strict() && work > limit
    }

    /// What `judge` finds wrong with the items whose `distance` is <= `r`. In the strict and the lax
    /// reading an item whose distance differs from `r` by at most delta counts both ways: strict passes
    /// when every choice of these does, lax when some does. With too many of them strict fails, with
    /// `too_many`, and lax passes.
    pub fn judge_within<T, W: Clone>(
        &self,
        items: &[T],
        distance: impl Fn(&T) -> Real,
        r: &Real,
        judge: impl Fn(&[&T]) -> Option<W>,
        too_many: impl FnOnce(&Real) -> W,
    ) -> Option<W> {
        let is_lax = self.reading == Reading::Lax;
        let beyond: Vec<Real> = items.iter().map(|item| distance(item) - r).collect();
        let on_the_edge =
            |i: &usize| self.reading != Reading::Exact && beyond[*i].abs() <= self.delta;
        let edge: Vec<usize> = (0..items.len()).filter(on_the_edge).collect();
        if edge.len() > MOST_ON_THE_EDGE {
            return (!is_lax).then(|| too_many(&self.delta));
        }
        let mut failures = (0..1usize << edge.len()).map(|choice| {
            let is_within = |i: &usize| match edge.iter().position(|e| e == i) {
                Some(bit) => choice >> bit & 1 == 1,
                None => beyond[*i] <= Real::zero(),
            };
            let within: Vec<&T> = (0..items.len()).filter(is_within).map(|i| &items[i]).collect();
            judge(&within)
        });
        if is_lax {
            let first = failures.next()??;
            failures.all(|failure| failure.is_some()).then_some(first)
        } else {
            failures.find_map(|failure| failure)
        }
    }
}
