//! How long an urban cycle takes the oracle: W1 of `benches/`, with 30 tracks, 40 detections, three earlier lists, 50
//! points and a grid of 600 x 600 cells, from the line to the answer, in all three readings.

use std::time::Instant;

use mufasa::input::profile::Profile;
use mufasa::services::configuration::Configuration::{AllRemote, MotRemote, PlanRemote};
use mufasa_benches::workload::{SIZES, Variant, Workload};
use mufasa_props::bridge;
use mufasa_records::{Answer, answer, cycle_to_line};

/// Shows the time; a clock decides nothing here. What is asserted is that no cycle is cheap because it fails early.
#[test]
fn an_urban_cycle_goes_through_all_stages() {
    let urban = Workload::new(&SIZES[0], Variant::Pass);
    for profile in [Profile::PAPER, Profile::HARDENED] {
        for configuration in [MotRemote, AllRemote, PlanRemote] {
            let cycle = bridge::from_impl(&urban.cycle(profile, configuration));
            let line = cycle_to_line("urban", &cycle);
            let times = (0..5).map(|_| {
                let begun = Instant::now();
                let found = answer(line.as_bytes(), 1);
                let time = begun.elapsed();
                let Answer::Cycle(found) = found else { panic!("{found:?}") };
                assert_eq!(found.failed_stage, None, "{profile:?} {configuration:?} {found:?}");
                time
            });
            let least = times.min().unwrap_or_default();
            println!("{profile:?} {configuration:?}: {least:?}, the least of 5");
        }
    }
}
