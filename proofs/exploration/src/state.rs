//! A state of the whole system, and how it is packed into 128 bits.
//!
//! Numbers of sessions are kept by rank. For one CAV, group and station the current session (the
//! one that the CAV has requested there or that runs there) has rank 0, the ended ones that a
//! message or the station still remembers have ranks 1, 2, ... from the newest. That is enough:
//! numbers are only compared with others of the same CAV, group and station, for order and
//! equality, and a new one is above all.
//!
//! Beside the parts a state holds what an observer from outside remembers, so that no property
//! is judged by what a part believes of itself.

use mufasa_model::offloading::requester::Group;

use super::bounds::{IN_FLIGHT, REQUESTERS, STATIONS, World};
use super::fit::fitted;

/// A state of the system.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct State {
    /// The CAVs; those that the world does not have are all zero.
    pub cavs: [Cav; REQUESTERS],
    /// The stations, in the order of their ids; those that the world does not have are all zero.
    pub stations: [Station; STATIONS],
    /// The messages in flight, without repetition, descending; free places come last.
    pub flight: [Message; IN_FLIGHT],
}

impl State {
    /// The state without what the observer remembers.
    #[must_use]
    pub fn parts(mut self) -> Self {
        for cav in &mut self.cavs {
            *cav = Cav { id: cav.id, ..Cav::default() };
        }
        for station in &mut self.stations {
            station.unheard = Default::default();
        }
        self
    }
}

/// A CAV.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cav {
    /// State of its requester, in the automaton.
    pub id: u32,
    /// Observed: bit 0 to 2, whether the local MOT, ENV, TPL were stopped.
    pub stopped: u8,
    /// Observed: ticks until the last safety issue allows offloading again.
    pub blocked: u8,
    /// Observed, of MOT and PLAN.
    pub proof: [Proof; 2],
}

/// What is known of the running session of a group.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Proof {
    /// No result of it was used, or none runs.
    #[default]
    None,
    /// A result was used.
    Used,
    /// A result was in a safe cycle.
    Safe,
}

/// A station.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Station {
    /// State of its provider, in the automaton.
    pub id: u32,
    /// By CAV and group: 1 + rank of the session that it runs; 0 for none.
    pub runs: [[u8; 2]; REQUESTERS],
    /// Observed, by CAV and group: ticks since a message of the running session came in, at most
    /// the lease.
    pub unheard: [[u8; 2]; REQUESTERS],
}

/// What a message says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// To a station.
    Request,
    /// To a station.
    Release,
    /// To a station: a sign of life.
    Alive,
    /// To a CAV.
    Confirm,
    /// To a CAV.
    Reject,
}

impl Kind {
    /// Whether it goes to a station, else to a CAV.
    pub fn is_to_station(self) -> bool {
        match self {
            Self::Request | Self::Release | Self::Alive => true,
            Self::Confirm | Self::Reject => false,
        }
    }

    const ALL: [Self; 5] = [Self::Request, Self::Release, Self::Alive, Self::Confirm, Self::Reject];
}

/// A message in flight, or a free place (0).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Message(u16);

/// A message taken apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Letter {
    /// What it says.
    pub kind: Kind,
    /// From or to this station: its place, 0 for station 1.
    pub station: usize,
    /// To or from this CAV.
    pub cav: usize,
    /// Of this group: 0 MOT, 1 PLAN.
    pub group: usize,
    /// Of the session of this rank.
    pub rank: u8,
}

impl Letter {
    /// The group.
    pub fn group(&self) -> Group {
        Group::ALL[self.group]
    }
}

const MESSAGE_BITS: u32 = 10;

impl Message {
    /// The message.
    pub fn new(letter: Letter) -> Self {
        let Letter { kind, station, cav, group, rank } = letter;
        let fields = [kind as usize + 1, station, cav, group, usize::from(rank)];
        let packed = fields.into_iter().zip([3, 2, 1, 1, 3]).fold(0, |packed, (field, bits)| {
            debug_assert!(field < 1 << bits);
            packed << bits | field
        });
        Self(fitted(packed))
    }

