//! A provider as a part of the system: what can happen to it, and when two are alike.
//!
//! Two providers with the same [`StationLikeness`] do the same for every event: a step depends on
//! times only through the time since a session was heard, which decides nothing any more once the
//! lease is over; and on the numbers of sessions only through the order of the running one and
//! the one that a message names, which the stimulus tells.

use mufasa_model::offloading::provider::{Provider, ProviderEvent, ProviderEventKind, Reply};
use mufasa_model::offloading::requester::Group;

use super::automaton::Part;
use super::bounds::{REQUESTERS, World};
use super::fit::fitted;
use super::state::Kind;
use mufasa_props::refine::Difference;

/// A provider of a world at a time.
#[derive(Clone, Debug)]
pub struct StationPart {
    provider: Provider,
    now: i64,
    capacity: usize,
    lease: i64,
}

/// What decides how a provider reacts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct StationLikeness {
    /// By requester and group: ticks since the running session was heard, at most the lease.
    pub ages: [[Option<u8>; 2]; REQUESTERS],
    /// Whether the provider finds its own state allowed: no more sessions than its capacity.
    pub valid: bool,
}

/// What can happen to a provider.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum StationStimulus {
    /// A tick of its clock, which it notices.
    TimePasses,
    /// It crashes and returns without memory. Between the two it is as if nothing arrived.
    Crash,
    /// A message of a requester.
    Message {
        /// From which requester, 0 or 1.
        cav: u8,
        /// Of which group.
        group: Group,
        /// What it says.
        kind: Kind,
        /// How its number is to the one of the running session.
        order: Order,
    },
}

/// The number of a message beside that of the running session of its requester and group.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Order {
    /// No session runs.
    Free,
    /// The message is of an older session.
    Older,
    /// Of the running one.
    Same,
    /// Of a newer one.
    Newer,
}

/// What a provider does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct StationEffect {
    /// It confirms (true) or rejects.
    pub confirms: Option<bool>,
    /// The session of the message runs now.
    pub runs: bool,
}

/// What a message is to a provider; none when it goes to a CAV.
pub fn provider_event(
    kind: Kind,
    requester: i64,
    group: Group,
    session: i64,
) -> Option<ProviderEventKind> {
    match kind {
        Kind::Request => Some(ProviderEventKind::Request { requester, group, session }),
        Kind::Release => Some(ProviderEventKind::Release { requester, group, session }),
        Kind::Alive => Some(ProviderEventKind::Heard { requester, group, session }),
        Kind::Confirm | Kind::Reject => None,
    }
}

impl StationPart {
    /// A provider without sessions.
    pub fn new(world: &World, capacity: usize) -> Self {
        let lease = world.ticks.lease;
        Self::standing_for(Provider::new(capacity, lease), 0, capacity, lease)
    }

    /// A provider in any state, at a time in ns.
    pub fn standing_for(provider: Provider, now: i64, capacity: usize, lease: i64) -> Self {
        Self { provider, now, capacity, lease }
    }

    /// Everything that can happen in a world.
    pub fn stimuli(world: &World) -> Vec<StationStimulus> {
        let mut stimuli = vec![StationStimulus::TimePasses, StationStimulus::Crash];
        for cav in (0..).take(world.requesters) {
            for group in world.groups() {
                for kind in [Kind::Request, Kind::Release, Kind::Alive] {
                    let orders = [Order::Free, Order::Older, Order::Same, Order::Newer];
                    let message = |order| StationStimulus::Message { cav, group, kind, order };
                    stimuli.extend(orders.map(message));
                }
            }
        }
        stimuli
    }

    /// A number for a message. Where none of this requester and group runs, one that runs of
    /// another, if there is: the numbers of one requester mean nothing for another.
    fn number(&self, cav: u8, group: Group, order: Order) -> Option<i64> {
        match (self.provider.session(cav.into(), group), order) {
            (None, Order::Free) => {
                let all = (0..).take(REQUESTERS).flat_map(|it| Group::ALL.map(|g| (it, g)));
                let mut running = all.filter_map(|(it, group)| self.provider.session(it, group));
                Some(running.next().unwrap_or(self.now))
            }
            (Some(running), Order::Older) => Some(running - 1),
            (Some(running), Order::Same) => Some(running),
            (Some(running), Order::Newer) => Some(running + 1),
            (None, _) | (Some(_), Order::Free) => None,
        }
    }
}

impl Part for StationPart {
    type Likeness = StationLikeness;
    type Stimulus = StationStimulus;
    type Effect = StationEffect;

    fn likeness(&mut self) -> StationLikeness {
        let mut ages = [[None; 2]; REQUESTERS];
        for (ages, cav) in ages.iter_mut().zip(0..) {
            *ages = Group::ALL.map(|group| {
                let heard = self.provider.last_heard_ns(cav, group)?;
                let age = self.now.saturating_sub(heard).min(self.lease);
                Some(fitted(age))
            });
        }
        StationLikeness { ages, valid: self.provider.is_valid() }
    }

    fn react(
        &self,
        stimulus: StationStimulus,
    ) -> Result<Option<(Self, StationEffect)>, Box<Difference>> {
        let mut next = self.clone();
        let silent = StationEffect { confirms: None, runs: false };
        let (cav, group, kind, order) = match stimulus {
            StationStimulus::TimePasses => {
                next.now += 1;
                next.provider
                    .step(&ProviderEvent { t_ns: next.now, kind: ProviderEventKind::Tick });
                return Ok(Some((next, silent)));
            }
            StationStimulus::Crash => {
                next.provider = Provider::new(self.capacity, self.lease);
                return Ok(Some((next, silent)));
            }
            StationStimulus::Message { cav, group, kind, order } => (cav, group, kind, order),
        };
        let Some(session) = self.number(cav, group, order) else { return Ok(None) };
        let requester = cav.into();
        let Some(kind) = provider_event(kind, requester, group, session) else { return Ok(None) };
        let confirms = next
            .provider
            .step(&ProviderEvent { t_ns: self.now, kind })
            .map(|reply| matches!(reply, Reply::Confirm { .. }));
        let runs = next.provider.session(requester, group) == Some(session);
        Ok(Some((next, StationEffect { confirms, runs })))
    }
}
