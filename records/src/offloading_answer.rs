//! The answer to an offloading trace (`spec/5-interfaces.md#offloading-trace`).

use mufasa_model::offloading::requester::{Action, Group, GroupState, Requester};
use schemars::JsonSchema;
use serde::Serialize;

use crate::record::offloading::Trace;
use crate::record::value::Word;

/// One state per event.
#[derive(Clone, Debug, PartialEq, Eq, JsonSchema, Serialize)]
pub struct OffloadingAnswer {
    /// Id of the record.
    pub id: String,
    /// The states after the events.
    pub states: Vec<StateAnswer>,
}

/// The state after an event, and what the event made the requester do.
#[derive(Clone, Debug, PartialEq, Eq, JsonSchema, Serialize)]
pub struct StateAnswer {
    /// `local`, `requested:N` or `remote:N`.
    pub mot: String,
    /// The same for ENV and TPL.
    pub plan: String,
    /// End of the last hold, ns; `None` before the first.
    pub hold_until_ns: Option<i64>,
    /// Actions in the order in which they are taken.
    pub actions: Vec<ActionAnswer>,
}

/// An action.
#[derive(Clone, Debug, PartialEq, Eq, JsonSchema, Serialize)]
#[serde(untagged)]
pub enum ActionAnswer {
    /// A message to a station.
    Send {
        /// `request` or `release`.
        send: Send,
        /// To whom.
        station: i64,
        /// Of which group.
        group: Word<Group>,
        /// In which session.
        session: i64,
    },
    /// The local services of a group start.
    Activate {
        /// Which group.
        activate: Word<Group>,
    },
    /// The local services of a group stop.
    Deactivate {
        /// Which group.
        deactivate: Word<Group>,
    },
    /// An element is not used.
    Drop {
        /// Of which group.
        drop: Word<Group>,
    },
}

/// A message to a station.
#[derive(Clone, Copy, Debug, PartialEq, Eq, JsonSchema, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Send {
    /// Run a group.
    Request,
    /// The session is over.
    Release,
}

impl OffloadingAnswer {
    /// Runs a requester through the trace with the record id `id`.
    pub fn run(id: String, trace: &Trace) -> Self {
        let mut requester = Requester::new(trace.profile, trace.parameters);
        let states = trace
            .events
            .iter()
            .map(|event| {
                let actions = requester.step(event);
                let groups = [Group::Mot, Group::Plan].map(|group| requester.state(group));
                StateAnswer::new(groups, requester.hold_until_ns(), actions)
            })
            .collect();
        Self { id, states }
    }
}

impl StateAnswer {
    /// The state of MOT and of PLAN, the end of the hold, and the actions.
    pub fn new(
        [mot, plan]: [GroupState; 2],
        hold_until_ns: Option<i64>,
        actions: impl IntoIterator<Item = Action>,
    ) -> Self {
        let actions = actions.into_iter().map(ActionAnswer::new).collect();
        Self { mot: state(mot), plan: state(plan), hold_until_ns, actions }
    }
}

impl ActionAnswer {
    /// As answers name it.
    pub fn new(action: Action) -> Self {
        match action {
            Action::Request { station, group, session } => {
                Self::Send { send: Send::Request, station, group: Word(group), session }
            }
            Action::Release { station, group, session } => {
                Self::Send { send: Send::Release, station, group: Word(group), session }
            }
            Action::Activate(group) => Self::Activate { activate: Word(group) },
            Action::Deactivate(group) => Self::Deactivate { deactivate: Word(group) },
            Action::Drop(group) => Self::Drop { drop: Word(group) },
        }
    }
}

fn state(state: GroupState) -> String {
    match state {
        GroupState::Local => String::from("local"),
        GroupState::Requested { station, .. } => format!("requested:{station}"),
        GroupState::Remote { station, .. } => format!("remote:{station}"),
    }
}
