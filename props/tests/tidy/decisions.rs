//! Compound conditions of what a vehicle runs.

use syn::visit::{self, Visit};
use syn::{BinOp, Expr, ExprBinary, UnOp};

use super::tree::Tree;

/// Conditions with a part to which more than one way leads, as the last one of `(a && b) || c`; `c || (a && b)` has none.
/// Of all other conditions tests that see each part true and false achieve masking MC/DC (Comar, Guitton, Hainque, Robert:
/// Formalization and Comparison of MCDC and Object Branch Coverage Criteria, 2012). `scripts/coverage` counts both outcomes.
pub fn with_two_ways(tree: &Tree) -> Vec<(String, String)> {
    let mut wrong = Vec::new();
    let run = ["impl/src/", "capi/src/"];
    let code = tree.ending(".rs").filter(|it| !it.0.ends_with("/tests.rs"));
    for (path, text) in code.filter(|it| run.iter().any(|of| it.0.starts_with(of))) {
        let mut found = Found(Vec::new());
        found.visit_file(&syn::parse_file(text).expect("sources are Rust"));
        wrong.extend(
            found
                .0
                .into_iter()
                .map(|line| (format!("{path}:{line}"), "turn the operands round".to_owned())),
        );
    }
    wrong
}

struct Found(Vec<usize>);

impl<'ast> Visit<'ast> for Found {
    fn visit_expr_binary(&mut self, it: &'ast ExprBinary) {
        let (on_true, on_false) = ways_out(&it.left);
        match &it.op {
            BinOp::And(op) if on_true > 1 => self.0.push(op.spans[0].start().line),
            BinOp::Or(op) if on_false > 1 => self.0.push(op.spans[0].start().line),
            _ => {}
        }
        visit::visit_expr_binary(self, it);
    }
}

/// How many ways lead out of a condition that is true, and out of one that is false.
fn ways_out(condition: &Expr) -> (usize, usize) {
    match condition {
        Expr::Paren(it) => ways_out(&it.expr),
        Expr::Unary(it) if matches!(it.op, UnOp::Not(_)) => {
            let (on_true, on_false) = ways_out(&it.expr);
            (on_false, on_true)
        }
        Expr::Binary(it) => {
            let (left, right) = (ways_out(&it.left), ways_out(&it.right));
            match it.op {
                BinOp::And(_) => (right.0, left.1 + right.1),
                BinOp::Or(_) => (left.0 + right.0, right.1),
                _ => (1, 1),
            }
        }
        _ => (1, 1),
    }
}

#[test]
fn a_part_with_two_ways_is_seen() {
    let of = |condition: &str| {
        let text = format!("fn f() -> bool {{\n    {condition}\n}}\n");
        with_two_ways(&Tree([("impl/src/a.rs".to_owned(), text)].into())).len()
    };
    for fine in [
        "a && b && c",
        "a || b || c",
        "c || a && b",
        "c && (a || b)",
        "!(a && b) || c",
        "(a == b) || c",
    ] {
        assert_eq!(of(fine), 0, "{fine}");
    }
    for wrong in [
        "a && b || c",
        "(a || b) && c",
        "!(a || b) || c",
        "(c || a && b) || d",
        "d || (a && b || c)",
    ] {
        assert_eq!(of(wrong), 1, "{wrong}");
    }
}
