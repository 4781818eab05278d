//! What was found as JSON Lines: one record per cycle, one per drive, one at the end.

use std::io::{self, Write};

use mufasa_model::report::{InvalidInput, Report, Stage};
use mufasa_props::conformance::Answer;
use schemars::JsonSchema;
use serde::ser::{Error, SerializeSeq};
use serde::{Serialize, Serializer};
use serde_json::Value;
use serde_json::value::RawValue;

use super::checked::{Checked, Seen};
use super::fallback::{Hold, RequesterRun};
use super::findings::Findings;
use super::judge::Judged;
use super::tally::Tally;
use super::words;
use crate::drive::DriveCycle;
use crate::spool::Spool;
use mufasa_records::answer::CycleAnswer;
use mufasa_records::{names, schema};

/// A cycle of a drive.
#[derive(Serialize, JsonSchema)]
struct CycleRecord<'a> {
    #[schemars(extend("const" = "checked_cycle"))]
    kind: &'static str,
    drive: &'a str,
    seconds: f64,
    answer: ModelAnswer,
    implementation: ImplementationAnswer,
    /// The stages that fail when each is run on its own.
    alone: Vec<&'static str>,
    disagreement: Option<String>,
}

/// The oracle's answer, or invalid local input.
#[derive(Serialize, JsonSchema)]
#[serde(untagged)]
enum ModelAnswer {
    Report(Box<CycleAnswer>),
    Error(ErrorAnswer),
}

#[derive(Serialize, JsonSchema)]
struct ErrorAnswer {
    id: String,
    verdict: &'static str,
    failed_stage: Option<&'static str>,
    error: Problem,
}

#[derive(Serialize, JsonSchema)]
struct Problem {
    field: String,
    index: Option<usize>,
    message: String,
}

#[derive(Serialize, JsonSchema)]
struct ImplementationAnswer {
    verdict: &'static str,
    failed_stage: Option<&'static str>,
}

/// A drive.
#[derive(Serialize, JsonSchema)]
struct DriveRecord<'a> {
    #[schemars(extend("const" = "checked_drive"))]
    kind: &'static str,
    drive: &'a str,
    source: &'a str,
    setting: String,
    notes: Vec<&'a str>,
    model: SideRecord,
    implementation: SideRecord,
    disagreements: usize,
    protocol: Option<&'a str>,
}

#[derive(Serialize, JsonSchema)]
struct SideRecord {
    cycles: usize,
    safe: usize,
    r#unsafe: usize,
    errors: usize,
    input: usize,
    no_obstacle_check: usize,
    stages: Vec<StageRecord>,
    offloaded: usize,
    late: usize,
    silent: usize,
    #[schemars(with = "Vec<FallbackRecord>")]
    fallbacks: Kept,
}

#[derive(Serialize, JsonSchema)]
struct StageRecord {
    stage: &'static str,
    passed: usize,
    failed: usize,
    skipped: usize,
    not_applicable: usize,
    not_scheduled: usize,
}

#[derive(Serialize, JsonSchema)]
struct FallbackRecord {
    id: String,
    seconds: f64,
    hold: &'static str,
    hold_until_ns: Option<i64>,
    why: String,
}

/// The last record of a run.
#[derive(Serialize, JsonSchema)]
struct LastRecord {
    #[schemars(extend("const" = "checked"))]
    kind: &'static str,
    drives: usize,
    unreadable: usize,
    cycles: usize,
    r#unsafe: usize,
    errors: usize,
    disagreements: usize,
    offloaded: usize,
    lost: usize,
}

