//! A requester as a part of the system, and when two are alike.
//!
//! Two requesters with the same [`CavLikeness`] do the same for every event, because a step
//! depends on the absolute numbers in its state only through these:
//!
//! * Times are compared with now, by differences and one limit each: a deadline or a hold that
//!   is over stays over, whatever its distance; a last arrival longer ago than `dt_max` is a
//!   violation, whatever comes; an element older than `l_max` is a violation, so a last used one
//!   older than that rejects nothing that would be used. So distances are kept up to one tick
//!   beyond the limit. Time runs forwards here (random traces let it run backwards).
//! * Sessions are compared for equality with the running or requested one of the same group, and
//!   the last requests for a group with each other. A new number is above all old ones. So of a
//!   number only matters whether it is the current one of its group, and of the last requests
//!   only in which order the stations' turns come: (last request, id), never asked first.

use mufasa_model::input::cycle::Profile;
use mufasa_model::offloading::requester::{Action, Event, Group, GroupState, Groups};
use mufasa_model::services::configuration::{Offloadable, Source};

use super::automaton::Part;
use super::bounds::{STATIONS, Ticks, World};
use super::fit::fitted;
use super::stimulus::{Named, Stimulus};
use mufasa_props::refine::{Difference, Pair};

/// A requester of a world at a time.
#[derive(Clone, Debug)]
pub struct CavPart {
    pair: Pair,
    /// Highest number of any request sent.
    highest: i64,
    now: i64,
    ticks: Ticks,
    stations: usize,
}

/// The use of stations for a group, times in ticks relative to now.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Use {
    /// None.
    Local,
    /// Asked.
    Requested {
        /// Whom.
        station: u8,
        /// Until the deadline; 0 is at or after it.
        left: u8,
    },
    /// Runs there.
    Remote {
        /// Where.
        station: u8,
        /// Since the last arrival, at most one more than `dt_max`.
        silent: u8,
        /// Age of the last element used, at most one more than `l_max`.
        used: Option<i8>,
        /// Whether the local services still compute.
        local_computes: bool,
    },
}

impl Use {
    /// The station asked or running.
    pub fn partner(self) -> Option<u8> {
        match self {
            Self::Local => None,
            Self::Requested { station, .. } | Self::Remote { station, .. } => Some(station),
        }
    }

    /// The station running.
    pub fn remote(self) -> Option<u8> {
        match self {
            Self::Remote { station, .. } => Some(station),
            Self::Local | Self::Requested { .. } => None,
        }
    }
}

/// What decides how a requester reacts.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct CavLikeness {
    /// MOT and PLAN.
    pub groups: [Use; 2],
    /// Ticks until `hold_until`, 0 at it; `None` after it, and without a hold. The end itself is
    /// kept apart, so that it is seen when a requester takes it for a part of the hold.
    pub hold_left: Option<u8>,
    /// Current offers by station, from 1.
    pub offers: [Groups; STATIONS],
    /// The area.
    pub area: Groups,
    /// By group: the stations in the order in which they are asked.
    pub turns: [[u8; STATIONS]; 2],
    /// The source of MOT, ENV and TPL, as the requester says: a station, or `None` for local.
    pub sources: [Option<u8>; 3],
    /// Whether the next number is above all that were sent.
    pub numbers_rise: bool,
    /// Whether the requester finds its own state allowed.
    pub valid: bool,
}

impl CavLikeness {
    /// Whether a hold runs.
    pub fn is_held(&self) -> bool {
        self.hold_left.is_some_and(|left| left > 0)
    }
}

/// An action of the requester.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Deed {
    /// A request.
    Request {
        /// To whom.
        station: u8,
        /// For what.
        group: Group,
        /// Whether its number is above all numbers before.
        fresh: bool,
    },
    /// A release.
    Release {
        /// To whom.
        station: u8,
        /// Of which group.
        group: Group,
        /// Whether it names what was the current session of the group before, else it names the
        /// session of the message that it answers.
        current: bool,
    },
    /// The local services of a group start.
    Activate(Group),
    /// The local services of a group stop.
    Deactivate(Group),
    /// An element of a group is not used.
    Drop(Group),
}

