//! Nothing is wrong: it is offloaded, and every cycle is safe.

use mufasa::services::configuration::Configuration;
use mufasa_model::input::cycle::Profile;

use crate::world::World;

#[test]
fn a_clean_drive_is_offloaded_from_its_first_second_to_its_end() {
    for profile in [Profile::Paper, Profile::Hardened] {
        let seen = World { profile, ..World::default() }.drive();
        let vehicle = &seen.vehicle;
        println!("{vehicle:#?} {:#?} {:?}", seen.station, seen.changes);
        assert_eq!(vehicle.cycles, 188, "every cycle of the drive");
        assert!(vehicle.offloaded >= 180, "{vehicle:?}");
        assert_eq!(vehicle.local + vehicle.safe, vehicle.cycles, "{vehicle:?}");
        assert!(vehicle.uncovered.is_empty() && vehicle.malformed.is_empty());
        assert!(vehicle.unsent.is_empty() && seen.station.unsent.is_empty());
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
