//! Random cycles of every configuration, aimed at thresholds, always the same.

use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_model::services::configuration::Configuration;
use mufasa_props::strategy::draw::Draw;
use mufasa_props::strategy::{input, whole};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::vectors::book::{Asked, Book, Topic};
use crate::vectors::expected::Expected;
use mufasa_records::cycle_to_line;

/// Cycles per configuration.
const CYCLES: usize = 200;
/// Longest record that is taken, bytes.
const LONGEST: usize = 12_000;
/// Numbers that a generator reads.
const TAPE: usize = 256;

const CONFIGURATIONS: [(Configuration, &str, u64); 4] = [
    (Configuration::Local, "random/Local", 1),
    (Configuration::MotRemote, "random/MotRemote", 2),
    (Configuration::AllRemote, "random/AllRemote", 3),
    (Configuration::PlanRemote, "random/PlanRemote", 4),
];

/// Adds them.
pub fn add(book: &mut Book) {
    for (configuration, file, seed) in CONFIGURATIONS {
        let topic = Topic::new(file, "spec/4-arithmetic.md#conformance-of-an-implementation", None);
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut count = 0;
        while count < CYCLES {
            let profile = [Profile::PAPER, Profile::HARDENED][count % 2];
            let cycle = cycle(&mut random, profile, configuration);
            if cycle_to_line("", &cycle).len() > LONGEST {
                continue;
            }
            let note = "Drawn by the generators of the differential tests.";
            let name = format!("{count:03}");
            book.add(topic, (&name, note), Asked::Cycle(&cycle), &Expected::default());
            count += 1;
        }
    }
}

/// A cycle as the generators draw it; of the first few the one in this configuration.
fn cycle(random: &mut ChaCha8Rng, profile: Profile, configuration: Configuration) -> Cycle {
    let mut cycle = drawn(random, profile);
    for _ in 0..20 {
        if cycle.configuration == configuration {
            return cycle;
        }
        cycle = drawn(random, profile);
    }
    cycle.configuration = configuration;
    cycle
}

fn drawn(random: &mut ChaCha8Rng, profile: Profile) -> Cycle {
    let tape: Vec<u32> = (0..TAPE).map(|_| random.random()).collect();
    let mut draw = Draw::new(&tape);
    if draw.one_in(8) { input::cycle(&mut draw, profile) } else { whole::cycle(&mut draw, profile) }
}
