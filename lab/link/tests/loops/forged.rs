//! Somebody else talks: nobody signs anything, so what they say looks like a station's or a vehicle's.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

use mufasa::input::cycle::{Ego, TrajectoryPoint};
use mufasa::services::configuration::{Configuration, Group, Groups};
use mufasa_drives::{Options, demo};
use mufasa_link::message::{Message, Payload};
use mufasa_link::transport::{Address, MESSAGE_MAX};
use mufasa_model::offloading::requester::Parameters;

use super::world::{MS, START_NS, Seen, Somebody, World};

const VEHICLE: Address = Address::Vehicle(1);
const STATION: Address = Address::Station(1);

fn while_somebody(also: impl FnMut(i64, &mut Somebody) + 'static) -> Seen {
    let seen = World { also: Box::new(also), ..World::default() }.drive();
    println!("{:#?}\n{:#?}\n{:?}", seen.vehicle, seen.station, seen.changes);
    assert!(seen.vehicle.uncovered.is_empty(), "{:?}", seen.vehicle);
    assert!(seen.vehicle.used > 0);
    seen
}

#[test]
fn sessions_that_nobody_asked_for_change_nothing() {
    let seen = while_somebody(|ms, by| {
        if ms % 50 == 0 {
            for session in [0, 1, 1_000_000, i64::MAX] {
                let tracks = Payload::Tracks { session, stamp_ns: by.now_ns, tracks: vec![] };
                for payload in [
                    Payload::Confirm { group: Group::Plan, session },
                    Payload::Reject { group: Group::Mot, session },
                    tracks,
                ] {
                    by.say(VEHICLE, [1, 1], payload);
                }
            }
        }
    });
    assert!(seen.vehicle.offloaded >= 175, "{:?}", seen.vehicle);
    assert_eq!(seen.vehicle.left.keys().collect::<Vec<_>>(), ["end"]);
    let dropped = &seen.vehicle.traffic.dropped;
    assert!(dropped["tracks: not of the running session"] > 1_000, "{dropped:?}");
    // Each confirmation is answered with a release of the session that it names.
    assert!(seen.vehicle.traffic.sent["release"] > 1_000, "{:?}", seen.vehicle.traffic.sent);
}

/// Whoever can send as the station ends its session with a result from the future; it is not called late.
#[test]
fn a_result_from_the_future_ends_its_session_and_is_said_to() {
    let seen = somebody_sends_tracks_ahead(10 * MS);
    assert_eq!(seen.vehicle.left.get("from the future"), Some(&1), "{:?}", seen.vehicle.left);
    assert_eq!(seen.vehicle.left.get("late"), None, "{:?}", seen.vehicle.left);
    assert_eq!(seen.vehicle.traffic.dropped["tracks: generated after it arrived"], 1);
}

/// What was made after the time that a step was told, and came while it ran, is taken in the next step.
#[test]
fn a_result_that_is_made_while_the_vehicle_takes_others_is_none_from_the_future() {
    let seen = somebody_sends_tracks_ahead(MS);
    assert_eq!(seen.vehicle.left.get("from the future"), None, "{:?}", seen.vehicle.left);
    let dropped = &seen.vehicle.traffic.dropped;
    assert_eq!(dropped.get("tracks: generated after it arrived"), None, "{dropped:?}");
}

/// At 4.005 s, for each number that the first sessions have.
fn somebody_sends_tracks_ahead(ahead_ns: i64) -> Seen {
    while_somebody(move |ms, by| {
        if ms == 4_005 {
            for session in (1..=4).map(|number| START_NS + number) {
                let payload = Payload::Tracks { session, stamp_ns: by.now_ns, tracks: vec![] };
                let generated_ns = by.now_ns + ahead_ns;
                by.send(VEHICLE, &Message { sender: 1, receiver: 1, generated_ns, payload });
            }
        }
    })
}

