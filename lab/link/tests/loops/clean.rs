//! Nothing is wrong: it is offloaded, and every cycle is safe.

use mufasa::services::configuration::Configuration;
use mufasa_drives::{Options, demo};
use mufasa_link::play::Played;
use mufasa_link::run::settings;
use mufasa_link::transport::Address;
use mufasa_link::transport::channels::Hub;
use mufasa_link::vehicle::Vehicle;
use mufasa_link::vehicle::memory::lent;
use mufasa_link::vehicle::summary::Tally;
use mufasa_model::input::cycle::Profile;

use super::world::{MS, START_NS, World};

#[test]
fn a_clean_drive_is_offloaded_from_its_first_second_to_its_end() {
    for profile in [Profile::PAPER, Profile::HARDENED] {
        let seen = World { profile, ..World::default() }.drive();
        let vehicle = &seen.vehicle;
        println!("{vehicle:#?} {:#?} {:?}", seen.station, seen.changes);
        assert_eq!(vehicle.cycles, 188, "every cycle of the drive");
        assert!(vehicle.offloaded >= 180, "{vehicle:?}");
        assert_eq!(vehicle.local + vehicle.safe, vehicle.cycles, "{vehicle:?}");
        assert!(vehicle.uncovered.is_empty() && vehicle.traffic.malformed.is_empty());
        assert!(vehicle.traffic.unsent.is_empty() && seen.station.traffic.unsent.is_empty());
        assert_eq!(vehicle.fallbacks, 0);
        assert_eq!(
            vehicle.left.get("end"),
            Some(&2),
            "both sessions end with the drive: {vehicle:?}"
        );
        assert_eq!(vehicle.left.len(), 1, "{:?}", vehicle.left);
        assert!(seen.offloaded_after(0).is_some_and(|ms| ms < 1_000), "{:?}", seen.changes);
        assert_eq!(seen.changes.last().map(|(_, it)| *it), Some(Configuration::Local));
    }
}

#[test]
fn a_drive_waits_for_a_computer_that_is_late() {
    let played = Played::new(demo(&Options::default()).unwrap().collect().unwrap()).unwrap();
    let mut of_vehicle = Hub::default().join(Address::Vehicle(1));
    let (mut lent, mut tally) = (lent(&played), Tally::default());
    let settings = settings(&played, &World::default().requester);
    let vehicle =
        Vehicle::new(1, START_NS, &played, settings, &mut lent, &mut of_vehicle, &mut tally);
    let mut vehicle = vehicle.unwrap();
    // The first cycle is sensed 70 ms after the start and decided at 130 ms.
    for (ms, due_ms) in [(0, 70), (70, 130), (130, 130), (131, 170), (190, 230), (230, 230)] {
        let due = vehicle.step(START_NS + ms * MS).unwrap();
        assert_eq!(due, Some(START_NS + due_ms * MS), "at {ms} ms");
    }
    // Three seconds late: the cycle that is due is sensed now, and no other is left out.
    assert_eq!(vehicle.step(START_NS + 3_270 * MS).unwrap(), Some(START_NS + 3_330 * MS));
    assert_eq!(vehicle.step(START_NS + 3_330 * MS).unwrap(), Some(START_NS + 3_330 * MS));
    assert_eq!(vehicle.step(START_NS + 3_331 * MS).unwrap(), Some(START_NS + 3_370 * MS));
    drop(vehicle);
    assert_eq!((tally.summary().cycles, tally.summary().paused), (3, 1));
}
