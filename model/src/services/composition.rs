//! Compositions of services: the rules, one predicate each (`spec/1-services.md#composition`).
//!
//! The predicates judge any value of [`Composition`], however it came about; an id that the
//! service set does not hold makes them false.

use std::collections::BTreeSet;

use crate::services::service::{CAV, Service, ServiceSet};

/// What to compose.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Task {
    /// The available services.
    pub services: Vec<Service>,
    /// Id of the service that everything else is there for.
    pub goal: String,
    /// Lists of ids; the members of a composition that one list names run on one station.
    pub same_station: Vec<Vec<String>>,
    /// Ids; members of a composition named here run on station 0.
    pub local_only: Vec<String>,
}

/// A chosen provider of one requirement of one consumer.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Link {
    /// Id of the service that guarantees the interface.
    pub provider: String,
    /// Name of the interface.
    pub interface: String,
    /// Id of the service that requires the interface.
    pub consumer: String,
}

/// Services with their chosen links; every list sorted bytewise, each entry once.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Composition {
    /// Ids of the services.
    pub members: Vec<String>,
    /// One link per requirement of a member.
    pub links: Vec<Link>,
    /// Device switches (provider, consumer).
    pub switches: Vec<(String, String)>,
    /// Whether there is a device switch.
    pub distributed: bool,
}

impl Composition {
    /// The goal, the providers of the links, and the device switches among the links.
    /// `spec/1-services.md#composition`.
    pub fn of_links(services: &ServiceSet, goal: &str, links: &BTreeSet<Link>) -> Self {
        let mut members = BTreeSet::from([goal.to_owned()]);
        members.extend(links.iter().map(|link| link.provider.clone()));
        let switches = device_switches(services, links.iter());
        Self {
            members: members.into_iter().collect(),
            links: links.iter().cloned().collect(),
            distributed: !switches.is_empty(),
            switches: switches.into_iter().collect(),
        }
    }
}

/// Whether the composition satisfies every rule for this task. `services` is the set of the task.
/// `spec/1-services.md#composition`.
pub fn is_composition(services: &ServiceSet, task: &Task, composition: &Composition) -> bool {
    holds_goal(&task.goal, composition)
        && is_choice(services, composition)
        && is_closed(services, composition)
        && is_minimal(&task.goal, composition)
        && is_acyclic(composition)
        && names_its_switches(services, composition)
        && keeps_same_station(services, &task.same_station, composition)
        && keeps_local_only(services, &task.local_only, composition)
}

/// "A composition for a goal service": the goal is a member.
pub fn holds_goal(goal: &str, composition: &Composition) -> bool {
    composition.members.iter().any(|member| member == goal)
}

/// "Picks exactly one service that guarantees it": every link leads from a service that guarantees
/// the interface to a member that requires it, and no requirement of a member has two links.
pub fn is_choice(services: &ServiceSet, composition: &Composition) -> bool {
    let guaranteed = |link: &Link| {
        services.get(&link.provider).is_some_and(|s| s.guarantees.contains(&link.interface))
    };
    let required = |link: &Link| {
        composition.members.contains(&link.consumer)
            && services.get(&link.consumer).is_some_and(|s| s.requires.contains(&link.interface))
    };
    let picked: BTreeSet<(&String, &String)> =
        composition.links.iter().map(|link| (&link.consumer, &link.interface)).collect();
    composition.links.iter().all(|link| guaranteed(link) && required(link))
        && picked.len() == composition.links.len()
}

/// "Closed: every requirement of every member is provided by a member."
pub fn is_closed(services: &ServiceSet, composition: &Composition) -> bool {
    composition.members.iter().all(|member| {
        services.get(member).is_some_and(|service| {
            service.requires.iter().all(|requirement| {
                composition.links.iter().any(|link| {
                    link.consumer == *member
                        && link.interface == *requirement
                        && composition.members.contains(&link.provider)
                })
            })
        })
    })
}

/// "Minimal: every member other than the goal provides some chosen link."
pub fn is_minimal(goal: &str, composition: &Composition) -> bool {
    composition
        .members
        .iter()
        .filter(|member| *member != goal)
        .all(|member| composition.links.iter().any(|link| link.provider == *member))
}

/// "Acyclic over its chosen links": the links can be taken away one after the other, each at a
/// time when no remaining link leads to its provider.
pub fn is_acyclic(composition: &Composition) -> bool {
    let mut links: Vec<&Link> = composition.links.iter().collect();
    while !links.is_empty() {
        let consumers: BTreeSet<&String> = links.iter().map(|link| &link.consumer).collect();
        let waiting: Vec<&Link> =
            links.iter().copied().filter(|link| consumers.contains(&link.provider)).collect();
        if waiting.len() == links.len() {
            return false;
        }
        links = waiting;
    }
    true
}

/// "The device switches are the chosen links whose two stations differ; distributed exactly when
/// there is at least one."
pub fn names_its_switches(services: &ServiceSet, composition: &Composition) -> bool {
    let expected = device_switches(services, composition.links.iter());
    composition.switches.iter().eq(expected.iter())
        && composition.distributed != expected.is_empty()
}

/// "All members named in one `same_station` list run on one station."
pub fn keeps_same_station(
    services: &ServiceSet,
    same_station: &[Vec<String>],
    composition: &Composition,
) -> bool {
    same_station.iter().all(|list| {
        let stations: BTreeSet<i64> = list
            .iter()
            .filter(|id| composition.members.contains(id))
            .filter_map(|id| services.get(id))
            .map(|service| service.station)
            .collect();
        stations.len() <= 1
    })
}

/// "Members named in `local_only` run on station 0."
pub fn keeps_local_only(
    services: &ServiceSet,
    local_only: &[String],
    composition: &Composition,
) -> bool {
    local_only
        .iter()
        .filter(|id| composition.members.contains(id))
        .filter_map(|id| services.get(id))
        .all(|service| service.station == CAV)
}

/// Provider and consumer of every link whose two stations differ, each pair once.
fn device_switches<'a>(
    services: &ServiceSet,
    links: impl Iterator<Item = &'a Link>,
) -> BTreeSet<(String, String)> {
    let station = |id: &str| services.get(id).map(|service| service.station);
    links
        .filter(|link| station(&link.provider) != station(&link.consumer))
        .map(|link| (link.provider.clone(), link.consumer.clone()))
        .collect()
}
