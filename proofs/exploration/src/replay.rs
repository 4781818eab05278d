//! The system with real numbers and real times: every trace of the exploration can be walked
//! here, by the model's requester, the implementation's and the model's provider.
//!
//! It is written beside `system.rs` on purpose: at each step its state, packed, has to be the one
//! that was explored, so each is a check of the other.

use std::fmt;

use mufasa_model::offloading::provider::{Provider, ProviderEvent, ProviderEventKind, Reply};
use mufasa_model::offloading::requester::{Action, Event, EventKind, Group, GroupState};

use super::automaton::Part;
use super::cav::CavPart;
use super::fit::fitted;
use super::moves::Move;
use super::state::{Kind, Letter, Message, State};
use super::station::{StationPart, provider_event};
use super::stimulus::Named;
use super::system::System;
use mufasa_props::refine::{Difference, Pair};

/// A number that no request ever has, for forged messages.
const NEVER_ASKED: i64 = 0;

/// The system on its way.
#[derive(Clone, Debug)]
pub struct Replay<'a> {
    system: &'a System,
    now_ns: i64,
    cavs: Vec<Pair>,
    providers: Vec<Provider>,
    flight: Vec<Post>,
}

/// A message with its real number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Post {
    /// What it says.
    pub kind: Kind,
    /// Id of the station that sends or gets it.
    pub station: i64,
    /// The CAV that gets or sends it, from 0.
    pub cav: usize,
    /// Of which group.
    pub group: Group,
    /// Of which session.
    pub session: i64,
}

/// What happened in a step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Episode {
    /// When, ns.
    pub t_ns: i64,
    /// What.
    pub what: What,
    /// What the CAV did, if it was one.
    pub actions: Vec<Action>,
    /// The CAVs afterwards.
    pub cavs: Vec<Look>,
}

/// What happens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum What {
    /// Time passes, up to the time of the episode.
    Time,
    /// An event at a CAV; `post` is the message that arrived, unless it was forged or none.
    AtCav {
        /// Which CAV.
        cav: usize,
        /// The event.
        event: Event,
        /// The message.
        post: Option<Post>,
    },
    /// A message arrives at a station.
    AtStation(Post),
    /// A message is lost.
    Lost(Post),
    /// A station crashes and returns.
    Crash {
        /// Its id.
        station: i64,
    },
    /// A CAV sends a sign of life.
    Alive {
        /// Which CAV.
        cav: usize,
    },
}

/// A CAV as seen from outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Look {
    /// MOT and PLAN.
    pub groups: [GroupState; 2],
    /// Whether their local services compute.
    pub computes: [bool; 2],
    /// End of the last hold, ns.
    pub hold_until_ns: Option<i64>,
}

/// Why a trace cannot be walked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ReplayError {
    /// Model and implementation differ.
    Difference(Box<Difference>),
    /// The move cannot happen here.
    Impossible(Move),
    /// After the move the state is another than the one explored.
    OtherState(Move),
}

impl fmt::Display for ReplayError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Difference(difference) => difference.fmt(f),
            Self::Impossible(by) => write!(f, "{by:?} cannot happen here"),
            Self::OtherState(by) => write!(f, "{by:?} leads to a state that was not explored"),
        }
    }
}

impl std::error::Error for ReplayError {}

impl From<Box<Difference>> for ReplayError {
    fn from(difference: Box<Difference>) -> Self {
        Self::Difference(difference)
    }
}

/// Walks a trace from the start, at 0 ns, one tick being 1 ns, beside the explored system. Errors:
/// model and implementation differ, a move cannot happen, or the states differ.
pub fn walk(system: &System, trace: &[Move]) -> Result<Vec<Episode>, ReplayError> {
    let (mut replay, mut state) = (Replay::new(system, 0)?, system.start());
    let walk = trace.iter().map(|by| {
        let episode = replay.go(*by)?;
        state = system.apply(&state, *by).ok_or(ReplayError::Impossible(*by))?.state;
        let same = replay.state() == Some(state.parts());
        same.then_some(episode).ok_or(ReplayError::OtherState(*by))
    });
    walk.collect()
}

impl<'a> Replay<'a> {
    /// The start, at this time. Errors: the implementation refuses the parameters.
    pub fn new(system: &'a System, now_ns: i64) -> Result<Self, ReplayError> {
        let world = system.world();
        let pair = Pair::new(system.profile(), world.parameters())?;
        let provider = |capacity| Provider::new(capacity, world.ticks.lease);
        Ok(Self {
            system,
            now_ns,
            cavs: vec![pair; world.requesters],
            providers: world.stations.iter().map(|it| provider(it.capacity)).collect(),
            flight: Vec::new(),
        })
    }

