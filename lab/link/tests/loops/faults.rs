//! What happens to messages, stations and vehicles; each ends as the spec says, and is offloaded again.

use std::cell::RefCell;
use std::rc::Rc;

use mufasa::services::configuration::Configuration;
use mufasa_link::message::Payload;
use mufasa_link::transport::Address;
use mufasa_model::offloading::requester::Parameters;

use super::world::{MS, Seen, Somebody, World};

/// What must hold whatever happens.
fn holds(seen: &Seen) {
    let vehicle = &seen.vehicle;
    println!("{vehicle:#?}\n{:#?}\n{:?}", seen.station, seen.changes);
    assert!(vehicle.uncovered.is_empty(), "{vehicle:?}");
    assert!(vehicle.used > 0 && vehicle.traffic.malformed.is_empty(), "{vehicle:?}");
    assert_eq!(vehicle.fallbacks, 0, "no cycle is unsafe: {vehicle:?}");
}

/// The longest hold that a fault leaves: nine times what passes until a session without use ends, 2 dt_max
/// and two periods, ms.
const LONGEST_HOLD: i64 = 9 * (2 * 150 + 2 * 100);

/// All is remote before a fault, and within a second after its end and that of the hold it leaves, ms.
fn offloaded_around(seen: &Seen, [from, to]: [i64; 2]) {
    assert_eq!(seen.at(from), Configuration::AllRemote, "{:?}", seen.changes);
    // What came before the end may leave a session to be starved.
    let of_fault = seen.holds.iter().filter(|(at, _)| *at <= to + 500).map(|(_, until)| *until);
    let free = of_fault.fold(to, i64::max);
    assert!(free <= to + 500 + LONGEST_HOLD, "{:?}", seen.holds);
    assert_eq!(seen.at(free + 1_000), Configuration::AllRemote, "{:?}", seen.changes);
}

#[test]
fn results_60_ms_late_end_their_sessions() {
    let seen = World { disturbances: vec!["delay=60@4..6"], ..World::default() }.drive();
    holds(&seen);
    offloaded_around(&seen, [3_900, 6_100]);
    // 60 ms are above l_max = 50 ms, and far below the time that a request has.
    assert!(seen.vehicle.left["late"] >= 2, "{:?}", seen.vehicle.left);
    let dropped = &seen.vehicle.traffic.dropped;
    assert!(dropped["tracks: latency above l_max"] >= 1, "{dropped:?}");
    assert!(dropped["trajectory: latency above l_max"] >= 1, "{dropped:?}");
    assert!(seen.vehicle.offloaded < 175, "{}", seen.vehicle.offloaded);
}

/// l_max allows it, and they are there when their cycle is decided: nothing is lost by it.
#[test]
fn results_49_ms_late_are_used() {
    let clean = World::default().drive();
    let seen = World { disturbances: vec!["delay=49@4..6"], ..World::default() }.drive();
    holds(&seen);
    assert_eq!(seen.vehicle.left.keys().collect::<Vec<_>>(), ["end"]);
    assert_eq!(seen.changes, clean.changes);
    assert_eq!(seen.vehicle.used, clean.vehicle.used);
}

/// The first result after a silence that no tick has seen yet ends the session as silent, not as late.
#[test]
fn a_result_after_a_silence_ends_its_session_as_silent() {
    let requester = Parameters { dt_max_ns: 101 * MS, ..Parameters::default() };
    let disturbances = vec!["delay=8@4..6"];
    let seen = World { disturbances, requester, ..World::default() }.drive();
    holds(&seen);
    let dropped = &seen.vehicle.traffic.dropped;
    assert!(dropped["tracks: more than dt_max after the last arrival"] >= 1, "{dropped:?}");
    assert_eq!(seen.vehicle.left.get("late"), None, "{:?}", seen.vehicle.left);
    assert!(seen.vehicle.left["silent"] >= 2, "{:?}", seen.vehicle.left);
}

#[test]
fn repeated_results_are_dropped_and_nothing_else_happens() {
    let seen = World { disturbances: vec!["duplicate@4..6"], ..World::default() }.drive();
    holds(&seen);
    assert!(
        (19..=21)
            .contains(&seen.vehicle.traffic.dropped["tracks: not newer than the last one used"]),
        "{:?}",
        seen.vehicle.traffic.dropped
    );
    assert_eq!(seen.vehicle.left.keys().collect::<Vec<_>>(), ["end"]);
    offloaded_around(&seen, [4_000, 5_000]);
}

