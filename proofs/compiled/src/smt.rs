//! z3 decides whether a truth value can be true.

use std::fmt::Write as _;
use std::io;

use mufasa_z3::{Effort, Satisfiability, Solver};

use crate::term::{Node, Op, Term, Terms};

/// What z3 says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Possible {
    /// Nothing makes it true.
    Never,
    /// These numbers of the variables do.
    With(Vec<(u32, u64)>),
    /// It did not end in time.
    Unknown,
}

/// Asks whether the truth value can be true, for at most `limit_ms`. Errors are those of running z3.
pub fn ask(terms: &Terms, truth: Term, limit_ms: u32) -> io::Result<Possible> {
    if let Some(value) = terms.number(truth) {
        return Ok(if value == 0 { Possible::Never } else { Possible::With(Vec::new()) });
    }
    let (script, variables) = script(terms, truth);
    let names: Vec<String> = variables.iter().map(|number| format!("v{number}")).collect();
    let mut solver = Solver::start()?;
    let answer = solver.check(&script, &names, Effort { steps: 0, limit_ms });
    if let Some(error) = solver.error.take() {
        return Err(error);
    }
    Ok(match answer {
        Satisfiability::Unsat => Possible::Never,
        Satisfiability::Unknown => Possible::Unknown,
        Satisfiability::Sat(values) => {
            let values: io::Result<Vec<u64>> = values.iter().map(|line| value(line)).collect();
            Possible::With(variables.into_iter().zip(values?).collect())
        }
    })
}

/// `#x00ff`
fn value(line: &str) -> io::Result<u64> {
    let digits = line.strip_prefix("#x").unwrap_or_default();
    u64::from_str_radix(digits, 16).map_err(|_| io::Error::other(format!("z3 says: {line}")))
}

/// Every part of the term once, in the order of the graph, which is one in which parts come first.
fn script(terms: &Terms, truth: Term) -> (String, Vec<u32>) {
    let mut wanted = std::collections::BTreeSet::new();
    let mut open = vec![truth];
    while let Some(term) = open.pop() {
        if wanted.insert(term) {
            open.extend(parts(terms.node(term)));
        }
    }
    let (mut script, mut variables) = ("(set-logic QF_BV)\n".to_owned(), Vec::new());
    for term in wanted {
        let sort = match terms.width(term) {
            1 => "Bool".to_owned(),
            width => format!("(_ BitVec {width})"),
        };
        let said = if let Node::Variable(number) = terms.node(term) {
            variables.push(number);
            writeln!(script, "(declare-const v{number} {sort})")
        } else {
            let body = body(terms, term);
            // An equation; z3 takes much longer to read definitions.
            let index = term.index();
            writeln!(script, "(declare-const t{index} {sort})(assert (= t{index} {body}))")
        };
        said.expect("text takes any text");
    }
    write!(script, "(assert {})", name(terms, truth)).expect("text takes any text");
    (script, variables)
}

fn parts(node: Node) -> Vec<Term> {
    match node {
        Node::Constant(_) | Node::Variable(_) => Vec::new(),
        Node::Not(one) | Node::Part(one, _) | Node::Signed(one) => vec![one],
        Node::Binary(_, one, other) | Node::Join(one, other) => vec![one, other],
        Node::Choice(condition, yes, no) => vec![condition, yes, no],
    }
}

fn name(terms: &Terms, term: Term) -> String {
    match terms.node(term) {
        Node::Variable(number) => format!("v{number}"),
        _ => format!("t{}", term.index()),
    }
}

fn body(terms: &Terms, term: Term) -> String {
    let width = terms.width(term);
    let name = |term| name(terms, term);
    match terms.node(term) {
        Node::Constant(value) if width == 1 => (value == 1).to_string(),
        Node::Constant(value) => format!("(_ bv{value} {width})"),
        Node::Variable(_) => unreachable!("declared"),
        Node::Not(one) => format!("(not {})", name(one)),
        Node::Binary(op, one, other) => {
            format!("({} {} {})", operator(op, terms.width(one)), name(one), name(other))
        }
        Node::Choice(condition, yes, no) => {
            format!("(ite {} {} {})", name(condition), name(yes), name(no))
        }
        Node::Part(one, low) => {
            format!("((_ extract {} {low}) {})", low + width - 1, name(one))
        }
        Node::Join(high, low) => format!("(concat {} {})", name(high), name(low)),
        Node::Signed(one) => {
            format!("((_ sign_extend {}) {})", width - terms.width(one), name(one))
        }
    }
}

const fn operator(op: Op, width: u8) -> &'static str {
    match (op, width) {
        (Op::And, 1) => "and",
        (Op::Xor, 1) => "xor",
        (Op::Equal, _) => "=",
        (Op::Add, _) => "bvadd",
        (Op::Sub, _) => "bvsub",
        (Op::Mul, _) => "bvmul",
        (Op::And, _) => "bvand",
        (Op::Or, _) => "bvor",
        (Op::Xor, _) => "bvxor",
        (Op::ShiftLeft, _) => "bvshl",
        (Op::ShiftRight, _) => "bvlshr",
        (Op::ShiftSigned, _) => "bvashr",
        (Op::Below, _) => "bvult",
        (Op::SignedBelow, _) => "bvslt",
    }
}
