//! The path that a symbolic execution takes: what was assumed, what each comparison answered, and
//! which answers remain to be tried.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

use crate::solver::{Effort, Satisfiability, Solver};
use dashu_base::{Abs, Signed};
use dashu_ratio::RBig;

use crate::numbers::real::polynomial::{Polynomial, Rules, Variable};

/// For telling whether a branch can be reached. Without an answer the branch is taken.
const BRANCH: Effort = Effort { steps: 30_000, limit_ms: 1000 };

/// Values as decimal fractions.
const DECIMALS: &str = "(set-option :pp.decimal true)(set-option :pp.decimal_precision 20)\n";

/// A set of signs: which of negative, zero and positive a polynomial may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Signs(u8);

impl Signs {
    /// Below 0.
    pub const NEGATIVE: Self = Self(0b001);
    /// 0.
    pub const ZERO: Self = Self(0b010);
    /// Above 0.
    pub const POSITIVE: Self = Self(0b100);
    /// At least 0.
    pub const AT_LEAST_ZERO: Self = Self(0b110);
    const ANY: Self = Self(0b111);

    /// The other signs.
    #[must_use]
    pub fn complement(self) -> Self {
        Self(Self::ANY.0 & !self.0)
    }

    /// The signs of the number times -1.
    #[must_use]
    pub fn negated(self) -> Self {
        Self((self.0 & 0b010) | (self.0 & 1) << 2 | self.0 >> 2)
    }

    fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    fn is_empty(self) -> bool {
        self.0 == 0
    }

    fn of(value: &RBig) -> Self {
        if value.is_zero() {
            Self::ZERO
        } else if value.is_negative() {
            Self::NEGATIVE
        } else {
            Self::POSITIVE
        }
    }
}

/// One execution.
#[derive(Debug, Default)]
pub struct Path {
    /// Names of the variables.
    pub names: Vec<String>,
    /// Rewriting rules.
    pub rules: Rules,
    /// Assumptions and branches, as assertions of SMT-LIB.
    pub script: Vec<String>,
    /// Roots made from here on are any numbers >= 0: the solver is not told of what. Facts about
    /// them have to be assumed, each a lemma. Fewer assumptions never prove more.
    pub roots_are_any_numbers: bool,
    /// A product of variables is any number, the same wherever it stands: the solver is asked what follows
    /// by linear steps alone. Fewer assumptions never prove more.
    pub products_are_any_numbers: bool,
    /// Roots and quotients made so far, by what they are made of.
    pub made: BTreeMap<(Operation, Polynomial), Polynomial>,
    signs: BTreeMap<Polynomial, Signs>,
    /// Comparisons answered by a branch so far.
    depth: usize,
}

/// An operation whose result is a variable of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Operation {
    /// Square root.
    Root,
    /// One over the number.
    Inverse,
}

/// An answer given at a branch, and whether the other remains to be tried.
#[derive(Clone, Copy, Debug)]
struct Branch {
    answer: bool,
    other_remains: bool,
}

/// The execution in progress, the branches up to it, and the solver that prunes them.
#[derive(Debug, Default)]
struct Execution {
    path: Path,
    branches: Vec<Branch>,
    solver: Option<Solver>,
}

thread_local! {
    static EXECUTION: RefCell<Execution> = RefCell::default();
}

/// Looks at or changes the path in progress.
pub fn with<T>(f: impl FnOnce(&mut Path) -> T) -> T {
    EXECUTION.with_borrow_mut(|execution| f(&mut execution.path))
}

/// Lends the solver to the executions of this thread, or takes it back.
pub fn exchange_solver(solver: Option<Solver>) -> Option<Solver> {
    EXECUTION.with_borrow_mut(|execution| std::mem::replace(&mut execution.solver, solver))
}

/// Asks the solver about the path in progress and one more assertion.
pub fn ask(assertion: &str, effort: Effort) -> Satisfiability {
    EXECUTION.with_borrow_mut(|execution| execution.ask(assertion, effort))
}

/// Starts at the first path.
pub fn first() {
    EXECUTION.with_borrow_mut(|execution| {
        execution.branches.clear();
        execution.path = Path::default();
    });
}

/// Goes on to the next path; false when there is none.
pub fn next() -> bool {
    EXECUTION.with_borrow_mut(|execution| {
        execution.path = Path::default();
        while execution.branches.last().is_some_and(|branch| !branch.other_remains) {
            execution.branches.pop();
        }
        let Some(last) = execution.branches.last_mut() else { return false };
        *last = Branch { answer: !last.answer, other_remains: false };
        true
    })
}

/// Whether the sign of the polynomial is one of these: known, or both answers are tried, each on a
/// path of its own, as far as the solver does not rule one out.
pub fn branch(polynomial: &Polynomial, signs: Signs) -> bool {
    EXECUTION.with_borrow_mut(|execution| {
        if let Some(value) = polynomial.as_constant() {
            return !Signs::of(&value).and(signs).is_empty();
        }
        let (key, signs) = execution.path.key(polynomial, signs);
        let known = execution.path.signs_of(&key);
        if known.and(signs.complement()).is_empty() {
            return true;
        }
        if known.and(signs).is_empty() {
            return false;
        }
        let answer = execution.decide(&key, signs);
        execution.path.assume(&key, if answer { signs } else { signs.complement() });
        answer
    })
}

