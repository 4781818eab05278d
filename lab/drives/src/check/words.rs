//! Verdicts and witnesses in words.

use std::cmp::Ordering;

use mufasa_model::report::{FailedStage, InvalidInput, Report, Rule, Stage, Witness};
use mufasa_props::conformance::{Answer, name};

use crate::seconds;

/// Number and subject of a stage, such as `iii tracks`.
pub fn stage(stage: Stage) -> &'static str {
    match stage {
        Stage::I => "i    track validation",
        Stage::Ii => "ii   map",
        Stage::Iii => "iii  tracks",
        Stage::Iv => "iv   detections",
        Stage::V => "v    grid",
    }
}

/// A failing stage for a sentence, such as `stage iii`.
pub fn failed_stage(failed: FailedStage) -> String {
    match failed {
        FailedStage::Input => "input".to_owned(),
        FailedStage::Stage(_) => format!("stage {}", name(Some(failed))),
        FailedStage::NoObstacleCheck => "no obstacle check (H-05)".to_owned(),
    }
}

/// Why a cycle is not safe: `stage iii, point 4 meets track 7 (4.1 m < 5 m)`; `safe` otherwise.
pub fn answer(answer: &Answer) -> String {
    match answer {
        Ok(report) => report_in_words(report),
        Err(problem) => format!("invalid local input: {}", invalid(problem)),
    }
}

/// A problem of the input: field, index, what is wrong.
pub fn invalid(problem: &InvalidInput) -> String {
    let InvalidInput { field, index, message } = problem;
    match index {
        Some(index) => format!("{field}[{index}]: {message}"),
        None => format!("{field}: {message}"),
    }
}

fn report_in_words(report: &Report) -> String {
    let Some(failed) = report.failed_stage else { return "safe".to_owned() };
    let place = failed_stage(failed);
    match (failed, &report.input, report.witness()) {
        (FailedStage::Input, Some(problem), _) => {
            format!("invalid remote input: {}", invalid(problem))
        }
        (FailedStage::NoObstacleCheck, _, _) => {
            format!("{place}: nothing compared the trajectory with obstacles")
        }
        (_, _, Some(found)) => format!("{place}, {}", witness(found)),
        (FailedStage::Input | FailedStage::Stage(_), _, None) => place,
    }
}

/// A witness in words, with the two numbers compared; a reader sees that the relation holds, also where it
/// is between numbers that are the same double.
pub fn witness(witness: &Witness) -> String {
    let (what, unit, relation) = phrase(witness);
    let equal = witness.compared[0].partial_cmp(&witness.compared[1]) == Some(Ordering::Equal);
    let [left, right] = numbers(witness.compared).map(|number| with_unit(&number, unit));
    match relation {
        "<" if equal => format!("{what} (below {right} by less than doubles tell apart)"),
        ">" if equal => format!("{what} (above {right} by less than doubles tell apart)"),
        _ => format!("{what} ({left} {relation} {right})"),
    }
}

/// A witness of a reading with a margin in words: the two numbers without a relation, which holds with the
/// margin alone.
pub fn witness_with_margin(witness: &Witness) -> String {
    let (what, unit, _) = phrase(witness);
    let [left, right] = numbers(witness.compared).map(|number| with_unit(&number, unit));
    format!("{what} ({left} against {right})")
}

