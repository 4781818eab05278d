//! The system: requesters, stations, and a network between them that loses, delays, duplicates
//! and reorders; an attacker who forges what a CAV receives; a validator that may say unsafe at
//! any time; stations that crash. What each part does is taken from its automaton, which was
//! found by running the real one; here messages travel between them.

use mufasa_model::input::cycle::Profile;
use mufasa_model::offloading::requester::Group;

use super::automaton::Automaton;
use super::bounds::World;
use super::cav::{CavLikeness, CavPart, Deed};
use super::fit::fitted;
use super::flight::{end_session, take, tidy};
use super::moves::Move;
use super::observer::{CavStep, Observed};
use super::properties::{Property, Sight};
use super::state::{Kind, Layout, Letter, Message, State};
use super::station::{Order, StationEffect, StationLikeness, StationPart, StationStimulus};
use super::stimulus::Stimulus;
use mufasa_props::refine::Difference;

/// The system of a world in a profile.
#[derive(Debug)]
pub struct System {
    world: &'static World,
    profile: Profile,
    requesters: Automaton<CavPart>,
    providers: Vec<Automaton<StationPart>>,
    layout: Layout,
    t_wait: u8,
    lease: u8,
}

/// A state after a move, and what the move shows.
#[derive(Clone, Copy, Debug)]
pub struct Next {
    /// The state.
    pub state: State,
    /// What the move shows.
    pub found: Observed,
}

impl System {
    /// Finds the automata of the parts. Errors: model and implementation of the requester differ
    /// in some state that the world reaches.
    pub fn new(world: &'static World, profile: Profile) -> Result<Self, Box<Difference>> {
        let start = CavPart::new(world, profile)?;
        let requesters = Automaton::explore(start, CavPart::stimuli(world))?;
        let provider = |capacity| {
            Automaton::explore(StationPart::new(world, capacity), StationPart::stimuli(world))
        };
        let providers =
            world.stations.iter().map(|it| provider(it.capacity)).collect::<Result<Vec<_>, _>>()?;
        let sizes: Vec<usize> = providers.iter().map(Automaton::len).collect();
        let layout = Layout::new(world, requesters.len(), &sizes);
        let (t_wait, lease) = (fitted(world.ticks.t_wait), fitted(world.ticks.lease));
        Ok(Self { world, profile, requesters, providers, layout, t_wait, lease })
    }

    /// Everything local, nothing offered, nothing in flight.
    pub fn start(&self) -> State {
        State::default()
    }