impl CavPart {
    /// A requester at its start. Errors: the implementation refuses the parameters.
    pub fn new(world: &World, profile: Profile) -> Result<Self, Box<Difference>> {
        Ok(Self::standing_for(world, Pair::new(profile, world.parameters())?, 0))
    }

    /// A requester in any state, at a time in ns.
    pub fn standing_for(world: &World, pair: Pair, now: i64) -> Self {
        let highest = pair.model().last_session();
        Self { pair, highest, now, ticks: world.ticks, stations: world.stations.len() }
    }

    /// Everything that can happen in a world.
    pub fn stimuli(world: &World) -> Vec<Stimulus> {
        let mut stimuli = vec![Stimulus::TimePasses, Stimulus::Tick];
        for (station, bounds) in (1..).zip(world.stations) {
            stimuli.extend(bounds.offers.iter().map(|groups| Stimulus::Offer(station, *groups)));
            stimuli.extend([Stimulus::Withdraw(station), Stimulus::Lost(station)]);
        }
        stimuli.extend(world.areas.iter().map(|groups| Stimulus::Area(*groups)));
        let used: Groups = world.groups().collect();
        stimuli.push(Stimulus::Verdict { safe: false, groups: used, current: true });
        for groups in [
            Groups::NONE,
            Groups { mot: true, plan: false },
            Groups { mot: false, plan: true },
            Groups::ALL,
        ] {
            if (used.mot || !groups.mot) && (used.plan || !groups.plan) {
                stimuli.push(Stimulus::Verdict { safe: true, groups, current: true });
                if groups != Groups::NONE {
                    stimuli.push(Stimulus::Verdict { safe: true, groups, current: false });
                }
            }
        }
        let stranger = u8::from(world.attacker);
        let senders = fitted::<_, u8>(world.stations.len()) + stranger;
        let oldest = fitted(world.ticks.l_max + 1);
        for station in 1..=senders {
            for group in world.groups() {
                for current in [true, false] {
                    let named = Named { station, group, current };
                    stimuli.extend([Stimulus::Confirm(named), Stimulus::Reject(named)]);
                    let ages = if current { -1..=oldest } else { 0..=0 };
                    stimuli.extend(ages.map(|age| Stimulus::Data(named, age)));
                }
            }
        }
        stimuli
    }

    /// The numbers that are not the current session of a group: of the other group, of the past,
    /// of the future, and such as never were. They are treated alike.
    pub fn other_numbers(&self, group: Group) -> Vec<i64> {
        let model = self.pair.model();
        let current = current(&self.pair, group);
        let others = Group::ALL.into_iter().filter_map(|other| self::current(&self.pair, other));
        let last = model.last_session();
        let all = others.chain([last, last - 1, last + 1, 0, -1, i64::MAX, i64::MIN]);
        all.filter(|number| Some(*number) != current).collect()
    }

    /// As [`Part::react`], with this number where the stimulus names one that is not current.
    pub fn react_to(
        &self,
        stimulus: Stimulus,
        other: i64,
    ) -> Result<Option<(Self, Vec<Deed>)>, Box<Difference>> {
        let mut next = self.clone();
        if stimulus == Stimulus::TimePasses {
            next.now += 1;
            return Ok(Some((next, Vec::new())));
        }
        let number = |named: Named| {
            if named.current { current(&self.pair, named.group) } else { Some(other) }
        };
        let Some(kind) = stimulus.event(self.now, number) else { return Ok(None) };
        let actions = next.pair.step(&Event { t_ns: self.now, kind })?;
        let deeds = actions.into_iter().map(|action| next.deed(action, self)).collect();
        Ok(Some((next, deeds)))
    }

