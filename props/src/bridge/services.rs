//! Services and compositions to the implementation's types, and what it says about them.

use mufasa::composition as twin;
use mufasa::service as twin_service;
use mufasa_model::composition::{Composition, Link};
use mufasa_model::orchestrator::Task;
use mufasa_model::service::{Service, ServiceRule};

/// A broken rule as both crates name it: the service and the kind of rule.
pub type BrokenRule = (Option<String>, &'static str);

/// The lists of one service, borrowed.
struct Names<'a> {
    requires: Vec<&'a str>,
    guarantees: Vec<&'a str>,
}

/// The implementation's verdict on a service set: the first service that breaks a rule.
pub fn check_services(list: &[Service]) -> Result<(), BrokenRule> {
    let names = names(list);
    let services = borrow(list, &names);
    twin_service::ServiceSet::new(&services).map(|_| ()).map_err(broken)
}

/// The implementation's verdict on the change from one service set to another.
pub fn check_change(before: &[Service], after: &[Service]) -> Result<(), BrokenRule> {
    let (names_before, names_after) = (names(before), names(after));
    let (before, after) = (borrow(before, &names_before), borrow(after, &names_after));
    let set = twin_service::ServiceSet::new(&before).map_err(broken)?;
    let next = twin_service::ServiceSet::new(&after).map_err(broken)?;
    set.check_change(&next).map_err(broken)
}

/// The device switches of a service set as the implementation sees them, sorted; `None` when it
/// is no set.
pub fn device_switches(list: &[Service]) -> Option<Vec<(String, String)>> {
    let names = names(list);
    let services = borrow(list, &names);
    let set = twin_service::ServiceSet::new(&services).ok()?;
    let pairs = set.device_switches();
    let mut pairs: Vec<_> = pairs.map(|(j, k)| (j.id.to_owned(), k.id.to_owned())).collect();
    pairs.sort();
    Some(pairs)
}

/// The implementation's verdict on a composition, with scratch of exactly the size it asks for;
/// the broken rule in words.
pub fn check_composition(task: &Task, composition: &Composition) -> Result<(), String> {
    let Task { services, goal, same_station, local_only } = task;
    let names = names(services);
    let services = borrow(services, &names);
    let services = twin_service::ServiceSet::new(&services).map_err(|error| error.to_string())?;
    let lists: Vec<Vec<&str>> = same_station.iter().map(|list| strs(list)).collect();
    let same_station: Vec<&[&str]> = lists.iter().map(Vec::as_slice).collect();
    let local_only = strs(local_only);
    let task = twin::Task { services, goal, same_station: &same_station, local_only: &local_only };
    let Composition { members, links, switches, distributed } = composition;
    let members = strs(members);
    let links: Vec<twin::Link<'_>> = links.iter().map(link).collect();
    let switches: Vec<twin::Switch<'_>> =
        switches.iter().map(|(provider, consumer)| twin::Switch { provider, consumer }).collect();
    let composition = twin::Composition {
        members: &members,
        links: &links,
        switches: &switches,
        distributed: *distributed,
    };
    let mut scratch = vec![usize::MAX; members.len()];
    twin::check(&task, &composition, &mut scratch).map_err(|error| error.to_string())
}

/// The kind of a rule of the model, by the name that `check_services` gives it.
pub fn rule_name(rule: &ServiceRule) -> &'static str {
    match rule {
        ServiceRule::EmptySet => "not_empty",
        ServiceRule::IdTwice => "unique_id",
        ServiceRule::RequirementTwice(_) => "requires_once",
        ServiceRule::GuaranteeTwice(_) => "guarantees_once",
        ServiceRule::NegativeStation(_) => "station_id",
        ServiceRule::LocalServiceLeft => "local_stays",
        ServiceRule::LocalServiceCame => "local_does_not_come",
    }
}

fn broken(error: twin_service::ServiceError<'_>) -> BrokenRule {
    let twin_service::ServiceError { service, rule } = error;
    let rule = match rule {
        twin_service::ServiceRule::NotEmpty => "not_empty",
        twin_service::ServiceRule::UniqueId => "unique_id",
        twin_service::ServiceRule::RequiresOnce => "requires_once",
        twin_service::ServiceRule::GuaranteesOnce => "guarantees_once",
        twin_service::ServiceRule::StationId => "station_id",
        twin_service::ServiceRule::LocalStays => "local_stays",
        twin_service::ServiceRule::LocalDoesNotCome => "local_does_not_come",
    };
    (service.map(str::to_owned), rule)
}

fn names(list: &[Service]) -> Vec<Names<'_>> {
    list.iter()
        .map(|service| Names {
            requires: strs(&service.requires),
            guarantees: strs(&service.guarantees),
        })
        .collect()
}

fn borrow<'a>(list: &'a [Service], names: &'a [Names<'a>]) -> Vec<twin_service::Service<'a>> {
    let pairs = list.iter().zip(names);
    pairs
        .map(|(service, names)| {
            let Service { id, requires: _, guarantees: _, station } = service;
            twin_service::Service {
                id,
                requires: &names.requires,
                guarantees: &names.guarantees,
                station: *station,
            }
        })
        .collect()
}

fn link(link: &Link) -> twin::Link<'_> {
    let Link { provider, interface, consumer } = link;
    twin::Link { provider, interface, consumer }
}

fn strs(names: &[String]) -> Vec<&str> {
    names.iter().map(String::as_str).collect()
}