#[test]
fn bytes_that_are_no_message_are_counted_and_change_nothing() {
    let seen = while_somebody(|ms, by| {
        let byte = u8::try_from(ms % 256).unwrap_or(0);
        for address in [VEHICLE, STATION] {
            by.shout(address, &[byte; 40][..usize::from(byte % 40)]);
            by.shout(address, &vec![byte; MESSAGE_MAX]);
        }
    });
    assert!(seen.vehicle.offloaded >= 180, "{:?}", seen.vehicle);
    assert_eq!(seen.vehicle.left.keys().collect::<Vec<_>>(), ["end"]);
    let count = |malformed: &BTreeMap<String, u64>| malformed.values().sum::<u64>();
    assert!(
        count(&seen.vehicle.traffic.malformed) > 30_000,
        "{:?}",
        seen.vehicle.traffic.malformed
    );
    assert!(
        count(&seen.station.traffic.malformed) > 30_000,
        "{:?}",
        seen.station.traffic.malformed
    );
}

#[test]
fn a_trajectory_in_the_running_session_that_leaves_the_road_is_caught_and_starts_the_hold() {
    let mut last = None;
    let seen = while_somebody(move |ms, by| {
        for payload in by.heard(VEHICLE) {
            if let Payload::Trajectory { session, stamp_ns, points } = payload {
                last = Some((session, stamp_ns, points));
            }
        }
        if let (4_090, Some((session, stamp_ns, points))) = (ms, last.clone()) {
            let aside = |it: TrajectoryPoint| TrajectoryPoint { y: it.y + 5.0, ..it };
            let points = points.into_iter().map(aside).collect();
            by.say(VEHICLE, [1, 1], Payload::Trajectory { session, stamp_ns, points });
        }
    });
    // Nothing tells that the station did not send it, but the stages do.
    assert_eq!(seen.vehicle.fallbacks, 1, "{:?}", seen.vehicle.unsafe_by_stage);
    assert_eq!(seen.vehicle.unsafe_by_stage.get("ii"), Some(&1));
    assert_eq!(seen.vehicle.left["unsafe"], 2);
    let t_wait_ms = Parameters::default().t_wait_ns / MS;
    let again = seen.offloaded_after(4_200);
    assert!(
        again.is_some_and(|ms| (4_000 + t_wait_ms..4_300 + t_wait_ms).contains(&ms)),
        "{again:?}"
    );
}

/// The next offer comes within half a second. Then the station is asked if its session was of use for nine
/// periods; if not, when what was missing has passed, too.
#[test]
fn a_withdrawal_that_is_forged_lasts_until_the_next_offer_or_for_nine_periods_less_the_use() {
    let clean = World::default().drive();
    let began = clean.offloaded_after(0).expect("offloaded");
    let ended = |at: i64| {
        let seen = while_somebody(move |ms, by| {
            if ms == at {
                by.say(VEHICLE, [1, 1], Payload::Withdraw);
            }
        });
        assert_eq!(seen.vehicle.left["withdrawn"], 2);
        let again = seen.offloaded_after(at).expect("offloaded again");
        println!("began {began}, withdrawn {at}, again {again}, {:?}", seen.holds);
        again
    };
    let again = ended(4_000);
    assert!((4_000..4_640).contains(&again), "{again}");
    let again = ended(began + 350);
    let of_use = 300;
    assert!((began + 350 + 900 - of_use..began + 350 + 1_040).contains(&again), "{again}");
}

#[test]
fn stations_that_are_made_up_fill_the_table_and_the_real_one_is_still_used() {
    let seen = while_somebody(|ms, by| {
        if ms >= 1_000 && ms % 10 == 0 {
            by.say(VEHICLE, [2 + ms, 0], Payload::Offer { groups: Groups::ALL });
        }
    });
    assert!(
        seen.vehicle.traffic.dropped["too many stations"] > 1_000,
        "{:?}",
        seen.vehicle.traffic.dropped
    );
    assert!(seen.vehicle.offloaded >= 180, "{:?}", seen.vehicle);
}

#[test]
fn who_takes_the_id_of_the_vehicle_ends_its_sessions_and_no_more() {
    let seen = while_somebody(|ms, by| {
        if (4_000..6_000).contains(&ms) && ms % 100 == 0 {
            for group in Group::ALL {
                let session = i64::MAX - 1;
                by.say(STATION, [1, 1], Payload::Request { group, session });
            }
        }
    });
    assert!(seen.vehicle.left["silent"] >= 2, "{:?}", seen.vehicle.left);
    // The vehicle is told of each session that it did not ask for, and releases it.
    assert!(seen.vehicle.traffic.sent["release"] >= 40, "{:?}", seen.vehicle.traffic.sent);
    assert_eq!(seen.at(7_500), Configuration::AllRemote, "{:?}", seen.changes);
}

