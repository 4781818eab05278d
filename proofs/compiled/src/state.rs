//! What a harness has computed where it stands, on all ways that lead there at once.

use std::rc::Rc;

use crate::term::{Term, Terms};

/// Locals, values on the stack, globals, memory, and under what conditions all this is so.
#[derive(Clone, Debug)]
pub struct State {
    /// All of these are true. States that were one have the first ones in common.
    pub path: Vec<Term>,
    /// Of the function that runs.
    pub locals: Vec<Term>,
    /// Operands.
    pub stack: Vec<Term>,
    /// Among them the stack pointer.
    pub globals: Vec<Term>,
    /// A term of 8 bits for every byte.
    pub memory: Rc<Vec<Term>>,
}

/// The end of a block or the start of a loop.
pub(crate) struct Label {
    pub(crate) results: usize,
    pub(crate) height: usize,
    pub(crate) arrived: Option<State>,
}

impl State {
    /// Pops an operand. The module is compiled code, which has one.
    pub fn pop(&mut self) -> Term {
        self.stack.pop().expect("an operand")
    }

    /// The state where both end: each value is the one of the state that is.
    pub fn merge(self, other: &Self, terms: &mut Terms) -> Self {
        let common = self.path.iter().zip(&other.path).take_while(|(one, other)| one == other);
        let common = common.count();
        let here = terms.all(&self.path[common..]);
        let there = terms.all(&other.path[common..]);
        // Where one condition parts the two, it alone decides.
        let condition = match (self.path.get(common), other.path.get(common)) {
            (Some(one), Some(other)) if terms.not(*one) == *other => *one,
            _ => here,
        };
        let mut path = self.path[..common].to_vec();
        let reached = terms.or(here, there);
        if terms.number(reached) != Some(1) {
            path.push(reached);
        }
        let mut both = |one: &[Term], other: &[Term]| -> Vec<Term> {
            assert_eq!(one.len(), other.len());
            let pairs = one.iter().zip(other);
            pairs.map(|(one, other)| terms.choice(condition, *one, *other)).collect()
        };
        let memory = if Rc::ptr_eq(&self.memory, &other.memory) {
            self.memory
        } else {
            Rc::new(both(&self.memory, &other.memory))
        };
        Self {
            path,
            locals: both(&self.locals, &other.locals),
            stack: both(&self.stack, &other.stack),
            globals: both(&self.globals, &other.globals),
            memory,
        }
    }
}

/// Both states as one, where there are two.
pub fn merged(one: Option<State>, other: Option<State>, terms: &mut Terms) -> Option<State> {
    match (one, other) {
        (Some(one), Some(other)) => Some(one.merge(&other, terms)),
        (one, other) => one.or(other),
    }
}
