//! Simplified terms are what they stand for: compared with numbers, and with z3.

use std::collections::HashMap;

use mufasa_compiled::smt::{Possible, ask};
use mufasa_compiled::term::{Op, Term, Terms, mask, signed};
use proptest::prelude::*;
use proptest::sample::select;

/// How a term is made, with numbers for whatever is chosen on the way.
#[derive(Clone, Copy, Debug)]
struct Step {
    kind: u8,
    op: Op,
    picks: [usize; 3],
    number: u64,
}

fn number() -> impl Strategy<Value = u64> {
    prop_oneof![0_u64..4, Just(u64::MAX), Just(1 << 63), any::<u64>()]
}

fn steps() -> impl Strategy<Value = Vec<Step>> {
    let one = (0_u8..8, select(Op::ALL.to_vec()), any::<[usize; 3]>(), number())
        .prop_map(|(kind, op, picks, number)| Step { kind, op, picks, number });
    proptest::collection::vec(one, 1..60)
}

/// Terms of 1, 8, 32 and 64 bits made by these steps, each with the number that it must be.
fn made(terms: &mut Terms, steps: &[Step], variables: &[u64; 3]) -> Vec<(Term, u64)> {
    let mut made: Vec<(Term, u64)> = Vec::new();
    for (number, value) in (0..).zip(variables) {
        made.push((terms.variable(number, 64), *value));
    }
    for step in steps {
        let [one, other, third] = step.picks;
        let pick = |terms: &Terms, pick: usize, width: u8| {
            let fit: Vec<_> = made.iter().filter(|(term, _)| terms.width(*term) == width).collect();
            (!fit.is_empty()).then(|| *fit[pick % fit.len()])
        };
        let (term, value) = made[one % made.len()];
        let width = terms.width(term);
        let (by, by_value) = pick(terms, other, width).unwrap_or((term, value));
        let shifts = matches!(step.op, Op::ShiftLeft | Op::ShiftRight | Op::ShiftSigned);
        let logic = matches!(step.op, Op::And | Op::Or | Op::Xor | Op::Equal);
        made.push(match step.kind {
            0 => (terms.constant(step.number, width), step.number & mask(width)),
            1 if width < 64 && width > 1 => {
                let to = if width == 8 { 32 } else { 64 };
                let wide = signed(value, width).cast_unsigned() & mask(to);
                (terms.signed(term, to), wide)
            }
            2 if width > 8 => {
                let (low, part) = if width == 64 { (32, 32) } else { (8, 8) };
                let low = if step.number % 2 == 0 { 0 } else { low };
                (terms.part(term, low, part), value >> low & mask(part))
            }
            3 if width == 32 => (terms.join(term, by), value << 32 | by_value),
            4 if width == 8 => (terms.unsigned(term, 64), value),
            5 if width > 1 => (terms.is_set(term), u64::from(value != 0)),
            5 => (terms.number_of_truth(term, 32), value),
            6 => match pick(terms, third, 1) {
                Some((truth, 1)) => (terms.choice(truth, term, by), value),
                Some((truth, _)) => (terms.choice(truth, term, by), by_value),
                None => continue,
            },
            _ if width == 1 && !logic => (terms.not(term), 1 - value),
            _ if shifts => {
                let count = step.number % u64::from(width);
                let by = terms.constant(count, width);
                (terms.binary(step.op, term, by), step.op.of(value, count, width))
            }
            _ => (terms.binary(step.op, term, by), step.op.of(value, by_value, width)),
        });
    }
    made
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn a_simplified_term_has_the_value_of_what_it_stands_for(
        steps in steps(),
        variables in [number(), number(), number()],
    ) {
        let mut terms = Terms::default();
        let values: HashMap<u32, u64> = (0..).zip(variables).collect();
        for (term, value) in made(&mut terms, &steps, &variables) {
            prop_assert_eq!(terms.value(term, &values), value, "{:?}", terms.node(term));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    /// What is written for z3 means what the numbers say: with these variables the last term has no
    /// other value.
    #[test]
    fn z3_reads_a_term_as_it_is_meant(
        steps in steps(),
        variables in [number(), number(), number()],
    ) {
        if mufasa_z3::version().is_none() {
            eprintln!("NOT RUN: z3 is not installed");
            return Ok(());
        }
        let mut terms = Terms::default();
        let made = made(&mut terms, &steps, &variables);
        let mut here = terms.truth(true);
        for (term, value) in &made[..3] {
            let number = terms.constant(*value, 64);
            let is_it = terms.binary(Op::Equal, *term, number);
            here = terms.and(here, is_it);
        }
        let (mut same, mut other) = (here, terms.truth(false));
        for (term, value) in &made[3..] {
            let number = terms.constant(*value, terms.width(*term));
            let is_it = terms.binary(Op::Equal, *term, number);
            let is_another = terms.not(is_it);
            same = terms.and(same, is_it);
            other = terms.or(other, is_another);
        }
        let wrong = terms.and(here, other);
        prop_assert_eq!(ask(&terms, wrong, 10_000).expect("z3"), Possible::Never);
        prop_assert!(matches!(ask(&terms, same, 10_000).expect("z3"), Possible::With(_)));
    }
}
