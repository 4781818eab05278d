//! Facts of plane geometry that the solver needs one by one: asked for all at once it does not end.
//! Each is a formula proved of any points here and assumed of particular points elsewhere.

use crate::claim::{Theorem, Wrong};
use crate::numbers::real::Real;
use crate::numbers::real::formula::{Formula, at_most, given, implies};
use crate::numbers::vector::Vector;
use crate::theorem::rectangle::vector;

/// The theorems of this file.
pub const THEOREMS: &[Theorem] = &[
    Theorem {
        id: "squares_order_as_numbers",
        statement: "y >= 0 and x^2 <= y^2 imply x <= y",
        domain: "all numbers",
        claim: || {
            let [x, y] = ["x", "y"].map(Real::variable);
            squares_order(&x, &y)
        },
        wrong: Wrong {
            statement: "x^2 <= y^2 implies x <= y",
            claim: || {
                let [x, y] = ["x", "y"].map(Real::variable);
                implies(at_most(&x.square(), &y.square()), at_most(&x, &y))
            },
        },
    },
    Theorem {
        id: "Cauchy_and_Schwarz",
        statement: "(p . q)^2 <= |p|^2 |q|^2",
        domain: "all vectors",
        claim: || {
            let [p, q] = ["p", "q"].map(vector);
            cauchy_schwarz(&p, &q)
        },
        wrong: Wrong {
            statement: "(p . q)^2 < |p|^2 |q|^2 - 1",
            claim: || {
                let [p, q] = ["p", "q"].map(vector);
                let product = p.squared() * q.squared() - Real::from_integer(1);
                at_most(&p.dot(&q).square(), &product)
            },
        },
    },
    Theorem {
        id: "triangle_inequality",
        statement: "|p + q| <= |p| + |q|",
        domain: "all vectors",
        claim: || {
            let [p, q] = ["p", "q"].map(vector);
            let (a, b) = (p.length(), q.length());
            given(cauchy_schwarz(&p, &q));
            given(squares_order(&p.dot(&q), &(&a * &b)));
            given(squares_order(&(&p + &q).length(), &(a + b)));
            triangle(&p, &q)
        },
        wrong: Wrong {
            statement: "|p + q| <= |p|",
            claim: || {
                let [p, q] = ["p", "q"].map(vector);
                at_most(&(&p + &q).length(), &p.length())
            },
        },
    },
];

/// y >= 0 and x^2 <= y^2 imply x <= y
pub fn squares_order(x: &Real, y: &Real) -> Formula {
    let premises = vec![at_most(&Real::zero(), y), at_most(&x.square(), &y.square())];
    implies(Formula::All(premises), at_most(x, y))
}

/// (p . q)^2 <= |p|^2 |q|^2
fn cauchy_schwarz(p: &Vector, q: &Vector) -> Formula {
    at_most(&p.dot(q).square(), &(p.squared() * q.squared()))
}

/// |p + q| <= |p| + |q|
pub fn triangle(p: &Vector, q: &Vector) -> Formula {
    at_most(&(p + q).length(), &(p.length() + q.length()))
}
