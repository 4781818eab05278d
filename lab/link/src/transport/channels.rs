//! Channels within one process: what is sent is there at once.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use super::queue::Queue;
use super::{Address, Health, Transport};

/// Where all meet who talk over channels.
#[derive(Clone, Debug, Default)]
pub struct Hub {
    joined: Arc<Mutex<Vec<(Address, Queue)>>>,
}

/// One of those who talk over a [`Hub`]; several may have the same address, and each then gets all.
#[derive(Debug)]
pub struct Channels {
    hub: Hub,
    inbox: Queue,
}

impl Hub {
    /// From now on what is sent to this address, or to all of its kind, arrives here as well.
    pub fn join(&self, address: Address) -> Channels {
        let inbox = Queue::default();
        inbox.note(|health| (health.connected, health.connections) = (true, 1));
        self.with(|joined| joined.push((address, inbox.clone())));
        Channels { hub: self.clone(), inbox }
    }

    fn with<T>(&self, on: impl FnOnce(&mut Vec<(Address, Queue)>) -> T) -> T {
        on(&mut self.joined.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl Transport for Channels {
    fn send(&mut self, _now_ns: i64, to: Address, bytes: Vec<u8>) {
        self.hub.with(|joined| {
            // Those who left are forgotten.
            joined.retain(|(_, inbox)| !inbox.is_left());
            let heard = joined.iter().filter(|(it, _)| *it == to || it.all() == to);
            heard.for_each(|(_, inbox)| inbox.push(bytes.clone()));
        });
    }

    fn receive(&mut self, _now_ns: i64) -> Option<Vec<u8>> {
        self.inbox.pop()
    }

    fn wait(&mut self, at_most: Duration) {
        self.inbox.wait(at_most);
    }

    fn health(&self) -> Health {
        self.inbox.health()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_reaches_its_address_and_all_of_a_kind_and_nobody_else() {
        let hub = Hub::default();
        let mut station = hub.join(Address::Station(1));
        let [mut first, mut second] = [1, 2].map(|id| hub.join(Address::Vehicle(id)));
        station.send(0, Address::Vehicle(2), vec![2]);
        station.send(0, Address::Vehicle(0), vec![0]);
        first.send(0, Address::Station(1), vec![1]);
        let mut all = |channels: &mut Channels| {
            std::iter::from_fn(|| channels.receive(0)).flatten().collect::<Vec<u8>>()
        };
        let heard = [&mut station, &mut first, &mut second].map(&mut all);
        assert_eq!(heard, [vec![1], vec![0], vec![2, 0]]);
    }

    #[test]
    fn who_left_is_forgotten() {
        let hub = Hub::default();
        let mut station = hub.join(Address::Station(1));
        drop(hub.join(Address::Vehicle(1)));
        station.send(0, Address::Vehicle(1), vec![1]);
        assert_eq!(hub.with(|joined| joined.len()), 1);
    }
}
