//! What instructions without branches and memory do with the operands.

use wasmparser::Operator;

use crate::state::State;
use crate::term::{Op, Term, Terms};

/// Runs the instruction, if it is one of these.
pub fn apply(operator: &Operator<'_>, state: &mut State, terms: &mut Terms) -> bool {
    use Operator as O;
    let result = match operator {
        O::I32Const { value } => terms.constant(value.cast_unsigned().into(), 32),
        O::I64Const { value } => terms.constant(value.cast_unsigned(), 64),
        O::I32Add | O::I64Add => of_two(Op::Add, state, terms),
        O::I32Sub | O::I64Sub => of_two(Op::Sub, state, terms),
        O::I32Mul | O::I64Mul => of_two(Op::Mul, state, terms),
        O::I32And | O::I64And => of_two(Op::And, state, terms),
        O::I32Or | O::I64Or => of_two(Op::Or, state, terms),
        O::I32Xor | O::I64Xor => of_two(Op::Xor, state, terms),
        O::I32Shl | O::I64Shl => shift(Op::ShiftLeft, state, terms),
        O::I32ShrU | O::I64ShrU => shift(Op::ShiftRight, state, terms),
        O::I32ShrS | O::I64ShrS => shift(Op::ShiftSigned, state, terms),
        O::I32Rotl | O::I64Rotl => rotate(Op::ShiftLeft, Op::ShiftRight, state, terms),
        O::I32Rotr | O::I64Rotr => rotate(Op::ShiftRight, Op::ShiftLeft, state, terms),
        O::I32Eqz | O::I64Eqz => {
            let term = state.pop();
            let set = terms.is_set(term);
            let truth = terms.not(set);
            terms.number_of_truth(truth, 32)
        }
        O::I32Eq | O::I64Eq => compare(Op::Equal, false, false, state, terms),
        O::I32Ne | O::I64Ne => compare(Op::Equal, false, true, state, terms),
        O::I32LtU | O::I64LtU => compare(Op::Below, false, false, state, terms),
        O::I32GtU | O::I64GtU => compare(Op::Below, true, false, state, terms),
        O::I32LeU | O::I64LeU => compare(Op::Below, true, true, state, terms),
        O::I32GeU | O::I64GeU => compare(Op::Below, false, true, state, terms),
        O::I32LtS | O::I64LtS => compare(Op::SignedBelow, false, false, state, terms),
        O::I32GtS | O::I64GtS => compare(Op::SignedBelow, true, false, state, terms),
        O::I32LeS | O::I64LeS => compare(Op::SignedBelow, true, true, state, terms),
        O::I32GeS | O::I64GeS => compare(Op::SignedBelow, false, true, state, terms),
        O::I32WrapI64 => {
            let term = state.pop();
            terms.part(term, 0, 32)
        }
        O::I64ExtendI32U => {
            let term = state.pop();
            terms.unsigned(term, 64)
        }
        O::I64ExtendI32S | O::I64Extend32S => extend(32, 64, state, terms),
        O::I32Extend8S => extend(8, 32, state, terms),
        O::I32Extend16S => extend(16, 32, state, terms),
        O::I64Extend8S => extend(8, 64, state, terms),
        O::I64Extend16S => extend(16, 64, state, terms),
        O::Select => {
            let (condition, no, yes) = (state.pop(), state.pop(), state.pop());
            let condition = terms.is_set(condition);
            terms.choice(condition, yes, no)
        }
        _ => return false,
    };
    state.stack.push(result);
    true
}

fn of_two(op: Op, state: &mut State, terms: &mut Terms) -> Term {
    let (other, one) = (state.pop(), state.pop());
    terms.binary(op, one, other)
}

/// `op`, of exchanged operands or not, or the opposite of that, as 0 or 1.
fn compare(op: Op, exchanged: bool, opposite: bool, state: &mut State, terms: &mut Terms) -> Term {
    let (other, one) = (state.pop(), state.pop());
    let (one, other) = if exchanged { (other, one) } else { (one, other) };
    let truth = terms.binary(op, one, other);
    let truth = if opposite { terms.not(truth) } else { truth };
    terms.number_of_truth(truth, 32)
}

/// The count is taken modulo the width.
fn shift(op: Op, state: &mut State, terms: &mut Terms) -> Term {
    let (count, term) = (state.pop(), state.pop());
    let width = terms.width(term);
    let most = terms.constant(u64::from(width) - 1, width);
    let count = terms.binary(Op::And, count, most);
    terms.binary(op, term, count)
}

fn rotate(there: Op, back: Op, state: &mut State, terms: &mut Terms) -> Term {
    let (count, term) = (state.pop(), state.pop());
    let width = terms.width(term);
    let (zero, most) = (terms.constant(0, width), terms.constant(u64::from(width) - 1, width));
    let count = terms.binary(Op::And, count, most);
    let negative = terms.binary(Op::Sub, zero, count);
    let rest = terms.binary(Op::And, negative, most);
    let (one, other) = (terms.binary(there, term, count), terms.binary(back, term, rest));
    terms.binary(Op::Or, one, other)
}

fn extend(from: u8, to: u8, state: &mut State, terms: &mut Terms) -> Term {
    let term = state.pop();
    let low = terms.part(term, 0, from);
    terms.signed(low, to)
}
