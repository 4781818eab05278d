//! Messages that wait to be read: a bounded number.

use std::collections::VecDeque;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use super::{Health, MESSAGE_MAX, WAITING_MAX};

/// A queue that several threads share. When it is full the oldest message is shed: of results the
/// newest is the one that is worth something.
#[derive(Clone, Debug, Default)]
pub struct Queue {
    shared: Arc<Shared>,
}

#[derive(Debug, Default)]
struct Shared {
    state: Mutex<State>,
    arrived: Condvar,
}

#[derive(Debug, Default)]
struct State {
    waiting: VecDeque<Vec<u8>>,
    health: Health,
}

impl Queue {
    /// Puts a message at the end; one above [`MESSAGE_MAX`] is shed.
    pub fn push(&self, bytes: Vec<u8>) {
        let mut state = self.state();
        if bytes.len() > MESSAGE_MAX {
            state.health.shed += 1;
            return;
        }
        if state.waiting.len() >= WAITING_MAX {
            state.waiting.pop_front();
            state.health.shed += 1;
        }
        state.waiting.push_back(bytes);
        self.shared.arrived.notify_all();
    }

    /// Takes the message at the front.
    pub fn pop(&self) -> Option<Vec<u8>> {
        self.state().waiting.pop_front()
    }

    /// Waits until there is a message, at most so long.
    pub fn wait(&self, at_most: Duration) {
        let is_empty = |state: &mut State| state.waiting.is_empty();
        // Whether the time is over or a message came, the caller looks for itself.
        drop(self.shared.arrived.wait_timeout_while(self.state(), at_most, is_empty));
    }

    /// What happened to it, and to the connection that feeds it.
    pub fn health(&self) -> Health {
        self.state().health.clone()
    }

    /// Notes what happened to the connection that feeds it.
    pub fn note(&self, note: impl FnOnce(&mut Health)) {
        note(&mut self.state().health);
    }

    /// Whether nobody else has this queue any more.
    pub(super) fn is_left(&self) -> bool {
        Arc::strong_count(&self.shared) == 1
    }

    /// A panic of another thread leaves a queue that can be used.
    fn state(&self) -> MutexGuard<'_, State> {
        self.shared.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flood_sheds_the_oldest_and_counts_them() {
        let queue = Queue::default();
        let most = u32::try_from(WAITING_MAX).unwrap();
        (0..most + 3).for_each(|number| queue.push(number.to_le_bytes().to_vec()));
        assert_eq!(queue.pop(), Some(3_u32.to_le_bytes().to_vec()));
        assert_eq!(queue.health().shed, 3);
        assert_eq!(std::iter::from_fn(|| queue.pop()).count(), WAITING_MAX - 1);
    }

    #[test]
    fn what_is_too_long_is_shed() {
        let queue = Queue::default();
        queue.push(vec![0; MESSAGE_MAX]);
        queue.push(vec![0; MESSAGE_MAX + 1]);
        assert_eq!(queue.pop().map(|bytes| bytes.len()), Some(MESSAGE_MAX));
        assert_eq!((queue.pop(), queue.health().shed), (None, 1));
    }
}
