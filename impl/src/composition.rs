//! Checks a given composition (`spec/1-services.md#composition`). Finding compositions is the
//! orchestrator's, which is not part of this crate.

mod error;

#[cfg(test)]
mod tests;

pub use self::error::CompositionError;

use crate::service::{Service, ServiceSet};

/// What a composition is for.
#[derive(Clone, Copy, Debug)]
pub struct Task<'a> {
    /// The services that are available.
    pub services: ServiceSet<'a>,
    /// The id of the goal service.
    pub goal: &'a str,
    /// Lists of ids: the members named in one list run on one station.
    pub same_station: &'a [&'a [&'a str]],
    /// Ids: members named here run on station 0.
    pub local_only: &'a [&'a str],
}

/// A chosen link: `provider` is picked to guarantee `interface` to `consumer`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Link<'a> {
    /// The id of the service that guarantees the interface.
    pub provider: &'a str,
    /// The interface.
    pub interface: &'a str,
    /// The id of the service that requires the interface.
    pub consumer: &'a str,
}

/// A switch from one station to another between two members.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Switch<'a> {
    /// The id of the service that provides.
    pub provider: &'a str,
    /// The id of the service on another station that consumes.
    pub consumer: &'a str,
}

/// A composition and what is said about it. The order of every list means nothing.
#[derive(Clone, Copy, Debug)]
pub struct Composition<'a> {
    /// The ids of the services that take part, each once.
    pub members: &'a [&'a str],
    /// The chosen links, one for each requirement of each member.
    pub links: &'a [Link<'a>],
    /// The device switches, each pair once although several interfaces may cross together.
    pub switches: &'a [Switch<'a>],
    /// Whether there is a device switch.
    pub distributed: bool,
}

/// Checks `composition` against every rule for `task`, in the order of `CompositionError`.
/// `scratch`: at least as many numbers as there are members, whatever their values. Time: members
/// and links times the services, and quadratic in members, links and switches.
///
/// Errors: the first rule that is broken, with what breaks it; too little scratch. Source:
/// `spec/1-services.md#composition`.
pub fn check<'a>(
    task: &Task<'a>,
    composition: &Composition<'a>,
    scratch: &mut [usize],
) -> Result<(), CompositionError<'a>> {
    let Some(pending) = scratch.get_mut(..composition.members.len()) else {
        let needed = composition.members.len();
        return Err(CompositionError::ScratchTooSmall { needed });
    };
    check_members(task, composition)?;
    check_links(task, composition)?;
    check_closed(task, composition)?;
    check_minimal(task, composition)?;
    check_same_station(task, composition)?;
    check_local_only(task, composition)?;
    check_acyclic(composition, pending)?;
    check_switches(task, composition)
}

/// The chosen links of `composition` whose two stations differ. Links between services that
/// `services` does not hold are none. Source: `spec/1-services.md#composition`.
pub fn switched_links<'a>(
    services: ServiceSet<'a>,
    composition: &Composition<'a>,
) -> impl Iterator<Item = Link<'a>> {
    let station = move |id: &str| services.find(id).map(|service| service.station);
    composition.links.iter().copied().filter(move |link| {
        let stations = (station(link.provider), station(link.consumer));
        matches!(stations, (Some(provider), Some(consumer)) if provider != consumer)
    })
}

fn check_members<'a>(
    task: &Task<'a>,
    composition: &Composition<'a>,
) -> Result<(), CompositionError<'a>> {
    if task.services.find(task.goal).is_none() {
        return Err(CompositionError::UnknownGoal { goal: task.goal });
    }
    let mut rest = composition.members;
    while let [member, tail @ ..] = rest {
        if task.services.find(member).is_none() {
            return Err(CompositionError::UnknownMember { member });
        }
        if tail.contains(member) {
            return Err(CompositionError::RepeatedMember { member });
        }
        rest = tail;
    }
    if composition.members.contains(&task.goal) {
        Ok(())
    } else {
        Err(CompositionError::GoalIsNoMember { goal: task.goal })
    }
}

/// Every link is between members and of an interface that one guarantees and the other requires,
/// and no requirement has two.
fn check_links<'a>(
    task: &Task<'a>,
    composition: &Composition<'a>,
) -> Result<(), CompositionError<'a>> {
    let mut rest = composition.links;
    while let [link, tail @ ..] = rest {
        let link = *link;
        let [Some(provider), Some(consumer)] =
            [link.provider, link.consumer].map(|id| member(task, composition, id))
        else {
            return Err(CompositionError::LinkOfNoMember { link });
        };
        if !provider.guarantees.contains(&link.interface) {
            return Err(CompositionError::NotGuaranteed { link });
        }
        if !consumer.requires.contains(&link.interface) {
            return Err(CompositionError::NotRequired { link });
        }
        if tail.iter().any(|other| meets(other, link.consumer, link.interface)) {
            let (service, requirement) = (link.consumer, link.interface);
            return Err(CompositionError::ProvidedTwice { service, requirement });
        }
        rest = tail;
    }
    Ok(())
}

