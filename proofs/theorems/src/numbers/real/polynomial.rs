//! Polynomials with rational coefficients in a normal form, so that equal terms are equal objects
//! and most questions never reach the solver.

use std::collections::BTreeMap;

use dashu_ratio::RBig;

/// A variable, by its number on the path.
pub type Variable = u16;

/// The variables of a product, ascending, each as often as its power says.
pub type Monomial = Vec<Variable>;

/// A sum of monomials with coefficients other than 0; empty is 0.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Polynomial(BTreeMap<Monomial, RBig>);

/// What is known of products of variables, as rewriting rules.
#[derive(Clone, Debug, Default)]
pub struct Rules {
    /// The square of a variable: s^2 = 1 - c^2 of a unit vector, r^2 = p of a root.
    pub squares: BTreeMap<Variable, Polynomial>,
    /// Variables whose product is 1.
    pub inverses: BTreeMap<Variable, Variable>,
}

impl Polynomial {
    /// A number.
    pub fn constant(value: RBig) -> Self {
        Self::term(Monomial::new(), value)
    }

    /// A variable.
    pub fn variable(variable: Variable) -> Self {
        Self::term(vec![variable], RBig::ONE)
    }

    fn term(monomial: Monomial, coefficient: RBig) -> Self {
        let mut polynomial = Self::default();
        polynomial.add_term(monomial, coefficient);
        polynomial
    }

    /// Monomials and their coefficients.
    pub fn terms(&self) -> impl Iterator<Item = (&Monomial, &RBig)> {
        self.0.iter()
    }

    /// The number, if it is one.
    pub fn as_constant(&self) -> Option<RBig> {
        match self.0.iter().next() {
            None => Some(RBig::ZERO),
            Some((monomial, value)) => {
                (self.0.len() == 1 && monomial.is_empty()).then(|| value.clone())
            }
        }
    }

    /// `self + factor other`
    #[must_use]
    pub fn plus(&self, factor: &RBig, other: &Self) -> Self {
        let mut sum = self.clone();
        for (monomial, coefficient) in &other.0 {
            sum.add_term(monomial.clone(), coefficient * factor);
        }
        sum
    }

    /// `factor self`
    #[must_use]
    pub fn scaled(&self, factor: &RBig) -> Self {
        Self::default().plus(factor, self)
    }

    /// The product in normal form.
    #[must_use]
    pub fn times(&self, other: &Self, rules: &Rules) -> Self {
        let mut product = Self::default();
        for (a, p) in &self.0 {
            for (b, q) in &other.0 {
                let mut monomial = [a.as_slice(), b].concat();
                monomial.sort_unstable();
                product = product.plus(&(p * q), &rules.reduced(monomial));
            }
        }
        product
    }

    /// The last coefficient; 1 of the polynomial 0.
    pub fn lead(&self) -> RBig {
        self.0.values().next_back().cloned().unwrap_or(RBig::ONE)
    }

    /// The polynomial without the common factors for which `drop` holds.
    #[must_use]
    pub fn without_factors(&self, drop: impl Fn(Variable) -> bool) -> Self {
        let Some(first) = self.0.keys().next() else { return self.clone() };
        let common = first.iter().copied().filter(|&variable| drop(variable));
        let mut rest = self.clone();
        for variable in common {
            if rest.0.keys().all(|monomial| monomial.contains(&variable)) {
                rest = rest.divided_by(variable);
            }
        }
        rest
    }

    fn divided_by(&self, variable: Variable) -> Self {
        let without = |monomial: &Monomial| {
            let mut monomial = monomial.clone();
            if let Some(place) = monomial.iter().position(|&factor| factor == variable) {
                monomial.remove(place);
            }
            monomial
        };
        Self(self.0.iter().map(|(monomial, value)| (without(monomial), value.clone())).collect())
    }

    fn add_term(&mut self, monomial: Monomial, coefficient: RBig) {
        let sum = match self.0.remove(&monomial) {
            Some(before) => before + coefficient,
            None => coefficient,
        };
        if !sum.is_zero() {
            self.0.insert(monomial, sum);
        }
    }
}

impl Rules {
    /// The normal form of a product of variables.
    fn reduced(&self, mut monomial: Monomial) -> Polynomial {
        if let Some((a, b)) = self.inverse_pair(&monomial) {
            monomial.remove(b);
            monomial.remove(a);
            return self.reduced(monomial);
        }
        let is_square =
            |pair: &[Variable]| pair[0] == pair[1] && self.squares.contains_key(&pair[0]);
        match monomial.windows(2).position(is_square) {
            None => Polynomial::term(monomial, RBig::ONE),
            Some(place) => {
                let square = &self.squares[&monomial[place]];
                monomial.drain(place..place + 2);
                self.reduced(monomial).times(square, self)
            }
        }
    }

    /// Places of two variables whose product is 1, ascending.
    fn inverse_pair(&self, monomial: &Monomial) -> Option<(usize, usize)> {
        monomial.iter().enumerate().find_map(|(a, variable)| {
            let inverse = self.inverses.get(variable)?;
            let b = monomial.iter().position(|other| other == inverse)?;
            Some((a.min(b), a.max(b)))
        })
    }
}
