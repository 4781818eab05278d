//! The paths of one claim, on all cores. What is asked on a path does not depend on the others, so the
//! paths are those of `prove_claim`; of several counterexamples any may come first.

use std::io;
use std::num::NonZero;
use std::sync::{Condvar, Mutex, MutexGuard};
use std::thread::{available_parallelism, scope};

use mufasa_z3::Solver;

use super::{Decision, Proof, on_this_path};
use crate::numbers::real::formula::Formula;
use crate::numbers::real::path;

/// What remains to be done, and what was found.
struct Work {
    /// The answers with which the paths begin that nobody has taken.
    waiting: Vec<Vec<bool>>,
    /// Workers that are on a path, which may leave more of them.
    busy: usize,
    decision: Decision,
    paths: usize,
}

struct Shared {
    work: Mutex<Work>,
    changed: Condvar,
}

/// As `prove_claim`. Errors are those of talking to the solver.
///
/// # Panics
/// If the claim does.
pub(super) fn prove(claim: fn() -> Formula) -> io::Result<Proof> {
    let work = Work { waiting: vec![Vec::new()], busy: 0, decision: Decision::Proved, paths: 0 };
    let shared = Shared { work: Mutex::new(work), changed: Condvar::new() };
    let workers = available_parallelism().map_or(1, NonZero::get);
    scope(|scope| {
        let all: Vec<_> = (0..workers).map(|_| scope.spawn(|| shared.run(claim))).collect();
        all.into_iter().try_for_each(|it| it.join().expect("the claim does not panic"))
    })?;
    let Work { decision, paths, .. } = shared.work.into_inner().expect("nobody panics with it");
    Ok(Proof { decision, paths })
}

impl Shared {
    fn run(&self, claim: fn() -> Formula) -> io::Result<()> {
        path::exchange_solver(Some(Solver::start()?));
        while let Some((answers, _busy)) = self.take() {
            path::begin(&answers);
            let found = on_this_path(&claim);
            let mut work = self.lock();
            work.paths += 1;
            work.found(found, path::remaining());
        }
        let solver = path::exchange_solver(None);
        path::first();
        solver.and_then(|mut solver| solver.error.take()).map_or(Ok(()), Err)
    }

    /// The next path, as soon as there is one; none when all are done.
    fn take(&self) -> Option<(Vec<bool>, Busy<'_>)> {
        let mut work = self.lock();
        while work.waiting.is_empty() && work.busy > 0 {
            work = self.changed.wait(work).expect("nobody panics with it");
        }
        let answers = work.waiting.pop()?;
        work.busy += 1;
        Some((answers, Busy(self)))
    }

    fn lock(&self) -> MutexGuard<'_, Work> {
        self.work.lock().expect("nobody panics with it")
    }
}

impl Work {
    fn found(&mut self, found: Decision, remaining: Vec<Vec<bool>>) {
        match (&self.decision, found) {
            (Decision::Refuted(_), _) => return,
            (_, Decision::Proved) => {}
            (_, found) => self.decision = found,
        }
        match self.decision {
            Decision::Refuted(_) => self.waiting.clear(),
            Decision::Proved | Decision::Unknown => self.waiting.extend(remaining),
        }
    }
}

/// A worker on a path. A claim that panics drops it, too, so that the others do not wait for ever.
struct Busy<'a>(&'a Shared);

impl Drop for Busy<'_> {
    fn drop(&mut self) {
        self.0.lock().busy -= 1;
        self.0.changed.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::prove::prove_claim;
    use crate::theorem::h14_fail_safe::motions::THEOREMS;

    #[test]
    fn the_paths_and_the_answer_are_those_of_one_worker() {
        if !mufasa_z3::is_new_enough() {
            println!("NOT RUN: no z3 4.8 here");
            return;
        }
        let [theorem, ..] = THEOREMS else { panic!("there are theorems") };
        let [one, all] = [prove_claim(&theorem.claim), prove(theorem.claim)];
        let (one, all) = (one.expect("z3 answers"), all.expect("z3 answers"));
        assert_eq!((&one.decision, one.paths), (&all.decision, all.paths));
        assert!(all.paths > 10 && all.decision == Decision::Proved, "{all:?}");
        let wrong = prove(theorem.wrong.claim).expect("z3 answers");
        assert!(matches!(wrong.decision, Decision::Refuted(_)), "{wrong:?}");
    }
}
