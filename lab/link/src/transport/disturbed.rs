//! A transport that delays, repeats, turns round or loses what arrives, for a while and on purpose.

use std::collections::VecDeque;
use std::str::FromStr;
use std::time::Duration;

use thiserror::Error;

use super::{Address, Health, Transport};

/// What happens to what arrives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// It comes so much later, ns.
    Delay {
        /// How much.
        by_ns: i64,
    },
    /// It comes twice.
    Duplicate,
    /// Of two neighbours the later comes first.
    Reorder,
    /// It does not come; nor does what is sent arrive anywhere.
    Cut,
}

/// A fault for a while.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disturbance {
    /// What happens.
    pub fault: Fault,
    /// From when on, s after the first message.
    pub from_s: f64,
    /// Until when, s after the first message.
    pub to_s: f64,
}

/// A disturbance that cannot be read.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error(
    "{text:?} is no disturbance; write delay=MS, duplicate, reorder or cut, and when, in seconds: delay=60@4..6"
)]
pub struct ParseDisturbanceError {
    text: String,
}

impl FromStr for Disturbance {
    type Err = ParseDisturbanceError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        parse(text).ok_or_else(|| ParseDisturbanceError { text: text.to_owned() })
    }
}

fn parse(text: &str) -> Option<Disturbance> {
    let (fault, span) = text.split_once('@')?;
    let fault = match fault.split_once('=') {
        Some(("delay", ms)) => {
            Fault::Delay { by_ns: i64::from(ms.parse::<u32>().ok()?) * 1_000_000 }
        }
        None if fault == "duplicate" => Fault::Duplicate,
        None if fault == "reorder" => Fault::Reorder,
        None if fault == "cut" => Fault::Cut,
        Some(_) | None => return None,
    };
    let (from, to) = span.split_once("..")?;
    let (from_s, to_s): (f64, f64) = (from.parse().ok()?, to.parse().ok()?);
    (0.0 <= from_s && from_s < to_s).then_some(Disturbance { fault, from_s, to_s })
}

/// A transport under disturbances.
#[derive(Debug)]
pub struct Disturbed<T> {
    inner: T,
    disturbances: Vec<Disturbance>,
    /// When its first message was sent or received, ns.
    began_ns: Option<i64>,
    /// What was received and is not yet due, with the time when it is, ns.
    held: VecDeque<(i64, Vec<u8>)>,
    /// The earlier of two that are turned round.
    behind: Option<Vec<u8>>,
}

impl<T: Transport> Disturbed<T> {
    /// Of several disturbances at a time the first one counts.
    pub fn new(inner: T, disturbances: Vec<Disturbance>) -> Self {
        Self { inner, disturbances, began_ns: None, held: VecDeque::new(), behind: None }
    }

    fn fault(&mut self, now_ns: i64) -> Option<Fault> {
        let began_ns = *self.began_ns.get_or_insert(now_ns);
        let s = Duration::from_nanos(now_ns.abs_diff(began_ns)).as_secs_f64();
        let current = self.disturbances.iter().find(|it| (it.from_s..it.to_s).contains(&s));
        current.map(|it| it.fault)
    }

    /// Takes what arrived, and puts it where the fault of this time wants it.
    fn take(&mut self, now_ns: i64, bytes: Vec<u8>) {
        let fault = self.fault(now_ns);
        match fault {
            Some(Fault::Cut) => return,
            Some(Fault::Delay { by_ns }) => {
                self.held.push_back((now_ns.saturating_add(by_ns), bytes));
                return;
            }
            Some(Fault::Reorder) if self.behind.is_none() => {
                self.behind = Some(bytes);
                return;
            }
            Some(Fault::Duplicate) => self.held.push_back((now_ns, bytes.clone())),
            Some(Fault::Reorder) | None => {}
        }
        self.held.push_back((now_ns, bytes));
        if let Some(earlier) = self.behind.take() {
            self.held.push_back((now_ns, earlier));
        }
    }
}

impl<T: Transport> Transport for Disturbed<T> {
    fn send(&mut self, now_ns: i64, to: Address, bytes: Vec<u8>) {
        if self.fault(now_ns) != Some(Fault::Cut) {
            self.inner.send(now_ns, to, bytes);
        }
    }

    fn receive(&mut self, now_ns: i64) -> Option<Vec<u8>> {
        while self.held.len() < super::WAITING_MAX
            && let Some(bytes) = self.inner.receive(now_ns)
        {
            self.take(now_ns, bytes);
        }
        let due = self.held.iter().position(|(due_ns, _)| *due_ns <= now_ns)?;
        self.held.remove(due).map(|(_, bytes)| bytes)
    }

    fn wait(&mut self, at_most: Duration) {
        // What is held may be due before anything else arrives.
        let at_most = if self.held.is_empty() { at_most } else { at_most.min(MILLISECOND) };
        self.inner.wait(at_most);
    }

    fn health(&self) -> Health {
        self.inner.health()
    }
}

const MILLISECOND: Duration = Duration::from_millis(1);

#[cfg(test)]
mod tests {
    use super::super::channels::Hub;
    use super::*;

    const MS: i64 = 1_000_000;

    /// What of the messages 1, 2, 3, each sent and looked for at these times, ms, arrives when.
    fn arrivals(disturbance: &str, at_ms: [i64; 3]) -> Vec<(i64, u8)> {
        let hub = Hub::default();
        let mut sender = hub.join(Address::Station(1));
        let disturbances = vec![disturbance.parse().unwrap()];
        let mut receiver = Disturbed::new(hub.join(Address::Vehicle(1)), disturbances);
        let mut seen = Vec::new();
        assert_eq!(receiver.receive(0), None);
        receiver.send(0, Address::Station(2), vec![]);
        for now_ms in 0..=200 {
            for (number, sent_ms) in (1_u8..).zip(at_ms) {
                if sent_ms == now_ms {
                    sender.send(now_ms * MS, Address::Vehicle(1), vec![number]);
                }
            }
            while let Some(bytes) = receiver.receive(now_ms * MS) {
                seen.push((now_ms, bytes[0]));
            }
        }
        seen
    }

    #[test]
    fn each_fault_does_what_its_name_says_and_ends() {
        let at_ms = [10, 20, 150];
        assert_eq!(arrivals("delay=60@0..0.1", at_ms), [(70, 1), (80, 2), (150, 3)]);
        assert_eq!(arrivals("duplicate@0..0.015", at_ms), [(10, 1), (10, 1), (20, 2), (150, 3)]);
        assert_eq!(arrivals("reorder@0..0.1", at_ms), [(20, 2), (20, 1), (150, 3)]);
        assert_eq!(arrivals("cut@0..0.1", at_ms), [(150, 3)]);
        assert_eq!(arrivals("cut@1..2", at_ms), [(10, 1), (20, 2), (150, 3)]);
    }

    #[test]
    fn what_is_no_disturbance_is_refused() {
        for text in [
            "",
            "delay@0..1",
            "delay=-1@0..1",
            "cut",
            "cut@1..1",
            "cut@1..0",
            "cut=3@0..1",
            "cut@nan..1",
            "lose@0..1",
        ] {
            let error = text.parse::<Disturbance>().unwrap_err();
            assert!(error.to_string().contains("is no disturbance"), "{text}");
        }
    }
}