    /// The world.
    pub fn world(&self) -> &'static World {
        self.world
    }

    /// The profile in force.
    pub fn profile(&self) -> Profile {
        self.profile
    }

    /// How states are packed.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// The requester's automaton.
    pub fn requesters(&self) -> &Automaton<CavPart> {
        &self.requesters
    }

    /// The automata of the providers of the stations.
    pub fn providers(&self) -> &[Automaton<StationPart>] {
        &self.providers
    }

    /// What the requester of a CAV is like.
    pub fn cav(&self, state: &State, cav: usize) -> &CavLikeness {
        self.requesters.likeness(state.cavs[cav].id)
    }

    /// What the provider of a station, by its place, is like.
    pub fn station(&self, state: &State, station: usize) -> &StationLikeness {
        self.providers[station].likeness(state.stations[station].id)
    }

    /// The state after a move, or `None` when the move cannot happen.
    pub fn apply(&self, state: &State, by: Move) -> Option<Next> {
        let mut next = Next { state: *state, found: Observed::default() };
        match by {
            Move::TimePasses => self.time_passes(&mut next)?,
            Move::Event { cav, place, rank } => {
                self.event(&mut next, usize::from(cav), usize::from(place), rank)?;
            }
            Move::Deliver { message, kept } => {
                let letter = take(&mut next.state, message, kept)?;
                self.deliver(&mut next, letter)?;
            }
            Move::Refuse { message } => {
                let letter = take(&mut next.state, message, false)?;
                self.send(&mut next.state, Letter { kind: Kind::Reject, ..letter });
            }
            Move::Lose { message } => {
                let Letter { kind, station, cav, group, rank } =
                    take(&mut next.state, message, false)?;
                let ends = next.state.stations[station].runs[cav][group] == rank + 1;
                next.found.shows(Sight::ReleaseLost, kind == Kind::Release && ends);
            }
            Move::Crash { station } => self.crash(&mut next, usize::from(station))?,
            Move::Alive { cav, group } => {
                let station = self.cav(state, cav.into()).groups[group as usize].remote()?;
                let (station, group) = (usize::from(station) - 1, group as usize);
                let letter = Letter { kind: Kind::Alive, station, cav: cav.into(), group, rank: 0 };
                self.send(&mut next.state, letter);
            }
        }
        // Ranks and places of messages are in order as long as none of this changes.
        if (next.state.flight, next.state.stations) != (state.flight, state.stations) {
            tidy(&mut next.state);
        }
        Some(next)
    }

    /// Time passes for all at once.
    fn time_passes(&self, next: &mut Next) -> Option<()> {
        for cav in 0..self.world.requesters {
            let place = self.requesters.place(&Stimulus::TimePasses)?;
            self.event(next, cav, place, None)?;
        }
        for station in 0..self.world.stations.len() {
            self.provider(next, station, StationStimulus::TimePasses)?;
            let memory = &mut next.state.stations[station];
            for cav in 0..self.world.requesters {
                for group in 0..2 {
                    if memory.runs[cav][group] > 0 {
                        let unheard = &mut memory.unheard[cav][group];
                        *unheard = (*unheard + 1).min(self.lease);
                        let left = memory.runs[cav][group] > 1;
                        let beyond = left && *unheard >= self.lease;
                        next.found.breaks(Property::LeftSessionWithinLease, beyond);
                    }
                }
            }
        }
        Some(())
    }

    /// An event at a CAV. `rank`: of the session that a message names when it is not current.
    fn event(&self, next: &mut Next, cav: usize, place: usize, rank: Option<u8>) -> Option<()> {
        let id = next.state.cavs[cav].id;
        let (after_id, deeds) = self.requesters.react(id, place)?;
        let step = CavStep {
            profile: self.profile,
            t_wait: self.t_wait,
            qos_hold: self.world.qos_hold,
            before: self.requesters.likeness(id),
            stimulus: self.requesters.stimuli()[place],
            deeds,
            after: self.requesters.likeness(after_id),
        };
        step.observe(&mut next.state.cavs[cav], &mut next.found);
        next.state.cavs[cav].id = after_id;
        for deed in deeds {
            if let Deed::Release { station, group, current } = *deed {
                let partner = step.before.groups[group as usize].partner();
                // A number that the station was never told is not kept: it ends nothing.
                let rank = if current { (partner == Some(station)).then_some(0) } else { rank };
                if let Some(rank) = rank {
                    self.send_to(&mut next.state, Kind::Release, cav, (station, group, rank));
                }
            }
        }
        for group in Group::ALL {
            let (before, after) =
                (step.before.groups[group as usize], step.after.groups[group as usize]);
            let asks =
                |deed: &Deed| matches!(deed, Deed::Request { group: of, .. } if *of == group);
            if let Some(station) = before.partner()
                && (after.partner() != Some(station) || deeds.iter().any(asks))
            {
                end_session(&mut next.state, cav, group as usize, usize::from(station) - 1);
            }
        }
        for deed in deeds {
            if let Deed::Request { station, group, fresh: _ } = *deed {
                self.send_to(&mut next.state, Kind::Request, cav, (station, group, 0));
            }
        }
        Some(())
    }

    /// A message arrives where it was sent to.
    fn deliver(&self, next: &mut Next, letter: Letter) -> Option<()> {
        if !letter.kind.is_to_station() {
            let named = letter.named();
            let confirms = letter.kind == Kind::Confirm;
            next.found.shows(Sight::ConfirmedAfterLeaving, confirms && !named.current);
            let stimulus =
                if confirms { Stimulus::Confirm(named) } else { Stimulus::Reject(named) };
            let place = self.requesters.place(&stimulus)?;
            return self.event(next, letter.cav, place, Some(letter.rank));
        }
        let Letter { kind, station, cav, group, rank } = letter;
        let order = match next.state.stations[station].runs[cav][group].checked_sub(1) {
            None => Order::Free,
            Some(running) if rank > running => Order::Older,
            Some(running) if rank == running => Order::Same,
            Some(_) => Order::Newer,
        };
        let before = *self.station(&next.state, station);
        let message =
            StationStimulus::Message { cav: fitted(cav), group: letter.group(), kind, order };
        let effect = self.provider(next, station, message)?;
        let after = *self.station(&next.state, station);
        self.judge_message(next, letter, order, [&before, &after]);
        let memory = &mut next.state.stations[station];
        if effect.runs {
            let heard = kind == Kind::Request || order == Order::Same;
            memory.runs[cav][group] = rank + 1;
            if heard {
                next.found.shows(Sight::LeftSessionKept, order == Order::Same && rank > 0);
                memory.unheard[cav][group] = 0;
            }
        }
        let running = memory.runs.iter().flatten().filter(|session| **session > 0).count();
        let full = self.world.stations[station].capacity;
        next.found.breaks(Property::NoMoreThanCapacity, running > full);
        if let Some(confirms) = effect.confirms {
            next.found.breaks(Property::NoMoreThanCapacity, confirms && !effect.runs);
            let kind = if confirms { Kind::Confirm } else { Kind::Reject };
            self.send(&mut next.state, Letter { kind, ..letter });
            let others = (0..self.world.requesters)
                .any(|other| other != cav && after.ages[other].iter().any(Option::is_some));
            let full = !confirms && order == Order::Free;
            next.found.shows(Sight::FullBecauseOfAnother, full && others);
            let replaces = confirms && order == Order::Newer;
            next.found.shows(Sight::LaterReplaces, replaces);
        }
        Some(())
    }

    /// What one message may change at a station, and what not.
    fn judge_message(
        &self,
        next: &mut Next,
        letter: Letter,
        order: Order,
        [before, after]: [&StationLikeness; 2],
    ) {
        let found = &mut next.found;
        let older = order == Order::Older;
        found.shows(Sight::EndedMeetsLaterAtStation, older);
        found.breaks(Property::EndedSessionChangesNothing, older && before != after);
        for cav in (0..self.world.requesters).filter(|cav| *cav != letter.cav) {
            let changed = before.ages[cav] != after.ages[cav];
            found.breaks(Property::OthersKeepTheirSessions, changed);
            let runs = |cav: usize| before.ages[cav].iter().any(Option::is_some);
            found.shows(Sight::TwoServedAtOnce, runs(cav) && runs(letter.cav));
        }
    }

    fn crash(&self, next: &mut Next, station: usize) -> Option<()> {
        let in_use = next.state.stations[station].runs.iter().flatten().any(|runs| *runs == 1);
        self.provider(next, station, StationStimulus::Crash)?;
        next.found.shows(Sight::CrashWhileRemote, in_use);
        Some(())
    }

    /// A provider reacts; sessions that ended are forgotten.
    fn provider(
        &self,
        next: &mut Next,
        station: usize,
        stimulus: StationStimulus,
    ) -> Option<StationEffect> {
        let provider = &self.providers[station];
        let place = provider.place(&stimulus)?;
        let (id, effect) = provider.react(next.state.stations[station].id, place)?;
        next.state.stations[station].id = id;
        let likeness = provider.likeness(id);
        next.found.breaks(Property::PartsValid, !likeness.valid);
        for (cav, ages) in likeness.ages.iter().enumerate() {
            for (group, age) in ages.iter().enumerate() {
                let memory = &mut next.state.stations[station];
                if age.is_some() || memory.runs[cav][group] == 0 {
                    continue;
                }
                let left = memory.runs[cav][group] > 1;
                (memory.runs[cav][group], memory.unheard[cav][group]) = (0, 0);
                let lapsed = stimulus == StationStimulus::TimePasses && left;
                next.found.shows(Sight::LeftSessionLapses, lapsed);
            }
        }
        Some(*effect)
    }

    fn send_to(
        &self,
        state: &mut State,
        kind: Kind,
        cav: usize,
        (station, group, rank): (u8, Group, u8),
    ) {
        let (station, group) = (usize::from(station) - 1, group as usize);
        if station < self.world.stations.len() {
            self.send(state, Letter { kind, station, cav, group, rank });
        }
    }

    /// Puts a message into a free place; without one it is lost.
    fn send(&self, state: &mut State, letter: Letter) {
        let message = Message::new(letter);
        let places = &mut state.flight[..self.world.in_flight];
        if places.contains(&message) {
            return;
        }
        if let Some(free) = places.iter_mut().find(|place| **place == Message::default()) {
            *free = message;
        }
    }
}
