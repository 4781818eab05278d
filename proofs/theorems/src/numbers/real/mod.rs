//! Symbolic real numbers in the place of the model's exact ones.
//!
//! The public functions are those of `model/src/numbers/real`, so that the model's source compiles with
//! either. A comparison that the path does not decide forks it (`path::branch`).

pub mod formula;
pub mod hole;
pub mod path;
pub mod polynomial;

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};
use std::rc::Rc;

use dashu_base::SquareRoot;
use dashu_ratio::RBig;

use path::{Operation, Signs};
use polynomial::Polynomial;

/// A symbolic number: a polynomial in the variables of the path.
#[derive(Clone, Debug)]
pub struct Real(Rc<Polynomial>);

/// Floors are looked for up to so far from 0.
const WIDEST_FLOOR: i64 = 100;

impl Real {
    /// A new variable.
    pub fn variable(name: &str) -> Self {
        Self::of(Polynomial::variable(path::with(|path| path.variable(name))))
    }

    /// The variable of this name, new or not.
    pub fn named(name: &str) -> Self {
        Self::of(Polynomial::variable(path::with(|path| path.named(name))))
    }

    /// cos and sin of a new unit vector.
    pub fn unit(name: &str) -> [Self; 2] {
        let [cos, sin] = ["cos", "sin"].map(|part| Self::variable(&format!("{part} {name}")));
        let square = Self::from_integer(1) - cos.square();
        sin.set_square(&square);
        [cos, sin]
    }

    /// `numerator / denominator`
    pub fn ratio(numerator: i64, denominator: i64) -> Self {
        Self::from_integer(numerator.into()) / Self::from_integer(denominator.into())
    }

    /// The exact value of a finite double, or the variable of a hole.
    ///
    /// # Panics
    /// If `value` is infinite, or NaN and no hole.
    pub fn from_double(value: f64) -> Self {
        if let Some(name) = hole::name_of(value) {
            return Self::named(&name);
        }
        let exact = RBig::try_from(value).expect("a real number was made of no finite double");
        Self::of(Polynomial::constant(exact))
    }

    /// An integer.
    pub fn from_integer(value: i128) -> Self {
        Self::of(Polynomial::constant(RBig::from(value)))
    }

    /// Zero.
    pub fn zero() -> Self {
        Self::from_integer(0)
    }

    /// Seconds of a duration in nanoseconds.
    pub fn seconds(nanoseconds: i128) -> Self {
        Self::from_integer(nanoseconds) / Self::from_integer(1_000_000_000)
    }

    /// The square root of a number that is not negative.
    #[must_use]
    pub fn sqrt(&self) -> Self {
        if let Some(root) = self.rational_root() {
            return root;
        }
        self.made(Operation::Root, |root| {
            root.assume(Signs::AT_LEAST_ZERO);
            if !path::with(|path| path.roots_are_any_numbers) {
                root.set_square(self);
            }
        })
    }

    /// The square.
    #[must_use]
    pub fn square(&self) -> Self {
        self * self
    }

    /// The absolute value.
    #[must_use]
    pub fn abs(&self) -> Self {
        if *self < Self::zero() { -self } else { self.clone() }
    }

    /// The larger one.
    #[must_use]
    pub fn max(self, other: Self) -> Self {
        Ord::max(self, other)
    }

    /// The double of a constant, for witnesses; NaN of anything else, as no formula reads it.
    pub fn to_f64(&self) -> f64 {
        self.0.as_constant().map_or(f64::NAN, |value| value.to_f64().value())
    }

    /// The largest integer not above the number, by as many branches as it takes.
    ///
    /// # Panics
    /// If the number, not a constant, may be farther than 100 from 0: assume bounds.
    pub fn floor(&self) -> i64 {
        if let Some(value) = self.0.as_constant() {
            return value.floor().try_into().expect("a small constant");
        }
        let mut floor = 0;
        while *self < Self::from_integer(floor.into()) {
            floor -= 1;
            assert!(floor > -WIDEST_FLOOR, "an unbounded number was rounded down");
        }
        while *self >= Self::from_integer(i128::from(floor) + 1) {
            floor += 1;
            assert!(floor < WIDEST_FLOOR, "an unbounded number was rounded down");
        }
        floor
    }

    /// A double near a constant; 0 for anything else. The model only looks for a candidate with it.
    pub fn near(&self) -> f64 {
        let near = self.to_f64();
        if near.is_nan() { 0.0 } else { near }
    }

    /// Doubles that the number is not below and not above: nothing is known of it.
    pub fn bounds(&self) -> [f64; 2] {
        [f64::NEG_INFINITY, f64::INFINITY]
    }

    /// The polynomial.
    pub fn polynomial(&self) -> &Polynomial {
        &self.0
    }

    /// Assumes that the sign is one of these.
    pub fn assume(&self, signs: Signs) {
        path::with(|path| path.assume(&self.0, signs));
    }

