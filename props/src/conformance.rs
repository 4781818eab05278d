//! When an implementation conforms (`spec/4-arithmetic.md#conformance-of-an-implementation`).

use std::fmt;

use mufasa_model::report::{FailedStage, InvalidInput, Report, Stage};

/// What the exact model, the strict model or an implementation says about one cycle; `Err` is
/// invalid local input.
pub type Answer = Result<Report, InvalidInput>;

/// Where input is invalid: field and index, the normative part of a problem.
pub type Place = (String, Option<usize>);

/// A breach of conformance. A failed stage of `None` is the verdict safe.
#[derive(Clone, Debug, PartialEq)]
pub enum Disagreement {
    /// Soundness: the implementation accepts what the exact model rejects.
    UnsafeAccepted {
        /// Where the exact model fails.
        exact: FailedStage,
    },
    /// Completeness: the implementation rejects what the strict model accepts.
    SafeRejected {
        /// Where the implementation fails.
        implementation: FailedStage,
    },
    /// The failing stage lies outside the range from the strict to the exact model's.
    WrongStage {
        /// The strict model's.
        strict: Option<FailedStage>,
        /// The exact model's.
        exact: Option<FailedStage>,
        /// The implementation's.
        implementation: Option<FailedStage>,
    },
    /// One of the two reports invalid input and the other none, or another field or index.
    WrongInput {
        /// The exact model's field and index.
        exact: Option<Place>,
        /// The implementation's field and index.
        implementation: Option<Place>,
    },
    /// The strict model fails later than the exact one, or differs in errors: a fault of the
    /// model, not of the implementation.
    ModelUnordered {
        /// What is out of order.
        what: String,
    },
}

impl fmt::Display for Disagreement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnsafeAccepted { exact } => {
                write!(f, "unsound: accepts what the exact model rejects at {}", name(Some(*exact)))
            }
            Self::SafeRejected { implementation } => {
                let stage = name(Some(*implementation));
                write!(f, "incomplete: rejects at {stage} what the strict model accepts")
            }
            Self::WrongStage { strict, exact, implementation } => write!(
                f,
                "fails at {}, but must from {} (strict) to {} (exact)",
                name(*implementation),
                name(*strict),
                name(*exact)
            ),
            Self::WrongInput { exact, implementation } => {
                write!(f, "invalid input: expected {exact:?}, found {implementation:?}")
            }
            Self::ModelUnordered { what } => write!(f, "the model contradicts itself: {what}"),
        }
    }
}

impl std::error::Error for Disagreement {}

/// Compares the answer of an implementation with the exact and the strict model's
/// (`spec/4-arithmetic.md#conformance-of-an-implementation`): soundness, completeness, failing
/// stage, and field and index of invalid input. Witnesses and messages are not compared, and nothing
/// where the model has too much to compute.
pub fn conforms(
    exact: &Answer,
    strict: &Answer,
    implementation: &Answer,
) -> Result<(), Disagreement> {
    if [exact, strict].into_iter().any(is_too_much) {
        return Ok(());
    }
    if place(problem(exact)) != place(problem(strict)) || exact.is_err() != strict.is_err() {
        let what = format!("exact input {:?}, strict {:?}", problem(exact), problem(strict));
        return Err(Disagreement::ModelUnordered { what });
    }
    if exact.is_err() != implementation.is_err()
        || place(problem(exact)) != place(problem(implementation))
    {
        return Err(Disagreement::WrongInput {
            exact: owned(exact),
            implementation: owned(implementation),
        });
    }
    match (exact, strict, implementation) {
        (Ok(exact), Ok(strict), Ok(implementation)) => {
            stage_conforms(exact.failed_stage, strict.failed_stage, implementation.failed_stage)
        }
        // Errors have been compared above.
        (Err(_), _, _) | (_, Err(_), _) | (_, _, Err(_)) => Ok(()),
    }
}

