//! Statements about numbers, for assumptions and claims.

use crate::numbers::real::Real;
use crate::numbers::real::path::{self, Path, Signs};
use crate::numbers::vector::Vector;

/// A statement.
#[derive(Clone, Debug)]
pub enum Formula {
    /// Decided on this path.
    Known(bool),
    /// The sign of the number is one of these.
    Sign(Real, Signs),
    /// All of them.
    All(Vec<Formula>),
    /// At least one.
    Any(Vec<Formula>),
    /// Not it.
    Not(Box<Formula>),
}

/// a < b
pub fn less(a: &Real, b: &Real) -> Formula {
    Formula::Sign(a.minus(b), Signs::NEGATIVE)
}

/// a <= b
pub fn at_most(a: &Real, b: &Real) -> Formula {
    Formula::Sign(b.minus(a), Signs::AT_LEAST_ZERO)
}

/// a = b
pub fn equal(a: &Real, b: &Real) -> Formula {
    Formula::Sign(a.minus(b), Signs::ZERO)
}

/// Two points are the same.
pub fn same(a: &Vector, b: &Vector) -> Formula {
    Formula::All(vec![equal(&a.x, &b.x), equal(&a.y, &b.y)])
}

/// Not `formula`.
pub fn not(formula: Formula) -> Formula {
    Formula::Not(Box::new(formula))
}

/// If `a` then `b`.
pub fn implies(a: Formula, b: Formula) -> Formula {
    Formula::Any(vec![not(a), b])
}

/// `a` exactly when `b`.
pub fn iff(a: &Formula, b: &Formula) -> Formula {
    Formula::All(vec![implies(a.clone(), b.clone()), implies(b.clone(), a.clone())])
}

/// From here on the solver knows of a root only that it is >= 0, and what lemmas say of it.
pub fn forget_of_what_roots_are() {
    path::with(|path| path.roots_are_any_numbers = true);
}

/// From here on the solver knows of a product of variables only that it is the same wherever it stands: it takes
/// linear steps from lemmas.
pub fn forget_of_what_products_are() {
    path::with(|path| path.products_are_any_numbers = true);
}

/// Assumes the formula on this path.
pub fn given(formula: Formula) {
    match formula {
        Formula::Sign(number, signs) => number.assume(signs),
        Formula::All(parts) => parts.into_iter().for_each(given),
        other => path::with(|path| {
            let text = other.text(path);
            path.script.push(text);
        }),
    }
}

impl Formula {
    /// In SMT-LIB.
    pub fn text(&self, path: &Path) -> String {
        let join = |word: &str, none: &str, parts: &[Self]| {
            let texts: Vec<String> = parts.iter().map(|part| part.text(path)).collect();
            if texts.is_empty() { none.to_owned() } else { format!("({word} {})", texts.join(" ")) }
        };
        match self {
            Self::Known(value) => value.to_string(),
            Self::Sign(number, signs) => path.assertion(number.polynomial(), *signs),
            Self::All(parts) => join("and", "true", parts),
            Self::Any(parts) => join("or", "false", parts),
            Self::Not(part) => format!("(not {})", part.text(path)),
        }
    }
}

impl From<bool> for Formula {
    fn from(value: bool) -> Self {
        Self::Known(value)
    }
}
