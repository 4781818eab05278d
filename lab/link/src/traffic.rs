//! What went to and fro, counted by a vehicle and by a station alike.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Serialize;

use crate::message::{DecodeError, EncodeError, Payload};
use crate::transport::Health;

/// How often each of something happened, by its name.
pub type Counts = BTreeMap<String, u64>;

/// Messages, and the transport below them.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Traffic {
    /// Messages that were sent, by kind.
    pub sent: Counts,
    /// Messages that could not be written, by kind and field.
    pub unsent: Counts,
    /// Messages that could be read, by kind.
    pub received: Counts,
    /// What of that was not used: results with the reason of the monitor, such as `tracks: latency above
    /// l_max`; messages for others.
    pub dropped: Counts,
    /// Bytes that are no message, by what is wrong.
    pub malformed: Counts,
    /// Messages that the transport threw away: too many waited, or too long.
    pub shed: u64,
    /// Connections of the transport.
    pub connections: u64,
    /// Why the last connection failed or ended.
    pub last_error: Option<String>,
}

impl Traffic {
    pub(crate) fn sent(&mut self, payload: &Payload) {
        add(&mut self.sent, kind(payload));
    }

    pub(crate) fn unsent(&mut self, payload: &Payload, error: &EncodeError) {
        add(&mut self.unsent, &format!("{}: {}", kind(payload), error.place.field));
    }

    pub(crate) fn received(&mut self, payload: &Payload) {
        add(&mut self.received, kind(payload));
    }

    pub(crate) fn dropped(&mut self, what: &str) {
        add(&mut self.dropped, what);
    }

    /// By the kind of the error: the name of its variant.
    pub(crate) fn malformed(&mut self, error: &DecodeError) {
        let text = format!("{error:?}");
        let variant = text.split(|c: char| !c.is_alphanumeric()).next().unwrap_or_default();
        add(&mut self.malformed, variant);
    }

    /// What the transport went through in all.
    pub(crate) fn health(&mut self, health: Health) {
        let Health { shed, connections, last_error, connected: _ } = health;
        (self.shed, self.connections, self.last_error) = (shed, connections, last_error);
    }
}

/// Counts one more. What can be counted has few names, whatever is received.
pub(crate) fn add(counts: &mut Counts, name: &str) {
    *counts.entry(name.to_owned()).or_default() += 1;
}

/// The name of what a message says.
fn kind(payload: &Payload) -> &'static str {
    match payload {
        Payload::Offer { .. } => "offer",
        Payload::Withdraw => "withdraw",
        Payload::Confirm { .. } => "confirm",
        Payload::Reject { .. } => "reject",
        Payload::Tracks { .. } => "tracks",
        Payload::Trajectory { .. } => "trajectory",
        Payload::Request { .. } => "request",
        Payload::Release { .. } => "release",
        Payload::Alive { .. } => "alive",
        Payload::State { .. } => "state",
        Payload::Detections { .. } => "detections",
    }
}
