//! The rules of `spec/1-services.md#composition` once more, on bit masks, by trying everything.
//! Shares nothing with the orchestrator.

use std::collections::BTreeSet;

use mufasa_model::services::composition::Composition;
use mufasa_model::services::orchestrator::{Answer, NoComposition, Rule, Task};

/// Indices of provider, name of the interface, index of the consumer.
type Arc = (usize, String, usize);

/// A choice by its members (bits) and its links (bits of the list of arcs), and what it breaks.
pub struct Found {
    members: u64,
    links: u64,
    /// Whether a chain of chosen links leads from every member to the goal.
    reaches_goal: bool,
    breaks: Vec<Rule>,
}

/// Every link that some choice could hold.
pub fn arcs(task: &Task) -> Vec<Arc> {
    let mut arcs = Vec::new();
    for (j, provider) in task.services.iter().enumerate() {
        for (k, consumer) in task.services.iter().enumerate() {
            for interface in &provider.guarantees {
                if consumer.requires.contains(interface) {
                    arcs.push((j, interface.clone(), k));
                }
            }
        }
    }
    arcs
}

/// All pairs of a set of members and a set of links that are a choice, closed and minimal: every
/// subset of links with every subset of members.
pub fn all(task: &Task) -> Vec<Found> {
    let arcs = arcs(task);
    let mut found = Vec::new();
    for members in 0..1_u64 << task.services.len() {
        for links in 0..1_u64 << arcs.len() {
            found.extend(examine(task, &arcs, members, links));
        }
    }
    found
}

/// The same with the only members that a closed and minimal choice can have: the goal and the
/// providers.
pub fn all_by_links(task: &Task) -> Vec<Found> {
    let arcs = arcs(task);
    let mut found = Vec::new();
    for links in 0..1_u64 << arcs.len() {
        let mut members = 1 << goal(task);
        for (bit, (provider, _, _)) in arcs.iter().enumerate() {
            members |= (links >> bit & 1) << provider;
        }
        found.extend(examine(task, &arcs, members, links));
    }
    found
}

/// The answer of `spec/5-interfaces.md#composition`.
pub fn answer(task: &Task, found: &[Found]) -> Answer {
    let arcs = arcs(task);
    let mut compositions: Vec<Composition> = found
        .iter()
        .filter(|found| found.breaks.is_empty())
        .map(|found| composition(task, &arcs, found))
        .collect();
    compositions.sort();
    let none = if compositions.is_empty() { Some(reason(task, found)) } else { None };
    Answer { compositions, none }
}

/// The number of closed choices.
pub fn closed_choices(found: &[Found]) -> usize {
    found.iter().filter(|found| found.reaches_goal).count()
}

fn goal(task: &Task) -> usize {
    task.services.iter().position(|service| service.id == task.goal).expect("the goal exists")
}

/// `None` unless the members hold the goal and the links are a choice, closed and minimal.
fn examine(task: &Task, arcs: &[Arc], members: u64, links: u64) -> Option<Found> {
    let is_member = |service: usize| members >> service & 1 == 1;
    let chosen: Vec<&Arc> =
        arcs.iter().enumerate().filter(|(bit, _)| links >> bit & 1 == 1).map(|(_, a)| a).collect();
    if !is_member(goal(task)) || chosen.iter().any(|(j, _, k)| !is_member(*j) || !is_member(*k)) {
        return None;
    }
    for (k, consumer) in task.services.iter().enumerate().filter(|(k, _)| is_member(*k)) {
        for requirement in &consumer.requires {
            if chosen.iter().filter(|(_, i, c)| *c == k && i == requirement).count() != 1 {
                return None;
            }
        }
        if k != goal(task) && !chosen.iter().any(|(j, _, _)| *j == k) {
            return None;
        }
    }
    // reach[j][k]: some chain of chosen links leads from j to k (Warshall).
    let n = task.services.len();
    let mut reach = vec![vec![false; n]; n];
    for (j, _, k) in &chosen {
        reach[*j][*k] = true;
    }
    for via in 0..n {
        for j in 0..n {
            for k in 0..n {
                reach[j][k] |= reach[j][via] && reach[via][k];
            }
        }
    }
    let mut breaks = Vec::new();
    if breaks_same_station(task, members) {
        breaks.push(Rule::SameStation);
    }
    if (0..n).any(|k| {
        let service = &task.services[k];
        is_member(k) && task.local_only.contains(&service.id) && service.station != 0
    }) {
        breaks.push(Rule::LocalOnly);
    }
    if (0..n).any(|k| reach[k][k]) {
        breaks.push(Rule::Acyclic);
    }
    let reaches_goal = (0..n).all(|k| !is_member(k) || k == goal(task) || reach[k][goal(task)]);
    Some(Found { members, links, reaches_goal, breaks })
}

fn breaks_same_station(task: &Task, members: u64) -> bool {
    let placed = |list: &Vec<String>| -> Vec<i64> {
        let named = |k: usize| members >> k & 1 == 1 && list.contains(&task.services[k].id);
        (0..task.services.len()).filter(|k| named(*k)).map(|k| task.services[k].station).collect()
    };
    task.same_station.iter().any(|list| placed(list).windows(2).any(|pair| pair[0] != pair[1]))
}

fn composition(task: &Task, arcs: &[Arc], found: &Found) -> Composition {
    let id = |k: usize| task.services[k].id.clone();
    let chosen = || arcs.iter().enumerate().filter(|(bit, _)| found.links >> bit & 1 == 1);
    let mut members: Vec<String> =
        (0..task.services.len()).filter(|k| found.members >> k & 1 == 1).map(id).collect();
    members.sort();
    let mut links: Vec<_> = chosen()
        .map(|(_, (j, interface, k))| mufasa_model::services::composition::Link {
            provider: id(*j),
            interface: interface.clone(),
            consumer: id(*k),
        })
        .collect();
    links.sort();
    let switches: BTreeSet<(String, String)> = chosen()
        .filter(|(_, (j, _, k))| task.services[*j].station != task.services[*k].station)
        .map(|(_, (j, _, k))| (id(*j), id(*k)))
        .collect();
    Composition {
        members,
        links,
        distributed: !switches.is_empty(),
        switches: switches.into_iter().collect(),
    }
}

fn reason(task: &Task, found: &[Found]) -> NoComposition {
    let mut reachable = BTreeSet::from([goal(task)]);
    loop {
        let more: BTreeSet<usize> =
            arcs(task).iter().filter(|a| reachable.contains(&a.2)).map(|a| a.0).collect();
        if more.is_subset(&reachable) {
            break;
        }
        reachable.extend(more);
    }
    let guaranteed = |name: &String| task.services.iter().any(|s| s.guarantees.contains(name));
    let missing: BTreeSet<(String, String)> = reachable
        .iter()
        .flat_map(|k| task.services[*k].requires.iter().map(|r| (r.clone(), *k)))
        .filter(|(requirement, _)| !guaranteed(requirement))
        .map(|(requirement, k)| (requirement, task.services[k].id.clone()))
        .collect();
    if let Some((requirement, service)) = missing.into_iter().next() {
        return NoComposition::Requirement { requirement, service };
    }
    for rule in Rule::ALL {
        if found.iter().any(|found| found.breaks.iter().all(|broken| *broken == rule)) {
            return NoComposition::Rule(rule);
        }
    }
    let some = |rule: &Rule| found.iter().any(|f| f.reaches_goal && f.breaks.contains(rule));
    NoComposition::Rule(Rule::ALL.into_iter().find(some).expect("a closed choice breaks a rule"))
}
