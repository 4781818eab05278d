//! The second engine: stateright, for the safety properties and for its explorer page.
//!
//! It keeps 64-bit fingerprints of states and not the states, its counterexamples need not be
//! minimal with several threads, and its `eventually` overlooks loops. So it confirms the number
//! of states and the safety properties, and decides nothing alone.

use std::net::ToSocketAddrs;
use std::sync::Arc;

use enumset::EnumSet;
use mufasa_model::services::configuration::Offloadable;
use stateright::{Checker, Model};

use super::moves::Move;
use super::properties::Property;
use super::state::State;
use super::system::System;

/// A system as stateright wants it.
#[derive(Clone)]
pub struct Twin {
    system: Arc<System>,
}

/// A state with the properties that the step to it broke. Such a state has no successor.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Seen {
    state: u128,
    broken: EnumSet<Property>,
}

/// What stateright found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Confirmation {
    /// Number of reachable states.
    pub states: usize,
    /// Names of the safety properties that it found broken.
    pub broken: Vec<&'static str>,
    /// Whether it saw somebody offload, so that it did not explore nothing.
    pub offloaded: bool,
}

/// Explores the system with stateright.
pub fn explore(system: &Arc<System>, threads: usize) -> Confirmation {
    let twin = Twin { system: Arc::clone(system) };
    let checker = twin.checker().threads(threads).spawn_bfs().join();
    let found = checker.discoveries();
    let properties =
        Property::ALL.into_iter().filter(|property| found.contains_key(property.name()));
    Confirmation {
        states: checker.unique_state_count(),
        broken: properties.map(Property::name).collect(),
        offloaded: found.contains_key(OFFLOADED),
    }
}

/// Serves stateright's explorer page until the process ends.
pub fn serve(system: &Arc<System>, address: impl ToSocketAddrs) {
    let twin = Twin { system: Arc::clone(system) };
    let _ = twin.checker().serve(address);
}

const OFFLOADED: &str = "a remote station is the source of a group";

impl Model for Twin {
    type State = Seen;
    type Action = Move;

    fn init_states(&self) -> Vec<Seen> {
        vec![Seen {
            state: self.system.layout().pack(&self.system.start()),
            broken: EnumSet::empty(),
        }]
    }

    fn actions(&self, seen: &Seen, actions: &mut Vec<Move>) {
        if seen.broken.is_empty() {
            self.system.moves(&self.state(seen), actions);
        }
    }

    fn next_state(&self, seen: &Seen, by: Move) -> Option<Seen> {
        let next = self.system.apply(&self.state(seen), by)?;
        let state = self.system.layout().pack(&next.state);
        let broken = claimed(&self.system, next.found.broken);
        (state != seen.state || !broken.is_empty()).then_some(Seen { state, broken })
    }

    fn format_action(&self, by: &Move) -> String {
        self.system.words(*by)
    }

    fn format_step(&self, seen: &Seen, by: Move) -> Option<String> {
        let next = self.system.apply(&self.state(seen), by)?;
        Some(self.system.describe(&next.state))
    }

    fn properties(&self) -> Vec<stateright::Property<Self>> {
        let mut properties =
            vec![stateright::Property::sometimes(OFFLOADED, |twin: &Self, seen| {
                let state = twin.state(seen);
                let cav = twin.system.cav(&state, 0);
                Offloadable::ALL.into_iter().zip(cav.sources).any(|(_, source)| source.is_some())
            })];
        macro_rules! always {
            ($($property:ident),*) => {
                $(properties.push(stateright::Property::always(
                    Property::$property.name(),
                    |_: &Self, seen: &Seen| !seen.broken.contains(Property::$property),
                ));)*
            };
        }
        always!(
            OneSource,
            NoRemoteResultBeforeHoldUntil,
            AskedOnceAllowed,
            EnvAndTplTogether,
            LeftSessionWithinLease,
            NoStopBeforeSafeCycle,
            EndedSessionChangesNothing,
            NoMoreThanCapacity,
            OthersKeepTheirSessions,
            PartsValid
        );
        properties
    }
}

impl Twin {
    fn state(&self, seen: &Seen) -> State {
        self.system.layout().unpack(seen.state)
    }
}

/// The broken properties that the profile claims.
fn claimed(system: &System, broken: EnumSet<Property>) -> EnumSet<Property> {
    broken.iter().filter(|property| property.is_claimed(system.profile())).collect()
}