    /// Makes a move.
    pub fn go(&mut self, by: Move) -> Result<Episode, ReplayError> {
        let mut episode =
            Episode { t_ns: self.now_ns, what: What::Time, actions: Vec::new(), cavs: Vec::new() };
        let impossible = || ReplayError::Impossible(by);
        match by {
            Move::TimePasses => {
                self.now_ns += 1;
                episode.t_ns = self.now_ns;
                for provider in &mut self.providers {
                    let kind = ProviderEventKind::Tick;
                    provider.step(&ProviderEvent { t_ns: self.now_ns, kind });
                }
            }
            Move::Event { cav, place, rank } => {
                let stimulus = self.system.requesters().stimuli()[usize::from(place)];
                let number = |named| self.session(cav.into(), named, rank);
                let kind = stimulus.event(self.now_ns, number).ok_or_else(impossible)?;
                self.at_cav(cav.into(), kind, None, &mut episode)?;
            }
            Move::Deliver { message, kept } => {
                let post = self.take(message, kept).ok_or_else(impossible)?;
                self.arrive(post, &mut episode)?;
            }
            Move::Refuse { message } => {
                let post = self.take(message, false).ok_or_else(impossible)?;
                episode.what = What::AtStation(post);
                self.send(Post { kind: Kind::Reject, ..post });
            }
            Move::Lose { message } => {
                episode.what = What::Lost(self.take(message, false).ok_or_else(impossible)?);
            }
            Move::Crash { station } => {
                let world = self.system.world();
                let capacity = world.stations[usize::from(station)].capacity;
                self.providers[usize::from(station)] = Provider::new(capacity, world.ticks.lease);
                episode.what = What::Crash { station: i64::from(station) + 1 };
            }
            Move::Alive { cav, group } => {
                let cav = usize::from(cav);
                let GroupState::Remote { station, session } = self.cavs[cav].model().state(group)
                else {
                    return Err(impossible());
                };
                episode.what = What::Alive { cav };
                self.send(Post { kind: Kind::Alive, station, cav, group, session });
            }
        }
        episode.cavs = self.cavs.iter().map(look).collect();
        Ok(episode)
    }

    /// The state as the exploration keeps it, without what the observer remembers. `None`: a part
    /// is like none that was explored.
    pub fn state(&self) -> Option<State> {
        let (world, mut state) = (self.system.world(), State::default());
        for (cav, pair) in state.cavs.iter_mut().zip(&self.cavs) {
            let mut part = CavPart::standing_for(world, pair.clone(), self.now_ns);
            cav.id = self.system.requesters().id(&part.likeness())?;
        }
        for (place, provider) in self.providers.iter().enumerate() {
            let (capacity, lease) = (world.stations[place].capacity, world.ticks.lease);
            let mut part =
                StationPart::standing_for(provider.clone(), self.now_ns, capacity, lease);
            state.stations[place].id = self.system.providers()[place].id(&part.likeness())?;
            for cav in 0..world.requesters {
                for group in Group::ALL {
                    let session = provider.session(requester(cav), group);
                    let rank = session.map(|it| self.rank(cav, group, station_id(place), it));
                    state.stations[place].runs[cav][group as usize] = rank.map_or(0, |it| it + 1);
                }
            }
        }
        for (message, post) in state.flight.iter_mut().zip(&self.flight) {
            *message = self.message(post);
        }
        state.flight.sort_unstable_by(|one, other| other.cmp(one));
        Some(state)
    }

    /// The real number of the session that a message names: the current one, an ended one of this
    /// rank, or one that never was.
    fn session(&self, cav: usize, named: Named, rank: Option<u8>) -> Option<i64> {
        let Named { station, group, current } = named;
        match rank {
            _ if current => self.current(cav, group).map(|(_, session)| session),
            None => Some(NEVER_ASKED),
            Some(rank) => {
                let mut known = self.numbers(cav, group, station.into()).into_iter();
                known.find(|it| self.rank(cav, group, station.into(), *it) == rank)
            }
        }
    }

