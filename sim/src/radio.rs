//! The simulated V2X link: bytes that arrive later, or never, or out of order.

use std::collections::BTreeMap;

use crate::services::detectors::random::Draws;

/// How messages travel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// What every message needs, ns.
    pub least_ns: i64,
    /// Mean of what comes on top, ns: exponentially distributed, so that messages overtake each other.
    pub jitter_ns: i64,
    /// Share of the messages that never arrive, in [0, 1].
    pub loss: f64,
}

impl Default for Settings {
    /// As a good link within a cell: 5 ms and 2 ms on top, one message in a thousand lost.
    fn default() -> Self {
        Self { least_ns: 5_000_000, jitter_ns: 2_000_000, loss: 0.001 }
    }
}

/// Whom a message is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum To {
    /// The CAV.
    Vehicle,
    /// The station.
    Station,
}

/// What is on its way.
#[derive(Debug)]
pub struct Radio {
    settings: Settings,
    seed: u64,
    sent: u64,
    /// By arrival and number, so that nothing depends on anything else's order.
    on_the_way: BTreeMap<(i64, u64), (To, Vec<u8>)>,
}

impl Radio {
    /// With nothing on its way.
    pub const fn new(settings: Settings, seed: u64) -> Self {
        Self { settings, seed, sent: 0, on_the_way: BTreeMap::new() }
    }

    /// Sends bytes at a time, ns.
    pub fn send(&mut self, now_ns: i64, to: To, bytes: Vec<u8>) {
        self.sent += 1;
        let mut draws = Draws::new([self.seed, u64::MAX, self.sent, 0]);
        if draws.share() < self.settings.loss {
            return;
        }
        #[expect(
            clippy::cast_precision_loss,
            clippy::cast_possible_truncation,
            reason = "milliseconds"
        )]
        let jitter_ns = (-libm::log(1.0 - draws.share()) * self.settings.jitter_ns as f64) as i64;
        let arrival_ns = now_ns + self.settings.least_ns + jitter_ns;
        self.on_the_way.insert((arrival_ns, self.sent), (to, bytes));
    }

    /// The next message that has arrived by a time, with its arrival, ns.
    pub fn receive(&mut self, now_ns: i64) -> Option<(i64, To, Vec<u8>)> {
        let entry = self.on_the_way.first_entry()?;
        let (arrival_ns, _) = *entry.key();
        (arrival_ns <= now_ns).then(|| {
            let (to, bytes) = entry.remove();
            (arrival_ns, to, bytes)
        })
    }
}
