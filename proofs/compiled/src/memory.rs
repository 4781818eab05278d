//! Loads and stores. An address is a number, a choice among numbers, or something of which z3 lists
//! all values.

use std::collections::{BTreeSet, HashSet};
use std::rc::Rc;

use wasmparser::{MemArg, Operator};

use crate::machine::Machine;
use crate::state::State;
use crate::term::{Node, Op, Term};

impl Machine<'_> {
    /// Runs the instruction, if it is a load or a store.
    pub(crate) fn memory(
        &mut self,
        operator: &Operator<'_>,
        state: &mut State,
    ) -> Result<bool, String> {
        use Operator as O;
        // Argument, bytes in memory, bits of the value, and whether a load keeps the sign.
        let (argument, bytes, width, is_signed) = match operator {
            O::I32Load { memarg } => (memarg, 4, 32, false),
            O::I64Load { memarg } => (memarg, 8, 64, false),
            O::I32Load8U { memarg } => (memarg, 1, 32, false),
            O::I32Load8S { memarg } => (memarg, 1, 32, true),
            O::I32Load16U { memarg } => (memarg, 2, 32, false),
            O::I32Load16S { memarg } => (memarg, 2, 32, true),
            O::I64Load8U { memarg } => (memarg, 1, 64, false),
            O::I64Load8S { memarg } => (memarg, 1, 64, true),
            O::I64Load16U { memarg } => (memarg, 2, 64, false),
            O::I64Load16S { memarg } => (memarg, 2, 64, true),
            O::I64Load32U { memarg } => (memarg, 4, 64, false),
            O::I64Load32S { memarg } => (memarg, 4, 64, true),
            O::I32Store { memarg } | O::I64Store32 { memarg } => {
                return self.store(*memarg, 4, state);
            }
            O::I64Store { memarg } => return self.store(*memarg, 8, state),
            O::I32Store8 { memarg } | O::I64Store8 { memarg } => {
                return self.store(*memarg, 1, state);
            }
            O::I32Store16 { memarg } | O::I64Store16 { memarg } => {
                return self.store(*memarg, 2, state);
            }
            _ => return Ok(false),
        };
        let address = state.pop();
        let mut loaded = None;
        for (start, is_there) in self.places(address, *argument, bytes, state)? {
            let parts = &state.memory[start..start + bytes];
            let value = parts[1..].iter().fold(parts[0], |low, high| self.terms.join(*high, low));
            loaded = Some(match loaded {
                None => value,
                Some(other) => self.terms.choice(is_there, value, other),
            });
        }
        // Without any place the trap is certain, and the value of no account.
        let loaded = match loaded {
            Some(value) => value,
            None => self.terms.constant(0, 8 * u8::try_from(bytes).unwrap_or(8)),
        };
        let value = if is_signed {
            self.terms.signed(loaded, width)
        } else {
            self.terms.unsigned(loaded, width)
        };
        state.stack.push(value);
        Ok(true)
    }

    fn store(&mut self, argument: MemArg, bytes: usize, state: &mut State) -> Result<bool, String> {
        let (value, address) = (state.pop(), state.pop());
        let places = self.places(address, argument, bytes, state)?;
        let is_certain = places.len() == 1;
        for (start, is_there) in places {
            for (offset, place) in (0..).zip(start..start + bytes) {
                let new = self.terms.part(value, 8 * offset, 8);
                let memory = Rc::make_mut(&mut state.memory);
                let old = memory[place];
                memory[place] =
                    if is_certain { new } else { self.terms.choice(is_there, new, old) };
            }
        }
        Ok(true)
    }

    /// Where in memory the access is, and under what condition; a trap where it is outside.
    fn places(
        &mut self,
        address: Term,
        argument: MemArg,
        bytes: usize,
        state: &State,
    ) -> Result<Vec<(usize, Term)>, String> {
        let path = self.terms.all(&state.path);
        let numbers = if self.terms.chooses(address) {
            self.numbers(address)
        } else {
            self.values(address, path)?
        };
        let mut places = Vec::new();
        for number in numbers {
            let wanted = self.terms.constant(number, 32);
            let is_there = self.terms.binary(Op::Equal, address, wanted);
            let start = number + argument.offset;
            if start + bytes as u64 <= self.module.memory {
                places.push((usize::try_from(start).map_err(|_| "an address")?, is_there));
            } else {
                let condition = self.terms.and(path, is_there);
                self.trap(condition, "outside of memory");
            }
        }
        Ok(places)
    }

    /// The numbers that the term chooses among.
    fn numbers(&self, term: Term) -> Vec<u64> {
        let (mut open, mut seen, mut found) = (vec![term], HashSet::new(), BTreeSet::new());
        while let Some(term) = open.pop() {
            if seen.insert(term) {
                match self.terms.node(term) {
                    Node::Constant(value) => {
                        found.insert(value);
                    }
                    Node::Choice(_, yes, no) => open.extend([yes, no]),
                    other => unreachable!("no choice among numbers: {other:?}"),
                }
            }
        }
        found.into_iter().collect()
    }
}
