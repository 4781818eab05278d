//! `spec/1-services.md#service` and `spec/1-services.md#device-switch`.

use mufasa_model::services::service::ServiceRule::{self, LocalServiceCame, LocalServiceLeft};
use mufasa_model::services::service::{Service, ServiceSet};

use crate::service;

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

/// SVC-05
#[test]
fn services_of_the_cav_stay_and_those_of_stations_come_and_go() {
    let own = service("own", "", "map", 0);
    let [far, farther] = [1, 2].map(|station| service("far", "", "tracks", station));
    let set = ServiceSet::new(vec![own.clone(), far.clone()]).expect("valid");
    let next = |list: Vec<Service>| -> Result<(), ServiceRule> {
        set.evolve(list).map(drop).map_err(|error| error.rule)
    };
    assert_eq!(next(vec![own.clone()]), Ok(()));
    assert_eq!(next(vec![own.clone(), farther]), Ok(()));
    assert_eq!(next(vec![own.clone(), far.clone(), service("new", "", "", 2)]), Ok(()));
    assert_eq!(next(vec![far.clone()]), Err(LocalServiceLeft));
    assert_eq!(next(vec![service("own", "", "lanes", 0), far.clone()]), Err(LocalServiceLeft));
    assert_eq!(next(vec![own.clone(), far, service("new", "", "", 0)]), Err(LocalServiceCame));
    assert_eq!(next(vec![own, service("far", "", "tracks", 0)]), Err(LocalServiceCame));
}
