//! The program under test, asked whether a smaller record still shows a class: at first in one process, then in one of
//! its own for each record; where none shows it alone, which of the lines before the case have to be asked first.

use std::time::{Duration, Instant};

use crate::cases::question::Question;
use crate::error::ConformError;
use crate::judge::class::Class;
use crate::judge::examine::{Examined, Expected, ask_and_compare, expect};
use crate::results::found::NotShrunk;
use crate::shrink::passes::smallest;
use crate::shrink::record::thinned;
use crate::subject::Subject;

/// Records tried.
const TRIES: usize = 4000;

/// Records at which the program may hang: each costs the time limit, a start of another program some milliseconds.
const HANGS: usize = 4;

/// So many lines are asked in all to shorten a sequence, in whole sequences.
const WHOLE_SEQUENCES: usize = 6;

/// So many more, for the last steps of a short one.
const FURTHER_LINES: usize = 2000;

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
            Expected::States(Ok(_)) | Expected::Composition(Ok(_)) => Self::Valid,
            Expected::States(Err(_)) | Expected::Composition(Err(_)) | Expected::Line(_) => {
                Self::Refused
            }
        }
    }
}

/// What shows a class again.
#[derive(Debug)]
pub enum Again {
    /// A record that shows it alone, and what came of it.
    Alone(Box<(Question, Examined)>),
    /// The case itself, after these lines.
    After(Vec<String>),
    /// Nothing that was tried, or there was no time to try.
    Not(NotShrunk),
}

/// A case that shows a class, and the program under test.
#[derive(Debug)]
pub struct Hunt<'a> {
    subject: &'a mut Subject,
    /// What must stay the same.
    class: &'a Class,
    /// As of the campaign.
    tolerance: Option<f64>,
    /// What is left.
    pub limits: Limits,
    /// Whether each record is asked in a process of its own.
    each_fresh: bool,
    /// The validity that smaller records must not lose.
    validity: Validity,
    tries_left: usize,
    hangs_left: usize,
    error: Option<ConformError>,
}

impl<'a> Hunt<'a> {
    /// A hunt that has not begun.
    pub fn new(
        subject: &'a mut Subject,
        class: &'a Class,
        tolerance: Option<f64>,
        limits: Limits,
    ) -> Self {
        Self {
            subject,
            class,
            tolerance,
            limits,
            each_fresh: false,
            validity: Validity::Refused,
            tries_left: 0,
            hangs_left: 0,
            error: None,
        }
    }

    /// The smallest record that shows the class alone; if there is none, the lines that the case
    /// needs of those that were asked `before` it.
    /// Errors: the program cannot be started again.
    pub fn run(
        &mut self,
        question: &Question,
        before: impl Fn() -> Vec<String>,
    ) -> Result<Again, ConformError> {
        if let Some(why) = self.over() {
            return Ok(Again::Not(why));
        }
        if self.class.breach.is_broken() {
            self.validity = Validity::of(question);
        }
        self.subject.restart();
        for each_fresh in [false, true] {
            self.each_fresh = each_fresh;
            (self.tries_left, self.hangs_left) = (TRIES, HANGS);
            if !self.shows(question) {
                break;
            }
            let found = smallest(question, self.limits.until, &mut |it| self.shows(it));
            self.subject.restart();
            let examined = self.examined(&found)?;
            if examined.class.as_ref() == Some(self.class) {
                return Ok(Again::Alone(Box::new((found, examined))));
            }
        }
        let needed = self.needed(question, &before());
        match self.error.take() {
            Some(error) => Err(error),
            None if needed.is_empty() => Ok(Again::Not(self.over().unwrap_or(NotShrunk::NotAlone))),
            None => Ok(Again::After(needed)),
        }
    }

    /// Why nothing more is tried, if that is so.
    fn over(&self) -> Option<NotShrunk> {
        match self.limits.restarts {
            _ if self.subject.is_interrupted() => Some(NotShrunk::Interrupted),
            _ if self.limits.is_over() => Some(NotShrunk::Time),
            0 if self.class.breach.is_broken() => Some(NotShrunk::Limit),
            _ => None,
        }
    }

    fn examined(&mut self, question: &Question) -> Result<Examined, ConformError> {
        ask_and_compare(self.subject, &self.class.slug(), question, self.tolerance)
    }

    /// Whether a record shows the class; never once the tries are used up or the campaign is interrupted.
    fn shows(&mut self, question: &Question) -> bool {
        let is_over = self.tries_left == 0 || self.hangs_left == 0 || self.limits.is_over();
        let takes_a_start = self.each_fresh || self.class.breach.is_broken();
        if is_over || self.error.is_some() || self.subject.is_interrupted() {
            return false;
        }
        if takes_a_start && self.limits.restarts == 0 {
            return false;
        }
        self.tries_left -= 1;
        // Who dies at a valid record has that to mend; at an invalid one it may die of something else.
        if self.validity > Validity::Refused && Validity::of(question) < self.validity {
            return false;
        }
        if self.each_fresh {
            self.subject.restart();
            self.limits.restarts -= 1;
        }
        match self.examined(question) {
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

    /// The lines, of those before, after which the case shows the class; none when it does not
    /// even after all of them.
    fn needed(&mut self, question: &Question, before: &[String]) -> Vec<String> {
        let mut lines_left = WHOLE_SEQUENCES * before.len() + FURTHER_LINES;
        let mut shows = |lines: &[&str]| {
            let is_over = self.limits.is_over() || self.limits.restarts == 0;
            if is_over || lines.is_empty() || lines.len() >= lines_left || self.error.is_some() {
                return false;
            }
            self.limits.restarts -= 1;
            lines_left -= lines.len() + 1;
            self.shows_after(lines, question).unwrap_or_else(|error| {
                self.error = Some(error);
                false
            })
        };
        let all: Vec<&str> = before.iter().map(String::as_str).collect();
        let needed = if shows(&all) { thinned(all, &|| false, &mut shows) } else { Vec::new() };
        needed.into_iter().map(str::to_owned).collect()
    }

    /// Whether the case shows the class after these lines in a fresh process.
    fn shows_after(&mut self, lines: &[&str], question: &Question) -> Result<bool, ConformError> {
        self.subject.restart();
        for line in lines {
            let is_over = self.limits.is_over() || self.subject.is_interrupted();
            if is_over || self.subject.ask(line, || ())?.1.is_err() {
                // The process that the case needs is no more.
                return Ok(false);
            }
        }
        Ok(self.examined(question)?.class.as_ref() == Some(self.class))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_a_sequence_only_what_is_needed_stays() {
        let lines: Vec<usize> = (0..1000).collect();
        let mut asked = 0;
        let found = thinned(lines, &|| false, &mut |lines| {
            asked += lines.len();
            lines.contains(&17) && lines.contains(&980)
        });
        assert_eq!(found, [17, 980]);
        assert!(asked < WHOLE_SEQUENCES * 1000 + FURTHER_LINES, "{asked}");
    }
}
