//! The offloading trace (`spec/5-interfaces.md#offloading-trace`).

use mufasa_model::input::profile::Profile;
use mufasa_model::offloading::requester as model;
use mufasa_model::report::InvalidInput;
use mufasa_model::services::configuration::{Group, Groups};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::cycle::hardened;
use super::event::{bounded, events, given};
use super::parameters::ProtocolParameters;
use super::value::{Integer, Word};
use super::{Recorded, record};

/// What one requester lives through.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Trace {
    /// Profile in force.
    pub profile: Profile,
    /// Parameters in force.
    pub parameters: model::Parameters,
    /// Events in order.
    pub events: Vec<model::Event>,
}

#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "a word")]
pub enum OffloadingKind {
    #[default]
    Offloading,
}

record! {
    /// What one requester lives through.
    Offloading = Trace {
        /// Hardened when it is absent.
        #[serde(default = "hardened")]
        profile: Word<Profile>,
        /// Defaults where they are absent.
        #[serde(default)]
        parameters: ProtocolParameters,
        /// Events in order.
        #[serde(deserialize_with = "bounded")]
        events: Vec<Event>,
    } + {
        /// The kind of the record.
        kind: OffloadingKind,
        /// Names the record in its answer.
        id: String,
    }
}

record! {
    /// For each group whose data a cycle used, the session they came from.
    Sessions = model::Sessions {
        /// That of MOT; absent when no remote tracks were used.
        #[serde(default, deserialize_with = "given", skip_serializing_if = "Option::is_none")]
        mot: Option<Integer>,
        /// That of PLAN; absent when no remote trajectory was used.
        #[serde(default, deserialize_with = "given", skip_serializing_if = "Option::is_none")]
        plan: Option<Integer>,
    }
}

impl Offloading {
    /// The record of a trace with all its parameters, those at their default too: it stays what it
    /// is when defaults change.
    pub fn whole(id: &str, trace: &Trace) -> Self {
        let mut record = Self { id: id.to_owned(), ..Self::of_model(trace) };
        record.parameters.whole = true;
        record
    }
}

impl TryFrom<Offloading> for Trace {
    type Error = InvalidInput;

    /// Errors: times outside their domain.
    fn try_from(record: Offloading) -> Result<Self, InvalidInput> {
        record.parameters.clone().check()?;
        Ok(record.into_model())
    }
}

/// Groups; one that is named twice counts once.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(transparent)]
#[schemars(inline)]
pub struct GroupList(Vec<Word<Group>>);

impl Recorded for GroupList {
    type Model = Groups;

    fn into_model(self) -> Groups {
        self.0.into_iter().map(|Word(group)| group).collect()
    }

    fn of_model(model: &Groups) -> Self {
        Self(Group::ALL.into_iter().filter(|it| model.contains(*it)).map(Word).collect())
    }
}

events! {
    "Event": "What happens at the requester."
    fields {
        station: Integer<1>,
        group: Word<Group>,
        session: Integer,
        generated_ns: Integer,
        verdict: Word<bool>,
        groups: GroupList,
        sessions: Sessions,
    }
    Offer = "offer" { station: Integer<1>, groups: GroupList }
    Withdraw = "withdraw" { station: Integer<1> }
    Lost = "lost" { station: Integer<1> }
    Area = "area" { groups: GroupList }
    Tick = "tick" {}
    Confirm = "confirm" { station: Integer<1>, group: Word<Group>, session: Integer }
    Reject = "reject" { station: Integer<1>, group: Word<Group>, session: Integer }
    Data = "data" { station: Integer<1>, group: Word<Group>, session: Integer, generated_ns: Integer }
    Verdict = "verdict" (verdict: Word<bool> as safe) { sessions: Sessions }
}