    /// An action, and what it makes the highest number. `before`: the requester before the step.
    fn deed(&mut self, action: Action, before: &Self) -> Deed {
        match action {
            Action::Request { station, group, session } => {
                let fresh = session > self.highest;
                self.highest = self.highest.max(session);
                Deed::Request { station: fitted(station), group, fresh }
            }
            Action::Release { station, group, session } => {
                let current = Some(session) == current(&before.pair, group);
                Deed::Release { station: fitted(station), group, current }
            }
            Action::Activate(group) => Deed::Activate(group),
            Action::Deactivate(group) => Deed::Deactivate(group),
            Action::Drop(group) => Deed::Drop(group),
        }
    }

    fn use_of(&self, group: Group) -> Use {
        let model = self.pair.model();
        match model.state(group) {
            GroupState::Local => Use::Local,
            GroupState::Requested { station, deadline_ns, .. } => {
                Use::Requested { station: fitted(station), left: self.left(deadline_ns) }
            }
            GroupState::Remote { station, .. } => {
                let session = model.session_of(group).expect("a remote group has a session");
                let age = |generated: i64| {
                    let age = self.now.saturating_sub(generated).min(self.ticks.l_max + 1);
                    fitted(age)
                };
                Use::Remote {
                    station: fitted(station),
                    silent: self.since(session.last_arrival_ns, self.ticks.dt_max + 1),
                    used: session.last_used_generated_ns.map(age),
                    local_computes: session.local_computes,
                }
            }
        }
    }

    /// Ticks until a time, at least 0.
    fn left(&self, until: i64) -> u8 {
        fitted(until.saturating_sub(self.now).max(0))
    }

    /// Ticks since a time, at most `limit`.
    fn since(&self, time: i64, limit: i64) -> u8 {
        fitted(self.now.saturating_sub(time).min(limit))
    }

    fn turns(&self, group: Group) -> [u8; STATIONS] {
        let mut turns = [0; STATIONS];
        for (turn, station) in turns.iter_mut().zip(1..).take(self.stations) {
            *turn = station;
        }
        let asked = |station: u8| self.pair.model().last_asked(group, station.into());
        turns[..self.stations].sort_by_key(|station| (asked(*station), *station));
        turns
    }
}

impl Part for CavPart {
    type Likeness = CavLikeness;
    type Stimulus = Stimulus;
    type Effect = Vec<Deed>;

    fn likeness(&mut self) -> CavLikeness {
        let valid = self.pair.is_valid();
        let model = self.pair.model();
        let mut offers = [Groups::NONE; STATIONS];
        for (offer, station) in offers.iter_mut().zip(1..) {
            *offer = model.offered(station);
        }
        let source = |service: Offloadable| match model.source(service.group()) {
            Source::Local => None,
            Source::Remote { station } => Some(fitted(station)),
        };
        CavLikeness {
            groups: Group::ALL.map(|group| self.use_of(group)),
            hold_left: model
                .hold_until_ns()
                .filter(|until| *until >= self.now)
                .map(|until| self.left(until)),
            offers,
            area: model.in_area(),
            turns: Group::ALL.map(|group| self.turns(group)),
            sources: Offloadable::ALL.map(source),
            numbers_rise: model.last_session() >= self.highest,
            valid,
        }
    }

    fn react(&self, stimulus: Stimulus) -> Result<Option<(Self, Vec<Deed>)>, Box<Difference>> {
        let other = match stimulus {
            Stimulus::Confirm(named) | Stimulus::Reject(named) | Stimulus::Data(named, _) => {
                self.other_numbers(named.group)[0]
            }
            // No request has this number.
            _ => 0,
        };
        self.react_to(stimulus, other)
    }
}

/// Number of the group's requested or running session.
fn current(pair: &Pair, group: Group) -> Option<i64> {
    match pair.model().state(group) {
        GroupState::Local => None,
        GroupState::Requested { session, .. } | GroupState::Remote { session, .. } => Some(session),
    }
}
