//! The answer to an offloading trace (`spec/5-interfaces.md#offloading-trace`).

use mufasa_model::offloading::requester::{Action, Group, GroupState, Requester};
use schemars::JsonSchema;
use serde::Serialize;

use crate::names;
use crate::offloading::Trace;
use crate::schema::{self, words};

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
        #[schemars(with = "words::Send")]
        send: &'static str,
        /// To whom.
        station: i64,
        /// Of which group.
        #[schemars(with = "schema::record::Group")]
        group: &'static str,
        /// In which session.
        session: i64,
    },
    /// The local services of a group start.
    Activate {
        /// Which group.
        #[schemars(with = "schema::record::Group")]
        activate: &'static str,
    },
    /// The local services of a group stop.
    Deactivate {
        /// Which group.
        #[schemars(with = "schema::record::Group")]
        deactivate: &'static str,
    },
    /// An element is not used.
    Drop {
        /// Of which group.
        #[schemars(with = "schema::record::Group")]
        drop: &'static str,
    },
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
                StateAnswer {
                    mot: state(requester.state(Group::Mot)),
                    plan: state(requester.state(Group::Plan)),
                    hold_until_ns: requester.hold_until_ns(),
                    actions: actions.into_iter().map(ActionAnswer::new).collect(),
                }
            })
            .collect();
        Self { id, states }
    }
}

impl ActionAnswer {
    fn new(action: Action) -> Self {
        match action {
            Action::Request { station, group, session } => {
                Self::Send { send: "request", station, group: names::group(group), session }
            }
            Action::Release { station, group, session } => {
                Self::Send { send: "release", station, group: names::group(group), session }
            }
            Action::Activate(group) => Self::Activate { activate: names::group(group) },
            Action::Deactivate(group) => Self::Deactivate { deactivate: names::group(group) },
            Action::Drop(group) => Self::Drop { drop: names::group(group) },
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
