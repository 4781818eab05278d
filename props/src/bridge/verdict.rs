//! Verdicts from the implementation's types to the model's, and back.

use mufasa::report as twin;
use mufasa_model::report::{
    FailedStage, Input, InvalidInput, Outcome, Reason, Report, Rule, Stage, Witness,
};

/// A report in the model's types.
pub fn report_from_impl(report: &twin::Report) -> Report {
    let twin::Report { failed_stage, stages, input } = *report;
    Report {
        failed_stage: failed_stage.map(failed_stage_from_impl),
        stages: stages.map(outcome_from_impl),
        input: input.as_ref().map(invalid_input_from_impl),
    }
}

/// A problem in the model's types; the message is the implementation's.
pub fn invalid_input_from_impl(problem: &twin::InvalidInput) -> InvalidInput {
    let twin::InvalidInput { field, index, problem } = *problem;
    InvalidInput { field: field.to_owned(), index, message: problem.message().to_owned() }
}

/// A report in the implementation's types, if it is one of valid input: a problem has words of its own there.
pub fn report_to_impl(report: &Report) -> Option<twin::Report> {
    let Report { failed_stage, stages, input: None } = report else { return None };
    let failed_stage = failed_stage.map(failed_stage_to_impl);
    Some(twin::Report { failed_stage, stages: stages.clone().map(outcome_to_impl), input: None })
}

pub(super) fn witness_from_impl(witness: twin::Witness) -> Witness {
    let twin::Witness {
        rule,
        point,
        track,
        detection,
        item,
        age_ns,
        segment,
        disk,
        cell,
        compared,
    } = witness;
    let rule = rule_from_impl(rule);
    Witness { rule, point, track, detection, item, age_ns, segment, disk, cell, compared }
}

#[expect(clippy::needless_pass_by_value, reason = "the outcome that held it is taken apart")]
fn witness_to_impl(witness: Witness) -> twin::Witness {
    let Witness { rule, point, track, detection, item, age_ns, segment, disk, cell, compared } =
        witness;
    let rule = rule_to_impl(rule);
    twin::Witness { rule, point, track, detection, item, age_ns, segment, disk, cell, compared }
}

both_ways! {
    pub(super) fn failed_stage_from_impl(twin::FailedStage), fn failed_stage_to_impl(FailedStage) {
        Input,
        Stage(stage: stage_from_impl, stage_to_impl),
        NoObstacleCheck,
    }

    fn stage_from_impl(twin::Stage),
    /// A stage in the implementation's types.
    pub fn stage_to_impl(Stage) { I, Ii, Iii, Iv, V, }

    /// An outcome in the model's types.
    pub fn outcome_from_impl(twin::Outcome), fn outcome_to_impl(Outcome) {
        Passed,
        Failed(witness: witness_from_impl, witness_to_impl),
        Skipped(reason: reason_from_impl, reason_to_impl),
        NotApplicable(input: input_from_impl, input_to_impl),
        NotScheduled,
    }

    fn reason_from_impl(twin::Reason), fn reason_to_impl(Reason) {
        AfterFailure,
        OtherStageRan,
        NoCurrent(input: input_from_impl, input_to_impl),
    }

    fn input_from_impl(twin::Input), fn input_to_impl(Input) { Trajectory, Tracks, Detections, Grid, }
}

macro_rules! same_rules {
    ($($(#[$doc:meta])* $name:ident = $word:literal;)*) => { both_ways! {
        fn rule_from_impl(twin::Rule), fn rule_to_impl(Rule) { $($name,)* }
    } };
}

mufasa_model::witness_rules!(same_rules);