fn check_closed<'a>(
    task: &Task<'a>,
    composition: &Composition<'a>,
) -> Result<(), CompositionError<'a>> {
    for service in members(task, composition) {
        let mut requirements = service.requires.iter().copied();
        let open = requirements
            .find(|name| !composition.links.iter().any(|link| meets(link, service.id, name)));
        if let Some(requirement) = open {
            return Err(CompositionError::NotClosed { service: service.id, requirement });
        }
    }
    Ok(())
}

fn check_minimal<'a>(
    task: &Task<'a>,
    composition: &Composition<'a>,
) -> Result<(), CompositionError<'a>> {
    let provides = |id: &str| composition.links.iter().any(|link| link.provider == id);
    let mut others = composition.members.iter().copied().filter(|&id| id != task.goal);
    match others.find(|id| !provides(id)) {
        Some(member) => Err(CompositionError::NotMinimal { member }),
        None => Ok(()),
    }
}

fn check_same_station<'a>(
    task: &Task<'a>,
    composition: &Composition<'a>,
) -> Result<(), CompositionError<'a>> {
    for list in task.same_station {
        let mut named = members(task, composition).filter(|service| list.contains(&service.id));
        if let Some(first) = named.next() {
            if let Some(apart) = named.find(|service| service.station != first.station) {
                let (member, other) = (first.id, apart.id);
                return Err(CompositionError::SameStation { member, other });
            }
        }
    }
    Ok(())
}

fn check_local_only<'a>(
    task: &Task<'a>,
    composition: &Composition<'a>,
) -> Result<(), CompositionError<'a>> {
    let mut named = members(task, composition).filter(|it| task.local_only.contains(&it.id));
    match named.find(|service| service.station != 0) {
        Some(service) => Err(CompositionError::LocalOnly { member: service.id }),
        None => Ok(()),
    }
}

/// Takes away, one after another, members whose providers are all gone; in an acyclic composition,
/// and in no other, nobody is left. `pending`: the links into each member from those not gone.
fn check_acyclic<'a>(
    composition: &Composition<'a>,
    pending: &mut [usize],
) -> Result<(), CompositionError<'a>> {
    /// More links than there can be: this member is gone.
    const GONE: usize = usize::MAX;
    let (members, links) = (composition.members, composition.links);
    for (count, member) in pending.iter_mut().zip(members) {
        *count = links.iter().filter(|link| link.consumer == *member).count();
    }
    for _ in members {
        let free = pending.iter_mut().zip(members).find(|(count, _)| **count == 0);
        let Some((count, gone)) = free else { break };
        *count = GONE;
        for link in links.iter().filter(|link| link.provider == *gone) {
            let consumer = pending.iter_mut().zip(members).find(|(_, id)| **id == link.consumer);
            if let Some((count, _)) = consumer {
                *count = count.saturating_sub(1);
            }
        }
    }
    let mut left = pending.iter().zip(members).filter(|(count, _)| **count != GONE);
    match left.next() {
        Some((_, member)) => Err(CompositionError::Cyclic { member }),
        None => Ok(()),
    }
}

/// The named switches are those of the chosen links, each once, and `distributed` is whether
/// there is one.
fn check_switches<'a>(
    task: &Task<'a>,
    composition: &Composition<'a>,
) -> Result<(), CompositionError<'a>> {
    let is = |link: &Link<'a>, switch: &Switch<'a>| {
        (link.provider, link.consumer) == (switch.provider, switch.consumer)
    };
    let mut missing = switched_links(task.services, composition)
        .filter(|link| !composition.switches.iter().any(|switch| is(link, switch)));
    if let Some(link) = missing.next() {
        return Err(CompositionError::MissingSwitch { link });
    }
    let mut rest = composition.switches;
    while let [switch, tail @ ..] = rest {
        if tail.contains(switch) {
            return Err(CompositionError::RepeatedSwitch { switch: *switch });
        }
        if !switched_links(task.services, composition).any(|link| is(&link, switch)) {
            return Err(CompositionError::NoSwitch { switch: *switch });
        }
        rest = tail;
    }
    if composition.distributed == composition.switches.is_empty() {
        return Err(CompositionError::Distributed { named: composition.distributed });
    }
    Ok(())
}

/// The services that are members, in the order of the members.
fn members<'a>(
    task: &Task<'a>,
    composition: &Composition<'a>,
) -> impl Iterator<Item = &'a Service<'a>> {
    let services = task.services;
    composition.members.iter().filter_map(move |id| services.find(id))
}

fn member<'a>(task: &Task<'a>, composition: &Composition<'a>, id: &str) -> Option<&'a Service<'a>> {
    if composition.members.contains(&id) { task.services.find(id) } else { None }
}

/// Whether `link` is the choice for this requirement of this consumer.
fn meets(link: &Link<'_>, consumer: &str, requirement: &str) -> bool {
    link.consumer == consumer && link.interface == requirement
}
