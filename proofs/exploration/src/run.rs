//! A world explored: every property with its verdict and what shows that it was not empty.

use std::sync::Arc;
use std::time::{Duration, Instant};

use mufasa_model::input::cycle::Profile;
use mufasa_model::offloading::requester::Group;

use super::bounds::World;
use super::lasso::{self, Lasso};
use super::moves::Move;
use super::properties::{Property, Sight};
use super::runs::{self, Manner};
use super::search::{self, Explored, Progress};
use super::system::System;
use mufasa_props::refine::Difference;

/// What the exploration of a world in a profile found.
#[derive(Debug)]
pub struct WorldOutcome {
    /// The system explored.
    pub system: Arc<System>,
    /// Reachable states.
    pub states: usize,
    /// Moves tried.
    pub transitions: u64,
    /// Largest distance from the start, moves.
    pub depth: usize,
    /// Bytes that the states take.
    pub bytes: usize,
    /// Time for the parts, the states and the endless runs.
    pub time: Duration,
    /// The properties that the world can speak of.
    pub results: Vec<PropertyOutcome>,
    /// The sights seen, each with a shortest trace to it.
    pub seen: Vec<(Sight, Vec<Move>)>,
}

impl WorldOutcome {
    /// Length of a shortest trace that shows it, if the world asks the property and shows it.
    pub fn moves_to(&self, property: Property, sight: Sight) -> Option<usize> {
        let asked = self.results.iter().any(|finding| finding.property == property);
        let trace = self.seen.iter().find(|(it, _)| asked && *it == sight);
        trace.map(|(_, trace)| trace.len())
    }
}

/// A property in a world.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PropertyOutcome {
    /// Which.
    pub property: Property,
    /// How it fails, if it does.
    pub counterexample: Option<Counterexample>,
    /// For a property of endless runs: states from which its aim lies ahead, and the most ticks
    /// until it comes.
    pub ahead: Option<(usize, u16)>,
}

/// How a property fails.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Counterexample {
    /// From the start; of a safety property a shortest one, of another the first that was found.
    pub trace: Vec<Move>,
    /// Round and round after it; empty for a safety property and for a run that ends.
    pub circle: Vec<Move>,
}

/// Explores a world. Errors: model and implementation of the requester differ.
pub fn explore(
    world: &'static World,
    profile: Profile,
    report: impl FnMut(Progress),
) -> Result<WorldOutcome, Box<Difference>> {
    let start = Instant::now();
    let system = Arc::new(System::new(world, profile)?);
    let explored = search::explore(&system, report);
    let results = Property::ALL
        .into_iter()
        .filter(|property| is_asked(*property, world))
        .map(|property| judge(&system, &explored, property))
        .collect();
    let seen = explored
        .seen
        .iter()
        .map(|(sight, step)| (*sight, explored.trace_of(&system, *step)))
        .collect();
    let time = start.elapsed();
    Ok(WorldOutcome {
        states: explored.len(),
        transitions: explored.transitions,
        depth: explored.depth,
        bytes: explored.bytes(),
        time,
        results,
        seen,
        system,
    })
}

/// Whether a world can break a property: without a network no station runs anything, and a CAV
/// that has to wait for the place of another may wait for ever.
pub fn is_asked(property: Property, world: &World) -> bool {
    match property {
        Property::OneSource
        | Property::NoRemoteResultBeforeHoldUntil
        | Property::AskedOnceAllowed
        | Property::EnvAndTplTogether
        | Property::NoStopBeforeSafeCycle
        | Property::EndedSessionChangesNothing
        | Property::PartsValid => true,
        Property::OffloadingReachedAgain => world.has_network() && world.has_room_for_all(),
        Property::LeftSessionWithinLease
        | Property::LeftSessionEnds
        | Property::NoMoreThanCapacity => world.has_network(),
        Property::OthersKeepTheirSessions => world.requesters > 1 && world.has_network(),
    }
}

fn judge(system: &System, explored: &Explored, property: Property) -> PropertyOutcome {
    let verdicts = match property {
        Property::OffloadingReachedAgain => offloading_is_reached_again(system, explored),
        Property::LeftSessionEnds => a_left_session_ends(system, explored),
        _ => {
            let broken = explored.broken.iter().find(|(broken, _)| *broken == property);
            let counterexample = broken.map(|(_, step)| Counterexample {
                trace: explored.trace_of(system, *step),
                circle: Vec::new(),
            });
            return PropertyOutcome { property, counterexample, ahead: None };
        }
    };
    let ahead = verdicts.iter().map(|verdict| verdict.ahead).sum();
    let longest = verdicts.iter().map(|verdict| verdict.longest).max().unwrap_or(0);
    let lassos = verdicts.into_iter().filter_map(|verdict| verdict.lasso);
    let shortest = lassos.min_by_key(|it| it.stem.len() + it.way.len() + it.circle.len());
    let counterexample = shortest
        .map(|Lasso { stem, way, circle }| Counterexample { trace: [stem, way].concat(), circle });
    PropertyOutcome { property, counterexample, ahead: Some((ahead, longest)) }
}

/// In calm runs, for every choice of the stations' manners and for every group.
fn offloading_is_reached_again(system: &System, explored: &Explored) -> Vec<lasso::Hunted> {
    let manners = runs::manners(system);
    let cavs = 0..system.world().requesters;
    let groups = cavs.flat_map(|cav| system.world().groups().map(move |group| (cav, group)));
    let groups: Vec<_> = groups.collect();
    let cases = manners.iter().flat_map(|it| groups.iter().map(move |group| (it, *group)));
    cases
        .map(|(manners, group): (&Vec<Manner>, (usize, Group))| {
            lasso::find(
                system,
                explored,
                |state, out| runs::calm(system, manners, state, out),
                |state| runs::offloaded(system, manners, group, state),
            )
        })
        .collect()
}

/// In quiet runs, for every station, CAV and group.
fn a_left_session_ends(system: &System, explored: &Explored) -> Vec<lasso::Hunted> {
    let world = system.world();
    let mut verdicts = Vec::new();
    for station in 0..world.stations.len() {
        for cav in 0..world.requesters {
            for group in world.groups() {
                verdicts.push(lasso::find(
                    system,
                    explored,
                    |state, out| runs::quiet(system, state, out),
                    |state| runs::left_session_ended(system, station, cav, group, state),
                ));
            }
        }
    }
    verdicts
}
