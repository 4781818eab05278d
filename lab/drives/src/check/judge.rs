//! Cycles, judged by the exact model and by the implementation.

use mufasa_model::cycle::check;
use mufasa_model::input::cycle::Cycle;
use mufasa_model::report::{Reading, Report, Stage};
use mufasa_props::bridge;
use mufasa_props::conformance::{Answer, Disagreement, conforms};
use rayon::prelude::*;

/// A cycle as model and implementation judge it.
#[derive(Clone, Debug, PartialEq)]
pub struct Judged {
    /// The exact model's answer.
    pub model: Answer,
    /// The implementation's answer, in the model's types.
    pub implementation: Answer,
    /// A breach of `spec/4-arithmetic.md#conformance-of-an-implementation`.
    pub disagreement: Option<Disagreement>,
    /// The strict and the lax reading, where they were asked for.
    pub readings: Option<[Answer; 2]>,
    /// The stages of the configuration that fail when each is run on its own. Those that ran before may
    /// keep a stage from running, so the verdict does not say it.
    pub alone: Vec<Stage>,
}

impl Judged {
    /// Judges a cycle; with `readings` also by the strict and the lax model.
    pub fn new(cycle: &Cycle, readings: bool) -> Self {
        let model = check(cycle, Reading::Exact);
        let implementation = bridge::check_impl(cycle);
        let strict = || check(cycle, Reading::Strict);
        let disagreement = compare(&model, strict, &implementation);
        let readings = readings.then(|| [strict(), check(cycle, Reading::Lax)]);
        let alone = bridge::failing_alone(cycle);
        Self { model, implementation, disagreement, readings, alone }
    }

    /// The model's report of a cycle that it finds unsafe.
    pub fn unsafe_report(&self) -> Option<&Report> {
        self.model.as_ref().ok().filter(|report| report.failed_stage.is_some())
    }
}

/// Whether an answer is the verdict safe; an error is not (`spec/2-offloading.md#fallback`).
pub(crate) fn is_safe(answer: &Answer) -> bool {
    answer.as_ref().is_ok_and(|report| report.failed_stage.is_none())
}

/// The breach of conformance, if there is one. The strict model is asked only where the
/// implementation does not answer as the exact one does: what conforms to the exact model alone
/// conforms to the range from the strict to the exact one.
pub fn compare(
    exact: &Answer,
    strict: impl FnOnce() -> Answer,
    implementation: &Answer,
) -> Option<Disagreement> {
    match conforms(exact, exact, implementation) {
        Ok(()) => None,
        Err(_) => conforms(exact, &strict(), implementation).err(),
    }
}

/// So many results wait at most for those before them.
const AT_ONCE: usize = 64;

/// Runs `job` for every index below `count` on all processors, so many at once, and hands the results to `take` in
/// their order. The first error of `take` ends the work.
pub(crate) fn in_order<T: Send, E>(
    count: usize,
    job: impl Fn(usize) -> T + Sync,
    mut take: impl FnMut(T) -> Result<(), E>,
) -> Result<(), E> {
    (0..count).step_by(AT_ONCE).try_for_each(|from| {
        let end = count.min(from + AT_ONCE);
        let results: Vec<T> = (from..end).into_par_iter().map(&job).collect();
        results.into_iter().try_for_each(&mut take)
    })
}

#[cfg(test)]
mod tests {
    use mufasa_model::report::{FailedStage, Outcome};

    use super::*;

    fn report(failed: Option<Stage>) -> Report {
        Report {
            failed_stage: failed.map(FailedStage::Stage),
            stages: [const { Outcome::NotScheduled }; 5],
            input: None,
        }
    }

    fn answers<const N: usize>(failed: [Option<Stage>; N]) -> [Answer; N] {
        failed.map(|stage| Ok(report(stage)))
    }

    /// What exact model, strict model and implementation say, and the breach of conformance in it. The strict model is
    /// not asked where the other two answer alike.
    #[test]
    fn a_breach_is_told_from_a_difference_within_the_margin() {
        use Stage::{Ii, Iii, Iv};
        for (exact, strict, implementation, breach) in [
            (None, None, None, ""),
            (Some(Iii), None, Some(Iii), ""),
            (Some(Iii), Some(Some(Iii)), None, "UnsafeAccepted"),
            (None, Some(None), Some(Iii), "SafeRejected"),
            (None, Some(Some(Iii)), Some(Iii), ""),
            (Some(Iv), Some(Some(Ii)), Some(Iii), ""),
            (Some(Iv), Some(Some(Iii)), Some(Ii), "WrongStage"),
        ] {
            let [exact, implementation] = answers([exact, implementation]);
            let strict = || Ok(report(strict.expect("it is asked")));
            let found = compare(&exact, strict, &implementation);
            let found = found.map_or(String::new(), |it| format!("{it:?}"));
            let is_said =
                if breach.is_empty() { found.is_empty() } else { found.starts_with(breach) };
            assert!(is_said, "{breach}: {found}");
        }
    }

    #[test]
    fn results_of_parallel_work_keep_their_order_up_to_an_error() {
        let mut squares = Vec::new();
        let taken = in_order(
            1000,
            |index| index * index,
            |square| {
                squares.push(square);
                if square == 99 * 99 { Err(square) } else { Ok(()) }
            },
        );
        assert_eq!(taken, Err(99 * 99));
        assert_eq!(squares, (0..100).map(|index| index * index).collect::<Vec<_>>());
        assert_eq!(in_order(0, |index| index, |_| Err("nothing to take")), Ok(()));
    }
}
