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
    /// Messages so far: of those who are meant to send, and of others.
    sent: [u64; 2],
    /// By arrival, number and who sends, so that nothing depends on anything else's order.
    on_the_way: BTreeMap<(i64, u64, usize), (To, Vec<u8>)>,
}

impl Radio {
    /// With nothing on its way.
    pub const fn new(settings: Settings, seed: u64) -> Self {
        Self { settings, seed, sent: [0; 2], on_the_way: BTreeMap::new() }
    }

    /// Sends bytes at a time, ns.
    pub fn send(&mut self, now_ns: i64, to: To, bytes: Vec<u8>) {
        self.launch(now_ns, to, bytes, 0);
    }

    /// The same for a message that somebody holds back for so long, ns; none: for ever. The fate of all other messages
    /// stays as it is.
    pub fn hold(&mut self, now_ns: i64, held_ns: Option<i64>, to: To, bytes: Vec<u8>) {
        match held_ns {
            Some(held_ns) => self.launch(now_ns + held_ns, to, bytes, 0),
            None => self.sent[0] += 1,
        }
    }

    /// The same by somebody else, which leaves the fate of all other messages as it is: runs with and
    /// without an attack have the same link.
    pub fn forge(&mut self, now_ns: i64, to: To, bytes: Vec<u8>) {
        self.launch(now_ns, to, bytes, 1);
    }

    fn launch(&mut self, now_ns: i64, to: To, bytes: Vec<u8>, by: usize) {
        self.sent[by] += 1;
        let number = self.sent[by];
        let mut draws = Draws::new([self.seed, u64::MAX, number, u64::from(by > 0)]);
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
        self.on_the_way.insert((arrival_ns, number, by), (to, bytes));
    }

    /// The next message that has arrived by a time, with its arrival, ns.
    pub fn receive(&mut self, now_ns: i64) -> Option<(i64, To, Vec<u8>)> {
        let entry = self.on_the_way.first_entry()?;
        let (arrival_ns, ..) = *entry.key();
        (arrival_ns <= now_ns).then(|| {
            let (to, bytes) = entry.remove();
            (arrival_ns, to, bytes)
        })
    }
}
