//! The hierarchical graph of a service set (paper Fig. 2): which service provides for which.

use std::collections::{BTreeMap, BTreeSet};

use mufasa_model::services::composition::Composition;
use mufasa_model::services::service::{CAV, ServiceSet};

/// Services and who provides for whom; the goal is node 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Graph {
    /// The services.
    pub nodes: Vec<Node>,
    /// One edge per pair of services, sorted.
    pub edges: Vec<Edge>,
}

/// A service.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Node {
    /// Its id.
    pub id: String,
    /// Where it runs.
    pub station: i64,
}

/// One service provides for another; both are indices of nodes.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Edge {
    /// Who provides.
    pub provider: usize,
    /// Who requires.
    pub consumer: usize,
    /// What, sorted.
    pub interfaces: Vec<String>,
    /// Whether the two run on different stations.
    pub switch: bool,
}

impl Graph {
    /// The members and links of all compositions together.
    pub fn of_compositions(
        services: &ServiceSet,
        goal: &str,
        compositions: &[Composition],
    ) -> Self {
        let mut links: Links<'_> = BTreeMap::new();
        for link in compositions.iter().flat_map(|composition| &composition.links) {
            links
                .entry((&link.provider, &link.consumer))
                .or_default()
                .insert(link.interface.as_str());
        }
        Self::new(services, goal, &links)
    }

    fn new(services: &ServiceSet, goal: &str, links: &Links<'_>) -> Self {
        let mut ids: BTreeSet<&str> = links.keys().flat_map(|(from, to)| [*from, *to]).collect();
        ids.remove(goal);
        let nodes: Vec<Node> = std::iter::once(goal)
            .chain(ids)
            .filter_map(|id| services.get(id))
            .map(|service| Node { id: service.id.clone(), station: service.station })
            .collect();
        let place: BTreeMap<&str, usize> =
            nodes.iter().enumerate().map(|(index, node)| (node.id.as_str(), index)).collect();
        let mut edges: Vec<Edge> = links
            .iter()
            .map(|((from, to), interfaces)| {
                let (provider, consumer) = (place[from], place[to]);
                Edge {
                    provider,
                    consumer,
                    interfaces: interfaces.iter().map(|name| String::from(*name)).collect(),
                    switch: nodes[provider].station != nodes[consumer].station,
                }
            })
            .collect();
        edges.sort();
        Self { nodes, edges }
    }
}

/// The name of a station in tables and legends (I-01).
pub fn station_name(station: i64) -> String {
    if station == CAV {
        String::from("station 0 (CAV)")
    } else {
        format!("station {station} (MEC)")
    }
}

/// Interfaces by provider and consumer.
type Links<'a> = BTreeMap<(&'a str, &'a str), BTreeSet<&'a str>>;