/// What happened, the unit of the numbers compared, and how they compare.
fn phrase(witness: &Witness) -> (String, &'static str, &'static str) {
    let point = witness.point.map_or("the trajectory".to_owned(), |index| format!("point {index}"));
    let object = match (witness.track, witness.detection) {
        (Some(id), _) => format!("track {id}"),
        (None, Some(index)) => format!("detection {index}"),
        (None, None) => "an object".to_owned(),
    };
    let disk = witness.disk.map_or("a disk".to_owned(), |index| format!("disk {index}"));
    let cell = match witness.cell {
        Some((column, row)) => format!("cell ({column}, {row})"),
        None => "a cell".to_owned(),
    };
    match witness.rule {
        Rule::Ambiguous => ("what the CAV saw itself is too close to call".to_owned(), "", "~"),
        Rule::MeanCost => ("mean distance of the assigned pairs".to_owned(), "m", ">="),
        Rule::WorkLimit => ("work of the stage".to_owned(), "", ">"),
        Rule::NoAssignment => {
            ("tracks that can be paired below theta_track_max".to_owned(), "", "<")
        }
        Rule::ThetaMap => {
            (format!("{point} outside the corridor and off the reference path"), "m", ">")
        }
        Rule::StartTime => ("time of the first point is far from now".to_owned(), "s", ">"),
        Rule::Position => {
            (format!("{point} farther from the CAV than it can drive by then"), "m", ">")
        }
        // Of the two bounds of this rule the first is 0.
        Rule::StartHeading if witness.compared[1] == 0.0 => {
            ("first heading is against the CAV's, by their dot product".to_owned(), "", "<=")
        }
        Rule::StartHeading => {
            ("first heading is not the CAV's, by their cross product".to_owned(), "", ">")
        }
        Rule::StartOffset => ("trajectory passes aside of the CAV".to_owned(), "m", ">"),
        Rule::Corridor => {
            (format!("{point} outside the corridor, off the reference path"), "m", ">")
        }
        Rule::Direction => (format!("{point} heads against the route"), "", "<"),
        Rule::StepTime => (format!("step to {point} takes too long"), "s", ">"),
        Rule::StepLength => (format!("step to {point} is longer than the CAV"), "m", ">"),
        Rule::StepSpeed => (format!("step to {point} is faster than v_max"), "m", ">"),
        Rule::StepForward => (format!("step to {point} goes backwards"), "", "<"),
        Rule::StepLateral => (format!("step to {point} goes sideways"), "m", ">"),
        // Of the two bounds of this rule only the first is below its limit.
        Rule::StepTurn if witness.compared[0] < witness.compared[1] => (
            format!("heading turns by more than 30 degrees at {point}, by the dot product"),
            "",
            "<",
        ),
        Rule::StepTurn => (
            format!("heading turns more than the step allows at {point}, by the cross product"),
            "",
            ">",
        ),
        Rule::Slide => (format!("{point} is beside where the headings lead"), "m", ">"),
        // Of the bounds of this rule only those of a heading and of a distance are least ones.
        Rule::Reach if witness.compared[0] < witness.compared[1] => {
            (format!("{point} leads back to the CAV, or its heading does"), "", "<")
        }
        Rule::Reach => (format!("{point} is beyond reach of the CAV, or leads back"), "m", ">"),
        Rule::Gap => ("gap to the leading vehicle".to_owned(), "m", "<="),
        Rule::Collision => (format!("{point} meets {object}"), "m", "<"),
        Rule::FailSafe => {
            let since = witness.item.zip(witness.age_ns).map_or(String::new(), |(item, age_ns)| {
                format!(", as it moved since item {item} of {:.1} s ago,", seconds(0, age_ns))
            });
            (format!("{object}{since} may be met before the CAV stands, on its way"), "m", "<=")
        }
        Rule::Occupied => (format!("{disk} of {point} touches occupied {cell}"), "m", "<="),
        Rule::Unknown => (format!("{disk} of {point} touches unknown {cell}"), "m", "<="),
        Rule::Outside => (format!("{disk} of {point} leaves the grid"), "m", "<="),
    }
}

fn with_unit(number: &str, unit: &str) -> String {
    if unit.is_empty() { number.to_owned() } else { format!("{number} {unit}") }
}

/// Two numbers with as few decimals as tell them apart, at least two.
fn numbers([left, right]: [f64; 2]) -> [String; 2] {
    let at = |decimals: usize| [left, right].map(|v| trimmed(&format!("{v:.decimals$}")));
    let differ = |pair: &[String; 2]| pair[0] != pair[1];
    // Equal numbers never differ; doubles that do, do so at the latest in `to_string`.
    let equal = left.partial_cmp(&right) == Some(Ordering::Equal);
    let most = if equal { 2 } else { 12 };
    (2..=most)
        .map(at)
        .find(|pair| equal || differ(pair))
        .unwrap_or_else(|| [left, right].map(|v| v.to_string()))
}

fn trimmed(number: &str) -> String {
    if !number.contains('.') {
        return number.to_owned();
    }
    let short = number.trim_end_matches('0').trim_end_matches('.');
    if short == "-0" { "0".to_owned() } else { short.to_owned() }
}

#[cfg(test)]
mod tests {
    use mufasa_model::numbers::real::Real;

    use super::*;

    #[test]
    fn numbers_are_short_but_told_apart() {
        assert_eq!(numbers([4.1, 5.0]), ["4.1", "5"]);
        assert_eq!(numbers([0.200_001, 0.2]), ["0.200001", "0.2"]);
        assert_eq!(numbers([-0.000_1, 0.0]), ["-0.0001", "0"]);
        assert_eq!(numbers([100.0, 20.0]), ["100", "20"]);
        assert_eq!(numbers([f64::NAN, 1.0]), ["NaN", "1"]);
    }

    #[test]
    fn a_collision_names_point_track_and_numbers() {
        let [four, five] = [4.1, 5.0].map(Real::from_double);
        let collision = Witness::new(Rule::Collision, &four, &five).at_point(4);
        let found = Witness { track: Some(7), ..collision };
        assert_eq!(witness(&found), "point 4 meets track 7 (4.1 m < 5 m)");
        // With a margin of 1 m a distance of 5.5 m counts as near.
        let near = Witness { compared: [5.5, 5.0], ..found.clone() };
        assert_eq!(witness_with_margin(&near), "point 4 meets track 7 (5.5 m against 5 m)");
        let moving = Witness {
            rule: Rule::FailSafe,
            track: None,
            detection: Some(2),
            item: Some(0),
            age_ns: Some(500_000_000),
            ..found
        };
        let words = "detection 2, as it moved since item 0 of 0.5 s ago, may be met before the CAV stands, on its way";
        assert_eq!(witness(&moving), format!("{words} (4.1 m <= 5 m)"));
    }
}
