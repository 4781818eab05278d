//! The answer to a sequence of the monitor (`spec/5-interfaces.md#monitor`).

use mufasa_model::monitor::Monitor;
use mufasa_model::monitor::messages::{Answer, Brake, Decision, Dropped, Verified};
use mufasa_model::report::{FailedStage, Input, InvalidInput, Reading, Report};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::offloading_answer::{ActionAnswer, StateAnswer};
use crate::record::monitor::Sequence;
use crate::record::value::Word;
use crate::witness_answer::{InputProblem, WitnessAnswer};

/// One state per event or cycle.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct MonitorAnswer {
    /// Id of the record.
    pub id: String,
    /// The states after the events and cycles.
    pub states: Vec<MonitorState>,
}

/// The state after an event or cycle, and what it made the monitor do.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct MonitorState {
    /// `local`, `requested:N` or `remote:N`.
    pub mot: String,
    /// The same for ENV and TPL.
    pub plan: String,
    /// End of the last hold, ns; `None` before the first.
    pub hold_until_ns: Option<i64>,
    /// Actions in the order in which they are taken.
    pub actions: Vec<ActionAnswer>,
    /// Why the element of this event was dropped.
    pub dropped: Option<Word<Dropped>>,
    /// When PLAN was given back last, ns.
    pub given_back_ns: Option<i64>,
    /// Of a cycle.
    pub decision: Option<DecisionAnswer>,
}

/// What a cycle decided.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct DecisionAnswer {
    /// `safe` or `unsafe`.
    pub verdict: Word<bool>,
    /// `None` when the cycle is safe or has an error.
    pub failed_stage: Option<Word<FailedStage>>,
    /// What decided, when a stage failed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub witness: Option<WitnessAnswer>,
    /// Where the problem is, when the failed stage is `input`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub input: Option<InputProblem>,
    /// Where the problem is of a cycle with an error.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<InputProblem>,
    /// The remote tracks that come out.
    pub tracks: Option<VerifiedAnswer>,
    /// The trajectory that comes out.
    pub trajectory: Option<VerifiedAnswer>,
    /// The time by which control has to brake along this trajectory.
    pub brake_by_ns: Option<i64>,
    /// Why control has to brake at once.
    pub brake: Option<BrakeAnswer>,
}

/// An element that comes out.
#[derive(
    Clone, Copy, Debug, Deserialize, PartialEq, Eq, PartialOrd, Ord, JsonSchema, Serialize,
)]
pub struct VerifiedAnswer {
    /// Its stamp.
    pub stamp_ns: i64,
    /// From whom; 0 is the CAV.
    pub station: i64,
    /// In which session; `None`: of the CAV itself.
    pub session: Option<i64>,
}

/// Why control has to brake at once.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
#[serde(untagged)]
pub enum BrakeAnswer {
    /// The CAV's own trajectory failed.
    Failed {
        /// Where.
        failed_stage: Word<FailedStage>,
        /// What decided, when a stage failed.
        #[serde(skip_serializing_if = "Option::is_none")]
        witness: Option<Box<WitnessAnswer>>,
    },
    /// Something is invalid.
    Invalid {
        /// Where.
        input: InputProblem,
    },
    /// The CAV's own planner gave no current trajectory.
    Missing {
        /// Always the trajectory.
        missing: Word<Input>,
    },
}

impl MonitorAnswer {
    /// Runs a monitor through the sequence with the record id `id`, as the exact model decides. `Err` names
    /// a setting that is refused, or `work`.
    pub fn run(id: String, sequence: &Sequence) -> Result<Self, InvalidInput> {
        let states = answers(sequence, Reading::Exact)?;
        Ok(Self { id, states: states.into_iter().map(MonitorState::new).collect() })
    }
}

/// The answers of the model in this reading. `Err` as of [`MonitorAnswer::run`].
pub fn answers(sequence: &Sequence, reading: Reading) -> Result<Vec<Answer>, InvalidInput> {
    let mut monitor = Monitor::new(sequence.settings(), sequence.route.clone(), reading)?;
    let step = |event: &_| {
        let answer = monitor.step(Clone::clone(event));
        match &answer.decision {
            Some(Decision { report: Err(problem), .. }) if problem.field == "work" => {
                Err(problem.clone())
            }
            Some(_) | None => Ok(answer),
        }
    };
    sequence.events.iter().map(step).collect()
}

impl MonitorState {
    /// The state that the model gives.
    pub fn new(answer: Answer) -> Self {
        let groups = [answer.mot, answer.plan];
        let StateAnswer { mot, plan, hold_until_ns, actions } =
            StateAnswer::new(groups, answer.hold_until_ns, answer.actions);
        Self {
            mot,
            plan,
            hold_until_ns,
            actions,
            dropped: answer.dropped.map(Word),
            given_back_ns: answer.given_back_ns,
            decision: answer.decision.map(DecisionAnswer::new),
        }
    }
}

impl DecisionAnswer {
    fn new(decision: Decision) -> Self {
        let verdict = Word(decision.is_safe());
        let Decision { report, tracks, trajectory, brake_by_ns, brake } = decision;
        let (report, error) = match report {
            Ok(report) => (Some(report), None),
            Err(problem) => (None, Some(place(problem))),
        };
        let witness = report.as_ref().and_then(Report::witness);
        let failed_stage = report.as_ref().and_then(|it| it.failed_stage);
        Self {
            verdict,
            failed_stage: failed_stage.map(Word),
            witness: witness.map(WitnessAnswer::new),
            input: report.as_ref().and_then(|it| it.input.clone()).map(place),
            error,
            tracks: tracks.map(VerifiedAnswer::new),
            trajectory: trajectory.map(VerifiedAnswer::new),
            brake_by_ns,
            brake: brake.map(BrakeAnswer::new),
        }
    }
}

impl VerifiedAnswer {
    /// As answers name it.
    pub fn new(verified: Verified) -> Self {
        let Verified { stamp_ns, remote } = verified;
        let (station, session) =
            remote.map_or((0, None), |(station, session)| (station, Some(session)));
        Self { stamp_ns, station, session }
    }
}

impl BrakeAnswer {
    /// As answers name it.
    pub fn new(brake: Brake) -> Self {
        match brake {
            Brake::Failed(stage, witness) => Self::Failed {
                failed_stage: Word(stage),
                witness: witness.map(|it| Box::new(WitnessAnswer::new(&it))),
            },
            Brake::Invalid(problem) => Self::Invalid { input: place(problem) },
            Brake::NoTrajectory => Self::Missing { missing: Word(Input::Trajectory) },
        }
    }
}

fn place(problem: InvalidInput) -> InputProblem {
    InputProblem { field: problem.field, index: problem.index }
}
