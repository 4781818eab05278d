//! One cycle, judged by the exact model and by the implementation.

use std::panic;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use mufasa_model::cycle::Cycle;
use mufasa_model::schedule;
use mufasa_model::verdict::{Reading, Report};
use mufasa_props::bridge;
use mufasa_props::conformance::{Answer, Disagreement, conforms};

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
}

impl Judged {
    /// Judges a cycle; with `readings` also by the strict and the lax model.
    pub fn new(cycle: &Cycle, readings: bool) -> Self {
        let model = schedule::check(cycle, Reading::Exact);
        let implementation = bridge::check_impl(cycle);
        let strict = || schedule::check(cycle, Reading::Strict);
        let disagreement = compare(&model, strict, &implementation);
        let readings = readings.then(|| [strict(), schedule::check(cycle, Reading::Lax)]);
        Self { model, implementation, disagreement, readings }
    }

    /// The model's report of a cycle that it finds unsafe.
    pub fn unsafe_report(&self) -> Option<&Report> {
        self.model.as_ref().ok().filter(|report| report.failed_stage.is_some())
    }

    /// Whether this is a safe cycle to the model.
    pub fn is_safe(&self) -> bool {
        is_safe(&self.model)
    }
}

/// Whether an answer is the verdict safe; an error is not (`spec/2-offloading.md#fallback`).
pub fn is_safe(answer: &Answer) -> bool {
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

/// Runs `job` for every index below `count` on all processors and returns the results in order;
/// `done` is called after each.
pub fn in_parallel<T: Send>(
    count: usize,
    job: impl Fn(usize) -> T + Sync,
    done: impl Fn() + Sync,
) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let worker = || {
        let mut results = Vec::new();
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            if index >= count {
                return results;
            }
            results.push((index, job(index)));
            done();
        }
    };
    let workers = thread::available_parallelism().map_or(1, usize::from).min(count.max(1));
    let mut results: Vec<(usize, T)> = thread::scope(|scope| {
        let handles: Vec<_> = (0..workers).map(|_| scope.spawn(worker)).collect();
        let join = |handle: thread::ScopedJoinHandle<'_, _>| {
            handle.join().unwrap_or_else(|panic| panic::resume_unwind(panic))
        };
        handles.into_iter().flat_map(join).collect()
    });
    results.sort_by_key(|(index, _)| *index);
    results.into_iter().map(|(_, result)| result).collect()
}

#[cfg(test)]
mod tests {
    use mufasa_model::verdict::{FailedStage, Outcome, Stage};

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

    #[test]
    fn equal_answers_agree_without_asking_the_strict_model() {
        for answer in answers([None, Some(Stage::I), Some(Stage::V)]) {
            assert_eq!(compare(&answer, || panic!("not needed"), &answer), None);
        }
    }

    #[test]
    fn an_accepted_unsafe_cycle_is_a_disagreement() {
        let [fails, safe] = answers([Some(Stage::Iii), None]);
        let found = compare(&fails, || fails.clone(), &safe);
        assert!(matches!(found, Some(Disagreement::UnsafeAccepted { .. })), "{found:?}");
    }

    #[test]
    fn a_rejected_strictly_safe_cycle_is_a_disagreement() {
        let [fails, safe] = answers([Some(Stage::Iii), None]);
        let found = compare(&safe, || safe.clone(), &fails);
        assert!(matches!(found, Some(Disagreement::SafeRejected { .. })), "{found:?}");
    }

    #[test]
    fn a_rejection_within_the_margin_is_none() {
        let [fails, safe] = answers([Some(Stage::Iii), None]);
        assert_eq!(compare(&safe, || fails.clone(), &fails), None);
    }

    #[test]
    fn another_stage_is_a_disagreement_outside_the_range_only() {
        let [ii, iii, iv] = answers([Stage::Ii, Stage::Iii, Stage::Iv].map(Some));
        assert_eq!(compare(&iv, || ii.clone(), &iii), None);
        let found = compare(&iv, || iii.clone(), &ii);
        assert!(matches!(found, Some(Disagreement::WrongStage { .. })), "{found:?}");
    }

    #[test]
    fn results_of_parallel_work_keep_their_order() {
        let done = AtomicUsize::new(0);
        let squares = in_parallel(
            100,
            |index| index * index,
            || {
                done.fetch_add(1, Ordering::Relaxed);
            },
        );
        assert_eq!(squares, (0..100).map(|index| index * index).collect::<Vec<_>>());
        assert_eq!(done.into_inner(), 100);
        assert!(in_parallel(0, |index| index, || {}).is_empty());
    }
}