    fn at_cav(
        &mut self,
        cav: usize,
        kind: EventKind,
        post: Option<Post>,
        episode: &mut Episode,
    ) -> Result<(), ReplayError> {
        let event = Event { t_ns: self.now_ns, kind };
        let known = |replay: &Self, group, station, session| {
            replay.numbers(cav, group, station).contains(&session)
                || replay.current(cav, group) == Some((station, session))
                || post.is_some_and(|it| it.session == session)
        };
        let before = self.clone();
        episode.actions = self.cavs[cav].step(&event)?;
        episode.what = What::AtCav { cav, event, post };
        for action in episode.actions.clone() {
            match action {
                Action::Request { station, group, session } => {
                    self.send(Post { kind: Kind::Request, station, cav, group, session });
                }
                // As in the exploration, a number that the station was never told is not kept.
                Action::Release { station, group, session }
                    if known(&before, group, station, session) =>
                {
                    self.send(Post { kind: Kind::Release, station, cav, group, session });
                }
                Action::Release { .. }
                | Action::Activate(_)
                | Action::Deactivate(_)
                | Action::Drop(_) => {}
            }
        }
        Ok(())
    }

    fn arrive(&mut self, post: Post, episode: &mut Episode) -> Result<(), ReplayError> {
        let Post { kind, station, cav, group, session } = post;
        let requester = requester(cav);
        let Some(kind) = provider_event(kind, requester, group, session) else {
            let kind = match kind {
                Kind::Confirm => EventKind::Confirm { station, group, session },
                _ => EventKind::Reject { station, group, session },
            };
            return self.at_cav(cav, kind, Some(post), episode);
        };
        episode.what = What::AtStation(post);
        let provider = &mut self.providers[place(station)];
        let kind = match provider.step(&ProviderEvent { t_ns: self.now_ns, kind }) {
            None => return Ok(()),
            Some(Reply::Confirm { .. }) => Kind::Confirm,
            Some(Reply::Reject { .. }) => Kind::Reject,
        };
        self.send(Post { kind, ..post });
        Ok(())
    }

    /// It is lost where the network has no place for it.
    fn send(&mut self, post: Post) {
        if !self.flight.contains(&post) && self.flight.len() < self.system.world().in_flight {
            self.flight.push(post);
        }
    }

    fn take(&mut self, message: Message, kept: bool) -> Option<Post> {
        let place = self.flight.iter().position(|post| self.message(post) == message)?;
        Some(if kept { self.flight[place] } else { self.flight.remove(place) })
    }

    fn message(&self, post: &Post) -> Message {
        let Post { kind, station, cav, group, session } = *post;
        let rank = self.rank(cav, group, station, session);
        Message::new(Letter { kind, station: place(station), cav, group: group as usize, rank })
    }

    /// Station and number of the requested or running session of a group.
    fn current(&self, cav: usize, group: Group) -> Option<(i64, i64)> {
        match self.cavs[cav].model().state(group) {
            GroupState::Local => None,
            GroupState::Requested { station, session, .. }
            | GroupState::Remote { station, session } => Some((station, session)),
        }
    }

    /// The ended sessions that the station or a message remembers, the newest first.
    fn numbers(&self, cav: usize, group: Group, station: i64) -> Vec<i64> {
        let runs = self.providers.get(place(station));
        let runs = runs.and_then(|it| it.session(requester(cav), group));
        let of = |post: &&Post| (post.cav, post.group, post.station) == (cav, group, station);
        let mut numbers: Vec<i64> =
            self.flight.iter().filter(of).map(|post| post.session).chain(runs).collect();
        numbers.retain(|number| self.current(cav, group) != Some((station, *number)));
        numbers.sort_unstable_by(|one, other| other.cmp(one));
        numbers.dedup();
        numbers
    }

    fn rank(&self, cav: usize, group: Group, station: i64, session: i64) -> u8 {
        let known = self.numbers(cav, group, station);
        let ended = known.iter().position(|number| *number == session);
        ended.map_or(0, |place| fitted(place + 1))
    }
}

fn look(pair: &Pair) -> Look {
    let model = pair.model();
    let computes = |group| model.session_of(group).is_none_or(|session| session.local_computes);
    Look {
        groups: Group::ALL.map(|group| model.state(group)),
        computes: Group::ALL.map(computes),
        hold_until_ns: model.hold_until_ns(),
    }
}

fn requester(cav: usize) -> i64 {
    fitted(cav)
}

fn station_id(place: usize) -> i64 {
    fitted::<_, i64>(place) + 1
}

/// The place of a station; that of one that the world does not have is out of range.
fn place(station: i64) -> usize {
    fitted(station - 1)
}
