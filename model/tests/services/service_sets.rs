//! `spec/1-services.md#service` and `spec/1-services.md#device-switch`.

use mufasa_model::services::service::{Service, ServiceError, ServiceRule, ServiceSet};

use crate::service;

fn refused(list: Vec<Service>) -> ServiceError {
    ServiceSet::new(list).expect_err("the set breaks a rule")
}

fn error(service: &str, index: Option<usize>, rule: ServiceRule) -> ServiceError {
    ServiceError { service: Some(service.to_owned()), index, rule }
}

/// SVC-01
#[test]
fn required_and_guaranteed_interfaces_are_finite_sets_possibly_empty() {
    assert!(ServiceSet::new(vec![service("a", "", "", 0)]).is_ok());
    assert!(ServiceSet::new(vec![service("a", "x y", "x y z", 0)]).is_ok());
}

/// SVC-02
#[test]
fn a_name_listed_twice_is_an_error() {
    let twice = refused(vec![service("a", "", "", 0), service("b", "x y x", "", 0)]);
    assert_eq!(twice, error("b", Some(1), ServiceRule::RequirementTwice("x".into())));
    let twice = refused(vec![service("a", "x", "y z z y", 0)]);
    assert_eq!(twice, error("a", Some(0), ServiceRule::GuaranteeTwice("z".into())));
}

/// SVC-03
#[test]
fn a_service_set_holds_at_least_one_service() {
    let empty = refused(vec![]);
    assert_eq!(empty, ServiceError { service: None, index: None, rule: ServiceRule::EmptySet });
}

/// SVC-04
#[test]
fn a_service_set_does_not_hold_two_services_with_the_same_id() {
    let twice =
        refused(vec![service("a", "", "", 0), service("b", "", "", 0), service("a", "", "x", 1)]);
    assert_eq!(twice, error("a", Some(2), ServiceRule::IdTwice));
}

/// `spec/1-services.md` (terms): a station is an integer id >= 0.
/// I-01
#[test]
fn a_station_is_not_negative() {
    assert_eq!(
        refused(vec![service("a", "", "", -1)]),
        error("a", Some(0), ServiceRule::NegativeStation(-1))
    );
}

/// SVC-05
#[test]
fn when_a_set_changes_the_services_of_station_0_stay() {
    let local = || service("mot", "detections", "tracks extra", 0);
    let set = ServiceSet::new(vec![local(), service("far", "", "", 1)]).expect("valid");

    let left = set.evolve(vec![service("far", "", "", 1)]);
    assert_eq!(left, Err(error("mot", None, ServiceRule::LocalServiceLeft)));
    let moved = set.evolve(vec![service("mot", "detections", "tracks extra", 1)]);
    assert_eq!(moved, Err(error("mot", Some(0), ServiceRule::LocalServiceLeft)));
    let changed = set.evolve(vec![service("mot", "detections", "tracks", 0)]);
    assert_eq!(changed, Err(error("mot", Some(0), ServiceRule::LocalServiceLeft)));

    let reordered = set.evolve(vec![service("mot", "detections", "extra tracks", 0)]);
    assert!(reordered.is_ok(), "guarantees are a set");
}

/// SVC-05
#[test]
fn only_the_services_of_other_stations_come_and_go() {
    let local = || service("mot", "", "", 0);
    let set = ServiceSet::new(vec![local(), service("far", "", "", 1)]).expect("valid");

    let next = set.evolve(vec![service("new", "", "", 2), local()]).expect("remote ones may");
    assert_eq!(next.ids().collect::<Vec<_>>(), ["mot", "new"]);
    let gone = next.evolve(vec![local()]).expect("all remote ones may go");
    assert_eq!(gone.ids().collect::<Vec<_>>(), ["mot"]);

    let came = set.evolve(vec![local(), service("env", "", "", 0)]);
    assert_eq!(came, Err(error("env", Some(1), ServiceRule::LocalServiceCame)));
    let became_local = set.evolve(vec![local(), service("far", "", "", 0)]);
    assert_eq!(became_local, Err(error("far", Some(1), ServiceRule::LocalServiceCame)));
}

/// SVC-06
#[test]
fn a_refused_set_names_the_service_and_the_rule() {
    for (list, service_id, rule) in [
        (vec![service("s7", "x x", "", 0)], "s7", "requires `x` twice"),
        (vec![service("s7", "", "y y", 0)], "s7", "guarantees `y` twice"),
        (vec![service("s7", "", "", 0), service("s7", "", "", 1)], "s7", "id is used twice"),
        (vec![service("s7", "", "", -3)], "s7", "station -3"),
        (vec![], "", "empty"),
    ] {
        let text = refused(list).to_string();
        assert!(text.contains(service_id) && text.contains(rule), "{text}");
    }
    let set = ServiceSet::new(vec![service("s7", "", "", 0)]).expect("valid");
    let came = set.evolve(vec![service("s7", "", "", 0), service("s8", "", "", 0)]);
    assert!(came.expect_err("a local service came").to_string().contains("`s8`"));
    let left = set.evolve(vec![service("s8", "", "", 1)]);
    assert!(left.expect_err("a local service left").to_string().contains("`s7`"));
}

/// `spec/1-services.md#device-switch`
#[test]
fn a_service_feeds_another_when_an_interface_is_guaranteed_and_required() {
    let mot = service("mot", "detections", "tracks", 0);
    let env = service("env", "map tracks", "environment", 0);
    assert!(mot.feeds(&env) && !env.feeds(&mot) && !mot.feeds(&mot));
}

/// SWITCH-01: every pair of feeding or not, same station or not.
#[test]
fn a_device_switch_is_reported_exactly_when_one_feeds_the_other_and_stations_differ() {
    for (guarantee, feeds) in [("tracks", true), ("lanes", false)] {
        for station in [0, 1, 2] {
            let far = service("far", "", guarantee, station);
            let near = service("near", "tracks", "", 0);
            let expected = feeds && station != 0;
            assert_eq!(far.switches_to(&near), expected);
            let set = ServiceSet::new(vec![near, far]).expect("valid");
            let pair = ("far".to_owned(), "near".to_owned());
            assert_eq!(set.device_switches(), if expected { vec![pair] } else { vec![] });
        }
    }
}
