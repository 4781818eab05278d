//! On sequences of events and cycles the monitor answers as its exact model.
#![no_main]

use mufasa_model::input::profile::Profile;
use mufasa_props::strategy::monitor::{Script, route};
use mufasa_props::{bridge::lent, refine::Monitors};

// A list of `arbitrary` ends behind each item with a chance of one half: too short for a script.
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let Some((first, words)) = bytes.split_first() else { return };
    let profile = if first & 1 == 0 { Profile::HARDENED } else { Profile::PAPER };
    let tape: Vec<u32> = words.as_chunks().0.iter().copied().map(u32::from_le_bytes).collect();
    let (mut script, settings) = Script::new(&tape, profile);
    let mut lent = lent(&settings);
    let mut pair = Monitors::new(&settings, route(), &mut lent).unwrap().unwrap();
    for _ in 0..60 {
        let event = script.event();
        script.take(&event, &pair.step(&event).unwrap());
    }
});
