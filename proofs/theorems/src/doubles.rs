//! The distances in plain doubles, every operation rounded to nearest: ranges, by bitwuzla.
//!
//! The questions are generated from the operations of `model/src/stages/distances.rs`. The implementation
//! computes in double-doubles.

mod bitwuzla;

use std::io;
use std::time::Instant;

pub use bitwuzla::version;

use crate::claim::Judgement;
use crate::numbers::real::Real;
use crate::numbers::real::program::{Operand, Operator};
use crate::stages::distances::{s_b, s_cav, s_follow, s_valid};

/// A claim about results in doubles.
#[derive(Debug)]
pub struct Range {
    /// Its name.
    pub id: &'static str,
    /// What is claimed.
    pub statement: &'static str,
    /// A statement near it that is false, which must be refuted.
    pub wrong: Wrong,
    /// The numbers that the claims name `$0`, `$1`, ...
    formulas: fn() -> Vec<Real>,
    /// In SMT-LIB; `(good x)` says that x is finite and at least 0.
    claim: &'static str,
}

/// A false variant of a claim.
#[derive(Debug)]
pub struct Wrong {
    /// What it says.
    pub statement: &'static str,
    claim: &'static str,
}

/// Of which doubles all claims are.
pub const DOMAIN: &str = "speeds from 0 to 150 m/s, a_b from 0.1 to 100 m/s^2, safety_time from 0 to 60 s: all \
                          doubles, rounding to nearest";

const INPUTS: [(&str, &str, &str); 4] = [
    ("v_now", "0.0", "150.0"),
    ("v_lead", "0.0", "150.0"),
    ("a_b", "0.1", "100.0"),
    ("safety_time", "0.0", "60.0"),
];

/// All claims.
pub const RANGES: [Range; 4] = [
    Range {
        id: "s_b_in_doubles_is_finite_and_not_negative",
        statement: "0 <= s_b <= 112500 m, computed in doubles",
        formulas: || vec![braking()],
        claim: "(and (good $0) (fp.leq $0 (number 112500.0)))",
        wrong: Wrong { statement: "0 < s_b", claim: "(fp.lt (number 0.0) $0)" },
    },
    Range {
        id: "s_follow_in_doubles_is_finite_and_not_negative",
        statement: "s_follow computed in doubles is finite and at least 0",
        formulas: || vec![follow()],
        claim: "(good $0)",
        wrong: Wrong { statement: "greater than 0", claim: "(fp.lt (number 0.0) $0)" },
    },
    Range {
        id: "s_follow_in_doubles_is_never_below_s_cav",
        statement: "s_CAV <= s_follow, both computed in doubles",
        formulas: || vec![s_cav(&Real::named("safety_time"), &Real::named("v_now")), follow()],
        claim: "(fp.leq $0 $1)",
        wrong: Wrong { statement: "s_CAV < s_follow", claim: "(fp.lt $0 $1)" },
    },
    Range {
        id: "s_valid_in_doubles_is_s_follow_or_s_b",
        statement: "s_valid computed in doubles is finite and at least 0; s_follow behind a leading vehicle, else \
                    s_b(v_now)",
        formulas: || {
            let [v_now, v_lead, a_b, safety_time] = INPUTS.map(|(name, ..)| Real::named(name));
            let valid = |lead| s_valid(&v_now, lead, &a_b, &safety_time);
            vec![valid(Some(&v_lead)), valid(None), follow(), braking()]
        },
        claim: "(and (good $0) (good $1) (fp.eq $0 $2) (fp.eq $1 $3))",
        wrong: Wrong {
            statement: "without a leading vehicle at least s_valid behind one (F-05)",
            claim: "(fp.leq $0 $1)",
        },
    },
];

fn follow() -> Real {
    let [v_now, v_lead, a_b, safety_time] = INPUTS.map(|(name, ..)| Real::named(name));
    s_follow(&v_now, &v_lead, &a_b, &safety_time)
}

fn braking() -> Real {
    s_b(&Real::named("v_now"), &Real::named("a_b"))
}

impl Range {
    /// Asks for a counterexample to the claim, and for one to the wrong variant, which there must
    /// be. Errors are those of running bitwuzla.
    pub fn judge(&self) -> io::Result<Judgement> {
        let start = Instant::now();
        let claim = bitwuzla::ask(&self.question(self.claim))?;
        let control = bitwuzla::ask(&self.question(self.wrong.claim))?;
        Ok(Judgement { claim, control, paths: 1, time: start.elapsed() })
    }

    /// Is there a counterexample? In SMT-LIB.
    fn question(&self, claim: &str) -> String {
        let mut lines = vec![String::from(PRELUDE)];
        for (name, least, most) in INPUTS {
            lines.push(format!("(declare-const {name} Float64)"));
            lines.push(format!("(assert (fp.leq (number {least}) {name}))"));
            lines.push(format!("(assert (fp.leq {name} (number {most})))"));
        }
        let program = Real::record(self.formulas);
        for step in &program.steps {
            let [a, b] = step.operands.each_ref().map(text);
            let result = match step.operator {
                Operator::Plus => format!("(fp.add RNE {a} {b})"),
                Operator::Minus => format!("(fp.sub RNE {a} {b})"),
                Operator::Times => format!("(fp.mul RNE {a} {b})"),
                Operator::Over => format!("(fp.div RNE {a} {b})"),
                Operator::Max => format!("(ite (fp.lt {a} {b}) {b} {a})"),
            };
            lines.push(format!("(define-fun {} () Float64 {result})", step.name));
        }
        let mut claim = claim.to_owned();
        for (place, result) in program.results.iter().enumerate() {
            claim = claim.replace(&format!("${place}"), &text(result));
        }
        lines.push(format!("(assert (not {claim}))\n(check-sat)"));
        lines.extend(INPUTS.map(|(name, ..)| format!("(get-value ({name}))")));
        lines.join("\n").replace("(number ", "((_ to_fp 11 53) RNE ")
    }
}

const PRELUDE: &str = "(set-logic QF_FP)
(set-option :produce-models true)
(define-fun good ((x Float64)) Bool
  (and (fp.leq (number 0.0) x) (not (fp.isInfinite x)) (not (fp.isNaN x))))";

fn text(operand: &Operand) -> String {
    match operand {
        Operand::Name(name) => name.clone(),
        Operand::Constant(value) => format!("(number {:?})", value.to_f64().value()),
    }
}
