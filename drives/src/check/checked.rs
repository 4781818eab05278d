//! A drive with all that was found on it.

use std::collections::BTreeSet;
use std::sync::Arc;

use mufasa_model::offloading::requester::{Parameters, Requester};
use mufasa_model::report::Stage;
use mufasa_props::conformance::Answer;

use super::fallback::{RequesterRun, follow};
use super::judge::{Judged, is_safe, judge_drive};
use super::sides::with_implementation;
use super::step::Step;
use super::tally::Tally;
use crate::drive::Stream;
use mufasa_records::names;

/// A drive, judged.
pub struct Checked {
    /// The drive; its cycles are not kept.
    pub drive: Stream,
    /// What is kept of each cycle.
    pub steps: Vec<Step>,
    /// One judgement per cycle.
    pub judged: Vec<Arc<Judged>>,
    /// The fallbacks by the model's requester and verdicts, and by the implementation's.
    pub requesters: [RequesterRun; 2],
    /// A complaint of a requester, or a difference of the two where the verdicts are the same.
    pub protocol: Option<String>,
}

impl Checked {
    /// Judges every cycle in order, with `readings` by the strict and the lax model too, and runs
    /// both requesters over the verdicts. `done` is called after each cycle.
    pub fn new(
        drive: impl Into<Stream>,
        requester: &Parameters,
        readings: bool,
        done: impl Fn(),
    ) -> Self {
        let drive = drive.into();
        let (steps, judged) = judge_drive(&drive, readings, done);
        let (requesters, protocol) = requesters(&steps, &judged, requester);
        Self { drive, steps, judged, requesters, protocol }
    }

    /// Counts of the model and of the implementation.
    pub fn tallies(&self) -> [Tally; 2] {
        let model = Tally::of(self.judged.iter().map(|judged| &judged.model));
        [model, Tally::of(self.judged.iter().map(|judged| &judged.implementation))]
    }

    /// For each stage the cycles in which it fails when it is run on its own.
    pub fn alone(&self) -> [usize; 5] {
        let fails = |stage| self.judged.iter().filter(|it| it.alone.contains(&stage)).count();
        Stage::ALL.map(fails)
    }

    /// Cycles with a breach of conformance; a difference of the requesters counts as one.
    pub fn disagreements(&self) -> usize {
        let cycles = self.judged.iter().filter(|judged| judged.disagreement.is_some()).count();
        cycles + usize::from(self.protocol.is_some())
    }

    /// Cycles that the implementation decides otherwise, within the rules or not.
    pub fn otherwise(&self) -> usize {
        let place = |answer: &Answer| answer.as_ref().ok().map(|report| report.failed_stage);
        let differ = |judged: &&Arc<Judged>| place(&judged.model) != place(&judged.implementation);
        self.judged.iter().filter(differ).count()
    }

    /// Time of a cycle since the first one, s.
    pub fn seconds(&self, index: usize) -> f64 {
        let time = |step: &Step| step.now_ns;
        let first = self.steps.first().map_or(0, time);
        let now = self.steps.get(index).map_or(first, time);
        seconds(first, now)
    }

    /// Time since the first cycle, s.
    pub fn seconds_of(&self, time_ns: i64) -> f64 {
        seconds(self.steps.first().map_or(0, |first| first.now_ns), time_ns)
    }

    /// Configurations and profiles of the cycles, such as `AllRemote, hardened`.
    pub fn setting(&self) -> String {
        let cycles = || self.steps.iter();
        let configurations: BTreeSet<_> =
            cycles().map(|cycle| names::configuration(cycle.configuration)).collect();
        let profiles: BTreeSet<_> = cycles().map(|cycle| names::profile(cycle.profile)).collect();
        configurations.into_iter().chain(profiles).collect::<Vec<_>>().join(", ")
    }
}

#[expect(clippy::cast_precision_loss)] // to be read by people
pub(super) fn seconds(from_ns: i64, to_ns: i64) -> f64 {
    (i128::from(to_ns) - i128::from(from_ns)) as f64 / 1e9
}

fn requesters(
    steps: &[Step],
    judged: &[Arc<Judged>],
    parameters: &Parameters,
) -> ([RequesterRun; 2], Option<String>) {
    let Some(first) = steps.first() else { return Default::default() };
    let profile = first.profile;
    let safe = |answer: fn(&Judged) -> &Answer| -> Vec<bool> {
        judged.iter().map(|judged| is_safe(answer(judged))).collect()
    };
    let model_safe = safe(|judged| &judged.model);
    let implementation_safe = safe(|judged| &judged.implementation);
    let model = follow(&mut Requester::new(profile, *parameters), steps, &model_safe);
    let implementation = with_implementation(profile, parameters, |requester| {
        follow(requester, steps, &implementation_safe)
    });
    match (model, implementation) {
        (Ok(model), Ok(implementation)) => {
            let same = model_safe != implementation_safe || model == implementation;
            let protocol = (!same).then(|| difference(&model, &implementation));
            ([model, implementation], protocol)
        }
        (Err(complaint), _) => (Default::default(), Some(format!("model: {complaint}"))),
        (_, Err(complaint)) => (Default::default(), Some(format!("implementation: {complaint}"))),
    }
}

/// The first action in which two requesters differ.
fn difference(model: &RequesterRun, implementation: &RequesterRun) -> String {
    let length = model.log.len().max(implementation.log.len());
    let first = (0..length)
        .map(|index| (model.log.get(index), implementation.log.get(index)))
        .find(|(model, implementation)| model != implementation);
    match first {
        Some((model, implementation)) => {
            format!("the requesters differ: model {model:?}, implementation {implementation:?}")
        }
        None => "the requesters take the same actions but count differently".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use mufasa_model::offloading::requester::{Action, Group};

    use super::*;

    #[test]
    fn the_first_different_action_is_named() {
        let run =
            |log: &[(usize, Action)]| RequesterRun { log: log.to_vec(), ..RequesterRun::default() };
        let (activate, drop) = ((1, Action::Activate(Group::Mot)), (2, Action::Drop(Group::Plan)));
        let text = difference(&run(&[activate, drop]), &run(&[activate]));
        assert!(text.contains("Drop(Plan)") && text.ends_with("implementation None"), "{text}");
    }
}
