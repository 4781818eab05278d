//! A drive with all that was found on it.

use std::collections::BTreeSet;

use mufasa_model::offloading::requester::Parameters;
use mufasa_model::report::{InvalidInput, Stage};
use mufasa_props::conformance::{Answer, Disagreement};

use super::fallback::{Hold, RequesterRun};
use super::judge::Judged;
use super::requesters::Requesters;
use super::sides::Table;
use super::steps::Steps;
use super::tally::Tally;
use crate::drive::{DriveCycle, Stream};
use crate::readers::error::ReadError;
use mufasa_records::names;

/// Errors of single cycles and breaches of conformance that are told one by one.
pub const TOLD: usize = 10;

/// What was found on a drive: counts and the first of what is rare, whatever the number of cycles.
pub struct Checked {
    /// The drive; its cycles are not kept, nor is what was found in each.
    pub drive: Stream,
    /// Counts of the model and of the implementation.
    pub tallies: [Tally; 2],
    /// For each stage the cycles in which it fails when it is run on its own.
    pub alone: [usize; 5],
    /// Cycles that the implementation decides otherwise, within the rules or not.
    pub otherwise: usize,
    /// The first cycles with invalid local input: their ids and what is wrong.
    pub errors: Vec<(String, InvalidInput)>,
    /// Cycles with a breach of conformance.
    pub breaches: usize,
    /// The first of them.
    pub first_breaches: Vec<Breach>,
    /// The fallbacks by the model's requester and verdicts, and by the implementation's.
    pub requesters: [RequesterRun; 2],
    /// Whether the two did the same in every cycle.
    pub alike: bool,
    /// A complaint of a requester, or a difference of the two where the verdicts are the same.
    pub protocol: Option<String>,
    /// Options without an effect; where offloading is lost, which limits of the quality of service the drive exceeds,
    /// and what to do.
    pub notes: Vec<String>,
    steps: Steps,
    configurations: BTreeSet<&'static str>,
    profiles: BTreeSet<&'static str>,
}

/// What is said where the cycles of a drive ignore options ([`Stream::ignores_options`]).
pub const IGNORED: &str = "each cycle has its own profile, configuration and parameters: options of recorded drives, \
                           --profile, --configuration and parameters of the stages change nothing";

/// A cycle with a breach of conformance.
#[derive(Clone, Debug, PartialEq)]
pub struct Breach {
    /// Name of the cycle.
    pub id: String,
    /// What is broken.
    pub disagreement: Disagreement,
    /// The answers of model and implementation.
    pub answers: [Answer; 2],
}

/// A cycle as it was judged, before the next one is made.
#[derive(Clone, Copy, Debug)]
pub struct Seen<'a> {
    /// Its number in the drive, from 0.
    pub index: usize,
    /// Time of the first cycle of the drive, ns.
    pub start_ns: i64,
    /// The cycle.
    pub made: &'a DriveCycle,
    /// What model and implementation say.
    pub judged: &'a Judged,
    /// If it is unsafe, what it did to the waiting time: to the model's requester, and to the implementation's.
    pub holds: [Option<Hold>; 2],
}

impl Seen<'_> {
    /// Its time since the first cycle, s.
    pub fn seconds(&self) -> f64 {
        self.seconds_of(self.made.cycle.now_ns)
    }

    /// Another time since the first cycle, s.
    pub fn seconds_of(&self, time_ns: i64) -> f64 {
        crate::seconds(self.start_ns, time_ns)
    }

    /// The answers of model and implementation.
    pub fn answers(&self) -> [&Answer; 2] {
        [&self.judged.model, &self.judged.implementation]
    }
}

impl Checked {
    /// A drive of which nothing is judged yet.
    pub fn of(drive: impl Into<Stream>) -> Self {
        Self {
            drive: drive.into(),
            tallies: Default::default(),
            alone: Default::default(),
            otherwise: 0,
            errors: Vec::new(),
            breaches: 0,
            first_breaches: Vec::new(),
            requesters: Default::default(),
            alike: true,
            protocol: None,
            notes: Vec::new(),
            steps: Steps::default(),
            configurations: BTreeSet::new(),
            profiles: BTreeSet::new(),
        }
    }

    /// Judges every cycle in order, with `readings` by the strict and the lax model too, and runs
    /// both requesters over the verdicts. Each cycle is shown to `each` and dropped.
    ///
    /// Errors: a cycle cannot be read again, or those of `each`.
    pub fn new(
        drive: impl Into<Stream>,
        parameters: &Parameters,
        readings: bool,
        mut each: impl FnMut(&Seen<'_>) -> Result<(), ReadError>,
    ) -> Result<Self, ReadError> {
        let mut checked = Self::of(drive);
        let mut table = Table::default();
        let drive = checked.drive.clone();
        let mut cycles = drive.cycles().enumerate().peekable();
        let first = match cycles.peek() {
            None => return Ok(checked),
            Some((_, Ok(first))) => &first.cycle,
            Some((_, Err(error))) => return Err(error.clone()),
        };
        let start_ns = first.now_ns;
        let mut requesters = Requesters::new(first.profile, parameters, &mut table);
        for (index, made) in cycles {
            let made = made?;
            let judged = Judged::new(&made.cycle, readings);
            let holds = requesters.follow(&made, &judged);
            let seen = Seen { index, start_ns, made: &made, judged: &judged, holds };
            checked.take(&seen);
            each(&seen)?;
        }
        checked.requesters = requesters.runs();
        checked.alike = requesters.are_alike();
        if drive.ignores_options {
            checked.notes.push(String::from(IGNORED));
        }
        if checked.lost() > 0 {
            checked.notes.extend(checked.steps.notes(parameters));
        }
        checked.protocol = requesters.complaint();
        Ok(checked)
    }

    /// Counts a cycle.
    pub fn take(&mut self, seen: &Seen<'_>) {
        let Seen { made: DriveCycle { id, cycle }, judged, .. } = *seen;
        for (tally, answer) in self.tallies.iter_mut().zip(seen.answers()) {
            tally.add(answer);
        }
        for (count, stage) in self.alone.iter_mut().zip(Stage::ALL) {
            *count += usize::from(judged.alone.contains(&stage));
        }
        let place = |answer: &Answer| answer.as_ref().ok().map(|report| report.failed_stage);
        let [model, implementation] = seen.answers().map(place);
        self.otherwise += usize::from(model != implementation);
        if let Err(problem) = &judged.model
            && self.errors.len() < TOLD
        {
            self.errors.push((id.clone(), problem.clone()));
        }
        if let Some(disagreement) = &judged.disagreement {
            self.breaches += 1;
            if self.first_breaches.len() < TOLD {
                let answers = seen.answers().map(Answer::clone);
                let disagreement = disagreement.clone();
                self.first_breaches.push(Breach { id: id.clone(), disagreement, answers });
            }
        }
        self.steps.take(cycle);
        self.configurations.insert(names::configuration(cycle.configuration));
        self.profiles.insert(names::profile(cycle.profile));
    }

    /// Cycles with a breach of conformance; a difference of the requesters counts as one.
    pub fn disagreements(&self) -> usize {
        self.breaches + usize::from(self.protocol.is_some())
    }

    /// Elements too late and silences that ended offloading, by the model's requester.
    pub fn lost(&self) -> usize {
        self.requesters[0].late + self.requesters[0].silent
    }

    /// Configurations and profiles of the cycles, such as `AllRemote, hardened`.
    pub fn setting(&self) -> String {
        let all: Vec<&str> = self.configurations.iter().chain(&self.profiles).copied().collect();
        all.join(", ")
    }
}
