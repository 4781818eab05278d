//! Gappa's text of a formula: each step rounded, and the same steps exact under capital letters.

use std::collections::{BTreeMap, BTreeSet};

use super::bound::{Bound, Known};
use crate::numbers::real::Real;
use crate::numbers::real::program::{Operand, Operator, Program, Step};

/// A formula and what is known of values within it.
pub(super) struct Script<'a> {
    bound: &'a Bound,
    program: Program,
    known: BTreeMap<String, Known>,
}

impl<'a> Script<'a> {
    pub(super) fn new(bound: &'a Bound) -> Self {
        let program = Real::record(|| {
            let known = bound.known.iter().map(|value| value());
            known.chain([(bound.formula)()]).collect()
        });
        let mut known = BTreeMap::new();
        for value in &program.results[..bound.known.len()] {
            if let Operand::Name(name) = value {
                known.insert(name.clone(), bound.lemma);
            }
        }
        Self { bound, program, known }
    }

    /// One for each maximum with 0, of the value that it is taken of; the last of the formula.
    pub(super) fn texts(&self, limit: &str) -> Vec<String> {
        let bound = self.bound;
        let mut known = self.known.clone();
        let mut texts = Vec::new();
        for step in &self.program.steps {
            if let (Operator::Max, [Operand::Name(of), Operand::Constant(other)]) =
                (step.operator, &step.operands)
                && other.is_zero()
            {
                texts.push(self.text(
                    of,
                    &known,
                    &format!("|{of} - {}| <= {}", exact(of), bound.of_max.error),
                ));
                known.insert(step.name.clone(), bound.of_max);
            }
        }
        if let Some(Operand::Name(name)) = self.program.results.last() {
            let error = if bound.relative { "-/" } else { "-" };
            let goal = format!("|{name} {error} {}| <= {limit}", exact(name));
            texts.push(self.text(name, &known, &goal));
        }
        texts
    }

    fn text(&self, target: &str, known: &BTreeMap<String, Known>, goal: &str) -> String {
        let needed = self.needed(target, known);
        let mut lines = vec![String::from("@rnd = float<ieee_64, ne>;")];
        let mut given = Vec::new();
        for name in &needed {
            if let Some(&(_, least, most)) = self.bound.inputs.iter().find(|input| input.0 == *name)
            {
                lines.push(format!("{name} = rnd({name}_);"));
                given.push(format!("{name} in [{least}, {most}]"));
            } else if let Some(Known { most, error }) = known.get(*name) {
                lines.push(format!("{name} = rnd({name}_);"));
                given.push(format!(
                    "{name} in [0, {most}] /\\ |{name} - {}| <= {error}",
                    exact(name)
                ));
            }
        }
        let steps = || {
            let is_step = |step: &&Step| {
                needed.contains(step.name.as_str()) && !known.contains_key(&step.name)
            };
            self.program.steps.iter().filter(is_step)
        };
        for Step { name, operator, operands } in steps() {
            let [a, b] = operands.each_ref().map(rounded);
            lines.push(format!("{name} rnd= {a} {} {b};", sign(*operator)));
        }
        for Step { name, operator, operands } in steps() {
            let [a, b] = operands.each_ref().map(|operand| self.exactly(operand));
            lines.push(format!("{} = {a} {} {b};", exact(name), sign(*operator)));
        }
        lines.push(format!("{{ {}\n  -> {goal} }}\n", given.join("\n  /\\ ")));
        lines.join("\n")
    }

    /// The names that the target is made of, down to inputs and to what is known.
    fn needed<'b>(&'b self, target: &'b str, known: &BTreeMap<String, Known>) -> BTreeSet<&'b str> {
        let mut needed = BTreeSet::from([target]);
        for step in self.program.steps.iter().rev() {
            if needed.contains(step.name.as_str()) && !known.contains_key(&step.name) {
                needed.extend(step.operands.iter().filter_map(|operand| match operand {
                    Operand::Name(name) => Some(name.as_str()),
                    Operand::Constant(_) => None,
                }));
            }
        }
        needed
    }

    /// The exact value of an operand: an input is a double.
    fn exactly(&self, operand: &Operand) -> String {
        match operand {
            Operand::Name(name) if self.program.steps.iter().any(|step| step.name == *name) => {
                exact(name)
            }
            Operand::Name(_) | Operand::Constant(_) => rounded(operand),
        }
    }
}

fn rounded(operand: &Operand) -> String {
    match operand {
        Operand::Name(name) => name.clone(),
        Operand::Constant(value) => match value.clone().into_parts() {
            (numerator, denominator) if denominator.is_one() => numerator.to_string(),
            (numerator, denominator) => format!("({numerator} / {denominator})"),
        },
    }
}

/// The name of the exact value of a step.
fn exact(name: &str) -> String {
    name.to_uppercase()
}

/// No script has a maximum as a step: it is known, or has no such sign and no proof.
fn sign(operator: Operator) -> &'static str {
    match operator {
        Operator::Plus => "+",
        Operator::Minus => "-",
        Operator::Times => "*",
        Operator::Over => "/",
        Operator::Max => "max",
    }
}