#[test]
fn results_out_of_order_are_not_used() {
    let seen = World { disturbances: vec!["reorder@4..6"], ..World::default() }.drive();
    holds(&seen);
    offloaded_around(&seen, [3_900, 6_200]);
}

#[test]
fn a_cut_ends_the_sessions_by_silence_and_the_station_ends_them_by_their_lease() {
    let seen = World { disturbances: vec!["cut@4..7"], ..World::default() }.drive();
    holds(&seen);
    offloaded_around(&seen, [3_900, 7_000]);
    assert_eq!(seen.at(4_300), Configuration::Local, "{:?}", seen.changes);
    assert_eq!(seen.vehicle.left["silent"], 2, "{:?}", seen.vehicle.left);
    assert!(seen.vehicle.left["not confirmed"] >= 2, "{:?}", seen.vehicle.left);
}

#[test]
fn a_station_that_is_killed_is_left_and_used_again_when_it_is_back() {
    let away = World { station: vec![(0, 4_000), (9_000, i64::MAX)], ..World::default() };
    let seen = away.drive();
    holds(&seen);
    offloaded_around(&seen, [3_900, 9_000]);
    assert_eq!(seen.at(4_300), Configuration::Local, "{:?}", seen.changes);
    // From three seconds without an offer on nobody is asked any more.
    assert!(seen.vehicle.left["not confirmed"] <= 12, "{:?}", seen.vehicle.left);
}

#[test]
fn a_vehicle_that_is_killed_is_served_again_at_once_in_sessions_of_higher_numbers() {
    let asked = Rc::new(RefCell::new(Vec::new()));
    let heard = Rc::clone(&asked);
    let also = move |_: i64, by: &mut Somebody| {
        for payload in by.heard(Address::Station(1)) {
            if let Payload::Request { session, .. } = payload {
                heard.borrow_mut().push(session);
            }
        }
    };
    // The station still has its sessions: the new ones take their place.
    let seen = World { restarts: vec![4_050], also: Box::new(also), ..World::default() }.drive();
    holds(&seen);
    offloaded_around(&seen, [4_000, 4_050]);
    assert_eq!((seen.vehicle.drives, seen.station.sessions), (2, 2));
    let sessions = asked.borrow();
    assert_eq!(sessions.len(), 4);
    assert!(sessions.is_sorted_by(|a, b| a < b), "{sessions:?}");
}

/// The station is away for 400 ms every 7 s, and the vehicle started anew every 6.1 s: after each it is
/// offloaded again, when the hold that the loss of a session leaves has ended.
#[test]
fn two_killed_again_and_again_are_offloaded_again_and_use_nothing_that_is_not_covered() {
    let station: Vec<(i64, i64)> = (0..9).map(|i| (7_000 * i, 7_000 * i + 6_600)).collect();
    let restarts: Vec<i64> = (1..10).map(|i| 6_100 * i).collect();
    let kills = [station.iter().map(|it| it.0).collect::<Vec<_>>(), restarts.clone()].concat();
    let seen = World { station, restarts, until: 61_000, ..World::default() }.drive();
    holds(&seen);
    assert_eq!(seen.vehicle.drives, 10);
    for killed in kills {
        let again = seen.offloaded_after(killed).expect("offloaded again");
        assert!(again <= killed + LONGEST_HOLD + 1_500, "{killed}: {:?}", seen.changes);
    }
}

/// Both are killed at every ms of a period, and back at once: each time it is offloaded again within 1.5 s,
/// half a second of which the CAV looks around.
#[test]
fn killed_at_every_ms_of_a_period_they_are_offloaded_again() {
    let mut restarts: Vec<i64> = Vec::new();
    for i in 0..100 {
        restarts.push(restarts.last().copied().unwrap_or(0) + 1_600 + i);
    }
    let until = restarts.last().expect("many") + 2_000;
    let station = [vec![0], restarts.clone(), vec![until]].concat();
    let station = station.windows(2).map(|it| (it[0], it[1])).collect();
    let seen = World { station, restarts: restarts.clone(), until, ..World::default() }.drive();
    holds(&seen);
    assert_eq!(seen.vehicle.drives, 101);
    for killed in restarts {
        assert_eq!(seen.at(killed - 1), Configuration::AllRemote, "{killed}: {:?}", seen.changes);
        let again = seen.offloaded_after(killed).expect("offloaded again");
        assert!(again <= killed + 1_500, "{killed}: again at {again}");
    }
}
