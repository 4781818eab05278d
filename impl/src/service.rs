//! Services, service sets and device switches (`spec/1-services.md#service`, `#device-switch`).

use core::fmt;

/// A service `(R, G, l)`: what it requires, what it guarantees, where it runs. The order of the
/// names means nothing.
#[derive(Clone, Copy, Debug)]
pub struct Service<'a> {
    /// The id, which no other service of its set has.
    pub id: &'a str,
    /// R: the required interfaces, possibly none, each once.
    pub requires: &'a [&'a str],
    /// G: the guaranteed interfaces, possibly none, each once.
    pub guarantees: &'a [&'a str],
    /// l: the station, >= 0; 0 is the CAV itself (I-01).
    pub station: i64,
}

impl Service<'_> {
    /// Whether some interface is guaranteed by this service and required by `consumer`. Source:
    /// `spec/1-services.md#device-switch`.
    pub fn feeds(&self, consumer: &Service<'_>) -> bool {
        self.guarantees.iter().any(|interface| consumer.requires.contains(interface))
    }

    /// Whether there is a device switch from this service to `consumer`. Source:
    /// `spec/1-services.md#device-switch`.
    pub fn device_switch(&self, consumer: &Service<'_>) -> bool {
        self.feeds(consumer) && self.station != consumer.station
    }
}

/// Two services are the same when their ids and stations are, and R and G as sets.
impl PartialEq for Service<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
            && self.station == other.station
            && same_set(self.requires, other.requires)
            && same_set(self.guarantees, other.guarantees)
    }
}

impl Eq for Service<'_> {}

/// A service set that keeps the rules.
#[derive(Clone, Copy, Debug)]
pub struct ServiceSet<'a> {
    services: &'a [Service<'a>],
}

impl<'a> ServiceSet<'a> {
    /// Checks `services` against the rules for one set, service by service in list order, the
    /// rules of each in the order of `ServiceRule`. Time: quadratic in services and names.
    ///
    /// Errors: the first service that breaks a rule. Source: `spec/1-services.md#service`.
    pub fn new(services: &'a [Service<'a>]) -> Result<Self, ServiceError<'a>> {
        if services.is_empty() {
            return Err(ServiceError { service: None, rule: ServiceRule::NotEmpty });
        }
        for (index, service) in services.iter().enumerate() {
            let repeated = services.iter().take(index).any(|other| other.id == service.id);
            if let Some(rule) = broken_rule(service, repeated) {
                return Err(ServiceError { service: Some(service.id), rule });
            }
        }
        Ok(Self { services })
    }

    /// The services in the order in which they were given.
    pub const fn services(&self) -> &'a [Service<'a>] {
        self.services
    }

    /// The service with this id.
    pub fn find(&self, id: &str) -> Option<&'a Service<'a>> {
        self.services.iter().find(|service| service.id == id)
    }

    /// Checks that the set may become `next`: the services of station 0 are the same, none more
    /// and none less; all others may come, go and change.
    ///
    /// Errors: the first service of station 0 that did not stay, in the order of this set; else
    /// the first that came, in the order of `next`. Source: `spec/1-services.md#service`.
    pub fn check_change(&self, next: &ServiceSet<'a>) -> Result<(), ServiceError<'a>> {
        let missing_in = |from: &ServiceSet<'a>, to: &ServiceSet<'a>| {
            let local = from.services.iter().filter(|service| service.station == 0);
            local.map(|service| (service, to.find(service.id))).find_map(|(service, found)| {
                if found == Some(service) { None } else { Some(service.id) }
            })
        };
        let (id, rule) = if let Some(id) = missing_in(self, next) {
            (id, ServiceRule::LocalStays)
        } else if let Some(id) = missing_in(next, self) {
            (id, ServiceRule::LocalDoesNotCome)
        } else {
            return Ok(());
        };
        Err(ServiceError { service: Some(id), rule })
    }

    /// Every pair `(j, k)` of the set with a device switch from j to k, in the order of j, then k.
    /// Source: `spec/1-services.md#device-switch`.
    pub fn device_switches(&self) -> impl Iterator<Item = (&'a Service<'a>, &'a Service<'a>)> {
        let services = self.services;
        services.iter().flat_map(move |provider| {
            let switched = services.iter().filter(|consumer| provider.device_switch(consumer));
            switched.map(move |consumer| (provider, consumer))
        })
    }
}

