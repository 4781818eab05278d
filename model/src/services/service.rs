//! Services, sets of services, device switches (`spec/1-services.md#service`,
//! `spec/1-services.md#device-switch`; paper Def. 1 and Def. 2).

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// The station of the CAV itself (I-01).
pub const CAV: i64 = 0;

/// The tuple (R, G, l), with the id by which compositions name it.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Service {
    /// Name, unique in a set.
    pub id: String,
    /// R: names of required interfaces, each once, in any order.
    pub requires: Vec<String>,
    /// G: names of guaranteed interfaces, each once, in any order.
    pub guarantees: Vec<String>,
    /// l: the computing device, >= 0.
    pub station: i64,
}

impl Service {
    /// Whether this service feeds `consumer`: some interface is in both `G_j` and `R_k`.
    /// `spec/1-services.md#device-switch`.
    pub fn feeds(&self, consumer: &Self) -> bool {
        self.guarantees.iter().any(|interface| consumer.requires.contains(interface))
    }

    /// Whether there is a device switch from this service to `consumer`.
    /// `spec/1-services.md#device-switch`.
    pub fn switches_to(&self, consumer: &Self) -> bool {
        self.feeds(consumer) && self.station != consumer.station
    }

    /// Whether both are the same service; R and G are sets, their order says nothing.
    fn is(&self, other: &Self) -> bool {
        let set = |names: &[String]| names.iter().cloned().collect::<BTreeSet<_>>();
        self.id == other.id
            && self.station == other.station
            && set(&self.requires) == set(&other.requires)
            && set(&self.guarantees) == set(&other.guarantees)
    }
}

/// A set of available services, at least one, each id once. `spec/1-services.md#service`.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ServiceSet {
    services: BTreeMap<String, Service>,
}

impl ServiceSet {
    /// The set of the listed services. Errors: the first service of the list that breaks a rule.
    /// `spec/1-services.md#service`.
    pub fn new(list: Vec<Service>) -> Result<Self, ServiceError> {
        if list.is_empty() {
            return Err(ServiceError { service: None, index: None, rule: ServiceRule::EmptySet });
        }
        let mut services = BTreeMap::new();
        for (index, service) in list.into_iter().enumerate() {
            let broken = if services.contains_key(&service.id) {
                Some(ServiceRule::IdTwice)
            } else {
                first_broken_rule(&service)
            };
            if let Some(rule) = broken {
                return Err(ServiceError { service: Some(service.id), index: Some(index), rule });
            }
            services.insert(service.id.clone(), service);
        }
        Ok(Self { services })
    }

    /// The set that follows this one in time. Errors: those of [`ServiceSet::new`], then the first
    /// service of station 0 (by id) that left or changed, then the first (by id) that came.
    /// `spec/1-services.md#service`.
    pub fn evolve(&self, list: Vec<Service>) -> Result<Self, ServiceError> {
        let ids: Vec<String> = list.iter().map(|service| service.id.clone()).collect();
        let error = |service: &Service, rule| ServiceError {
            service: Some(service.id.clone()),
            index: ids.iter().position(|id| *id == service.id),
            rule,
        };
        let next = Self::new(list)?;
        for old in self.iter().filter(|service| service.station == CAV) {
            if !next.get(&old.id).is_some_and(|new| new.is(old)) {
                return Err(error(old, ServiceRule::LocalServiceLeft));
            }
        }
        for new in next.iter().filter(|service| service.station == CAV) {
            if self.get(&new.id).is_none_or(|old| old.station != CAV) {
                return Err(error(new, ServiceRule::LocalServiceCame));
            }
        }
        Ok(next)
    }

    /// The service of this id.
    pub fn get(&self, id: &str) -> Option<&Service> {
        self.services.get(id)
    }

    /// All services, by id.
    pub fn iter(&self) -> impl Iterator<Item = &Service> {
        self.services.values()
    }

    /// All ids, bytewise sorted.
    pub fn ids(&self) -> impl Iterator<Item = &str> {
        self.services.keys().map(String::as_str)
    }

    /// Every device switch (from, to) between two services of the set, sorted.
    /// `spec/1-services.md#device-switch`.
    pub fn device_switches(&self) -> Vec<(String, String)> {
        let mut switches = Vec::new();
        for j in self.iter() {
            for k in self.iter().filter(|k| j.switches_to(k)) {
                switches.push((j.id.clone(), k.id.clone()));
            }
        }
        switches
    }
}

/// A broken rule and the service that breaks it. `spec/1-services.md#service`.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ServiceError {
    /// Id of the service; `None` only for the empty set, which has no service to name.
    pub service: Option<String>,
    /// Its place in the list that was given; `None` when it is not in the list.
    pub index: Option<usize>,
    /// The rule.
    pub rule: ServiceRule,
}

/// The rules of a service set. `spec/1-services.md#service`.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum ServiceRule {
    /// A set holds at least one service.
    EmptySet,
    /// No two services have the same id.
    IdTwice,
    /// R names every interface once.
    RequirementTwice(String),
    /// G names every interface once.
    GuaranteeTwice(String),
    /// Stations are >= 0.
    NegativeStation(i64),
    /// The services of station 0 stay as they are.
    LocalServiceLeft,
    /// Only services of other stations may come.
    LocalServiceCame,
}

impl fmt::Display for ServiceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let id = self.service.as_deref().unwrap_or("");
        match &self.rule {
            ServiceRule::EmptySet => write!(f, "the service set is empty: give at least one"),
            ServiceRule::IdTwice => write!(f, "service `{id}`: the id is used twice: rename one"),
            ServiceRule::RequirementTwice(name) => {
                write!(f, "service `{id}`: requires `{name}` twice: list it once")
            }
            ServiceRule::GuaranteeTwice(name) => {
                write!(f, "service `{id}`: guarantees `{name}` twice: list it once")
            }
            ServiceRule::NegativeStation(station) => {
                write!(f, "service `{id}`: station {station} is below 0: number stations from 0")
            }
            ServiceRule::LocalServiceLeft => {
                write!(f, "service `{id}`: services of station 0 must stay as they are")
            }
            ServiceRule::LocalServiceCame => {
                write!(f, "service `{id}`: only services of other stations may come")
            }
        }
    }
}

impl std::error::Error for ServiceError {}

/// The first rule that a service breaks on its own.
fn first_broken_rule(service: &Service) -> Option<ServiceRule> {
    if let Some(name) = first_listed_twice(&service.requires) {
        return Some(ServiceRule::RequirementTwice(name));
    }
    if let Some(name) = first_listed_twice(&service.guarantees) {
        return Some(ServiceRule::GuaranteeTwice(name));
    }
    (service.station < CAV).then_some(ServiceRule::NegativeStation(service.station))
}

fn first_listed_twice(names: &[String]) -> Option<String> {
    let mut seen = BTreeSet::new();
    names.iter().find(|name| !seen.insert(*name)).cloned()
}