#[test]
fn a_second_vehicle_is_served_beside_the_first() {
    let seen = while_somebody(|ms, by| {
        if ms >= 2_000 && ms % 100 == 0 {
            for group in Group::ALL {
                by.say(STATION, [2, 1], Payload::Request { group, session: 5 });
            }
            by.say(STATION, [2, 1], Payload::State { stamp_ns: by.now_ns, ego: at(1e4) });
            // What is meant for it is not for the first.
            by.say(VEHICLE, [1, 2], Payload::Withdraw);
        }
    });
    assert_eq!(seen.station.sessions, 4);
    assert!(
        seen.station.traffic.dropped["off the drive"] > 100,
        "{:?}",
        seen.station.traffic.dropped
    );
    assert!(
        seen.vehicle.traffic.dropped["for another"] > 100,
        "{:?}",
        seen.vehicle.traffic.dropped
    );
    assert_eq!(seen.vehicle.left.keys().collect::<Vec<_>>(), ["end"]);
    assert!(seen.vehicle.offloaded >= 180, "{:?}", seen.vehicle);
}

#[test]
fn results_are_sent_in_running_sessions_alone() {
    let answers = Rc::new(RefCell::new(BTreeMap::new()));
    let heard = Rc::clone(&answers);
    let place = demo(&Options::default()).unwrap().cycle(0).unwrap().cycle.ego;
    while_somebody(move |ms, by| {
        for payload in by.heard(Address::Vehicle(2)) {
            let answer = match payload {
                Payload::Tracks { session, .. } => ("tracks", session),
                Payload::Trajectory { session, .. } => ("trajectory", session),
                _ => continue,
            };
            *heard.borrow_mut().entry(answer).or_insert(0) += 1;
        }
        if ms % 100 == 0 {
            // MOT runs from 2 s on, PLAN never, whatever is asked in its name.
            if ms == 2_000 {
                by.say(STATION, [2, 1], Payload::Request { group: Group::Mot, session: 5 });
            }
            let ego = Ego { x: place.x, y: place.y, cos: place.cos, sin: place.sin, ..at(0.0) };
            for payload in [
                Payload::Alive { group: Group::Mot, session: 5 },
                Payload::Alive { group: Group::Plan, session: 6 },
                Payload::State { stamp_ns: by.now_ns, ego },
                Payload::Detections { stamp_ns: by.now_ns, ego, detections: vec![] },
            ] {
                by.say(STATION, [2, 1], payload);
            }
        }
    });
    let answers = answers.borrow();
    assert_eq!(answers.keys().collect::<Vec<_>>(), [&("tracks", 5)], "{answers:?}");
    assert!((160..=170).contains(&answers[&("tracks", 5)]), "{answers:?}");
}

/// A vehicle that stands somewhere.
fn at(x: f64) -> Ego {
    Ego { x, y: x, cos: 1.0, sin: 0.0, speed: 0.0, length: 4.5, width: 1.9, center_offset: 1.4 }
}

/// From one cycle to the next 46 messages are told the monitor, and 64 KiB are decoded. The first two cycles of the
/// drive are decided after 50 ms and 150 ms at the latest.
#[test]
fn a_flood_is_taken_little_by_little() {
    let flood = |until, bytes: Option<usize>| {
        let flood = move |ms: i64, by: &mut Somebody| {
            (0..200).filter(|_| ms == 0).for_each(|_| match bytes {
                Some(bytes) => by.shout(VEHICLE, &vec![0xff; bytes]),
                None => by.say(VEHICLE, [1, 1], Payload::Withdraw),
            });
        };
        let world = World { also: Box::new(flood), until, station: vec![], ..World::default() };
        let traffic = world.drive().vehicle.traffic;
        [traffic.malformed, traffic.received].iter().flat_map(BTreeMap::values).sum::<u64>()
    };
    for (bytes, in_a_cycle) in [(Some(16_384), 4), (Some(8_192), 8), (None, 46)] {
        assert_eq!(flood(3, bytes), in_a_cycle, "{bytes:?}");
        let later = flood(160, bytes);
        assert!((2 * in_a_cycle..=4 * in_a_cycle).contains(&later), "{bytes:?}: {later}");
    }
    // What costs nothing does not keep others away.
    assert_eq!([flood(3, Some(16_385)), flood(3, Some(40))], [200; 2]);
}
