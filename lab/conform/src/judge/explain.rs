//! A disagreement in words: what the program answered, what is right, and the two numbers that
//! decide.

use mufasa_model::cycle::check;
use mufasa_model::input::cycle::Cycle;
use mufasa_model::report::{FailedStage, Outcome, Reading, Report, Rule, Witness};
use mufasa_props::conformance::{Answer, name};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::cases::question::Question;
use crate::judge::answer::{self, Said};
use crate::judge::class::Breach;
use crate::judge::examine::{Examined, Expected, index, is_within};
use crate::judge::states::States;
use crate::subject::Broken;
use mufasa_drives::check::words;
use mufasa_records::answer::decimal;
use mufasa_records::names;

/// Margins that are tried, m: those of the domain of `delta`.
const MARGINS_M: [f64; 7] = [1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2];

/// Numbers that are farther apart than so many times the margin that changes the verdict do not decide
/// it: of all that is compared with a bound, each moves by the margin, twice at most.
const FAR: f64 = 8.0;

/// Most characters of an expected answer that are shown.
const MOST: usize = 600;

/// The line that came back, or what came instead.
type Answered = Result<Vec<u8>, Broken>;

/// What is told of a disagreement.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Told {
    /// What came back.
    pub answered: String,
    /// What the exact model says.
    pub expected: String,
    /// What decides.
    pub numbers: Option<Numbers>,
}

/// The two numbers that decide, as the model compares them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Numbers {
    /// The comparison in words.
    pub what: String,
    /// Its left side.
    pub left: String,
    /// Its right side.
    pub right: String,
    /// How far they are apart.
    pub margin: String,
}

/// A disagreement in words.
pub fn in_words(question: &Question, examined: &Examined) -> Told {
    let answered = match &examined.answered {
        Ok(line) => answer::in_short(line),
        Err(broken) => broken.words.clone(),
    };
    let breach = examined.class.as_ref().map(|class| class.breach);
    match (question, &examined.expected) {
        (Question::Cycle(cycle), Expected::Cycle(exact)) => {
            let broken = breach.is_none_or(Breach::is_broken);
            let numbers = if broken { None } else { decide(cycle, exact, &examined.answered) };
            Told { answered, expected: verdict(exact, &examined.answered), numbers }
        }
        (_, Expected::States(Ok(expected))) => match first_difference(expected, &examined.answered)
        {
            Some((expected, numbers)) => Told { answered, expected, numbers: Some(numbers) },
            None => Told { answered, expected: shown(&expected.list), numbers: None },
        },
        (_, Expected::Composition(Ok(expected))) => {
            Told { answered, expected: shown(expected), numbers: None }
        }
        (_, Expected::States(Err(problem)) | Expected::Composition(Err(problem))) => {
            let expected = format!("error: {}", words::invalid(problem));
            Told { answered, expected, numbers: None }
        }
        (_, Expected::Line(Some(error))) => {
            let place = match error.index {
                Some(index) => format!("field {:?}, index {index}", error.field),
                None => format!("field {:?}", error.field),
            };
            let expected = format!("error: {place}: {}", error.message);
            Told { answered, expected, numbers: None }
        }
        // `expect` answers in kind.
        (_, _) => Told { answered, expected: String::new(), numbers: None },
    }
}

/// The program's verdict, if it gave one.
fn answer_of(answered: &Answered) -> Option<Said> {
    let object = serde_json::from_slice(answered.as_ref().ok()?).ok()?;
    answer::said(&object).ok()
}

/// The stage at which the program fails, if it does.
fn said(answered: &Answered) -> Option<FailedStage> {
    match answer_of(answered)? {
        Said::Verdict(failed) => failed,
        Said::Error => None,
    }
}

