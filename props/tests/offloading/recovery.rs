//! `spec/2-offloading.md#properties-of-the-whole-protocol`, no dead state: every combination of three
//! stations that confirm, reject or keep silent.

use mufasa_model::offloading::requester::{Action, Group, GroupState, Groups};

use crate::protocol::parameters;
use crate::{Cav, PROFILES, TICK, UNSAFE, confirm, data, offer, reject};

/// What a station does with a request.
#[derive(Clone, Copy, PartialEq)]
enum Manner {
    Confirms,
    Rejects,
    Silent,
}

/// `spec/2-offloading.md#properties-of-the-whole-protocol.4`: "if offers persist, some offering
/// station confirms, no fault occurs and the hold has ended, offloading is reached again": every
/// combination of three stations of which at least one confirms, after a fallback, three times.
#[test]
fn offloading_is_reached_again_whatever_the_other_stations_do() {
    let manners = [Manner::Confirms, Manner::Rejects, Manner::Silent];
    for profile in PROFILES {
        for combination in 0..27 {
            let stations =
                [combination % 3, combination / 3 % 3, combination / 9].map(|m| manners[m]);
            if !stations.contains(&Manner::Confirms) {
                continue;
            }
            let mut cav = Cav::new(profile, parameters());
            let mut now_ns = 0;
            for station in 1..=3 {
                cav.at(now_ns, offer(station, Groups::ALL));
            }
            for _ in 0..3 {
                cav.at(now_ns, UNSAFE);
                now_ns = cav.model().hold_until_ns().expect("a hold");
                reach_offloading(&mut cav, stations, now_ns);
            }
        }
    }
}

/// At most three stations a group, each at most a timeout (15 ns) and a tick that waits.
fn reach_offloading(cav: &mut Cav, stations: [Manner; 3], start_ns: i64) {
    let is_remote =
        |cav: &Cav, group| matches!(cav.model().state(group), GroupState::Remote { .. });
    for now_ns in start_ns..start_ns + 3 * 17 {
        for group in Group::ALL {
            if let GroupState::Remote { station, session } = cav.model().state(group) {
                assert_eq!(cav.at(now_ns, data(station, group, session, now_ns)), []);
            }
        }
        for action in cav.at(now_ns, TICK) {
            let Action::Request { station, group, session } = action else { continue };
            let place = usize::try_from(station - 1).expect("station 1 to 3");
            match stations[place] {
                Manner::Confirms => drop(cav.at(now_ns, confirm(station, group, session))),
                Manner::Rejects => drop(cav.at(now_ns, reject(station, group, session))),
                Manner::Silent => {}
            }
        }
    }
    assert!(Group::ALL.iter().all(|group| is_remote(cav, *group)), "a dead state");
}