/// A rule of `spec/1-services.md#service`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ServiceRule {
    /// A service set holds at least one service.
    NotEmpty,
    /// No two services have the same id.
    UniqueId,
    /// R is a set: no name is listed twice.
    RequiresOnce,
    /// G is a set: no name is listed twice.
    GuaranteesOnce,
    /// A station is an integer >= 0.
    StationId,
    /// When the set changes, the services of station 0 stay as they are.
    LocalStays,
    /// When the set changes, only services of other stations come.
    LocalDoesNotCome,
}

/// A service set that breaks a rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ServiceError<'a> {
    /// The id of the service; `None` only for the empty set, which has none.
    pub service: Option<&'a str>,
    /// The rule that it breaks.
    pub rule: ServiceRule,
}

impl fmt::Display for ServiceError<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = match self.rule {
            ServiceRule::NotEmpty => "a service set must hold at least one service",
            ServiceRule::UniqueId => "no two services may have the same id",
            ServiceRule::RequiresOnce => "no interface may be listed twice in `requires`",
            ServiceRule::GuaranteesOnce => "no interface may be listed twice in `guarantees`",
            ServiceRule::StationId => "a station must be 0 (the CAV) or above",
            ServiceRule::LocalStays => "a service of station 0 must stay as it is",
            ServiceRule::LocalDoesNotCome => "only services of other stations may come",
        };
        match self.service {
            Some(id) => write!(f, "service `{id}`: {text}"),
            None => f.write_str(text),
        }
    }
}

impl core::error::Error for ServiceError<'_> {}

fn broken_rule(service: &Service<'_>, id_repeated: bool) -> Option<ServiceRule> {
    if id_repeated {
        Some(ServiceRule::UniqueId)
    } else if !all_once(service.requires) {
        Some(ServiceRule::RequiresOnce)
    } else if !all_once(service.guarantees) {
        Some(ServiceRule::GuaranteesOnce)
    } else if service.station < 0 {
        Some(ServiceRule::StationId)
    } else {
        None
    }
}

/// Whether no name is listed twice.
fn all_once(names: &[&str]) -> bool {
    let mut rest = names;
    while let [first, tail @ ..] = rest {
        if tail.contains(first) {
            return false;
        }
        rest = tail;
    }
    true
}

fn same_set(one: &[&str], other: &[&str]) -> bool {
    one.iter().all(|name| other.contains(name)) && other.iter().all(|name| one.contains(name))
}

#[cfg(test)]
mod tests {
    use super::{Service, ServiceError, ServiceRule, ServiceSet};