/// Whether the model did not answer since the cycle needs more than 10^10 comparisons: no answer of
/// an implementation is right or wrong then.
pub fn is_too_much(answer: &Answer) -> bool {
    problem(answer).is_some_and(|problem| problem.field == "work")
}

/// The same rule for failing stages alone, `None` being safe: all that a program under test has
/// to answer (`spec/5-interfaces.md#programs-under-test`).
pub fn stage_conforms(
    exact: Option<FailedStage>,
    strict: Option<FailedStage>,
    implementation: Option<FailedStage>,
) -> Result<(), Disagreement> {
    if rank(strict) > rank(exact) {
        let what = format!("strict fails at {}, exact at {}", name(strict), name(exact));
        return Err(Disagreement::ModelUnordered { what });
    }
    if let (Some(exact), None) = (exact, implementation) {
        return Err(Disagreement::UnsafeAccepted { exact });
    }
    if let (None, Some(implementation)) = (strict, implementation) {
        return Err(Disagreement::SafeRejected { implementation });
    }
    if !(rank(strict)..=rank(exact)).contains(&rank(implementation)) {
        return Err(Disagreement::WrongStage { strict, exact, implementation });
    }
    Ok(())
}

/// Position in the order in which a cycle is decided: input, i to v, `no_obstacle_check`, safe.
/// The strict model rejects at least what the exact one does, so it never fails later; safe
/// stands last, because a cycle is safe when everything before it was passed.
pub fn rank(failed_stage: Option<FailedStage>) -> u8 {
    match failed_stage {
        Some(FailedStage::Input) => 0,
        Some(FailedStage::Stage(Stage::I)) => 1,
        Some(FailedStage::Stage(Stage::Ii)) => 2,
        Some(FailedStage::Stage(Stage::Iii)) => 3,
        Some(FailedStage::Stage(Stage::Iv)) => 4,
        Some(FailedStage::Stage(Stage::V)) => 5,
        Some(FailedStage::NoObstacleCheck) => 6,
        None => 7,
    }
}

/// Name of a failing stage as in the records; `safe` for none.
pub fn name(failed_stage: Option<FailedStage>) -> &'static str {
    match failed_stage {
        Some(FailedStage::Input) => "input",
        Some(FailedStage::Stage(Stage::I)) => "i",
        Some(FailedStage::Stage(Stage::Ii)) => "ii",
        Some(FailedStage::Stage(Stage::Iii)) => "iii",
        Some(FailedStage::Stage(Stage::Iv)) => "iv",
        Some(FailedStage::Stage(Stage::V)) => "v",
        Some(FailedStage::NoObstacleCheck) => "no_obstacle_check",
        None => "safe",
    }
}

/// The problem in the input, local or remote.
fn problem(answer: &Answer) -> Option<&InvalidInput> {
    match answer {
        Ok(report) => report.input.as_ref(),
        Err(problem) => Some(problem),
    }
}

/// Field and index, the part of a problem that is normative.
fn place(problem: Option<&InvalidInput>) -> Option<(&str, Option<usize>)> {
    problem.map(|problem| (problem.field.as_str(), problem.index))
}

/// The place for a report.
fn owned(answer: &Answer) -> Option<Place> {
    place(problem(answer)).map(|(field, index)| (field.to_owned(), index))
}

#[cfg(test)]
mod tests {
    use mufasa_model::report::{Outcome, Reason};

    use super::*;

    const STAGES: [Option<FailedStage>; 8] = [
        Some(FailedStage::Input),
        Some(FailedStage::Stage(Stage::I)),
        Some(FailedStage::Stage(Stage::Ii)),
        Some(FailedStage::Stage(Stage::Iii)),
        Some(FailedStage::Stage(Stage::Iv)),
        Some(FailedStage::Stage(Stage::V)),
        Some(FailedStage::NoObstacleCheck),
        None,
    ];

