//! Blocks, loops and branches: where the ways part, and where they come together.

use std::collections::BTreeMap;

use wasmparser::{BlockType, Operator};

use crate::machine::{Machine, Run};
use crate::module::{Body, Module};
use crate::numeric;
use crate::smt::Possible;
use crate::state::{Label, State, merged};
use crate::term::{Op, Term};

/// Rounds of a loop that may have ended before the machine gives up.
const ROUNDS: u32 = 1000;
/// Instructions before the machine gives up.
const STEPS: u64 = 50_000_000;
/// Instructions of a loop after which the machine asks whether it goes on; then twice as many.
/// Most loops end before that by themselves, because their counters are numbers.
const PATIENCE: u64 = 1000;

impl<'a> Machine<'a> {
    /// The state where this is true too, if that can be.
    pub(crate) fn given_that(&mut self, condition: Term, mut state: State) -> Option<State> {
        let opposite = self.terms.not(condition);
        if self.terms.number(condition) == Some(0) || state.path.contains(&opposite) {
            return None;
        }
        if self.terms.number(condition).is_none() && !state.path.contains(&condition) {
            state.path.push(condition);
        }
        Some(state)
    }

    /// Runs part of a body up to where it falls out of its end.
    pub(crate) fn block(
        &mut self,
        body: &'a Body<'a>,
        part: std::ops::Range<usize>,
        state: State,
        labels: &mut Vec<Label>,
    ) -> Run {
        let (mut at, end, mut state) = (part.start, part.end, state);
        while at < end {
            self.steps += 1;
            if self.steps > STEPS {
                return Err(format!("{STEPS} instructions"));
            }
            let operator = &body.code[at];
            let next = match operator {
                Operator::Block { blockty } => {
                    let close = body.next[at];
                    let results = results(self.module, *blockty)?;
                    labels.push(Label { results, height: state.stack.len(), arrived: None });
                    let fell = self.block(body, at + 1..close, state, labels)?;
                    at = close;
                    self.leave(fell, labels)
                }
                Operator::Loop { .. } => {
                    let close = body.next[at];
                    let fell = self.rounds(body, at + 1..close, state, labels)?;
                    at = close;
                    fell
                }
                Operator::If { blockty } => {
                    let (fell, close) = self.either(body, at, *blockty, state, labels)?;
                    at = close;
                    fell
                }
                Operator::Br { relative_depth } => {
                    self.branch(*relative_depth, state, labels);
                    None
                }
                Operator::BrIf { relative_depth } => {
                    let condition = state.pop();
                    let condition = self.terms.is_set(condition);
                    let (taken, on) = self.fork(condition, state);
                    if let Some(taken) = taken {
                        self.branch(*relative_depth, taken, labels);
                    }
                    on
                }
                Operator::BrTable { targets } => {
                    let index = state.pop();
                    self.table(index, targets, state, labels)?;
                    None
                }
                Operator::Return => {
                    let outermost = u32::try_from(labels.len() - 1).map_err(|_| "deep blocks")?;
                    self.branch(outermost, state, labels);
                    None
                }
                Operator::Unreachable => {
                    let path = self.terms.all(&state.path);
                    self.trap(path, "unreachable");
                    None
                }
                Operator::Call { function_index } => {
                    self.placed(at, |machine| machine.call(*function_index, state))?
                }
                Operator::CallIndirect { .. } => {
                    let place = state.pop();
                    let place = self.terms.number(place).ok_or("an unknown function is called")?;
                    let function = self.module.table.get(&place).ok_or("no such function")?;
                    self.placed(at, |machine| machine.call(*function, state))?
                }
                other => {
                    self.simple(other, &mut state)?;
                    Some(state)
                }
            };
            let Some(next) = next else { return Ok(None) };
            state = next;
            at += 1;
        }
        Ok(Some(state))
    }

    /// Both arms of the `If` there; where it ends.
    fn either(
        &mut self,
        body: &'a Body<'a>,
        at: usize,
        kind: BlockType,
        mut state: State,
        labels: &mut Vec<Label>,
    ) -> Result<(Option<State>, usize), String> {
        let results = results(self.module, kind)?;
        let condition = state.pop();
        let condition = self.terms.is_set(condition);
        labels.push(Label { results, height: state.stack.len(), arrived: None });
        let middle = body.next[at];
        let has_else = matches!(body.code[middle], Operator::Else);
        let close = if has_else { body.next[middle] } else { middle };
        let (yes, no) = self.fork(condition, state);
        let yes = match yes {
            Some(state) => self.block(body, at + 1..middle, state, labels)?,
            None => None,
        };
        let no = match no {
            Some(state) if has_else => self.block(body, middle + 1..close, state, labels)?,
            other => other,
        };
        let fell = merged(yes, no, &mut self.terms);
        Ok((self.leave(fell, labels), close))
    }

    /// With the instruction as part of the place.
    fn placed(&mut self, at: usize, run: impl FnOnce(&mut Self) -> Run) -> Run {
        self.place.push(u32::try_from(at).map_err(|_| "long code")?);
        let end = run(self);
        self.place.pop();
        end
    }