impl Execution {
    fn decide(&mut self, key: &Polynomial, signs: Signs) -> bool {
        let depth = self.path.depth;
        self.path.depth += 1;
        if let Some(branch) = self.branches.get(depth) {
            return branch.answer;
        }
        let mut possible = |signs: Signs| {
            let assertion = self.path.assertion(key, signs);
            // Of what is linear alone more is possible, and few steps tell. Where roots are any numbers, most is linear.
            let is_asked = is_linear(&assertion) && !self.path.roots_are_any_numbers;
            let is_out = is_asked && self.excludes(&assertion, is_linear);
            !is_out && !self.excludes(&assertion, |_| true)
        };
        // Some answer is possible on a path that can be reached: without the one, the other is.
        let answer = possible(signs);
        let branch = Branch { answer, other_remains: answer && possible(signs.complement()) };
        self.branches.push(branch);
        branch.answer
    }

    /// Whether what was assumed, as far as it is kept, rules the assertion out.
    fn excludes(&mut self, assertion: &str, is_kept: fn(&str) -> bool) -> bool {
        let script = self.path.script_with(assertion, is_kept);
        matches!(self.check(&script, BRANCH), Satisfiability::Unsat)
    }

    fn ask(&mut self, assertion: &str, effort: Effort) -> Satisfiability {
        let script = self.path.script_with(assertion, |_| true);
        self.check(&script, effort)
    }

    fn check(&mut self, script: &str, effort: Effort) -> Satisfiability {
        let Some(solver) = &mut self.solver else { return Satisfiability::Unknown };
        solver.check(script, &self.path.names, effort)
    }
}

/// No product in this SMT-LIB has two variables.
fn is_linear(assertion: &str) -> bool {
    !assertion.contains("| |")
}

impl Path {
    /// The variable of this name, new or not.
    pub fn named(&mut self, name: &str) -> Variable {
        let known = self.names.iter().position(|other| other == name);
        known
            .and_then(|place| Variable::try_from(place).ok())
            .unwrap_or_else(|| self.variable(name))
    }

    /// A new variable. A name that is taken gets a number, so that two of one name differ.
    ///
    /// # Panics
    /// If there are more than 65,536.
    pub fn variable(&mut self, name: &str) -> Variable {
        let number = self.names.len();
        let taken = self.names.iter().any(|other| other == name);
        self.names.push(if taken { format!("{name}.{number}") } else { name.to_owned() });
        Variable::try_from(number).expect("a path has few variables")
    }

    /// Assumes that the sign of the polynomial is one of these.
    pub fn assume(&mut self, polynomial: &Polynomial, signs: Signs) {
        let (key, signs) = self.key(polynomial, signs);
        if key.as_constant().is_none() {
            let known = self.signs_of(&key);
            self.signs.insert(key.clone(), known.and(signs));
        }
        let assertion = self.assertion(&key, signs);
        self.script.push(assertion);
    }

    /// What was assumed, as far as it is kept, and one more assertion, in SMT-LIB.
    fn script_with(&self, assertion: &str, is_kept: fn(&str) -> bool) -> String {
        let kept = self.script.iter().map(String::as_str).filter(|line| is_kept(line));
        let lines = kept.chain([assertion]);
        let script: String = lines.flat_map(|line| ["(assert ", line, ")\n"]).collect();
        // Names stand between bars. Those of products that are any numbers are not among the variables.
        let products: BTreeSet<&str> = script.split('|').skip(1).step_by(2).collect();
        let is_new = |name: &&&str| !self.names.iter().any(|known| known == **name);
        let products = products.iter().filter(is_new).copied();
        let names = self.names.iter().map(String::as_str).chain(products);
        let declared: String =
            names.flat_map(|name| ["(declare-const |", name, "| Real)\n"]).collect();
        [DECIMALS, &declared, &script].concat()
    }

    /// "The sign of the polynomial is one of these" in SMT-LIB.
    pub fn assertion(&self, polynomial: &Polynomial, signs: Signs) -> String {
        let operator = match signs.0 {
            0b001 => "<",
            0b010 => "=",
            0b011 => "<=",
            0b100 => ">",
            0b101 => "distinct",
            0b110 => ">=",
            0b111 => return String::from("true"),
            _ => return String::from("false"),
        };
        format!("({operator} {} 0.0)", self.text(polynomial))
    }

    fn signs_of(&self, key: &Polynomial) -> Signs {
        self.signs.get(key).copied().unwrap_or(Signs::ANY)
    }

    /// The same question of a polynomial with leading coefficient 1 and without positive factors.
    fn key(&self, polynomial: &Polynomial, signs: Signs) -> (Polynomial, Signs) {
        let is_positive =
            |variable| self.signs.get(&Polynomial::variable(variable)) == Some(&Signs::POSITIVE);
        let rest = polynomial.without_factors(is_positive);
        let lead = rest.lead();
        let signs = if lead.is_negative() { signs.negated() } else { signs };
        (rest.scaled(&(RBig::ONE / lead)), signs)
    }

    /// The polynomial in SMT-LIB.
    pub fn text(&self, polynomial: &Polynomial) -> String {
        let number = |value: &RBig| {
            let (numerator, denominator) = (value.numerator(), value.denominator());
            let text = format!("(/ {}.0 {denominator}.0)", numerator.clone().abs());
            if value.is_negative() { format!("(- {text})") } else { text }
        };
        let term = |(monomial, value): (&Vec<Variable>, &RBig)| {
            let factors = monomial.iter().map(|&v| self.names[usize::from(v)].as_str());
            let between = if self.products_are_any_numbers { " times " } else { "| |" };
            let text = factors.collect::<Vec<_>>().join(between);
            let text = if text.is_empty() { text } else { format!("|{text}|") };
            match (text.is_empty(), value.is_one()) {
                (true, _) => number(value),
                (false, true) => format!("(* 1.0 {text})"),
                (false, false) => format!("(* {} {text})", number(value)),
            }
        };
        let terms: Vec<String> = polynomial.terms().map(term).collect();
        format!("(+ 0.0 {})", terms.join(" "))
    }
}
