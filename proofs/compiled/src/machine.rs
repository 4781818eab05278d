//! Runs a compiled harness on all inputs at once. WebAssembly is structured: every branch goes to
//! the end of a block or to the start of a loop, so all states that go there become one before the
//! run goes on, and every instruction runs once (in a loop once a round). What comes out is, for
//! every trap, cover and the end, the condition under which it is reached.

use std::collections::BTreeMap;
use std::rc::Rc;

use crate::module::{Function, Module, width};
use crate::smt::{self, Possible};
use crate::state::{Label, State, merged};
use crate::term::{Op, Term, Terms};

/// Calls in calls before the machine gives up.
const CALLS: usize = 60;
/// Time of a question that the run itself asks, ms.
const QUESTION_MS: u32 = 20_000;

/// Where a value is drawn: calls, rounds of loops, and the instruction.
pub type Place = Vec<u32>;

/// The machine and what it has found.
#[derive(Debug)]
pub struct Machine<'a> {
    /// What runs.
    pub(crate) module: &'a Module<'a>,
    /// All terms.
    pub terms: Terms,
    /// When the code traps, and where that is.
    pub traps: Vec<(Term, String)>,
    /// When each cover is reached with its condition.
    pub covers: BTreeMap<u32, Term>,
    /// The variables, by the place where they are drawn.
    pub draws: BTreeMap<Place, u32>,
    /// Values to be drawn instead of variables.
    pub given: Option<BTreeMap<Place, u64>>,
    /// Instructions run.
    pub steps: u64,
    /// Questions asked to see where a loop ends or an address leads.
    pub questions: u64,
    pub(crate) place: Place,
    calls: usize,
}

/// The state after something has run, if it goes on.
pub(crate) type Run = Result<Option<State>, String>;

impl<'a> Machine<'a> {
    /// A machine that has not run.
    pub fn new(module: &'a Module<'a>) -> Self {
        Self {
            module,
            terms: Terms::default(),
            traps: Vec::new(),
            covers: BTreeMap::new(),
            draws: BTreeMap::new(),
            given: None,
            steps: 0,
            questions: 0,
            place: Vec::new(),
            calls: 0,
        }
    }

    /// Runs an exported function without arguments; says when it returns. Errors: what is not
    /// supported, or does not end.
    pub fn run(&mut self, export: &str) -> Result<Term, String> {
        let function = *self.module.exports.get(export).ok_or(format!("no export {export}"))?;
        let zero = self.terms.constant(0, 8);
        let mut memory = vec![zero; usize::try_from(self.module.memory).map_err(|_| "memory")?];
        for (start, bytes) in &self.module.data {
            let start = usize::try_from(*start).map_err(|_| "data")?;
            let places =
                memory.get_mut(start..start + bytes.len()).ok_or("data beyond the heap")?;
            for (place, byte) in places.iter_mut().zip(*bytes) {
                *place = self.terms.constant((*byte).into(), 8);
            }
        }
        let globals = self.module.globals.iter();
        let globals = globals.map(|(value, width)| self.terms.constant(*value, *width)).collect();
        let state = State {
            path: Vec::new(),
            locals: Vec::new(),
            stack: Vec::new(),
            globals,
            memory: Rc::new(memory),
        };
        Ok(match self.call(function, state)? {
            Some(end) => self.terms.all(&end.path),
            None => self.terms.truth(false),
        })
    }

    pub(crate) fn call(&mut self, number: u32, mut state: State) -> Run {
        let module = self.module;
        let body = match &module.functions[number as usize] {
            Function::Import(name, _) => return self.import(name, state),
            Function::Body(body) => body,
        };
        if self.calls == CALLS {
            return Err(format!("{CALLS} calls in calls"));
        }
        self.calls += 1;
        let arguments = state.stack.split_off(state.stack.len() - body.of.params().len());
        let stack = std::mem::take(&mut state.stack);
        let locals = std::mem::replace(&mut state.locals, arguments);
        for kind in &body.locals[body.of.params().len()..] {
            let width = width(*kind).ok_or("a local that is no integer")?;
            state.locals.push(self.terms.constant(0, width));
        }
        let results = body.of.results().len();
        let mut labels = vec![Label { results, height: 0, arrived: None }];
        let end = self.block(body, 0..body.code.len() - 1, state, &mut labels)?;
        self.calls -= 1;
        let left = labels.pop().and_then(|label| label.arrived);
        Ok(merged(end, left, &mut self.terms).map(|mut state| {
            let results = std::mem::replace(&mut state.stack, stack);
            state.stack.extend(results);
            state.locals = locals;
            state
        }))
    }

