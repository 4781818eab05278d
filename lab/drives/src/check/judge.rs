//! Cycles, judged by the exact model and by the implementation.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Condvar, Mutex, PoisonError, mpsc};
use std::thread;

use mufasa_model::cycle::check;
use mufasa_model::input::cycle::Cycle;
use mufasa_model::report::{Reading, Report, Stage};
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

/// So many results wait at most for one before them, or are being made.
const AHEAD: usize = 64;

/// Runs `job` for every index below `count` on all processors and hands the results to `take` in
/// their order, each as soon as those before it are there. The first error of `take` ends the work.
pub fn in_order<T: Send, E>(
    count: usize,
    job: impl Fn(usize) -> T + Sync,
    mut take: impl FnMut(T) -> Result<(), E>,
) -> Result<(), E> {
    let (next, gate) = (AtomicUsize::new(0), Gate::default());
    let workers = thread::available_parallelism().map_or(1, usize::from).min(count);
    let (sender, results) = mpsc::channel();
    thread::scope(|scope| {
        for _ in 0..workers {
            let (sender, next, job, gate) = (sender.clone(), &next, &job, &gate);
            scope.spawn(move || {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    gate.wait(index);
                    // The results are dropped when they are no longer wanted.
                    if index >= count || sender.send((index, job(index))).is_err() {
                        return;
                    }
                }
            });
        }
        drop(sender);
        let _open = Opened(&gate);
        let mut early = BTreeMap::new();
        let mut wanted = 0;
        // Moved, so that an error drops it and the workers notice.
        for (index, result) in results {
            early.insert(index, result);
            while let Some(result) = early.remove(&wanted) {
                take(result)?;
                wanted += 1;
                gate.open(wanted);
            }
        }
        Ok(())
    })
}

/// Lets work begin whose results will not wait for too many others.
#[derive(Default)]
struct Gate {
    /// Results that were taken.
    taken: Mutex<usize>,
    moved: Condvar,
}

impl Gate {
    fn wait(&self, index: usize) {
        let taken = self.taken.lock().unwrap_or_else(PoisonError::into_inner);
        let is_far = |taken: &mut usize| index.saturating_sub(*taken) >= AHEAD;
        drop(self.moved.wait_while(taken, is_far));
    }

    fn open(&self, taken: usize) {
        *self.taken.lock().unwrap_or_else(PoisonError::into_inner) = taken;
        self.moved.notify_all();
    }
}

/// At its end, in whatever way, nobody has to wait any more.
struct Opened<'a>(&'a Gate);

impl Drop for Opened<'_> {
    fn drop(&mut self) {
        self.0.open(usize::MAX);
    }
}

#[cfg(test)]
mod tests {
    use mufasa_model::report::{FailedStage, Outcome, Stage};

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
        let mut squares = Vec::new();
        let taken: Result<(), ()> = in_order(
            100,
            |index| index * index,
            |square| {
                squares.push(square);
                Ok(())
            },
        );
        assert_eq!(taken, Ok(()));
        assert_eq!(squares, (0..100).map(|index| index * index).collect::<Vec<_>>());
        assert_eq!(in_order(0, |index| index, |_| Err("nothing to take")), Ok(()));
    }

    /// What waits for the first result is not more than was said.
    #[test]
    fn work_does_not_run_far_ahead_of_what_is_taken() {
        let (done, farthest) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let job = |index| {
            if index == 0 {
                thread::sleep(std::time::Duration::from_millis(200));
            }
            done.fetch_add(1, Ordering::SeqCst)
        };
        let mut taken = 0;
        let ended: Result<(), ()> = in_order(1000, job, |_| {
            farthest.fetch_max(done.load(Ordering::SeqCst) - taken, Ordering::SeqCst);
            taken += 1;
            Ok(())
        });
        assert_eq!((ended, taken), (Ok(()), 1000));
        let farthest = farthest.load(Ordering::SeqCst);
        assert!(farthest <= AHEAD, "{farthest} results wait");
    }

    #[test]
    fn an_error_ends_parallel_work() {
        let mut seen = 0;
        let taken = in_order(
            1000,
            |index| index,
            |index| {
                seen += 1;
                if index == 3 { Err(index) } else { Ok(()) }
            },
        );
        assert_eq!((taken, seen), (Err(3), 4));
    }
}
