//! What an attack does to a drive, found by going through its cycles once.

use mufasa_model::input::cycle::Cycle;
use mufasa_model::services::configuration::Configuration;

use super::change::{Onset, apply};
use super::error::InjectError;
use super::injection::Injection;
use super::meeting;
use super::planner::driven_line;
use crate::drive::Stream;
use crate::readers::error::ReadError;
use crate::seconds;

/// What an attack does to a drive.
pub(super) struct Course {
    /// For every cycle of the attacked drive whether and how it is attacked.
    pub(super) targets: Vec<Option<Target>>,
    /// What is to be known of it.
    pub(super) notes: Vec<String>,
}

/// How a cycle is attacked.
#[derive(Clone, Copy)]
pub(super) struct Target {
    /// The object that the attack was on before.
    pub(super) before: Option<i64>,
}

impl Course {
    /// Goes through the drive. Errors: no cycle is changed, or one cannot be read again.
    pub(super) fn of(drive: &Stream, injection: Injection) -> Result<(Self, Onset), InjectError> {
        let mut pass = Pass::new(drive, injection);
        for (index, clean) in drive.cycles().enumerate() {
            if !pass.take(index, &clean?.cycle)? {
                break;
            }
        }
        pass.end()
    }
}

/// One pass over the cycles of a drive.
struct Pass<'d> {
    drive: &'d Stream,
    injection: Injection,
    start_ns: Option<i64>,
    targets: Vec<Option<Target>>,
    target: Option<i64>,
    onset: Option<Onset>,
    /// Cycles that are changed, and the time of the first, s.
    changed: usize,
    first_s: f64,
    meeting: Option<String>,
    at_the_end: bool,
    span: Span,
}

/// What the cycles in the span are like, in case that none is changed.
#[derive(Default)]
struct Span {
    first: Option<Configuration>,
    is_remote: bool,
    /// Time of the last cycle of the drive, s.
    end_s: f64,
}

impl<'d> Pass<'d> {
    fn new(drive: &'d Stream, injection: Injection) -> Self {
        Self {
            drive,
            injection,
            start_ns: None,
            targets: Vec::with_capacity(drive.count()),
            target: None,
            onset: None,
            changed: 0,
            first_s: 0.0,
            meeting: None,
            at_the_end: false,
            span: Span::default(),
        }
    }

    /// Takes the next cycle of the clean drive; `false` when the attacked one ends before it.
    fn take(&mut self, index: usize, clean: &Cycle) -> Result<bool, ReadError> {
        let Injection { attack, from_s, to_s } = self.injection;
        let start_ns = *self.start_ns.get_or_insert(clean.now_ns);
        let at_s = seconds(start_ns, clean.now_ns);
        let in_span = (from_s..=to_s).contains(&at_s);
        self.span.end_s = at_s;
        if in_span {
            self.span.first.get_or_insert(clean.configuration);
            self.span.is_remote |= attack.is_remote(clean);
        }
        if !(in_span && attack.reaches(clean)) {
            let ends = attack.is_driven() && self.onset.is_some();
            self.targets.extend((!ends).then_some(None));
            return Ok(!ends);
        }
        if self.onset.is_none() {
            let rest = || (index..self.drive.count()).map(|at| self.drive.cycle(at));
            let line = || driven_line(rest());
            self.onset = Onset::new(clean, attack, self.drive.lead_range_m, line)?;
        }
        let Some(onset) = &self.onset else {
            self.targets.push(None);
            return Ok(true);
        };
        if attack.is_driven() && onset.is_at_the_end(clean) {
            self.at_the_end = true;
            return Ok(false);
        }
        self.targets.push(Some(Target { before: self.target }));
        let mut attacked = clean.clone();
        self.target = apply(&mut attacked, attack, onset, self.target);
        if attacked != *clean {
            self.first_s = if self.changed == 0 { at_s } else { self.first_s };
            self.changed += 1;
        }
        if attack.is_driven() && self.meeting.is_none() {
            self.meeting = meeting::note(&attacked, clean, at_s);
        }
        Ok(true)
    }

    fn end(self) -> Result<(Course, Onset), InjectError> {
        let Self { injection, targets, changed, first_s, .. } = self;
        let onset = self.onset.filter(|_| changed > 0);
        let onset = onset.ok_or_else(|| self.span.unchanged(injection))?;
        let mut notes = vec![format!(
            "attack {injection} s changes {changed} cycles, the first at {first_s:.1} s"
        )];
        if injection.attack.is_driven() {
            notes.push(String::from(
                "from its first attacked cycle on the CAV drives what it is sent; the drive ends with \
                 the attack",
            ));
            if self.at_the_end {
                notes.push(String::from(
                    "the drive ends where the CAV has come to the end of the road that is known",
                ));
            }
            notes.extend(self.meeting);
        }
        Ok((Course { targets, notes }, onset))
    }
}

impl Span {
    /// Why the attack changed no cycle.
    fn unchanged(&self, injection: Injection) -> InjectError {
        match self.first {
            None => InjectError::Outside { injection, end_s: self.end_s },
            Some(configuration) if !self.is_remote => {
                InjectError::Local { injection, configuration }
            }
            Some(_) => InjectError::Unchanged { injection },
        }
    }
}
