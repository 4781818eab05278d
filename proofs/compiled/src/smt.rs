//! z3 as a process that decides whether a truth value can be true.

use std::fmt::Write as _;
use std::io::{self, BufRead, BufReader, Write};
use std::process::{Command, Stdio};

use crate::term::{Node, Op, Term, Terms};

/// What z3 says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Answer {
    /// Nothing makes it true.
    Never,
    /// These numbers of the variables do.
    With(Vec<(u32, u64)>),
    /// It did not end in time.
    Unknown,
}

/// Whether there is a z3.
pub fn is_here() -> bool {
    Command::new("z3").arg("--version").output().is_ok_and(|output| output.status.success())
}

/// Asks whether the truth value can be true, for at most `limit_ms`.
pub fn ask(terms: &Terms, truth: Term, limit_ms: u64) -> io::Result<Answer> {
    if let Some(value) = terms.number(truth) {
        return Ok(if value == 0 { Answer::Never } else { Answer::With(Vec::new()) });
    }
    let (script, variables) = script(terms, truth);
    let mut process = Command::new("z3")
        .args(["-in", &format!("-t:{limit_ms}")])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()?;
    let missing = || io::Error::other("z3 has no pipes");
    let mut input = process.stdin.take().ok_or_else(missing)?;
    let output = BufReader::new(process.stdout.take().ok_or_else(missing)?);
    input.write_all(script.as_bytes())?;
    drop(input);
    let mut lines = output.lines();
    let answer = match lines.next().transpose()?.as_deref() {
        Some("unsat") => Answer::Never,
        Some("sat") => {
            let mut values = Vec::new();
            for variable in variables {
                let line = lines.next().transpose()?.unwrap_or_default();
                values.push((variable, value(&line)?));
            }
            Answer::With(values)
        }
        Some("unknown" | "timeout") => Answer::Unknown,
        other => return Err(io::Error::other(format!("z3 says: {other:?}"))),
    };
    process.kill()?;
    process.wait()?;
    Ok(answer)
}

/// `((v3 #x00ff))`
fn value(line: &str) -> io::Result<u64> {
    let digits = line.split("#x").nth(1).unwrap_or_default().trim_end_matches(')');
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
    writeln!(script, "(assert {})\n(check-sat)", name(terms, truth)).expect("text takes any text");
    for variable in &variables {
        writeln!(script, "(get-value (v{variable}))").expect("text takes any text");
    }
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