    fn of(polynomial: Polynomial) -> Self {
        Self(Rc::new(polynomial))
    }

    /// `self^2 = square` as an assumption and as a rule; `self` is a variable.
    fn set_square(&self, square: &Self) {
        path::with(|path| {
            let (variable, _) = self.0.terms().next().expect("a variable is not 0");
            let name = format!("|{}|", path.names[usize::from(variable[0])]);
            let square = (*square.0).clone();
            path.script.push(format!("(= (* {name} {name}) {})", path.text(&square)));
            path.rules.squares.insert(variable[0], square);
        });
    }

    /// The result of an operation on this number: one variable, however often it is asked for.
    fn made(&self, operation: Operation, describe: impl FnOnce(&Self)) -> Self {
        let key = (operation, (*self.0).clone());
        if let Some(made) = path::with(|path| path.made.get(&key).cloned()) {
            return Self::of(made);
        }
        let name = match operation {
            Operation::Root => "root",
            Operation::Inverse => "inverse",
        };
        let made = path::with(|path| format!("{name} {}", path.names.len()));
        let made = Self::variable(&made);
        describe(&made);
        path::with(|path| path.made.insert(key, (*made.0).clone()));
        made
    }

    /// The difference.
    pub(crate) fn minus(&self, other: &Self) -> Self {
        Self::of(self.0.plus(&RBig::NEG_ONE, &other.0))
    }

    fn times(&self, other: &Self) -> Self {
        Self::of(path::with(|path| self.0.times(&other.0, &path.rules)))
    }

    fn rational_root(&self) -> Option<Self> {
        let value = self.0.as_constant()?;
        let (numerator, denominator) = (value.numerator().clone(), value.denominator().clone());
        let root = |n: dashu_int::UBig| {
            let root = n.sqrt();
            (&root * &root == n).then_some(root)
        };
        let (_, numerator) = numerator.into_parts();
        let (numerator, denominator) = (root(numerator)?, root(denominator)?);
        Some(Self::of(Polynomial::constant(RBig::from_parts(numerator.into(), denominator))))
    }

    /// One over the number, which is assumed not to be 0: the formulas divide by nothing else.
    fn inverse(&self) -> Self {
        if let Some(value) = self.0.as_constant() {
            return Self::of(Polynomial::constant(RBig::ONE / value));
        }
        // One variable for all multiples of a number.
        let factor = RBig::ONE / self.0.lead();
        let monic = Self::of(self.0.scaled(&factor));
        let inverse = monic.made(Operation::Inverse, |inverse| monic.set_inverse(inverse));
        Self::of(inverse.0.scaled(&factor))
    }

    fn set_inverse(&self, inverse: &Self) {
        path::with(|path| {
            let product = format!("(* {} {})", path.text(&self.0), path.text(&inverse.0));
            path.script.push(format!("(= {product} 1.0)"));
            let one_variable = |number: &Self| {
                let mut terms = number.0.terms();
                let (monomial, value) = terms.next()?;
                (terms.next().is_none() && value.is_one() && monomial.len() == 1)
                    .then(|| monomial[0])
            };
            if let (Some(a), Some(b)) = (one_variable(self), one_variable(inverse)) {
                path.rules.inverses.extend([(a, b), (b, a)]);
            }
        });
    }
}

impl Ord for Real {
    fn cmp(&self, other: &Self) -> Ordering {
        let is_less = self < other;
        if is_less {
            return Ordering::Less;
        }
        let is_equal = self == other;
        if is_equal { Ordering::Equal } else { Ordering::Greater }
    }
}

impl PartialOrd for Real {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }

    fn lt(&self, other: &Self) -> bool {
        path::branch(&self.minus(other).0, Signs::NEGATIVE)
    }

    fn le(&self, other: &Self) -> bool {
        path::branch(&other.minus(self).0, Signs::AT_LEAST_ZERO)
    }

    fn gt(&self, other: &Self) -> bool {
        other < self
    }

    fn ge(&self, other: &Self) -> bool {
        other <= self
    }
}

impl PartialEq for Real {
    fn eq(&self, other: &Self) -> bool {
        path::branch(&self.minus(other).0, Signs::ZERO)
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
        Real::of(self.0.scaled(&RBig::NEG_ONE))
    }
}

impl Neg for Real {
    type Output = Real;
    fn neg(self) -> Real {
        -&self
    }
}

macro_rules! operator {
    ($Op:ident, $op:ident, $compute:expr) => {
        impl $Op<&Real> for &Real {
            type Output = Real;
            fn $op(self, other: &Real) -> Real {
                let compute: fn(&Real, &Real) -> Real = $compute;
                compute(self, other)
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

operator!(Add, add, |a, b| Real::of(a.0.plus(&RBig::ONE, &b.0)));
operator!(Sub, sub, |a, b| a.minus(b));
operator!(Mul, mul, |a, b| a.times(b));
operator!(Div, div, |a, b| a.times(&b.inverse()));
