//! Exact real numbers: rationals and square roots of rationals, compared without rounding
//! (`spec/4-arithmetic.md#the-model-is-exact`).
//!
//! A `Real` remembers how it was made and encloses its value in an interval of doubles. A
//! comparison is answered by the intervals when they are apart, and by exact arithmetic otherwise:
//! the interval only saves time, it decides nothing that the exact numbers would decide otherwise.
//! `unfiltered` computes without it; a test compares both.

mod interval;
mod roots;

use std::cell::{Cell, OnceCell};
use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};
use std::rc::Rc;

use dashu_ratio::RBig;

use interval::Interval;
use roots::Roots;

/// An exact real number.
#[derive(Clone, Debug)]
pub struct Real {
    interval: Interval,
    /// How the number was made; none where the interval is a point, which is the number then.
    node: Option<Rc<Node>>,
}

#[derive(Debug)]
struct Node {
    term: Term,
    exact: OnceCell<Rc<Roots>>,
}

#[derive(Debug)]
enum Term {
    Double(f64),
    Integer(i128),
    Sum(Real, Real),
    Difference(Real, Real),
    Product(Real, Real),
    Quotient(Real, Real),
    Greater(Real, Real),
    Root(Real),
}

thread_local! {
    static FILTER: Cell<bool> = const { Cell::new(true) };
}

/// Runs `compute` with every number it makes kept as a term, and every comparison decided by exact
/// arithmetic alone, on this thread.
pub fn unfiltered<T>(compute: impl FnOnce() -> T) -> T {
    FILTER.set(false);
    let result = compute();
    FILTER.set(true);
    result
}

impl Real {
    /// The exact value of a finite double.
    ///
    /// # Panics
    /// If `value` is NaN or infinite; `input` lets only finite numbers pass.
    pub fn from_double(value: f64) -> Self {
        assert!(value.is_finite(), "a real number was made of {value}");
        Self::new(Interval::point(value), Term::Double(value))
    }

    /// An integer.
    pub fn from_integer(value: i128) -> Self {
        #[expect(clippy::cast_precision_loss, reason = "the interval is widened by the error")]
        let near = value as f64;
        let exact = value.unsigned_abs() <= 1 << 53;
        let interval = if exact {
            Interval::point(near)
        } else {
            Interval { lo: near.next_down(), hi: near.next_up() }
        };
        Self::new(interval, Term::Integer(value))
    }

    /// Zero.
    pub fn zero() -> Self {
        Self::from_integer(0)
    }

    /// Seconds of a duration in nanoseconds.
    pub fn seconds(nanoseconds: i128) -> Self {
        Self::from_integer(nanoseconds) / Self::from_integer(1_000_000_000)
    }

    /// The square root of a rational that is not negative.
    #[must_use]
    pub fn sqrt(&self) -> Self {
        Self::new(self.interval.sqrt(), Term::Root(self.clone()))
    }

    /// The square.
    #[must_use]
    pub fn square(&self) -> Self {
        Self::new(self.interval.square(), Term::Product(self.clone(), self.clone()))
    }

    /// The absolute value.
    #[must_use]
    pub fn abs(&self) -> Self {
        self.clone().max(-self)
    }

    /// The nearest double, for witnesses.
    pub fn to_f64(&self) -> f64 {
        if self.interval.is_point() { self.interval.lo } else { self.exact().to_f64() }
    }

    /// The largest integer not above the number, at the limits of 64 bits when it is beyond.
    pub fn floor(&self) -> i64 {
        #[expect(clippy::cast_possible_truncation, reason = "`as` saturates; a guess to start at")]
        let mut floor = self.near().floor() as i64;
        while floor > i64::MIN && *self < Self::from_integer(floor.into()) {
            floor -= 1;
        }
        while floor < i64::MAX && *self >= Self::from_integer(i128::from(floor) + 1) {
            floor += 1;
        }
        floor
    }

    /// A double near the number, as near as its interval tells.
    pub fn near(&self) -> f64 {
        let Interval { lo, hi } = self.interval;
        if lo == f64::NEG_INFINITY || hi == f64::INFINITY { self.to_f64() } else { lo.midpoint(hi) }
    }

    /// Doubles that the number is not below and not above.
    pub fn bounds(&self) -> [f64; 2] {
        if !FILTER.get() {
            return [f64::NEG_INFINITY, f64::INFINITY];
        }
        [self.interval.lo, self.interval.hi]
    }

