//! Counting outcomes by stage.

use mufasa_model::report::{FailedStage, Outcome};
use mufasa_props::conformance::Answer;

/// How often a stage ended how.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StageTally {
    /// Ran and found nothing.
    pub passed: usize,
    /// Ran and found a safety issue.
    pub failed: usize,
    /// Conditional, or stopped by an earlier failure.
    pub skipped: usize,
    /// Scheduled always, but an input was missing.
    pub not_applicable: usize,
    /// Not part of the configuration.
    pub not_scheduled: usize,
}

impl StageTally {
    /// How often the stage ran.
    pub fn run(&self) -> usize {
        self.passed + self.failed
    }
}

/// The outcomes of many cycles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Cycles judged.
    pub cycles: usize,
    /// Safe ones.
    pub safe: usize,
    /// Those with invalid remote data.
    pub input: usize,
    /// Those that fail with `no_obstacle_check` (H-05).
    pub no_obstacle_check: usize,
    /// Those with invalid local input.
    pub errors: usize,
    /// By stage, in the order of `Stage::ALL`.
    pub stages: [StageTally; 5],
}

impl Tally {
    /// Cycles that are neither safe nor errors.
    pub fn unsafe_cycles(&self) -> usize {
        self.cycles - self.safe - self.errors
    }

    /// Sums the outcomes of other cycles.
    pub fn merge(&mut self, other: &Self) {
        self.cycles += other.cycles;
        self.safe += other.safe;
        self.input += other.input;
        self.no_obstacle_check += other.no_obstacle_check;
        self.errors += other.errors;
        for (mine, theirs) in self.stages.iter_mut().zip(&other.stages) {
            mine.passed += theirs.passed;
            mine.failed += theirs.failed;
            mine.skipped += theirs.skipped;
            mine.not_applicable += theirs.not_applicable;
            mine.not_scheduled += theirs.not_scheduled;
        }
    }

    /// Counts an answer.
    pub fn add(&mut self, answer: &Answer) {
        self.cycles += 1;
        let Ok(report) = answer else {
            self.errors += 1;
            return;
        };
        match report.failed_stage {
            None => self.safe += 1,
            Some(FailedStage::Input) => self.input += 1,
            Some(FailedStage::NoObstacleCheck) => self.no_obstacle_check += 1,
            Some(FailedStage::Stage(_)) => {}
        }
        for (tally, outcome) in self.stages.iter_mut().zip(&report.stages) {
            let count = match outcome {
                Outcome::Passed => &mut tally.passed,
                Outcome::Failed(_) => &mut tally.failed,
                Outcome::Skipped(_) => &mut tally.skipped,
                Outcome::NotApplicable(_) => &mut tally.not_applicable,
                Outcome::NotScheduled => &mut tally.not_scheduled,
            };
            *count += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use mufasa_model::report::{InvalidInput, Reason, Report, Stage};

    use super::*;

    #[test]
    fn every_cycle_counts_once_as_safe_unsafe_or_error() {
        let report = |failed_stage| {
            Ok(Report {
                failed_stage,
                stages: [const { Outcome::Skipped(Reason::AfterFailure) }; 5],
                input: None,
            })
        };
        let answers = [
            report(None),
            report(Some(FailedStage::Stage(Stage::I))),
            report(Some(FailedStage::Input)),
            report(Some(FailedStage::NoObstacleCheck)),
            Err(InvalidInput { field: String::new(), index: None, message: String::new() }),
        ];
        let mut tally = Tally::default();
        answers.iter().for_each(|answer| tally.add(answer));
        tally.merge(&tally.clone());
        assert_eq!((tally.cycles, tally.safe, tally.errors), (10, 2, 2));
        assert_eq!((tally.unsafe_cycles(), tally.input, tally.no_obstacle_check), (6, 2, 2));
        assert_eq!(tally.stages[4].skipped, 8);
        assert_eq!(tally.stages[4].run(), 0);
    }
}
