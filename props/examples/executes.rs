//! Decides records of cycles and traces, one a line of standard input, by the implementation, and says nothing:
//! `scripts/coverage` counts what they execute.

use std::error::Error;
use std::io;

use mufasa::offloading::requester::{Requester, StationRecord};
use mufasa_props::bridge;
use mufasa_records::{Record, parse};

fn main() -> Result<(), Box<dyn Error>> {
    for line in io::stdin().lines() {
        match parse(line?.as_bytes(), 1) {
            // What is decided does not matter here.
            Ok(Record::Cycle { cycle, .. }) => drop(bridge::check_impl(&cycle)),
            Ok(Record::Offloading { trace, .. }) => {
                let mut table = [StationRecord::FREE; 16];
                let profile = bridge::profile_to_impl(trace.profile);
                let parameters = bridge::parameters_to_impl(&trace.parameters);
                let Ok(mut requester) = Requester::new(profile, parameters, &mut table) else {
                    continue;
                };
                for event in &trace.events {
                    let _actions = requester.step(&bridge::event_to_impl(event));
                }
            }
            Ok(Record::Monitor { .. } | Record::Composition { .. }) | Err(_) => {}
        }
    }
    Ok(())
}