/// The schemas of these records by the stem of their file's name.
pub fn schemas() -> [(&'static str, Value); 3] {
    [
        ("checked-cycle", schema::written::<CycleRecord<'_>>()),
        ("checked-drive", schema::written::<DriveRecord<'_>>()),
        ("checked", schema::written::<LastRecord>()),
    ]
}

/// The records of a drive, kept while its cycles are judged.
#[derive(Default)]
pub struct Records {
    cycles: Spool,
    /// Of the model and of the implementation.
    fallbacks: [Spool; 2],
}

impl Records {
    /// Keeps the record of a cycle. Errors: there is no place for it.
    pub fn take(&mut self, drive: &str, seen: &Seen<'_>) -> io::Result<()> {
        let Seen { made: DriveCycle { id, .. }, judged, .. } = *seen;
        let record = CycleRecord {
            kind: "checked_cycle",
            drive,
            seconds: seen.seconds(),
            answer: model_answer(id, judged),
            implementation: implementation_answer(&judged.implementation),
            alone: judged.alone.iter().copied().map(names::stage).collect(),
            disagreement: judged.disagreement.as_ref().map(ToString::to_string),
        };
        self.cycles.keep(0, &serde_json::to_vec(&record)?)?;
        for (spool, (hold, answer)) in
            self.fallbacks.iter().zip(seen.holds.into_iter().zip(seen.answers()))
        {
            if let Some(hold) = hold {
                spool.keep(0, &serde_json::to_vec(&fallback(seen, hold, answer))?)?;
            }
        }
        Ok(())
    }

    /// Writes the records, each on a line: the cycles, then the drive. Errors: of writing, or what was
    /// kept cannot be read again.
    pub fn write(self, out: &mut impl Write, checked: &Checked) -> io::Result<()> {
        self.cycles.copy(out)?;
        let Checked { drive, tallies, requesters, .. } = checked;
        let [model, implementation] = self.fallbacks;
        let notes: Vec<_> = drive.notes.iter().chain(&checked.notes).map(String::as_str).collect();
        let record = DriveRecord {
            kind: "checked_drive",
            drive: &drive.name,
            source: &drive.source,
            setting: checked.setting(),
            notes,
            model: side(&tallies[0], &requesters[0], model),
            implementation: side(&tallies[1], &requesters[1], implementation),
            disagreements: checked.disagreements(),
            protocol: checked.protocol.as_deref(),
        };
        serde_json::to_writer(&mut *out, &record)?;
        writeln!(out)
    }
}

/// Records that were kept as they are written.
struct Kept(Spool);

impl Serialize for Kept {
    fn serialize<S: Serializer>(&self, json: S) -> Result<S::Ok, S::Error> {
        let mut list = json.serialize_seq(Some(self.0.count()))?;
        for index in 0..self.0.count() {
            let (_, line) = self.0.line(index).map_err(S::Error::custom)?;
            let record = serde_json::from_slice::<&RawValue>(&line);
            list.serialize_element(record.map_err(S::Error::custom)?)?;
        }
        list.end()
    }
}

/// The record at the end of a run.
pub fn last(findings: &Findings) -> serde_json::Result<String> {
    serde_json::to_string(&LastRecord {
        kind: "checked",
        drives: findings.drives,
        unreadable: findings.unreadable,
        cycles: findings.tally.cycles,
        r#unsafe: findings.tally.unsafe_cycles(),
        errors: findings.tally.errors,
        disagreements: findings.disagreements,
        offloaded: findings.offloaded,
        lost: findings.lost,
    })
}

fn model_answer(id: &str, judged: &Judged) -> ModelAnswer {
    match (&judged.model, &judged.readings) {
        (Ok(exact), Some([Ok(strict), Ok(lax)])) => report(id, exact, strict, lax),
        // Local input does not depend on the reading, so these are the errors; an exact report
        // beside the error of a reading would be a disagreement of its own.
        (Ok(exact), _) => report(id, exact, exact, exact),
        (Err(InvalidInput { field, index, message }), _) => ModelAnswer::Error(ErrorAnswer {
            id: id.to_owned(),
            verdict: "error",
            failed_stage: None,
            error: Problem { field: field.clone(), index: *index, message: message.clone() },
        }),
    }
}

fn report(id: &str, exact: &Report, strict: &Report, lax: &Report) -> ModelAnswer {
    ModelAnswer::Report(Box::new(CycleAnswer::new(id.to_owned(), exact.clone(), strict, lax)))
}

fn implementation_answer(answer: &Answer) -> ImplementationAnswer {
    match answer {
        Ok(report) => ImplementationAnswer {
            verdict: names::verdict(report.failed_stage.is_none()),
            failed_stage: report.failed_stage.map(names::failed_stage),
        },
        Err(_) => ImplementationAnswer { verdict: "error", failed_stage: None },
    }
}

fn fallback(seen: &Seen<'_>, hold: Hold, answer: &Answer) -> FallbackRecord {
    let (hold, hold_until_ns) = match hold {
        Hold::Started { until_ns } => ("started", Some(until_ns)),
        Hold::Running => ("running", None),
        Hold::Off => ("off", None),
    };
    let (id, seconds) = (seen.made.id.clone(), seen.seconds());
    FallbackRecord { id, seconds, hold, hold_until_ns, why: words::answer(answer) }
}

fn side(tally: &Tally, run: &RequesterRun, fallbacks: Spool) -> SideRecord {
    let stages = Stage::ALL.into_iter().zip(&tally.stages).map(|(stage, count)| StageRecord {
        stage: names::stage(stage),
        passed: count.passed,
        failed: count.failed,
        skipped: count.skipped,
        not_applicable: count.not_applicable,
        not_scheduled: count.not_scheduled,
    });
    SideRecord {
        cycles: tally.cycles,
        safe: tally.safe,
        r#unsafe: tally.unsafe_cycles(),
        errors: tally.errors,
        input: tally.input,
        no_obstacle_check: tally.no_obstacle_check,
        stages: stages.collect(),
        offloaded: run.offloaded,
        late: run.late,
        silent: run.silent,
        fallbacks: Kept(fallbacks),
    }
}
