//! What may happen in the system.

use mufasa_model::offloading::requester::Group;

use super::fit::fitted;
use super::state::{Letter, Message};
use super::stimulus::Named;

/// Something that happens.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Move {
    /// A tick of all clocks; stations notice leases that end.
    TimePasses,
    /// An event at a CAV that is no message from flight; what is forged is delivered at once.
    Event {
        /// At which CAV.
        cav: u8,
        /// Place of the stimulus in the automaton.
        place: u16,
        /// Rank of the session that a forged message names, if anybody still remembers it.
        rank: Option<u8>,
    },
    /// A message arrives; when it is kept, it will arrive again.
    Deliver {
        /// Which.
        message: Message,
        /// Whether a copy stays in flight.
        kept: bool,
    },
    /// A station rejects a request although it has capacity.
    Refuse {
        /// The request.
        message: Message,
    },
    /// A message is lost.
    Lose {
        /// Which.
        message: Message,
    },
    /// A station crashes and returns without memory.
    Crash {
        /// Which: its place, 0 for station 1.
        station: u8,
    },
    /// A CAV sends a sign of life in its running session.
    Alive {
        /// Which CAV.
        cav: u8,
        /// In the session of which group.
        group: Group,
    },
}

impl Letter {
    /// The session that the letter names to a CAV.
    pub fn named(&self) -> Named {
        let station = fitted::<_, u8>(self.station) + 1;
        Named { station, group: self.group(), current: self.rank == 0 }
    }
}