    fn new(interval: Interval, term: Term) -> Self {
        if FILTER.get() && interval.is_point() {
            return Self { interval, node: None };
        }
        Self { interval, node: Some(Rc::new(Node { term, exact: OnceCell::new() })) }
    }

    fn order_of_intervals(&self, other: &Self) -> Option<Ordering> {
        if FILTER.get() { self.interval.order(other.interval) } else { None }
    }

    fn exact(&self) -> Rc<Roots> {
        match &self.node {
            Some(node) => Rc::clone(node.exact.get_or_init(|| Rc::new(node.term.value()))),
            None => Rc::new(Term::Double(self.interval.lo).value()),
        }
    }

    /// The formulas divide by, take roots of, and round only rationals.
    fn rational(&self) -> RBig {
        let exact = self.exact();
        let rational = exact.as_rational();
        rational.expect("the formulas take roots of and divide by rationals only").clone()
    }
}

impl Term {
    fn value(&self) -> Roots {
        match self {
            Self::Double(value) => Roots::rational(RBig::try_from(*value).unwrap_or(RBig::ZERO)),
            Self::Integer(value) => Roots::rational(RBig::from(*value)),
            Self::Sum(a, b) => a.exact().plus(&RBig::ONE, &b.exact()),
            Self::Difference(a, b) => a.exact().plus(&RBig::NEG_ONE, &b.exact()),
            Self::Product(a, b) => a.exact().times(&b.exact()),
            Self::Quotient(a, b) => a.exact().times(&Roots::rational(RBig::ONE / b.rational())),
            Self::Greater(a, b) => {
                let (a, b) = (a.exact(), b.exact());
                (if a.order(&b).is_ge() { &a } else { &b }).as_ref().clone()
            }
            Self::Root(a) => Roots::sqrt(&a.rational()),
        }
    }
}

impl Ord for Real {
    fn cmp(&self, other: &Self) -> Ordering {
        self.order_of_intervals(other).unwrap_or_else(|| self.exact().order(&other.exact()))
    }

    /// Where the intervals do not tell, the question waits until the result is compared: not for long lists, whose
    /// greatest would be a chain of questions.
    fn max(self, other: Self) -> Self {
        match self.order_of_intervals(&other) {
            Some(Ordering::Less) => other,
            Some(Ordering::Equal | Ordering::Greater) => self,
            None => Self::new(self.interval.max(other.interval), Term::Greater(self, other)),
        }
    }

    fn min(self, other: Self) -> Self {
        -(-self).max(-other)
    }
}

impl PartialOrd for Real {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Real {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Real {}

impl std::iter::Sum for Real {
    fn sum<I: Iterator<Item = Self>>(terms: I) -> Self {
        terms.fold(Self::zero(), |sum, term| sum + term)
    }
}

impl Neg for &Real {
    type Output = Real;
    fn neg(self) -> Real {
        Real::new(self.interval.negated(), Term::Difference(Real::zero(), self.clone()))
    }
}

impl Neg for Real {
    type Output = Real;
    fn neg(self) -> Real {
        -&self
    }
}

macro_rules! operator {
    ($Op:ident, $op:ident, $term:ident, $interval:expr) => {
        impl $Op<&Real> for &Real {
            type Output = Real;
            fn $op(self, other: &Real) -> Real {
                let interval: fn(Interval, Interval) -> Interval = $interval;
                Real::new(
                    interval(self.interval, other.interval),
                    Term::$term(self.clone(), other.clone()),
                )
            }
        }
        impl $Op<Real> for &Real {
            type Output = Real;
            fn $op(self, other: Real) -> Real {
                self.$op(&other)
            }
        }
        impl $Op<&Real> for Real {
            type Output = Real;
            fn $op(self, other: &Real) -> Real {
                (&self).$op(other)
            }
        }
        impl $Op<Real> for Real {
            type Output = Real;
            fn $op(self, other: Real) -> Real {
                (&self).$op(&other)
            }
        }
    };
}

operator!(Add, add, Sum, Interval::plus);
operator!(Sub, sub, Difference, |a, b| a.plus(b.negated()));
operator!(Mul, mul, Product, Interval::times);
operator!(Div, div, Quotient, Interval::over);

#[cfg(test)]
mod tests;