    /// Round after round, until nothing goes back to the start.
    fn rounds(
        &mut self,
        body: &'a Body<'a>,
        part: std::ops::Range<usize>,
        state: State,
        labels: &mut Vec<Label>,
    ) -> Run {
        let (mut state, mut left) = (state, None);
        let (mut undecided, mut patience) = (0, PATIENCE);
        let mut ask_at = self.steps + patience;
        for round in 0.. {
            let (height, known) = (state.stack.len(), state.path.clone());
            labels.push(Label { results: 0, height, arrived: None });
            let fell =
                self.placed(round, |machine| machine.block(body, part.clone(), state, labels))?;
            left = merged(left, fell, &mut self.terms);
            let Some(back) = labels.pop().and_then(|label| label.arrived) else {
                return Ok(left);
            };
            if back.path != known {
                undecided += 1;
                if undecided > ROUNDS {
                    return Err(format!("a loop may go on after {ROUNDS} rounds"));
                }
            }
            if self.steps >= ask_at {
                let path = self.terms.all(&back.path);
                if self.ask(path)? == Possible::Never {
                    return Ok(left);
                }
                patience *= 2;
                ask_at = self.steps + patience;
            }
            state = back;
        }
        unreachable!("it ends by itself or by what it takes")
    }

    /// What falls out of a block, with what branches to its end.
    fn leave(&mut self, fell: Option<State>, labels: &mut Vec<Label>) -> Option<State> {
        let arrived = labels.pop().and_then(|label| label.arrived);
        merged(fell, arrived, &mut self.terms)
    }

    fn fork(&mut self, condition: Term, state: State) -> (Option<State>, Option<State>) {
        let opposite = self.terms.not(condition);
        let taken = self.given_that(condition, state.clone());
        (taken, self.given_that(opposite, state))
    }

    fn branch(&mut self, depth: u32, mut state: State, labels: &mut [Label]) {
        let place = labels.len() - 1 - depth as usize;
        let label = &mut labels[place];
        let results = state.stack.split_off(state.stack.len() - label.results);
        state.stack.truncate(label.height);
        state.stack.extend(results);
        label.arrived = merged(label.arrived.take(), Some(state), &mut self.terms);
    }

    fn table(
        &mut self,
        index: Term,
        targets: &wasmparser::BrTable<'_>,
        state: State,
        labels: &mut [Label],
    ) -> Result<(), String> {
        let mut ways: BTreeMap<u32, Term> = BTreeMap::new();
        let never = self.terms.truth(false);
        for (number, target) in (0..).zip(targets.targets()) {
            let target = target.map_err(|error| error.to_string())?;
            let number = self.terms.constant(number, 32);
            let is_it = self.terms.binary(Op::Equal, index, number);
            let before = ways.get(&target).copied().unwrap_or(never);
            ways.insert(target, self.terms.or(before, is_it));
        }
        let count = self.terms.constant(targets.len().into(), 32);
        let inside = self.terms.binary(Op::Below, index, count);
        let beyond = self.terms.not(inside);
        let before = ways.get(&targets.default()).copied().unwrap_or(never);
        ways.insert(targets.default(), self.terms.or(before, beyond));
        // Each way excludes those before it.
        let mut rest = Some(state);
        for (target, condition) in ways {
            let Some(state) = rest else { break };
            let (taken, on) = self.fork(condition, state);
            if let Some(taken) = taken {
                self.branch(target, taken, labels);
            }
            rest = on;
        }
        Ok(())
    }

    /// Instructions that go on to the next one.
    fn simple(&mut self, operator: &Operator<'_>, state: &mut State) -> Result<(), String> {
        match operator {
            Operator::LocalGet { local_index } => {
                state.stack.push(state.locals[*local_index as usize]);
            }
            Operator::LocalSet { local_index } => {
                let value = state.pop();
                state.locals[*local_index as usize] = value;
            }
            Operator::LocalTee { local_index } => {
                let value = state.pop();
                state.stack.push(value);
                state.locals[*local_index as usize] = value;
            }
            Operator::GlobalGet { global_index } => {
                state.stack.push(state.globals[*global_index as usize]);
            }
            Operator::GlobalSet { global_index } => {
                let value = state.pop();
                state.globals[*global_index as usize] = value;
            }
            Operator::Drop => {
                state.pop();
            }
            Operator::Nop => {}
            other => {
                if !numeric::apply(other, state, &mut self.terms) && !self.memory(other, state)? {
                    return Err(format!("no support for {other:?}"));
                }
            }
        }
        Ok(())
    }
}

/// How many values a block leaves.
fn results(module: &Module<'_>, kind: BlockType) -> Result<usize, String> {
    match kind {
        BlockType::Empty => Ok(0),
        BlockType::Type(_) => Ok(1),
        BlockType::FuncType(number) => {
            let of = module.kind(number);
            if of.params().is_empty() {
                Ok(of.results().len())
            } else {
                Err("a block that takes values".to_owned())
            }
        }
    }
}
