//! Offloading traces told event by event, with sessions numbered as the requester numbers them.

use mufasa_model::input::cycle::Profile;
use mufasa_model::offloading::requester::{Event, EventKind, Group, Groups, Parameters};

use mufasa_records::Trace;

/// MOT alone.
pub const MOT: Groups = Groups { mot: true, plan: false };
/// PLAN alone.
pub const PLAN: Groups = Groups { mot: false, plan: true };
/// Both groups.
pub const ALL: Groups = Groups::ALL;
/// No group.
pub const NONE: Groups = Groups::NONE;

/// A trace under construction.
#[derive(Clone, Debug)]
pub struct Story(Trace);

impl Story {
    /// Nothing has happened yet; default parameters.
    pub fn new(profile: Profile) -> Self {
        Self(Trace { profile, parameters: Parameters::default(), events: Vec::new() })
    }

    /// These groups are requested from station 1 at 0 ns, sessions from 1 on, MOT first.
    pub fn requested(profile: Profile, groups: Groups) -> Self {
        Self::new(profile).offer(0, 1, groups).tick(0)
    }

    /// These groups run on station 1 since 0 ns, sessions from 1 on, MOT first.
    pub fn remote(profile: Profile, groups: Groups) -> Self {
        let mut story = Self::requested(profile, groups);
        let wanted = Group::ALL.into_iter().filter(|group| groups.contains(*group));
        for (group, session) in wanted.zip(1..) {
            story = story.confirm(0, (1, group, session));
        }
        story
    }

    /// With other parameters.
    pub fn parameters(mut self, parameters: Parameters) -> Self {
        self.0.parameters = parameters;
        self
    }

    /// A station offers groups.
    pub fn offer(self, t_ns: i64, station: i64, groups: Groups) -> Self {
        self.at(t_ns, EventKind::Offer { station, groups })
    }

    /// A station withdraws its offer.
    pub fn withdraw(self, t_ns: i64, station: i64) -> Self {
        self.at(t_ns, EventKind::Withdraw { station })
    }

    /// A station is lost.
    pub fn lost(self, t_ns: i64, station: i64) -> Self {
        self.at(t_ns, EventKind::Lost { station })
    }

    /// The area changes.
    pub fn area(self, t_ns: i64, groups: Groups) -> Self {
        self.at(t_ns, EventKind::Area { groups })
    }

    /// A tick.
    pub fn tick(self, t_ns: i64) -> Self {
        self.at(t_ns, EventKind::Tick)
    }

    /// A confirmation of (station, group, session).
    pub fn confirm(self, t_ns: i64, (station, group, session): (i64, Group, i64)) -> Self {
        self.at(t_ns, EventKind::Confirm { station, group, session })
    }

    /// A rejection of (station, group, session).
    pub fn reject(self, t_ns: i64, (station, group, session): (i64, Group, i64)) -> Self {
        self.at(t_ns, EventKind::Reject { station, group, session })
    }

    /// Data of (station, group, session).
    pub fn data(
        self,
        t_ns: i64,
        (station, group, session): (i64, Group, i64),
        generated_ns: i64,
    ) -> Self {
        self.at(t_ns, EventKind::Data { station, group, session, generated_ns })
    }

    /// A safe cycle that used these groups.
    pub fn safe(self, t_ns: i64, groups: Groups) -> Self {
        self.at(t_ns, EventKind::Verdict { safe: true, groups })
    }

    /// An unsafe cycle.
    pub fn issue(self, t_ns: i64) -> Self {
        self.at(t_ns, EventKind::Verdict { safe: false, groups: NONE })
    }

    /// Any event.
    pub fn at(mut self, t_ns: i64, kind: EventKind) -> Self {
        self.0.events.push(Event { t_ns, kind });
        self
    }

    /// The trace.
    pub fn trace(&self) -> &Trace {
        &self.0
    }

    /// How many events there are.
    pub fn len(&self) -> usize {
        self.0.events.len()
    }

    /// Whether nothing has happened.
    pub fn is_empty(&self) -> bool {
        self.0.events.is_empty()
    }
}
