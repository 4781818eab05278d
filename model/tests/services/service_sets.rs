//! `spec/1-services.md#service` and `spec/1-services.md#device-switch`.

use mufasa_model::services::service::ServiceSet;

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
