//! Cases from drives: their cycles in each configuration, and attacked.
//!
//! Every cycle is a case of its own.

use std::path::PathBuf;

use mufasa_model::input::cycle::Cycle;
use mufasa_model::services::configuration::Configuration;

use crate::cases::generate::mix;
use crate::error::ConformError;
use mufasa_drives::{self, Attack, Drive, Injection, Options, ReadError, Stream, inject};

/// Cycles before an attacked one that are attacked, too.
const ATTACKED_BEFORE: usize = 10;

/// The configurations that a drive is taken in, its own first. Attacked drives keep theirs.
const CONFIGURATIONS: [Option<Configuration>; 3] =
    [None, Some(Configuration::MotRemote), Some(Configuration::PlanRemote)];

/// Variants of every cycle: in each configuration, under each attack.
const VARIANTS: usize = CONFIGURATIONS.len() + Attack::ON_DRIVES.len();

/// The cycles of drives, in an order that depends on the seed.
#[derive(Clone, Debug)]
pub struct Pool {
    rides: Vec<Ride>,
    total: u64,
    /// An odd stride and a start, which visit every case once.
    stride: u64,
    start: u64,
}

impl Pool {
    /// Reads the files; what cannot be read is returned beside the pool.
    /// Errors: there is no cycle in any of them.
    pub fn read(
        files: &[PathBuf],
        options: &Options,
        seed: u64,
    ) -> Result<(Self, Vec<ReadError>), ConformError> {
        let (mut rides, mut errors) = (Vec::new(), Vec::new());
        for read in mufasa_drives::read(files, options) {
            match read {
                Ok(drive) => rides.push(Ride { drive }),
                Err(error) => errors.push(error),
            }
        }
        let cycles: usize = rides.iter().map(|ride: &Ride| ride.drive.cycles.len()).sum();
        let total = (cycles * VARIANTS) as u64;
        if total == 0 {
            return Err(errors
                .into_iter()
                .next()
                .map_or(ConformError::NoCycles, |error| ConformError::Read(Box::new(error))));
        }
        let mut stride = mix(seed) % total;
        while gcd(stride, total) != 1 {
            stride = (stride + 1) % total.max(2);
        }
        Ok((Self { rides, total, stride, start: mix(seed ^ 1) % total }, errors))
    }

    /// How many different cases there are.
    pub fn total(&self) -> u64 {
        self.total
    }

    /// Case number `case`, with what it is called.
    pub fn cycle(&self, case: u64) -> (String, Cycle) {
        let wide = u128::from(case % self.total) * u128::from(self.stride);
        let at = (wide + u128::from(self.start)) % u128::from(self.total);
        let mut at = usize::try_from(at).unwrap_or(0);
        for ride in &self.rides {
            let here = ride.drive.cycles.len() * VARIANTS;
            if at < here {
                return ride.variant(at / VARIANTS, at % VARIANTS);
            }
            at -= here;
        }
        // `at` is below the sum of what the drives hold.
        self.rides[0].variant(0, 0)
    }
}

/// A drive, of which each cycle has variants.
#[derive(Clone, Debug)]
struct Ride {
    drive: Drive,
}

impl Ride {
    /// A variant of a cycle, with what it is called.
    fn variant(&self, index: usize, variant: usize) -> (String, Cycle) {
        let Drive { name, lead_range_m, cycles, .. } = &self.drive;
        let found = &cycles[index];
        let name = format!("{name}#{}", found.id);
        match variant.checked_sub(CONFIGURATIONS.len()) {
            None => (name, self.clean(index, variant)),
            Some(attack) => {
                let attack = Attack::ON_DRIVES[attack];
                let from = index.saturating_sub(ATTACKED_BEFORE);
                let mut part = Drive {
                    name: name.clone(),
                    source: String::new(),
                    lead_range_m: *lead_range_m,
                    cycles: cycles[from..=index].to_vec(),
                    notes: Vec::new(),
                };
                let clean = self.clean(index, 0);
                if let Some(last) = part.cycles.last_mut() {
                    last.cycle = clean.clone();
                }
                let injection = Injection { attack, from_s: 0.0, to_s: f64::INFINITY };
                // Where the attack changes nothing, or ends before this cycle, it is as it was.
                let attacked = inject(&Stream::from(part), &injection).ok();
                let reached = attacked.filter(|it| index - from < it.count());
                match reached.and_then(|it| it.cycle(index - from).ok()) {
                    Some(made) => (format!("{name}+{}", attack.name()), made.cycle),
                    None => (name, clean),
                }
            }
        }
    }

    /// A cycle in one of `CONFIGURATIONS`.
    fn clean(&self, index: usize, configuration: usize) -> Cycle {
        let cycle = &self.drive.cycles[index].cycle;
        let configuration = CONFIGURATIONS[configuration].unwrap_or(cycle.configuration);
        Cycle { configuration, ..cycle.clone() }
    }
}

fn gcd(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { gcd(b, a % b) }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    fn demo() -> Drive {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../drives/data/demo");
        let files = ["urban.xml", "urban.solution.xml"].map(|name| folder.join(name));
        let mut drives = mufasa_drives::read(&files, &Options::default());
        drives.remove(0).expect("the drive of the demo")
    }

    #[test]
    fn an_attack_leaves_the_history_of_the_clean_drive() {
        let ride = Ride { drive: demo() };
        let ghosts = Attack::ON_DRIVES.iter().position(|it| *it == Attack::GhostTracks);
        let variant = CONFIGURATIONS.len() + ghosts.expect("an attack");
        let (name, attacked) = ride.variant(40, variant);
        let clean = ride.clean(40, 0);
        assert!(name.ends_with("+ghost-tracks"), "{name}");
        assert_ne!(attacked.tracks, clean.tracks);
        assert_eq!(attacked.detection_history, clean.detection_history);
    }
}
