//! Cases from drives: their cycles in each configuration, and attacked.
//!
//! Every cycle is a case of its own. Where a drive does not say what the cycle before left, its
//! `previous_tracks` are what they would be if the whole clean drive had been judged by the exact
//! model in that configuration; what the program under test answered before has no part in it, so
//! that a case can be asked again alone. Under an attack they stay those of the clean drive.

use std::cell::OnceCell;
use std::path::PathBuf;

use mufasa_model::input::cycle::{Cycle, TrackList};
use mufasa_model::report::{Outcome, Reading};
use mufasa_model::services::configuration::Configuration;
use mufasa_model::stages::check;

use crate::cases::generate::mix;
use crate::error::ConformError;
use mufasa_drives::{
    self, Attack, Drive, DriveCycle, Injection, Options, PreviousTracks, ReadError, inject,
};

/// Cycles before an attacked one that are attacked, too.
const ATTACKED_BEFORE: usize = 10;

/// The configurations that a drive is taken in, its own first. Attacked drives keep theirs.
const CONFIGURATIONS: [Option<Configuration>; 3] =
    [None, Some(Configuration::MotRemote), Some(Configuration::PlanRemote)];

/// Variants of every cycle: in each configuration, under each attack.
const VARIANTS: usize = CONFIGURATIONS.len() + Attack::ALL.len();

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
                Ok(drive) => rides.push(Ride::new(drive)),
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

/// A drive with the lists that its cycles carry on.
#[derive(Clone, Debug)]
struct Ride {
    drive: Drive,
    /// For each of `CONFIGURATIONS` and each cycle: whose tracks are its `previous_tracks`.
    held: [OnceCell<Vec<Option<usize>>>; CONFIGURATIONS.len()],
}

impl Ride {
    fn new(drive: Drive) -> Self {
        Self { drive, held: Default::default() }
    }

    /// A variant of a cycle, with what it is called.
    fn variant(&self, index: usize, variant: usize) -> (String, Cycle) {
        let Drive { name, cycles, .. } = &self.drive;
        let found = &cycles[index];
        let name = format!("{name}#{}", found.id);
        match variant.checked_sub(CONFIGURATIONS.len()) {
            None => (name, self.clean(index, variant)),
            Some(attack) => {
                let attack = Attack::ALL[attack];
                let from = index.saturating_sub(ATTACKED_BEFORE);
                let mut part = Drive {
                    cycles: cycles[from..=index].to_vec(),
                    name: name.clone(),
                    source: String::new(),
                    previous_tracks: self.drive.previous_tracks,
                    notes: Vec::new(),
                };
                let clean = self.clean(index, 0);
                if let Some(last) = part.cycles.last_mut() {
                    last.cycle = clean.clone();
                }
                let injection = Injection { attack, from_s: 0.0, to_s: f64::INFINITY };
                // Where the attack changes nothing, or ends before this cycle, it is as it was.
                let attacked = inject(&part, &injection).ok();
                match attacked.and_then(|it| it.cycles.into_iter().nth(index - from)) {
                    Some(it) => (format!("{name}+{}", attack.name()), it.cycle),
                    None => (name, clean),
                }
            }
        }
    }

    /// A cycle in one of `CONFIGURATIONS`.
    fn clean(&self, index: usize, configuration: usize) -> Cycle {
        let mut cycle = taken_in(&self.drive.cycles[index].cycle, CONFIGURATIONS[configuration]);
        if self.drive.previous_tracks == PreviousTracks::Carried {
            let held = self.held[configuration]
                .get_or_init(|| held(&self.drive.cycles, CONFIGURATIONS[configuration]));
            cycle.previous_tracks = held[index].and_then(|at| self.tracks(at));
        }
        cycle
    }

    fn tracks(&self, index: usize) -> Option<TrackList> {
        self.drive.cycles[index].cycle.tracks.clone()
    }
}

/// For each cycle the one whose tracks are the last list that stage i passed in a safe cycle
/// (H-09), as the exact model judges the whole drive in this configuration.
fn held(cycles: &[DriveCycle], configuration: Option<Configuration>) -> Vec<Option<usize>> {
    let mut last: Option<usize> = None;
    let each = |(index, DriveCycle { cycle, .. }): (usize, &DriveCycle)| {
        let before = last;
        let mut cycle = taken_in(cycle, configuration);
        cycle.previous_tracks = before.and_then(|at| cycles[at].cycle.tracks.clone());
        let is_held = check(&cycle, Reading::Exact)
            .is_ok_and(|it| it.failed_stage.is_none() && it.stages[0] == Outcome::Passed);
        if is_held {
            last = Some(index);
        }
        before
    };
    cycles.iter().enumerate().map(each).collect()
}

fn taken_in(cycle: &Cycle, configuration: Option<Configuration>) -> Cycle {
    let configuration = configuration.unwrap_or(cycle.configuration);
    Cycle { configuration, ..cycle.clone() }
}

fn gcd(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { gcd(b, a % b) }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use mufasa_drives::check::judge::judge_drive;

    fn demo() -> Drive {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../drives/data/demo");
        let files = ["urban.xml", "urban.solution.xml"].map(|name| folder.join(name));
        let mut drives = mufasa_drives::read(&files, &Options::default());
        drives.remove(0).expect("the drive of the demo")
    }

    #[test]
    fn lists_are_carried_as_mufasa_check_carries_them() {
        // Rejected lists are not carried.
        let injection = Injection { attack: Attack::GhostTracks, from_s: 2.0, to_s: 3.0 };
        let attacked = inject(&demo(), &injection).expect("tracks are remote");
        for configuration in CONFIGURATIONS {
            let mut drive = attacked.clone();
            for it in &mut drive.cycles {
                it.cycle = taken_in(&it.cycle, configuration);
            }
            let ride = Ride::new(drive.clone());
            judge_drive(&mut drive, false, || ());
            for (index, judged) in drive.cycles.iter().enumerate() {
                assert_eq!(ride.clean(index, 0), judged.cycle, "{configuration:?} {index}");
            }
            let is_carried = |pair: &&[DriveCycle]| {
                pair[1].cycle.previous_tracks.is_some()
                    && pair[1].cycle.previous_tracks == pair[0].cycle.tracks
            };
            let carried = drive.cycles.windows(2).filter(is_carried).count();
            let all = drive.cycles.len() - 1;
            if configuration == Some(Configuration::PlanRemote) {
                assert_eq!(carried, 0);
            } else {
                assert!((all - 15..all - 5).contains(&carried), "{carried} of {all}");
            }
        }
    }

    #[test]
    fn an_attack_leaves_the_list_of_the_clean_drive() {
        let ride = Ride::new(demo());
        let ghosts = Attack::ALL.iter().position(|it| *it == Attack::GhostTracks);
        let variant = CONFIGURATIONS.len() + ghosts.expect("an attack");
        let (name, attacked) = ride.variant(40, variant);
        let clean = ride.clean(40, 0);
        assert!(name.ends_with("+ghost-tracks"), "{name}");
        assert!(clean.previous_tracks.is_some() && attacked.tracks != clean.tracks);
        assert_eq!(attacked.previous_tracks, clean.previous_tracks);
    }
}
