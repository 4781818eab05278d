//! On sequences of events and cycles the monitor answers as its exact model.
#![no_main]

use mufasa_model::input::profile::Profile;
use mufasa_props::strategy::monitor::{Script, route};
use mufasa_props::{bridge::lent, refine::Monitors};

libfuzzer_sys::fuzz_target!(|input: (bool, Vec<u32>)| {
    let profile = if input.0 { Profile::HARDENED } else { Profile::PAPER };
    let (mut script, settings) = Script::new(&input.1, profile);
    let mut lent = lent(&settings);
    let mut pair = Monitors::new(&settings, route(), &mut lent).unwrap().unwrap();
    for _ in 0..60 {
        let event = script.event();
        script.take(&event, &pair.step(&event).unwrap());
    }
});
