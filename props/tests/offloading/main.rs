//! What no vector of `spec/2-offloading.md` shows (`props/tests/vectors.rs`), of the requesters of model and
//! implementation together: after each step everything that either remembers is compared.

mod fallback;
mod provider;
mod quality_of_service;
mod traces;

use mufasa_model::input::cycle::Profile;
use mufasa_model::offloading::requester::Group::{Mot, Plan};
use mufasa_model::offloading::requester::{
    Action, Event, EventKind, Group, GroupState, Groups, Parameters, Requester, Sessions,
};
use mufasa_props::refine::Pair;

const MOT: Groups = Groups { mot: true, plan: false };
const PLAN: Groups = Groups { mot: false, plan: true };
const TICK: EventKind = EventKind::Tick;
/// Session 1 runs MOT.
const SESSION_1: Sessions = Sessions { mot: Some(1), plan: None };
const PROFILES: [Profile; 2] = [Profile::PAPER, Profile::HARDENED];

/// Both requesters, checked after every step.
struct Cav(Pair);

impl Cav {
    fn new(profile: Profile, parameters: Parameters) -> Self {
        Self(Pair::new(profile, parameters).unwrap_or_else(|difference| panic!("{difference}")))
    }

    /// With these groups requested from station 1 at 0 ns, sessions from 1 on.
    fn requested(profile: Profile, groups: Groups) -> Self {
        let mut cav = Self::new(profile, Parameters::default());
        cav.at(0, offer(1, groups));
        cav.at(0, TICK);
        cav
    }

    /// With these groups on station 1 since 0 ns, sessions from 1 on.
    fn remote(profile: Profile, groups: Groups) -> Self {
        let mut cav = Self::requested(profile, groups);
        for group in Group::ALL {
            if let GroupState::Requested { session, .. } = cav.model().state(group) {
                cav.at(0, confirm(1, group, session));
            }
        }
        cav
    }

    fn at(&mut self, t_ns: i64, kind: EventKind) -> Vec<Action> {
        let actions =
            self.0.step(&Event { t_ns, kind }).unwrap_or_else(|difference| panic!("{difference}"));
        assert!(self.0.is_valid(), "after {kind:?} at {t_ns}: {:?}", self.0);
        actions
    }

    fn states(&self) -> (GroupState, GroupState) {
        (self.model().state(Mot), self.model().state(Plan))
    }

    /// What both remember, in the model's words.
    fn model(&self) -> &Requester {
        self.0.model()
    }
}

fn offer(station: i64, groups: Groups) -> EventKind {
    EventKind::Offer { station, groups }
}

fn confirm(station: i64, group: Group, session: i64) -> EventKind {
    EventKind::Confirm { station, group, session }
}

fn data(station: i64, group: Group, session: i64, generated_ns: i64) -> EventKind {
    EventKind::Data { station, group, session, generated_ns }
}

fn safe(mot: Option<i64>, plan: Option<i64>) -> EventKind {
    EventKind::Verdict { safe: true, sessions: Sessions { mot, plan } }
}

fn on(station: i64, session: i64) -> GroupState {
    GroupState::Remote { station, session }
}