/// The exact answer, and what became of the stage at which the program fails.
fn verdict(exact: &Answer, answered: &Answered) -> String {
    let text = match exact {
        Ok(report) if report.failed_stage.is_some() => format!("unsafe: {}", words::answer(exact)),
        Ok(_) => String::from("safe"),
        Err(_) => format!("error: {}", words::answer(exact)),
    };
    match (exact, said(answered)) {
        (Ok(report), Some(FailedStage::Stage(stage)))
            if report.failed_stage != Some(FailedStage::Stage(stage)) =>
        {
            let outcome = match &report.stages[index(stage)] {
                Outcome::Passed => String::from("passed"),
                Outcome::Failed(_) => String::from("failed"),
                Outcome::Skipped(reason) => format!("skipped ({})", names::reason(*reason)),
                Outcome::NotApplicable(input) => {
                    format!("not applicable (no current {})", names::input(*input))
                }
                Outcome::NotScheduled => String::from("not scheduled"),
            };
            format!("{text}; stage {} {outcome}", names::stage(stage))
        }
        (_, _) => text,
    }
}

/// The comparison that decides: that of the exact model's witness, or where it passes the one that a
/// growing margin first makes fail; none where the edge of the field of view or of the corridor may be what decides.
fn decide(cycle: &Cycle, exact: &Answer, answered: &Answered) -> Option<Numbers> {
    let report = exact.as_ref().ok()?;
    let answer = answer_of(answered)?;
    let Said::Verdict(said) = answer else { return None };
    let told = match report.witness() {
        Some(witness) => {
            // A witness compares two numbers of several: the centres, not the sides, of rectangles.
            let near = MARGINS_M.into_iter().find(|it| is_within(cycle, answer, *it));
            Some((witness.clone(), near, words::witness(witness)))
        }
        None => MARGINS_M.into_iter().find_map(|margin| strictly(cycle, margin, said?)),
    };
    let (witness, near, what) = told?;
    let apart = (witness.compared[0] - witness.compared[1]).abs();
    let hides = near.is_some_and(|near| apart > FAR * near);
    if hides && is_behind_an_edge(witness.rule) {
        return None;
    }
    let [left, right] = witness.compared.map(decimal);
    let margin = match (near, report.failed_stage) {
        (Some(near), None) => format!("at most {near}"),
        (Some(near), Some(_)) => format!("at most {near}: with it the model could answer the same"),
        (None, _) => decimal(apart),
    };
    Some(Numbers { what, left, right, margin })
}

/// Whether an edge of the field of view or of the corridor may decide in place of the numbers of a
/// witness of this rule.
fn is_behind_an_edge(rule: Rule) -> bool {
    matches!(rule, Rule::MeanCost | Rule::NoAssignment | Rule::ThetaMap | Rule::Corridor)
}

/// The witness of the stage at which the cycle fails with this margin, if it is this stage; the
/// margin, and the witness in words.
fn strictly(
    cycle: &Cycle,
    margin_m: f64,
    stage: FailedStage,
) -> Option<(Witness, Option<f64>, String)> {
    let mut cycle = cycle.clone();
    cycle.parameters.delta = margin_m;
    let report: Report = check(&cycle, Reading::Strict).ok()?;
    if report.failed_stage != Some(stage) {
        return None;
    }
    let witness = report.witness()?;
    let what = format!(
        "passes; with a margin of {margin_m} m it would fail at {}: {}",
        name(Some(stage)),
        words::witness_with_margin(witness)
    );
    Some((witness.clone(), Some(margin_m), what))
}

/// The first state that differs: what it must be, and both values.
fn first_difference(expected: &States, answered: &Answered) -> Option<(String, Numbers)> {
    let object: Value = serde_json::from_slice(answered.as_ref().ok()?).ok()?;
    let difference = expected.first_difference(object.get("states")?.as_array()?)?;
    let (what, wanted, found) = (difference.place(), difference.wanted, difference.found);
    let left = found.as_ref().map_or_else(|| String::from("missing"), ToString::to_string);
    let right = wanted.to_string();
    let told = format!("{what} must be {right}, is {left}");
    let apart = |it: Value| Some((i128::from(it.as_i64()?) - i128::from(wanted.as_i64()?)).abs());
    let margin = found.and_then(apart).map_or_else(String::new, |it| it.to_string());
    Some((told, Numbers { what, left, right, margin }))
}

fn shown(answer: &impl Serialize) -> String {
    let text = serde_json::to_string(answer).unwrap_or_default();
    let short: String = text.chars().take(MOST).collect();
    if short.len() < text.len() { short + "..." } else { short }
}
