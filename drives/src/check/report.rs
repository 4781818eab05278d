//! What was found on a drive, in words.

use std::collections::BTreeMap;
use std::io::{self, Write};

use mufasa_model::report::{FailedStage, Stage};
use mufasa_props::conformance::{Answer, name};
use mufasa_records::names;

use super::checked::Checked;
use super::fallback::{Hold, RequesterRun, UnsafeCycle};
use super::words;
use crate::check::table;
use crate::counted;

/// Breaches of conformance that are written out.
const DISAGREEMENTS: usize = 10;

/// Writes a drive: its setting, the table by stage, the fallbacks, disagreements.
pub fn write(out: &mut impl Write, checked: &Checked) -> io::Result<()> {
    let [model, implementation] = checked.tallies();
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
    write!(out, "{}", table::by_stage(&model, &implementation))?;
    write_alone(out, checked)?;
    write_fallbacks(out, checked)?;
    write_disagreements(out, checked)?;
    writeln!(out)
}

/// The line of a drive in the table over all drives.
pub fn line(checked: &Checked) -> table::Line {
    let [tally, _] = checked.tallies();
    table::Line {
        name: checked.drive.name.clone(),
        tally,
        fallbacks: checked.requesters[0].fallbacks(),
        offloaded: checked.requesters[0].offloaded,
        otherwise: checked.otherwise(),
        disagreements: checked.disagreements(),
    }
}

/// Which stages would have caught what was found, or what was not, had there been no other.
fn write_alone(out: &mut impl Write, checked: &Checked) -> io::Result<()> {
    let alone = checked.alone();
    if alone == [0; 5] {
        return Ok(());
    }
    let stages = Stage::ALL.into_iter().zip(alone);
    let words: Vec<_> =
        stages.map(|(stage, count)| format!("{} {count}", names::stage(stage))).collect();
    writeln!(out, "cycles in which a stage, run on its own, fails: {}", words.join(", "))
}

fn write_fallbacks(out: &mut impl Write, checked: &Checked) -> io::Result<()> {
    let [model, implementation] = &checked.requesters;
    if model == implementation {
        return write_course(out, checked, model, "", |judged| &judged.model);
    }
    write_course(out, checked, model, " of the model", |judged| &judged.model)?;
    write_course(out, checked, implementation, " of the implementation", |judged| {
        &judged.implementation
    })
}

fn write_course(
    out: &mut impl Write,
    checked: &Checked,
    run: &RequesterRun,
    whose: &str,
    answer: impl Fn(&super::judge::Judged) -> &Answer,
) -> io::Result<()> {
    let words_of = |index: usize| words::answer(answer(&checked.judged[index]));
    writeln!(
        out,
        "fallbacks{whose}: {} ({} of {} offloaded)",
        run.fallbacks(),
        run.offloaded,
        counted(checked.judged.len(), "cycle")
    )?;
    if run.late > 0 {
        writeln!(
            out,
            "  data too late {}: back to local without a wait",
            counted(run.late, "time")
        )?;
    }
    if run.silent > 0 {
        let times = counted(run.silent, "time");
        writeln!(out, "  silence longer than dt_max {times}: back to local without a wait")?;
    }
    let mut rest = &run.unsafe_cycles[..];
    while let Some((first, after)) = rest.split_first() {
        let at = checked.seconds(first.index);
        if let Hold::Started { until_ns } = first.hold {
            let until = checked.seconds_of(until_ns);
            let what = words_of(first.index);
            writeln!(out, "  at {at:.1} s: {what}; all local, wait until {until:.1} s")?;
            rest = after;
            continue;
        }
        let alike = rest.iter().take_while(|cycle| cycle.hold == first.hold).count();
        let (alike, after) = rest.split_at(alike);
        let last = checked.seconds(alike[alike.len() - 1].index);
        let why = if first.hold == Hold::Running { "during that wait" } else { "while all local" };
        let span = if alike.len() == 1 {
            format!("at {at:.1} s")
        } else {
            format!("{at:.1} s to {last:.1} s")
        };
        let stages = by_stage(alike, |cycle| answer(&checked.judged[cycle.index]));
        writeln!(out, "  {span}: {} more unsafe {why} ({stages})", alike.len())?;
        rest = after;
    }
    Ok(())
}

/// How many of these cycles failed where: `ii 3, iii 20`.
fn by_stage<'a>(cycles: &[UnsafeCycle], answer: impl Fn(&UnsafeCycle) -> &'a Answer) -> String {
    let mut counts: BTreeMap<(u8, &str), usize> = BTreeMap::new();
    for cycle in cycles {
        let key = match answer(cycle) {
            Ok(report) => (rank(report.failed_stage), name(report.failed_stage)),
            Err(_) => (u8::MAX, "error"),
        };
        *counts.entry(key).or_default() += 1;
    }
    let words: Vec<_> = counts.iter().map(|((_, name), count)| format!("{name} {count}")).collect();
    words.join(", ")
}

fn rank(failed: Option<FailedStage>) -> u8 {
    mufasa_props::conformance::rank(failed)
}

fn write_disagreements(out: &mut impl Write, checked: &Checked) -> io::Result<()> {
    let breaches = checked
        .judged
        .iter()
        .enumerate()
        .filter_map(|(index, judged)| Some((index, judged, judged.disagreement.as_ref()?)));
    for (index, judged, breach) in breaches.clone().take(DISAGREEMENTS) {
        let id = &checked.steps[index].id;
        writeln!(out, "DISAGREEMENT in cycle {id}: {breach}")?;
        writeln!(out, "  model: {}", words::answer(&judged.model))?;
        writeln!(out, "  implementation: {}", words::answer(&judged.implementation))?;
    }
    let more = breaches.count().saturating_sub(DISAGREEMENTS);
    if more > 0 {
        writeln!(out, "and {more} more disagreements")?;
    }
    if let Some(protocol) = &checked.protocol {
        writeln!(out, "DISAGREEMENT: {protocol}")?;
    }
    Ok(())
}
