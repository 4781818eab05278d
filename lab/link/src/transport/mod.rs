//! How bytes get from one program to the other: over channels of one process, or over a broker.
//!
//! The loops of vehicle and station are plain and synchronous; what waits for sockets stays behind
//! [`Transport`].

pub mod amqp;
pub mod channels;
pub mod disturbed;
pub mod queue;

use std::fmt;
use std::time::Duration;

/// Largest message that is taken, bytes: more than the largest that the formats hold.
pub const MESSAGE_MAX: usize = 65_536;

/// Most messages that wait to be read; of more the oldest are shed.
pub const WAITING_MAX: usize = 256;

/// Where messages go.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Address {
    /// A vehicle by its id, or all of them: 0.
    Vehicle(i64),
    /// A station by its id, or all of them: 0.
    Station(i64),
}

impl Address {
    /// All of the same kind.
    pub fn all(self) -> Self {
        match self {
            Self::Vehicle(_) => Self::Vehicle(0),
            Self::Station(_) => Self::Station(0),
        }
    }
}

impl fmt::Display for Address {
    /// As a routing key of the broker.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Vehicle(id) => write!(f, "vehicle.{id}"),
            Self::Station(id) => write!(f, "station.{id}"),
        }
    }
}

/// What a transport went through.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Health {
    /// Whether there is a connection now.
    pub connected: bool,
    /// Messages that were thrown away because too many waited, or were too long.
    pub shed: u64,
    /// How often it was connected; one that needs no connection is so once.
    pub connections: u64,
    /// Why the last connection failed or ended.
    pub last_error: Option<String>,
}

/// Sends and receives bytes, keeps a bounded number of them, and connects again by itself. Times are
/// those of the shared clock, ns; only what delays on purpose looks at them.
pub trait Transport {
    /// Hands bytes over, to be sent soon or never.
    fn send(&mut self, now_ns: i64, to: Address, bytes: Vec<u8>);

    /// The next bytes that have arrived, without waiting.
    fn receive(&mut self, now_ns: i64) -> Option<Vec<u8>>;

    /// Waits until bytes arrive, at most so long.
    fn wait(&mut self, at_most: Duration);

    /// What it went through so far.
    fn health(&self) -> Health;
}