    /// What it says; `None` for a free place.
    pub fn letter(self) -> Option<Letter> {
        let field = |shift: u32, bits: u32| usize::from(self.0 >> shift) & ((1 << bits) - 1);
        let kind = *Kind::ALL.get(field(7, 3).checked_sub(1)?)?;
        let rank = fitted(field(0, 3));
        Some(Letter { kind, station: field(5, 2), cav: field(4, 1), group: field(3, 1), rank })
    }
}

/// Widths of the fields of the packed states of a world.
#[derive(Clone, Copy, Debug)]
pub struct Layout {
    requesters: usize,
    stations: usize,
    in_flight: usize,
    cav_bits: u32,
    station_bits: [u32; STATIONS],
    blocked_bits: u32,
    unheard_bits: u32,
}

const RANK_BITS: u32 = 3;

impl Layout {
    /// For automata of these sizes. A state has to fit into 128 bits.
    pub fn new(world: &World, cav_states: usize, station_states: &[usize]) -> Self {
        let mut station_bits = [0; STATIONS];
        for (bits, states) in station_bits.iter_mut().zip(station_states) {
            *bits = width(*states);
        }
        let values = |most: i64| width(fitted::<_, usize>(most) + 1);
        let layout = Self {
            requesters: world.requesters,
            stations: world.stations.len(),
            in_flight: world.in_flight,
            cav_bits: width(cav_states),
            station_bits,
            blocked_bits: values(world.ticks.t_wait),
            unheard_bits: values(world.ticks.lease),
        };
        fit_into_128(layout.bits(), world.name);
        layout
    }

    /// Bits of a state.
    pub fn bits(&self) -> u32 {
        let times = |count: usize, bits: u32| fitted::<_, u32>(count) * bits;
        let session = times(self.requesters * 2, RANK_BITS + self.unheard_bits);
        times(self.requesters, self.cav_bits + 3 + self.blocked_bits + 4)
            + self.station_bits.iter().sum::<u32>()
            + times(self.stations, session)
            + times(self.in_flight, MESSAGE_BITS)
    }

    /// The state in 128 bits. Different states differ in them.
    pub fn pack(&self, state: &State) -> u128 {
        let mut packed = 0;
        let mut put = |value: u32, bits: u32| packed = packed << bits | u128::from(value);
        for cav in &state.cavs[..self.requesters] {
            put(cav.id, self.cav_bits);
            put(cav.stopped.into(), 3);
            put(cav.blocked.into(), self.blocked_bits);
            cav.proof.iter().for_each(|proof| put(*proof as u32, 2));
        }
        for (station, bits) in state.stations[..self.stations].iter().zip(self.station_bits) {
            put(station.id, bits);
            for cav in 0..self.requesters {
                for group in 0..2 {
                    put(station.runs[cav][group].into(), RANK_BITS);
                    put(station.unheard[cav][group].into(), self.unheard_bits);
                }
            }
        }
        state.flight[..self.in_flight].iter().for_each(|it| put(it.0.into(), MESSAGE_BITS));
        packed
    }

    /// The state again.
    pub fn unpack(&self, packed: u128) -> State {
        let mut state = State::default();
        let mut shift = self.bits();
        let mut take = |bits: u32| {
            shift -= bits;
            fitted::<_, u32>(packed >> shift & ((1 << bits) - 1))
        };
        for cav in &mut state.cavs[..self.requesters] {
            cav.id = take(self.cav_bits);
            cav.stopped = fitted(take(3));
            cav.blocked = fitted(take(self.blocked_bits));
            cav.proof = [(); 2].map(|()| match take(2) {
                0 => Proof::None,
                1 => Proof::Used,
                _ => Proof::Safe,
            });
        }
        for (station, bits) in state.stations[..self.stations].iter_mut().zip(self.station_bits) {
            station.id = take(bits);
            for cav in 0..self.requesters {
                for group in 0..2 {
                    station.runs[cav][group] = fitted(take(RANK_BITS));
                    station.unheard[cav][group] = fitted(take(self.unheard_bits));
                }
            }
        }
        for message in &mut state.flight[..self.in_flight] {
            *message = Message(fitted(take(MESSAGE_BITS)));
        }
        state
    }
}

fn fit_into_128(bits: u32, world: &str) {
    assert!(bits <= 128, "the states of the world {world} have {bits} bits");
}

/// Bits for so many values.
fn width(values: usize) -> u32 {
    values.saturating_sub(1).checked_ilog2().map_or(0, |log| log + 1)
}
