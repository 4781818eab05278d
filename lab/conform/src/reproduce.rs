//! What shows a disagreement again: a small record alone, in a fresh process of the program under
//! test, or else the lines that have to be asked before it.

use crate::cases::question::Question;
use crate::error::ConformError;
use crate::judge::class::Class;
use crate::judge::examine::{Examined, ask_and_compare};
use crate::results::found::NotShrunk;
use crate::shrink::{Hunt, Limits, Read};
use crate::subject::Subject;

/// So many lines are asked in all to shorten a sequence, in whole sequences.
const WHOLE_SEQUENCES: usize = 6;

/// So many more, for the last steps of a short one.
const FURTHER_LINES: usize = 2000;

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
pub struct Reproduction<'a> {
    /// The program under test, as the case left it.
    pub subject: &'a mut Subject,
    /// What must stay the same.
    pub class: &'a Class,
    /// Name of the case.
    pub name: &'a str,
    /// The case.
    pub question: &'a Question,
    /// As of the campaign.
    pub tolerance: Option<f64>,
    /// How long, and how many starts.
    pub limits: &'a mut Limits,
}

impl Reproduction<'_> {
    /// The smallest record that shows the class alone; if there is none, the lines that the case
    /// needs of those that were asked `before` it. `tape` are the choices that the
    /// case was drawn from and how they are read.
    /// Errors: the program cannot be started again.
    pub fn run(
        &mut self,
        tape: Option<&(Vec<u32>, &Read<'_>)>,
        before: &dyn Fn() -> Vec<String>,
    ) -> Result<Again, ConformError> {
        if let Some(why) = self.over() {
            return Ok(Again::Not(why));
        }
        self.subject.restart();
        for each_fresh in [false, true] {
            let tape = tape.map(|(tape, read)| (tape.clone(), *read));
            let Self { class, name, tolerance, .. } = *self;
            let hunt = Hunt::new(self.subject, class, name, tolerance, each_fresh, self.limits);
            let Some(smallest) = hunt.run(self.question, tape)? else { break };
            let examined = self.alone(&smallest)?;
            if examined.class.as_ref() == Some(self.class) {
                return Ok(Again::Alone(Box::new((smallest, examined))));
            }
        }
        let needed = self.needed(&before())?;
        if needed.is_empty() {
            return Ok(Again::Not(self.over().unwrap_or(NotShrunk::NotAlone)));
        }
        Ok(Again::After(needed))
    }

    /// Why nothing more is tried, if that is so.
    fn over(&self) -> Option<NotShrunk> {
        let may_break = self.class.breach.is_broken();
        match self.limits.restarts {
            _ if self.subject.is_interrupted() => Some(NotShrunk::Interrupted),
            _ if self.limits.is_over() => Some(NotShrunk::Time),
            0 if may_break => Some(NotShrunk::Limit),
            _ => None,
        }
    }

    /// Asks a record in a fresh process.
    fn alone(&mut self, question: &Question) -> Result<Examined, ConformError> {
        self.subject.restart();
        ask_and_compare(self.subject, &self.class.slug(), question, self.tolerance)
    }

    /// The lines, of those before, after which the case shows the class; none when it does not
    /// even after all of them.
    fn needed(&mut self, before: &[String]) -> Result<Vec<String>, ConformError> {
        let mut lines_left = WHOLE_SEQUENCES * before.len() + FURTHER_LINES;
        let mut failed = None;
        let mut shows = |lines: &[&str]| {
            let is_over = self.limits.is_over() || self.limits.restarts == 0;
            if is_over || lines.is_empty() || lines.len() >= lines_left || failed.is_some() {
                return false;
            }
            self.limits.restarts -= 1;
            lines_left -= lines.len() + 1;
            self.shows_after(lines).unwrap_or_else(|error| {
                failed = Some(error);
                false
            })
        };
        let all: Vec<&str> = before.iter().map(String::as_str).collect();
        let needed = if shows(&all) { halved(all, &mut shows) } else { Vec::new() };
        let needed = needed.into_iter().map(str::to_owned).collect();
        failed.map_or(Ok(needed), Err)
    }

    /// Whether the case shows the class after these lines in a fresh process.
    fn shows_after(&mut self, lines: &[&str]) -> Result<bool, ConformError> {
        self.subject.restart();
        for line in lines {
            let is_over = self.limits.is_over() || self.subject.is_interrupted();
            if is_over || self.subject.ask(line, || ())?.1.is_err() {
                // The process that the case needs is no more.
                return Ok(false);
            }
        }
        let id = self.class.slug();
        let examined = ask_and_compare(self.subject, &id, self.question, self.tolerance)?;
        Ok(examined.class.as_ref() == Some(self.class))
    }
}

/// Leaves out halves, quarters, and so on to single lines, while what stays still shows.
fn halved<'a>(mut lines: Vec<&'a str>, shows: &mut dyn FnMut(&[&str]) -> bool) -> Vec<&'a str> {
    let mut size = lines.len().div_ceil(2);
    while size > 0 {
        let mut start = 0;
        while start < lines.len() {
            let end = (start + size).min(lines.len());
            let fewer = [&lines[..start], &lines[end..]].concat();
            if !fewer.is_empty() && shows(&fewer) {
                lines = fewer;
            } else {
                start = end;
            }
        }
        size /= 2;
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_a_sequence_only_what_is_needed_stays() {
        let lines: Vec<String> = (0..1000).map(|it| it.to_string()).collect();
        let all = lines.iter().map(String::as_str).collect();
        let mut asked = 0;
        let found = halved(all, &mut |lines| {
            asked += lines.len();
            lines.contains(&"17") && lines.contains(&"980")
        });
        assert_eq!(found, ["17", "980"]);
        assert!(asked < WHOLE_SEQUENCES * 1000 + FURTHER_LINES, "{asked}");
    }
}
