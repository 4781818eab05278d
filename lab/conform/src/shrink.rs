//! Shrinking: the smallest record that still shows the same class. First the choices that the
//! record was drawn from, with proptest's search; then the record itself, by what makes it easier
//! to read.

use std::time::{Duration, Instant};

use proptest::num::u32::BinarySearch;
use proptest::strategy::ValueTree;

use crate::cases::question::Question;
use crate::error::ConformError;
use crate::judge::class::Class;
use crate::judge::examine::{Expected, ask_and_compare, expect};
use crate::minimise;
use crate::subject::Subject;

/// Records tried while the choices are shrunk.
const TRIES_OF_CHOICES: usize = 1500;

/// Records at which it may hang.
const HANGS: usize = 4;

/// Records tried while the record itself is made smaller.
const TRIES_OF_RECORDS: usize = 4000;

/// So long, and with so many starts of the program beyond the first, records are made small.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// When it ends.
    pub until: Instant,
    /// Starts that are left for records that take one each.
    pub restarts: usize,
}

impl Limits {
    /// Whether the time is over.
    pub fn is_over(&self) -> bool {
        Instant::now() >= self.until
    }

    /// What one of several may take: a part of what is left, of the starts at least one.
    pub fn part(&self, parts: u32) -> Self {
        let now = Instant::now();
        let left: Duration = self.until.saturating_duration_since(now);
        let parts_of_starts = usize::try_from(parts).unwrap_or(1).max(1);
        let restarts = self.restarts.div_ceil(parts_of_starts);
        Self { until: now + left / parts.max(1), restarts }
    }
}

/// How choices become a record.
pub type Read<'a> = dyn Fn(&[u32]) -> Question + 'a;

/// How much of a record is valid, the more the greater.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Validity {
    /// It is answered by an error.
    Refused,
    /// What the remote sent is invalid.
    RemoteInvalid,
    /// All of it is valid.
    Valid,
}

impl Validity {
    fn of(question: &Question) -> Self {
        match expect("", question) {
            Expected::Cycle(answer) => match answer.as_ref() {
                Ok(report) if report.input.is_none() => Self::Valid,
                Ok(_) => Self::RemoteInvalid,
                Err(_) => Self::Refused,
            },
            Expected::Offloading(_) | Expected::Composition(Ok(_)) => Self::Valid,
            Expected::Composition(Err(_)) | Expected::Line(_) => Self::Refused,
        }
    }
}

/// A case that shows a class, and the program that is asked whether a smaller one does.
#[derive(Debug)]
pub struct Hunt<'a> {
    /// The program under test.
    pub subject: &'a mut Subject,
    /// What must stay the same.
    pub class: &'a Class,
    /// Name of the case; smaller ones are called `NAME.1`, `NAME.2` and so on.
    pub name: &'a str,
    /// As of the campaign.
    pub tolerance: Option<f64>,
    /// Whether each record is asked in a process of its own.
    each_fresh: bool,
    /// The validity that smaller records must not lose.
    validity: Validity,
    tries: usize,
    tries_left: usize,
    limits: &'a mut Limits,
    /// A hang costs the time limit each, a start of another program some milliseconds.
    hangs_left: usize,
    error: Option<ConformError>,
}

impl<'a> Hunt<'a> {
    /// A hunt that has not begun.
    pub fn new(
        subject: &'a mut Subject,
        class: &'a Class,
        name: &'a str,
        tolerance: Option<f64>,
        each_fresh: bool,
        limits: &'a mut Limits,
    ) -> Self {
        Self {
            subject,
            class,
            name,
            tolerance,
            each_fresh,
            validity: Validity::Refused,
            tries: 0,
            tries_left: 1,
            limits,
            hangs_left: HANGS,
            error: None,
        }
    }

    /// The smallest record found, or `None` when the record, asked again, shows the class no
    /// more. `tape` are the choices that it was drawn from and how they are read.
    /// Errors: the program cannot be started again.
    pub fn run(
        mut self,
        question: &Question,
        tape: Option<(Vec<u32>, &Read<'_>)>,
    ) -> Result<Option<Question>, ConformError> {
        let mut smallest = None;
        if self.class.breach.is_broken() {
            self.validity = Validity::of(question);
        }
        if self.shows(question) {
            let mut found = question.clone();
            if let Some((tape, read)) = tape {
                self.tries_left = TRIES_OF_CHOICES;
                found = read(&self.choices(tape, read));
            }
            self.tries_left = TRIES_OF_RECORDS;
            smallest = Some(minimise::question(&found, &mut |it| self.shows(it)));
        }
        match self.error {
            Some(error) => Err(error),
            None => Ok(smallest),
        }
    }

    /// Whether a record shows the class; never once the tries are used up or the campaign is interrupted.
    fn shows(&mut self, question: &Question) -> bool {
        let is_over = self.tries_left == 0 || self.hangs_left == 0 || self.limits.is_over();
        if is_over || self.error.is_some() || self.subject.is_interrupted() {
            return false;
        }
        let takes_a_start = self.each_fresh || self.class.breach.is_broken();
        if takes_a_start && self.limits.restarts == 0 {
            return false;
        }
        self.tries_left -= 1;
        // Who dies at a valid record has that to mend; at an invalid one it may die of something else.
        if self.validity > Validity::Refused && Validity::of(question) < self.validity {
            return false;
        }
        self.tries += 1;
        let id = format!("{}.{}", self.name, self.tries);
        if self.each_fresh {
            self.subject.restart();
            self.limits.restarts -= 1;
        }
        match ask_and_compare(self.subject, &id, question, self.tolerance) {
            Ok(examined) => {
                if examined.answered.is_err() {
                    self.limits.restarts = self.limits.restarts.saturating_sub(1);
                    self.hangs_left -= usize::from(examined.hangs());
                }
                examined.class.as_ref() == Some(self.class)
            }
            Err(error) => {
                self.error = Some(error);
                false
            }
        }
    }

    /// Zeroes as many choices as possible, in chunks, then lowers the others one by one.
    fn choices(&mut self, mut tape: Vec<u32>, read: &Read<'_>) -> Vec<u32> {
        for size in [160, 64, 32, 16, 8, 4, 2, 1] {
            for start in (0..tape.len()).step_by(size) {
                let end = (start + size).min(tape.len());
                if tape[start..end].iter().any(|choice| *choice != 0) {
                    let before = tape[start..end].to_vec();
                    tape[start..end].fill(0);
                    if !self.shows(&read(&tape)) {
                        tape[start..end].copy_from_slice(&before);
                    }
                }
            }
        }
        for at in 0..tape.len() {
            if tape[at] == 0 {
                continue;
            }
            let mut search = BinarySearch::new(tape[at]);
            let mut best = tape[at];
            let mut moved = search.simplify();
            while moved && self.tries_left > 0 {
                tape[at] = search.current();
                moved = if self.shows(&read(&tape)) {
                    best = search.current();
                    search.simplify()
                } else {
                    search.complicate()
                };
            }
            tape[at] = best;
        }
        tape
    }
}