    fn report(failed_stage: Option<FailedStage>) -> Report {
        Report {
            failed_stage,
            stages: [const { Outcome::Skipped(Reason::AfterFailure) }; 5],
            input: None,
        }
    }

    fn problem(field: &str, index: Option<usize>) -> InvalidInput {
        InvalidInput { field: field.to_owned(), index, message: String::new() }
    }

    #[test]
    fn where_the_model_has_too_much_to_compute_nothing_is_compared() {
        let work = || Err(problem("work", None));
        let other = || Err(problem("ego.x", None));
        for implementation in [Ok(report(None)), Ok(report(STAGES[1])), other(), work()] {
            assert_eq!(conforms(&work(), &work(), &implementation), Ok(()));
            assert_eq!(conforms(&Ok(report(None)), &work(), &implementation), Ok(()));
        }
        assert!(conforms(&other(), &other(), &work()).is_err());
        assert!(conforms(&Ok(report(None)), &Ok(report(None)), &work()).is_err());
    }

    #[test]
    fn a_cycle_is_decided_in_this_order() {
        assert_eq!(STAGES.map(rank), [0, 1, 2, 3, 4, 5, 6, 7]);
    }

    #[test]
    fn every_triple_is_judged_by_the_three_rules() {
        for exact in STAGES {
            for strict in STAGES.into_iter().filter(|strict| rank(*strict) <= rank(exact)) {
                for implementation in STAGES {
                    let verdict = stage_conforms(exact, strict, implementation);
                    let sound = exact.is_none() || implementation.is_some();
                    let complete = strict.is_some() || implementation.is_none();
                    let placed =
                        rank(strict) <= rank(implementation) && rank(implementation) <= rank(exact);
                    assert_eq!(verdict.is_ok(), sound && complete && placed);
                    if strict == exact {
                        assert_eq!(verdict.is_ok(), implementation == exact);
                    }
                    assert_eq!(matches!(verdict, Err(Disagreement::UnsafeAccepted { .. })), !sound);
                    assert_eq!(
                        matches!(verdict, Err(Disagreement::SafeRejected { .. })),
                        !complete
                    );
                }
            }
        }
    }

    #[test]
    fn a_strict_model_that_fails_later_is_reported() {
        let verdict = stage_conforms(STAGES[1], STAGES[2], STAGES[1]);
        assert!(matches!(verdict, Err(Disagreement::ModelUnordered { .. })));
    }

    #[test]
    fn errors_must_name_the_same_field_and_index() {
        let error: Answer = Err(problem("ego.x", None));
        let other: Answer = Err(problem("tracks.items.x", Some(1)));
        let safe: Answer = Ok(report(None));
        assert_eq!(conforms(&error, &error, &error), Ok(()));
        assert!(matches!(conforms(&error, &error, &other), Err(Disagreement::WrongInput { .. })));
        assert!(matches!(conforms(&error, &error, &safe), Err(Disagreement::WrongInput { .. })));
        assert!(matches!(conforms(&safe, &safe, &error), Err(Disagreement::WrongInput { .. })));
        assert!(matches!(conforms(&safe, &error, &safe), Err(Disagreement::ModelUnordered { .. })));
    }

    #[test]
    fn remote_problems_are_compared_by_place_and_kept_apart_from_errors() {
        let remote = |index| -> Answer {
            let mut report = report(Some(FailedStage::Input));
            report.input = Some(problem("tracks.items.x", Some(index)));
            Ok(report)
        };
        assert_eq!(conforms(&remote(1), &remote(1), &remote(1)), Ok(()));
        assert!(matches!(
            conforms(&remote(1), &remote(1), &remote(2)),
            Err(Disagreement::WrongInput { .. })
        ));
        let error: Answer = Err(problem("tracks.items.x", Some(1)));
        assert!(matches!(
            conforms(&remote(1), &remote(1), &error),
            Err(Disagreement::WrongInput { .. })
        ));
    }
}
