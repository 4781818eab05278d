//! A formula as the program in doubles that computes it: every operation of the source is a step.

use dashu_ratio::RBig;

use super::Real;
use super::path;

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

/// Executes the formula and takes down its operations. Its inputs are `Real::named`.
///
/// # Panics
/// If it compares numbers other than by `max`, or takes roots: a program here has no branches.
pub fn record(formula: impl FnOnce() -> Vec<Real>) -> Program {
    path::first();
    path::with(|path| path.steps = Some(Vec::new()));
    let results = formula().iter().map(operand).collect();
    let steps = path::with(|path| path.steps.take()).unwrap_or_default();
    path::first();
    Program { steps, results }
}

/// The result of a step, if operations are taken down and this is none of two constants.
pub(super) fn step(operator: Operator, a: &Real, b: &Real) -> Option<Real> {
    if !path::with(|path| path.steps.is_some()) {
        return None;
    }
    let operands = [operand(a), operand(b)];
    if let [Operand::Constant(_), Operand::Constant(_)] = operands {
        return None;
    }
    let name = path::with(|path| {
        let steps = path.steps.get_or_insert_default();
        let same = |step: &&Step| step.operator == operator && step.operands == operands;
        if let Some(known) = steps.iter().find(same) {
            return known.name.clone();
        }
        let name = format!("t{}", steps.len() + 1);
        steps.push(Step { name: name.clone(), operator, operands });
        name
    });
    Some(Real::named(&name))
}

fn operand(number: &Real) -> Operand {
    if let Some(value) = number.polynomial().as_constant() {
        return Operand::Constant(value);
    }
    let (variable, _) = number.polynomial().terms().next().expect("a number that is not constant");
    Operand::Name(path::with(|path| path.names[usize::from(variable[0])].clone()))
}
