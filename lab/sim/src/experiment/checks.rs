//! Cycles of runs, checked by the exact model beside what the monitor decided.

use mufasa_drives::check::judge::compare;
use mufasa_model::cycle::check;
use mufasa_model::input::cycle::Cycle;
use mufasa_model::report::Reading;
use mufasa_props::bridge::{invalid_input_from_impl, report_from_impl};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::cav::decided::Decided;

/// How many cycles were checked, and where the monitor did not decide as the model allows
/// (`spec/4-arithmetic.md#conformance-of-an-implementation`).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Checks {
    /// Cycles that the monitor decided.
    pub decided: u64,
    /// Those of them that were checked.
    pub checked: u64,
    /// In the order of the runs' ids.
    pub disagreements: Vec<Disagreement>,
}

/// A cycle that was decided otherwise.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
pub struct Disagreement {
    /// The run.
    pub id: String,
    /// When the cycle was decided, ns.
    pub t_ns: i64,
    /// What differs.
    pub why: String,
}

impl Checks {
    /// Checks what was decided, if it is recorded. `id`: of the run.
    pub fn see(&mut self, id: &str, decided: &Decided) {
        self.decided += u64::from(decided.report.is_some());
        let (Some(cycle), Some(report)) = (&decided.record, &decided.report) else { return };
        self.checked += 1;
        let cycle: &Cycle = cycle;
        let implementation = report.as_ref().map(report_from_impl).map_err(invalid_input_from_impl);
        let exact = check(cycle, Reading::Exact);
        let strict = || check(cycle, Reading::Strict);
        if let Some(found) = compare(&exact, strict, &implementation) {
            let (id, t_ns, why) = (id.to_owned(), cycle.now_ns, found.to_string());
            self.disagreements.push(Disagreement { id, t_ns, why });
        }
    }

    /// Adds those of other runs.
    pub fn add(&mut self, other: Self) {
        self.decided += other.decided;
        self.checked += other.checked;
        self.disagreements.extend(other.disagreements);
        self.disagreements.sort();
    }
}
