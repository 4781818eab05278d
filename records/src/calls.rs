//! The log of a loop around a monitor, line by line (`docs/safety-manual.md#the-test-of-the-loop`).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::error::LineError;
use crate::monitor_answer::VerifiedAnswer;
use crate::record::event::given;
use crate::record::monitor::{Event, Monitor};
use crate::typed::from_json;

/// A line of the log.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields, rename_all = "snake_case")]
pub enum Line {
    /// A monitor was made.
    Made(Box<Made>),
    /// A call of it.
    Call(Box<Call>),
    /// From now on control does something else.
    Control {
        /// When.
        t_ns: i64,
        /// What it does.
        follows: Follows,
    },
}

/// With what a monitor was made.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Made {
    /// Its settings, its memory and its route, without events.
    pub record: Monitor,
    /// `check_time`.
    pub check_time_ns: u64,
    /// `step_ps`.
    pub step_ps: u64,
    /// `meant`.
    #[serde(default)]
    pub meant: u32,
    /// Places of its table of stations.
    #[serde(default = "stations")]
    pub stations: usize,
}

const fn stations() -> usize {
    256
}

/// A call of a monitor.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Call {
    /// What the monitor was told.
    pub event: Event,
    /// Who sent it, as the message itself says; of an event that comes from a station.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sender: Option<Sender>,
    /// How long the call took.
    pub took_ns: u64,
    /// What the loop took of the answer: members of a state of a monitor's answer.
    pub answer: Value,
    /// What it got when it asked for advice; absent: it did not ask.
    #[serde(default, deserialize_with = "given", skip_serializing_if = "Option::is_none")]
    pub advice: Option<Option<String>>,
}

/// Who sent a message.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Eq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Sender {
    /// The station.
    pub station: i64,
    /// The session, of a message that names one.
    pub session: Option<i64>,
}

/// What control does.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Eq, Serialize)]
#[serde(deny_unknown_fields, rename_all = "snake_case")]
pub enum Follows {
    /// It follows a plan of the CAV's own planner that came out of no cycle.
    OwnPlan,
    /// It brakes with at least `a_b`.
    Brakes,
    /// It follows a trajectory that came out of a cycle.
    Verified(VerifiedAnswer),
}

impl Sender {
    /// As it is handed over with an event; of none that comes from no station.
    pub fn handed(event: &Value) -> Option<Self> {
        let named = |key| event.get(key).and_then(Value::as_i64);
        let station = named("station").filter(|_| event["type"] != "lost")?;
        Some(Self { station, session: named("session") })
    }
}

impl Line {
    /// The line of this number (from 1). Errors: it is none.
    pub fn parse(text: &str, number: usize) -> Result<Self, LineError> {
        from_json(text).map_err(|problem| LineError::new(number, None, problem))
    }
}
