//! Sums of square roots of rationals, and their signs, decided exactly
//! (`spec/4-arithmetic.md#the-model-is-exact`).

use std::cmp::Ordering;
use std::collections::BTreeMap;

use dashu_base::{Abs, Sign, SquareRoot, SquareRootRem};
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;

/// `rational + sum of coefficient * sqrt(radicand)`, radicands positive and pairwise different.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Roots {
    rational: RBig,
    /// radicand -> coefficient, no coefficient zero.
    roots: BTreeMap<RBig, RBig>,
}

/// Bits behind the point of the first enclosure; doubled until the sign shows.
const FIRST_BITS: usize = 128;

impl Roots {
    pub(super) fn rational(rational: RBig) -> Self {
        Self { rational, roots: BTreeMap::new() }
    }

    /// The value itself when there is no root in it.
    pub(super) fn as_rational(&self) -> Option<&RBig> {
        self.roots.is_empty().then_some(&self.rational)
    }

    /// `self + factor * other`
    pub(super) fn plus(&self, factor: &RBig, other: &Self) -> Self {
        let mut sum = self.clone();
        sum.rational += factor * &other.rational;
        for (radicand, coefficient) in &other.roots {
            sum.add_root(radicand.clone(), factor * coefficient);
        }
        sum
    }

    /// The product; `sqrt(a) * sqrt(b)` is `sqrt(a * b)`.
    pub(super) fn times(&self, other: &Self) -> Self {
        let mut product = Self::rational(&self.rational * &other.rational);
        for (radicand, coefficient) in &self.roots {
            product.add_root(radicand.clone(), coefficient * &other.rational);
            for (other_radicand, other_coefficient) in &other.roots {
                product.add_root(radicand * other_radicand, coefficient * other_coefficient);
            }
        }
        for (radicand, coefficient) in &other.roots {
            product.add_root(radicand.clone(), coefficient * &self.rational);
        }
        product
    }

    /// The square root of a rational >= 0.
    pub(super) fn sqrt(radicand: &RBig) -> Self {
        let mut root = Self::rational(RBig::ZERO);
        root.add_root(radicand.clone(), RBig::ONE);
        root
    }

    fn add_root(&mut self, radicand: RBig, coefficient: RBig) {
        if let Some(root) = rational_root(&radicand) {
            self.rational += coefficient * root;
            return;
        }
        let sum = match self.roots.remove(&radicand) {
            Some(old) => old + coefficient,
            None => coefficient,
        };
        if !sum.is_zero() {
            self.roots.insert(radicand, sum);
        }
    }

    /// The order of two values.
    pub(super) fn order(&self, other: &Self) -> Ordering {
        match (self.as_rational(), other.as_rational()) {
            (Some(a), Some(b)) => a.cmp(b),
            _ => self.plus(&RBig::NEG_ONE, other).sign(),
        }
    }

    /// The sign, by enclosures of doubling precision. Only when the first one does not tell can
    /// the value be zero; then the roots are grouped first, because square roots of rationals
    /// whose pairwise products are no squares are linearly independent over the rationals
    /// (Besicovitch 1940): a grouped sum is zero only when it has no roots left.
    fn sign(&self) -> Ordering {
        if let Some(sign) = self.enclosed_sign(FIRST_BITS) {
            return sign;
        }
        let grouped = self.grouped();
        if grouped.roots.is_empty() {
            return grouped.rational.cmp(&RBig::ZERO);
        }
        let mut bits = 2 * FIRST_BITS;
        loop {
            if let Some(sign) = grouped.enclosed_sign(bits) {
                return sign;
            }
            bits *= 2;
        }
    }

    /// The nearest double.
    pub(super) fn to_f64(&self) -> f64 {
        let grouped = self.grouped();
        let mut bits = FIRST_BITS;
        loop {
            let (lo, hi) = grouped.enclosure(bits);
            let (lo, hi) = (lo.to_f64().value(), hi.to_f64().value());
            // A sum with roots left is irrational, hence no tie between two doubles.
            if lo.to_bits() == hi.to_bits() || grouped.roots.is_empty() {
                return lo;
            }
            bits *= 2;
        }
    }

    fn enclosed_sign(&self, bits: usize) -> Option<Ordering> {
        let (lo, hi) = self.enclosure(bits);
        match (lo.cmp(&RBig::ZERO), hi.cmp(&RBig::ZERO)) {
            (Ordering::Greater, _) => Some(Ordering::Greater),
            (_, Ordering::Less) => Some(Ordering::Less),
            (Ordering::Equal, Ordering::Equal) => Some(Ordering::Equal),
            (Ordering::Less | Ordering::Equal, Ordering::Greater | Ordering::Equal) => None,
        }
    }

    /// Rationals below and above the value.
    fn enclosure(&self, bits: usize) -> (RBig, RBig) {
        let (mut lo, mut hi) = (self.rational.clone(), self.rational.clone());
        for (radicand, coefficient) in &self.roots {
            let (below, above) = root_enclosure(radicand, bits);
            let (a, b) = (coefficient * below, coefficient * above);
            let (least, most) = if coefficient.sign() == Sign::Positive { (a, b) } else { (b, a) };
            lo += least;
            hi += most;
        }
        (lo, hi)
    }

    /// The same number with roots merged whose radicands differ by the square of a rational.
    fn grouped(&self) -> Self {
        let mut classes: Vec<(RBig, RBig)> = Vec::new();
        for (radicand, coefficient) in &self.roots {
            let class = classes.iter_mut().find_map(|(representative, sum)| {
                rational_root(&(radicand / &*representative)).map(|root| (sum, root))
            });
            match class {
                Some((sum, root)) => *sum += coefficient * root,
                None => classes.push((radicand.clone(), coefficient.clone())),
            }
        }
        classes.retain(|(_, sum)| !sum.is_zero());
        Self { rational: self.rational.clone(), roots: classes.into_iter().collect() }
    }
}

/// The square root of a rational, when it is rational.
fn rational_root(radicand: &RBig) -> Option<RBig> {
    let numerator = perfect_root(&radicand.numerator().clone().abs().try_into().ok()?)?;
    let denominator = perfect_root(radicand.denominator())?;
    Some(RBig::from_parts(IBig::from(numerator), denominator))
}

fn perfect_root(square: &UBig) -> Option<UBig> {
    let (root, rest) = square.sqrt_rem();
    rest.is_zero().then_some(root)
}

/// Rationals below and above `sqrt(n/d) = sqrt(n d) / d`, `2^-bits / d` apart.
fn root_enclosure(radicand: &RBig, bits: usize) -> (RBig, RBig) {
    let denominator = radicand.denominator();
    let numerator = UBig::try_from(radicand.numerator().clone()).unwrap_or(UBig::ZERO);
    let floor = ((numerator * denominator) << (2 * bits)).sqrt();
    let scale = denominator.clone() << bits;
    let above = RBig::from_parts(IBig::from(&floor + UBig::ONE), scale.clone());
    (RBig::from_parts(IBig::from(floor), scale), above)
}
