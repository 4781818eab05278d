//! What was found on a drive, in words.

use std::collections::BTreeMap;
use std::io::{self, Write};

use mufasa_model::report::Stage;
use mufasa_props::conformance::{Answer, name, rank};
use mufasa_records::names;

use super::checked::{Breach, Checked, Seen};
use super::fallback::{Hold, RequesterRun};
use super::words;
use crate::check::table;
use crate::counted;
use crate::spool::Spool;

/// The report of a drive, put together while its cycles are judged.
#[derive(Default)]
pub struct Report {
    /// Of the model and of the implementation.
    courses: [Course; 2],
}

impl Report {
    /// Takes the next cycle. Errors: there is no place for what is to be written of it.
    pub fn take(&mut self, seen: &Seen<'_>) -> io::Result<()> {
        let both = seen.holds.into_iter().zip(seen.answers());
        for (course, (hold, answer)) in self.courses.iter_mut().zip(both) {
            if let Some(hold) = hold {
                course.take(seen, hold, answer)?;
            }
        }
        Ok(())
    }

    /// Writes the drive: its setting, the table by stage, the fallbacks, disagreements. Errors: of
    /// writing, or what was kept cannot be read again.
    pub fn write(mut self, out: &mut impl Write, checked: &Checked) -> io::Result<()> {
        let [model, implementation] = &checked.tallies;
        writeln!(out, "{} ({})", checked.drive.name, checked.drive.source)?;
        for note in &checked.drive.notes {
            writeln!(out, "  note: {note}")?;
        }
        let errors = if model.errors > 0 {
            format!(", {}", counted(model.errors, "error"))
        } else {
            String::new()
        };
        writeln!(
            out,
            "{}, {}: {} safe, {} unsafe{errors}",
            counted(model.cycles, "cycle"),
            checked.setting(),
            model.safe,
            model.unsafe_cycles()
        )?;
        if model.cycles == 0 {
            return writeln!(out);
        }
        write!(out, "{}", table::by_stage(model, implementation))?;
        write_alone(out, checked)?;
        let [of_model, of_implementation] = &mut self.courses;
        let [by_model, by_implementation] = &checked.requesters;
        if checked.alike {
            of_model.write(out, checked, by_model, "")?;
        } else {
            of_model.write(out, checked, by_model, " of the model")?;
            of_implementation.write(out, checked, by_implementation, " of the implementation")?;
        }
        for note in &checked.notes {
            writeln!(out, "  note: {note}")?;
        }
        write_disagreements(out, checked)?;
        writeln!(out)
    }
}

/// The line of a drive in the table over all drives.
pub fn line(checked: &Checked) -> table::Line {
    table::Line {
        name: checked.drive.name.clone(),
        tally: checked.tallies[0],
        fallbacks: checked.requesters[0].fallbacks,
        offloaded: checked.requesters[0].offloaded,
        otherwise: checked.otherwise,
        disagreements: checked.disagreements(),
    }
}

/// Which stages would have caught what was found, or what was not, had there been no other.
fn write_alone(out: &mut impl Write, checked: &Checked) -> io::Result<()> {
    let alone = checked.alone;
    if alone == [0; 5] {
        return Ok(());
    }
    let stages = Stage::ALL.into_iter().zip(alone);
    let words: Vec<_> =
        stages.map(|(stage, count)| format!("{} {count}", names::stage(stage))).collect();
    writeln!(out, "cycles in which a stage, run on its own, fails: {}", words.join(", "))
}

/// The unsafe cycles of a requester's course in lines; those in succession that did the same to the
/// waiting time, but start it, are one.
#[derive(Default)]
struct Course {
    lines: Spool,
    alike: Option<Alike>,
}

/// Unsafe cycles that did the same to the waiting time.
struct Alike {
    hold: Hold,
    count: usize,
    /// Times of the first and the last, s.
    from_to_s: [f64; 2],
    /// How many failed where.
    stages: BTreeMap<(u8, &'static str), usize>,
}

impl Course {
    fn take(&mut self, seen: &Seen<'_>, hold: Hold, answer: &Answer) -> io::Result<()> {
        let at_s = seen.seconds();
        if let Hold::Started { until_ns } = hold {
            self.close()?;
            let (what, until_s) = (words::answer(answer), seen.seconds_of(until_ns));
            let line = format!("  at {at_s:.1} s: {what}; all local, wait until {until_s:.1} s");
            return self.lines.keep(0, line.as_bytes());
        }
        if self.alike.as_ref().is_some_and(|alike| alike.hold != hold) {
            self.close()?;
        }
        let stages = BTreeMap::new();
        let none = Alike { hold, count: 0, from_to_s: [at_s; 2], stages };
        let alike = self.alike.get_or_insert(none);
        alike.count += 1;
        alike.from_to_s[1] = at_s;
        let place = match answer {
            Ok(report) => (rank(report.failed_stage), name(report.failed_stage)),
            Err(_) => (u8::MAX, "error"),
        };
        *alike.stages.entry(place).or_default() += 1;
        Ok(())
    }

    /// Writes the line of those that did the same.
    fn close(&mut self) -> io::Result<()> {
        let Some(Alike { hold, count, from_to_s: [from_s, to_s], stages }) = self.alike.take()
        else {
            return Ok(());
        };
        let why = if hold == Hold::Running { "during that wait" } else { "while all local" };
        let span = if count == 1 {
            format!("at {from_s:.1} s")
        } else {
            format!("{from_s:.1} s to {to_s:.1} s")
        };
        let stages: Vec<_> =
            stages.iter().map(|((_, name), count)| format!("{name} {count}")).collect();
        let line = format!("  {span}: {count} more unsafe {why} ({})", stages.join(", "));
        self.lines.keep(0, line.as_bytes())
    }

    fn write(
        &mut self,
        out: &mut impl Write,
        checked: &Checked,
        run: &RequesterRun,
        whose: &str,
    ) -> io::Result<()> {
        let cycles = counted(checked.tallies[0].cycles, "cycle");
        let (fallbacks, offloaded) = (run.fallbacks, run.offloaded);
        writeln!(out, "fallbacks{whose}: {fallbacks} ({offloaded} of {cycles} offloaded)")?;
        if run.late > 0 {
            let results = counted(run.late, "result");
            writeln!(
                out,
                "  {results} too late, of tracking and of planning each for itself: back to local \
                 without a wait"
            )?;
        }
        if run.silent > 0 {
            let times = counted(run.silent, "time");
            writeln!(
                out,
                "  silence longer than dt_max {times}, of tracking and of planning each for itself: \
                 back to local without a wait"
            )?;
        }
        self.close()?;
        self.lines.copy(out)
    }
}

fn write_disagreements(out: &mut impl Write, checked: &Checked) -> io::Result<()> {
    for Breach { id, disagreement, answers: [model, implementation] } in &checked.first_breaches {
        writeln!(out, "DISAGREEMENT in cycle {id}: {disagreement}")?;
        writeln!(out, "  model: {}", words::answer(model))?;
        writeln!(out, "  implementation: {}", words::answer(implementation))?;
    }
    let more = checked.breaches - checked.first_breaches.len();
    if more > 0 {
        writeln!(out, "and {more} more disagreements")?;
    }
    if let Some(protocol) = &checked.protocol {
        writeln!(out, "DISAGREEMENT: {protocol}")?;
    }
    Ok(())
}