    fn import(&mut self, name: &str, mut state: State) -> Run {
        match name {
            "any_u64" => {
                let value = self.draw()?;
                state.stack.push(value);
                Ok(Some(state))
            }
            // A choice among numbers, so that what it leads to is one, too.
            "any_below" => {
                let limit = state.pop();
                let limit = self.terms.number(limit).ok_or("a limit that is no number")?;
                let Some(last) = limit.checked_sub(1) else { return Ok(None) };
                let drawn = self.draw()?;
                let mut value = self.terms.constant(last, 32);
                for number in (0..last).rev() {
                    let wanted = self.terms.constant(number, 64);
                    let is_it = self.terms.binary(Op::Equal, drawn, wanted);
                    let number = self.terms.constant(number, 32);
                    value = self.terms.choice(is_it, number, value);
                }
                state.stack.push(value);
                Ok(Some(state))
            }
            "assume_that" => {
                let condition = state.pop();
                let condition = self.terms.is_set(condition);
                Ok(self.given_that(condition, state))
            }
            "cover_that" => {
                let (condition, cover) = (state.pop(), state.pop());
                let cover = self.terms.number(cover).ok_or("a cover without a number")?;
                let cover = u32::try_from(cover).map_err(|_| "a cover beyond 32 bits")?;
                let condition = self.terms.is_set(condition);
                let reached = self.terms.all(&state.path);
                let reached = self.terms.and(reached, condition);
                let before = self.terms.truth(false);
                let before = self.covers.get(&cover).copied().unwrap_or(before);
                let reached = self.terms.or(before, reached);
                self.covers.insert(cover, reached);
                Ok(Some(state))
            }
            other => Err(format!("no import {other}")),
        }
    }

    /// An arbitrary value, or the one that is given for this place.
    fn draw(&mut self) -> Result<Term, String> {
        if let Some(given) = &self.given {
            return Ok(self.terms.constant(given.get(&self.place).copied().unwrap_or(0), 64));
        }
        let next = u32::try_from(self.draws.len()).map_err(|_| "many draws")?;
        let number = *self.draws.entry(self.place.clone()).or_insert(next);
        Ok(self.terms.variable(number, 64))
    }

    pub(crate) fn ask(&mut self, truth: Term) -> Result<Possible, String> {
        if self.terms.number(truth).is_none() {
            self.questions += 1;
        }
        smt::ask(&self.terms, truth, QUESTION_MS).map_err(|error| error.to_string())
    }

    pub(crate) fn trap(&mut self, condition: Term, why: &str) {
        if self.terms.number(condition) != Some(0) {
            self.traps.push((condition, format!("{why} at {:?}", self.place)));
        }
    }

    /// All numbers that the term can be on this path.
    pub(crate) fn values(&mut self, term: Term, path: Term) -> Result<Vec<u64>, String> {
        /// More than this are no way to look at memory.
        const MOST: usize = 64;
        let (mut found, mut rest) = (Vec::new(), path);
        loop {
            let values = match self.ask(rest)? {
                Possible::Never => return Ok(found),
                Possible::Unknown => {
                    return Err("the values of an address are not known".to_owned());
                }
                Possible::With(_) if found.len() == MOST => {
                    return Err(format!("an address with more than {MOST} values"));
                }
                Possible::With(values) => values,
            };
            let value = self.terms.value(term, &values.into_iter().collect());
            found.push(value);
            let number = self.terms.constant(value, self.terms.width(term));
            let is_it = self.terms.binary(Op::Equal, term, number);
            let is_another = self.terms.not(is_it);
            rest = self.terms.and(rest, is_another);
        }
    }
}
