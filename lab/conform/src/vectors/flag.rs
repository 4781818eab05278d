//! Whom a vector binds (`spec/5-interfaces.md#vectors`).

use std::fmt;

use mufasa_model::cycle::check;
use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_model::report::{FailedStage, Reading};

pub use crate::judge::states::decisions;

use mufasa_records::offloading_answer::OffloadingAnswer;
use mufasa_records::{Sequence, Trace};

/// Whom a vector binds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flag {
    /// Every conforming implementation: both profiles answer alike.
    Must,
    /// The paper profile; the hardened one answers otherwise.
    PaperOnly,
    /// The hardened profile; the paper's answers otherwise.
    HardenedOnly,
    /// Who reads the paper as this interpretation says.
    Interpretation(&'static str),
}

impl fmt::Display for Flag {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Must => out.write_str("must"),
            Self::PaperOnly => out.write_str("paper-only"),
            Self::HardenedOnly => out.write_str("hardened-only"),
            Self::Interpretation(name) => write!(out, "interpretation {name}"),
        }
    }
}

/// The flag of a cycle: whether the other profile has another verdict or failed stage, in the
/// exact or in the strict model.
pub fn of_cycle(cycle: &Cycle) -> Flag {
    let other = Cycle { profile: other(cycle.profile), ..cycle.clone() };
    if verdicts(cycle) == verdicts(&other) { Flag::Must } else { only(cycle.profile) }
}

/// The flag of a trace: whether the other profile has another state or action anywhere.
pub fn of_trace(trace: &Trace) -> Flag {
    let other = Trace { profile: other(trace.profile), ..trace.clone() };
    let run = |trace| OffloadingAnswer::run(String::new(), trace);
    if run(trace) == run(&other) { Flag::Must } else { only(trace.profile) }
}

/// The flag of a sequence: whether the other profile gives another answer anywhere. One that is refused in
/// the other profile binds its own.
pub fn of_sequence(sequence: &Sequence) -> Flag {
    let other = Sequence { profile: other(sequence.profile), ..sequence.clone() };
    let same = [Reading::Exact, Reading::Strict]
        .iter()
        .all(|reading| decisions(sequence, *reading) == decisions(&other, *reading));
    if same { Flag::Must } else { only(sequence.profile) }
}

/// The other profile.
pub const fn other(profile: Profile) -> Profile {
    match profile {
        Profile::PAPER => Profile::HARDENED,
        _ => Profile::PAPER,
    }
}

const fn only(profile: Profile) -> Flag {
    match profile {
        Profile::PAPER => Flag::PaperOnly,
        _ => Flag::HardenedOnly,
    }
}

/// Failed stages of the exact and the strict model; `Err` is invalid local input.
fn verdicts(cycle: &Cycle) -> [Result<Option<FailedStage>, ()>; 2] {
    [Reading::Exact, Reading::Strict]
        .map(|reading| check(cycle, reading).map(|report| report.failed_stage).map_err(|_| ()))
}
