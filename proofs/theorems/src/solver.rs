//! z3 as a process that reads and writes SMT-LIB.

use std::io::{self, BufRead, BufReader, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::time::Duration;

/// What the solver says of assertions.
#[derive(Clone, Debug, PartialEq)]
pub enum Satisfiability {
    /// No values of the variables satisfy them.
    Unsat,
    /// These do, in the order in which they were asked for, as z3 writes them.
    Sat(Vec<String>),
    /// It does not know.
    Unknown,
}

/// How hard the solver tries before it says that it does not know.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// z3's own count of steps: the same on every machine, however busy. 0: any number.
    pub steps: u32,
    /// For what is not counted, ms.
    pub limit_ms: u32,
}

/// Beyond its own limit the solver gets as long again and this, then it is ended.
const GRACE: Duration = Duration::from_secs(2);

/// A running solver.
#[derive(Debug)]
pub struct Solver {
    program: PathBuf,
    process: Child,
    input: ChildStdin,
    /// Its lines, read by a thread that ends with it.
    output: Receiver<io::Result<String>>,
    /// Questions asked.
    pub questions: usize,
    /// The first error of reading or writing; no answer is given after it.
    pub error: Option<io::Error>,
}

/// The version line of z3, or nothing where there is none.
fn version() -> Option<String> {
    let output = Command::new("z3").arg("--version").output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| text.trim().to_owned())
}

/// Whether z3 is here and at least 4.8, the oldest that the theorems were tried with.
pub fn is_new_enough() -> bool {
    version().is_some_and(|line| is_version_4_8(&line))
}

/// The line names version 4.8 or newer: `Z3 version 4.8.12 - 64 bit`.
pub fn is_version_4_8(line: &str) -> bool {
    let Some(rest) = line.strip_prefix("Z3 version ") else { return false };
    let mut parts = rest.split(['.', ' ']).map(str::parse::<u32>);
    match (parts.next(), parts.next()) {
        (Some(Ok(major)), Some(Ok(minor))) => (major, minor) >= (4, 8),
        _ => false,
    }
}

impl Solver {
    /// Starts z3.
    pub fn start() -> io::Result<Self> {
        Self::start_program(Path::new("z3"))
    }

    /// Starts a program that takes the arguments of z3.
    pub fn start_program(program: &Path) -> io::Result<Self> {
        let mut process = Command::new(program)
            .arg("-in")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()?;
        let missing = || io::Error::other("the solver has no pipes");
        let input = process.stdin.take().ok_or_else(missing)?;
        let lines = BufReader::new(process.stdout.take().ok_or_else(missing)?).lines();
        let (sender, output) = mpsc::channel();
        std::thread::spawn(move || lines.map(|line| sender.send(line)).find(Result::is_err));
        Ok(Self { program: program.to_owned(), process, input, output, questions: 0, error: None })
    }

    /// Whether the declarations and assertions of the script can be satisfied; if so, by what
    /// values of these variables. Nothing is left of it afterwards.
    pub fn check(&mut self, script: &str, variables: &[String], effort: Effort) -> Satisfiability {
        self.questions += 1;
        self.try_check(script, variables, effort).unwrap_or_else(|error| {
            if error.kind() != ErrorKind::TimedOut {
                self.error.get_or_insert(error);
            } else if let Err(error) = self.start_again() {
                self.error.get_or_insert(error);
            }
            Satisfiability::Unknown
        })
    }

    fn try_check(
        &mut self,
        script: &str,
        variables: &[String],
        effort: Effort,
    ) -> io::Result<Satisfiability> {
        let Effort { steps, limit_ms } = effort;
        let limits = format!("(set-option :rlimit {steps})(set-option :timeout {limit_ms})");
        writeln!(self.input, "(reset){limits}\n{script}\n(check-sat)")?;
        self.input.flush()?;
        let limit = Duration::from_millis(2 * u64::from(limit_ms)) + GRACE;
        match self.line(limit)?.as_str() {
            "unsat" => Ok(Satisfiability::Unsat),
            "sat" => Ok(Satisfiability::Sat(self.values(variables)?)),
            "unknown" | "timeout" => Ok(Satisfiability::Unknown),
            other => Err(io::Error::other(format!("z3 says: {other}"))),
        }
    }

    fn values(&mut self, variables: &[String]) -> io::Result<Vec<String>> {
        let value = |name: &String| {
            writeln!(self.input, "(eval |{name}| :completion true)")?;
            self.input.flush()?;
            self.line(GRACE)
        };
        variables.iter().map(value).collect()
    }

    fn line(&mut self, limit: Duration) -> io::Result<String> {
        match self.output.recv_timeout(limit) {
            Ok(line) => Ok(line?.trim().to_owned()),
            Err(RecvTimeoutError::Timeout) => Err(ErrorKind::TimedOut.into()),
            Err(RecvTimeoutError::Disconnected) => Err(io::Error::other("z3 ended")),
        }
    }

    /// Ends a solver that hangs; a new one takes the next question.
    fn start_again(&mut self) -> io::Result<()> {
        let questions = self.questions;
        *self = Self::start_program(&self.program)?;
        self.questions = questions;
        Ok(())
    }
}

impl Drop for Solver {
    fn drop(&mut self) {
        // It may have ended by itself; either way it is gone afterwards.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// A number as z3 writes it: `1.5`, `(- 1.5)`, `(/ 1.0 3.0)`, `1.4142?`; NaN of anything else.
pub fn number(text: &str) -> f64 {
    let words: Vec<&str> =
        text.split(|c: char| c.is_whitespace() || c == '(' || c == ')').collect();
    let mut sign = 1.0;
    let mut numbers = Vec::new();
    for word in words {
        match word {
            "-" => sign = -sign,
            "" | "/" => {}
            other => numbers.push(other.trim_end_matches('?').parse().unwrap_or(f64::NAN)),
        }
    }
    match numbers.as_slice() {
        [value] => sign * value,
        [numerator, denominator] => sign * numerator / denominator,
        _ => f64::NAN,
    }
}
