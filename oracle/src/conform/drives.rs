//! Cases from drives: their cycles as they are, in the other configurations, and attacked.

use std::path::PathBuf;

use mufasa_model::configuration::Configuration;
use mufasa_model::cycle::Cycle;

use super::error::ConformError;
use super::generate::mix;
use crate::drive::{
    self, Attack, Drive, DriveCycle, Injection, Options, PreviousTracks, ReadError, inject,
};

/// Cycles before an attacked one that are attacked, too.
const ATTACKED_BEFORE: usize = 10;

/// The configurations that a drive is also taken in.
const OTHERS: [Configuration; 2] = [Configuration::MotRemote, Configuration::PlanRemote];

/// Variants of every cycle: as it is, in other configurations, under each attack.
const VARIANTS: usize = 1 + OTHERS.len() + Attack::ALL.len();

/// The cycles of drives, in an order that depends on the seed.
#[derive(Clone, Debug)]
pub struct Pool {
    drives: Vec<Drive>,
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
        let (mut drives, mut errors) = (Vec::new(), Vec::new());
        for read in drive::read(files, options) {
            match read {
                Ok(drive) => drives.push(with_previous_tracks(drive)),
                Err(error) => errors.push(error),
            }
        }
        let cycles: usize = drives.iter().map(|drive| drive.cycles.len()).sum();
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
        Ok((Self { drives, total, stride, start: mix(seed ^ 1) % total }, errors))
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
        for drive in &self.drives {
            let here = drive.cycles.len() * VARIANTS;
            if at < here {
                return variant(drive, at / VARIANTS, at % VARIANTS);
            }
            at -= here;
        }
        // `at` is below the sum of what the drives hold.
        variant(&self.drives[0], 0, 0)
    }
}

/// Every cycle is a case of its own, whatever became of the one before it: where `previous_tracks`
/// are to be carried, each takes the list of the cycle before it, as if that was safe. Under an
/// attack they stay true.
fn with_previous_tracks(mut drive: Drive) -> Drive {
    if drive.previous_tracks == PreviousTracks::Carried {
        let mut last = None;
        for DriveCycle { cycle, .. } in &mut drive.cycles {
            cycle.previous_tracks = last.replace(cycle.tracks.clone()).flatten();
        }
        drive.previous_tracks = PreviousTracks::AsGiven;
    }
    drive
}

fn variant(drive: &Drive, index: usize, variant: usize) -> (String, Cycle) {
    let found = &drive.cycles[index];
    let name = format!("{}#{}", drive.name, found.id);
    match variant.checked_sub(1) {
        None => (name, found.cycle.clone()),
        Some(other) if other < OTHERS.len() => {
            let mut cycle = found.cycle.clone();
            cycle.configuration = OTHERS[other];
            (name, cycle)
        }
        Some(other) => {
            let attack = Attack::ALL[other - OTHERS.len()];
            let from = index.saturating_sub(ATTACKED_BEFORE);
            let part = Drive {
                cycles: drive.cycles[from..=index].to_vec(),
                name: drive.name.clone(),
                source: String::new(),
                previous_tracks: drive.previous_tracks,
                notes: Vec::new(),
            };
            let injection = Injection { attack, from_s: 0.0, to_s: f64::INFINITY };
            // Where the attack changes nothing, or ends before this cycle, the cycle is as it was.
            let attacked = inject(&part, &injection).ok();
            match attacked.and_then(|it| it.cycles.into_iter().nth(index - from)) {
                Some(it) => (format!("{name}+{}", attack.name()), it.cycle),
                None => (name, found.cycle.clone()),
            }
        }
    }
}

fn gcd(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { gcd(b, a % b) }
}