    const fn service<'a>(
        id: &'a str,
        requires: &'a [&'a str],
        guarantees: &'a [&'a str],
        station: i64,
    ) -> Service<'a> {
        Service { id, requires, guarantees, station }
    }

    const DETECTOR: Service<'static> = service("detector", &[], &["detections"], 0);
    const MOT: Service<'static> = service("mot", &["detections"], &["tracks"], 0);
    const MEC_MOT: Service<'static> = service("mec-mot", &["detections"], &["tracks"], 1);

    /// What a list of services is refused for.
    fn refused<'a>(services: &'a [Service<'a>]) -> Option<ServiceError<'a>> {
        ServiceSet::new(services).err()
    }

    /// What a change from one list to another is refused for.
    fn change_refused<'a>(
        from: &'a [Service<'a>],
        to: &'a [Service<'a>],
    ) -> Result<(), ServiceError<'a>> {
        ServiceSet::new(from)?.check_change(&ServiceSet::new(to)?)
    }

    /// `spec/1-services.md#service.1`: "The required interfaces R and the guaranteed interfaces G
    /// MUST each be a finite set, possibly empty, of named interfaces; a name listed twice is an
    /// error." The same name in R and in G is none.
    #[test]
    fn r_and_g_are_sets_possibly_empty() {
        assert_eq!(refused(&[service("a", &[], &[], 0)]), None);
        assert_eq!(refused(&[service("a", &["x", "y"], &["x", "y"], 0)]), None);
        assert_eq!(
            refused(&[DETECTOR, service("a", &["x", "y", "x"], &[], 0)]),
            Some(ServiceError { service: Some("a"), rule: ServiceRule::RequiresOnce })
        );
        assert_eq!(
            refused(&[DETECTOR, service("a", &[], &["y", "x", "x"], 0)]),
            Some(ServiceError { service: Some("a"), rule: ServiceRule::GuaranteesOnce })
        );
    }

    /// `spec/1-services.md#service.2`: "A service set MUST hold at least one service and MUST NOT
    /// hold two services with the same id."
    #[test]
    fn a_set_holds_at_least_one_service_and_no_id_twice() {
        assert_eq!(refused(&[]), Some(ServiceError { service: None, rule: ServiceRule::NotEmpty }));
        assert_eq!(refused(&[MOT, DETECTOR, MEC_MOT]), None);
        let twin = Service { id: "mot", ..MEC_MOT };
        assert_eq!(
            refused(&[MOT, DETECTOR, twin]),
            Some(ServiceError { service: Some("mot"), rule: ServiceRule::UniqueId })
        );
    }

    /// `spec/1-services.md`, the terms: a station is named by an integer id >= 0 (I-01).
    #[test]
    fn a_station_is_an_integer_from_0() {
        assert_eq!(refused(&[Service { station: i64::MAX, ..MOT }]), None);
        assert_eq!(
            refused(&[DETECTOR, Service { station: -1, ..MOT }]),
            Some(ServiceError { service: Some("mot"), rule: ServiceRule::StationId })
        );
    }

    /// `spec/1-services.md#service.3`: "When a service set changes over time, the services of
    /// station 0 MUST stay; only the services of other stations may come and go."
    #[test]
    fn services_of_station_0_stay_and_others_come_and_go() {
        assert_eq!(change_refused(&[DETECTOR, MOT], &[MOT, MEC_MOT, DETECTOR]), Ok(()));
        assert_eq!(change_refused(&[MEC_MOT, MOT], &[MOT]), Ok(()));
        let moved = Service { station: 2, ..MEC_MOT };
        assert_eq!(change_refused(&[MEC_MOT, MOT], &[MOT, moved]), Ok(()));
        let stays = |service| Err(ServiceError { service, rule: ServiceRule::LocalStays });
        assert_eq!(change_refused(&[DETECTOR, MOT], &[DETECTOR, MEC_MOT]), stays(Some("mot")));
        let left = Service { station: 1, ..MOT };
        assert_eq!(change_refused(&[DETECTOR, MOT], &[DETECTOR, left]), stays(Some("mot")));
        let altered = Service { guarantees: &["tracks", "ghosts"], ..MOT };
        assert_eq!(change_refused(&[DETECTOR, MOT], &[DETECTOR, altered]), stays(Some("mot")));
        assert_eq!(
            change_refused(&[DETECTOR], &[DETECTOR, MOT]),
            Err(ServiceError { service: Some("mot"), rule: ServiceRule::LocalDoesNotCome })
        );
    }

    /// `spec/1-services.md#service.4`: "A service set that breaks one of these rules MUST be
    /// refused with an error that names the service and the rule."
    #[test]
    fn the_error_names_the_first_service_and_its_first_rule() {
        let bad = service("a", &["x", "x"], &["y", "y"], -1);
        assert_eq!(
            refused(&[bad, bad]),
            Some(ServiceError { service: Some("a"), rule: ServiceRule::RequiresOnce })
        );
        assert_eq!(
            refused(&[service("a", &[], &[], 0), bad]),
            Some(ServiceError { service: Some("a"), rule: ServiceRule::UniqueId })
        );
    }

    /// `spec/1-services.md#device-switch`: "Service j feeds service k when some interface is in
    /// both `G_j` and `R_k`."
    #[test]
    fn feeds_is_a_shared_interface_in_this_direction() {
        assert!(DETECTOR.feeds(&MOT));
        assert!(!MOT.feeds(&DETECTOR));
        assert!(!MOT.feeds(&MEC_MOT), "the same requirements and guarantees feed nothing");
        assert!(service("a", &[], &["z", "detections"], 5).feeds(&MOT));
    }

    /// `spec/1-services.md#device-switch.1`: "Between two services a device switch from j to k MUST
    /// be reported exactly when j feeds k and their stations differ."
    #[test]
    fn a_device_switch_is_reported_exactly_when_j_feeds_k_and_stations_differ() {
        let env = service("env", &["tracks"], &[], 0);
        let mec_env = service("mec-env", &["tracks"], &[], 1);
        let services = [DETECTOR, MOT, MEC_MOT, env, mec_env];
        let expected = [("detector", "mec-mot"), ("mot", "mec-env"), ("mec-mot", "env")].as_slice();
        let set = ServiceSet::new(&services);
        let found = set.iter().flat_map(ServiceSet::device_switches);
        assert!(found.map(|(j, k)| (j.id, k.id)).eq(expected.iter().copied()));
    }
}
