//! What was found as JSON Lines: one record per cycle, one per drive, one at the end.

use mufasa_model::report::{InvalidInput, Report, Stage};
use mufasa_props::conformance::Answer;
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::Value;

use super::checked::Checked;
use super::fallback::{Hold, RequesterRun};
use super::judge::Judged;
use super::tally::Tally;
use super::{Findings, words};
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
    notes: &'a [String],
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
    fallbacks: Vec<FallbackRecord>,
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

/// The records of a drive, each on a line: its cycles, then the drive.
pub fn lines(checked: &Checked) -> serde_json::Result<Vec<String>> {
    let mut lines = Vec::new();
    for (index, (judged, cycle)) in checked.judged.iter().zip(&checked.steps).enumerate() {
        lines.push(serde_json::to_string(&CycleRecord {
            kind: "checked_cycle",
            drive: &checked.drive.name,
            seconds: checked.seconds(index),
            answer: model_answer(&cycle.id, judged),
            implementation: implementation_answer(&judged.implementation),
            alone: judged.alone.iter().copied().map(names::stage).collect(),
            disagreement: judged.disagreement.as_ref().map(ToString::to_string),
        })?);
    }
    let [model, implementation] = checked.tallies();
    let [model_course, implementation_course] = &checked.requesters;
    lines.push(serde_json::to_string(&DriveRecord {
        kind: "checked_drive",
        drive: &checked.drive.name,
        source: &checked.drive.source,
        setting: checked.setting(),
        notes: &checked.drive.notes,
        model: side(checked, &model, model_course, |judged| &judged.model),
        implementation: side(checked, &implementation, implementation_course, |judged| {
            &judged.implementation
        }),
        disagreements: checked.disagreements(),
        protocol: checked.protocol.as_deref(),
    })?);
    Ok(lines)
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

fn side(
    checked: &Checked,
    tally: &Tally,
    run: &RequesterRun,
    answer: impl Fn(&Judged) -> &Answer,
) -> SideRecord {
    let stages = Stage::ALL.into_iter().zip(&tally.stages).map(|(stage, count)| StageRecord {
        stage: names::stage(stage),
        passed: count.passed,
        failed: count.failed,
        skipped: count.skipped,
        not_applicable: count.not_applicable,
        not_scheduled: count.not_scheduled,
    });
    let fallbacks = run.unsafe_cycles.iter().map(|cycle| {
        let (hold, hold_until_ns) = match cycle.hold {
            Hold::Started { until_ns } => ("started", Some(until_ns)),
            Hold::Running => ("running", None),
            Hold::Off => ("off", None),
        };
        FallbackRecord {
            id: checked.steps[cycle.index].id.clone(),
            seconds: checked.seconds(cycle.index),
            hold,
            hold_until_ns,
            why: words::answer(answer(&checked.judged[cycle.index])),
        }
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
        fallbacks: fallbacks.collect(),
    }
}
