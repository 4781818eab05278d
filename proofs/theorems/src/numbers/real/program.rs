//! A formula as the program in doubles that computes it: every operation of the source is a step.

use dashu_ratio::RBig;

/// What a step does with its two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    /// Sum.
    Plus,
    /// Difference.
    Minus,
    /// Product.
    Times,
    /// Quotient.
    Over,
    /// The larger one.
    Max,
}

/// What a step works on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Operand {
    /// An input, or the result of a step.
    Name(String),
    /// A number.
    Constant(RBig),
}

/// One operation, whose result has a name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step {
    /// Of the result.
    pub name: String,
    /// What is done.
    pub operator: Operator,
    /// With what.
    pub operands: [Operand; 2],
}

/// Steps in the order in which they are done, and what is asked of them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Program {
    /// Each once, however often the source asks for it.
    pub steps: Vec<Step>,
    /// Results, by the place in what the formula returned.
    pub results: Vec<Operand>,
}
